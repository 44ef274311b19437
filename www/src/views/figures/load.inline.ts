// The same for the one-file page: a page opened from disk may not import other files.
import * as figures from './figures'

export const loadFigures = async () => figures
