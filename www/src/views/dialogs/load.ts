// The dialogs, loaded when one is first opened. In the one-file page the build takes load.inline.ts instead.
export const loadDialogs = () => import('./dialogs')
