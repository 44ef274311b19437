// The same for the one-file page: a page opened from disk may not import other files.
import * as dialogs from './dialogs'

export const loadDialogs = async () => dialogs
