// What is loaded when it is first asked for. The one-file page takes later.inline.ts instead, in the same way as
// place.inline.ts.
export const loadFigures = () => import('./views/figures')
