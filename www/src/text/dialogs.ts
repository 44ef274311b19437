// The language of the dialogs; see index.ts for that of the page.
import { type DialogsDictionary, enDialogs } from './en_dialogs'

export const dialogsText: DialogsDictionary = enDialogs
