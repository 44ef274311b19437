// The paper's figures, loaded when they are first asked for. In the one-file page the build takes load.inline.ts instead.
export const loadFigures = () => import('./figures')
