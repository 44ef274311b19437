// The dialogs of the page, by name: each is made when it is first opened.
import { filesDialog } from './files'
import { helpDialog } from './help'
import { shareDialog } from './share'

export const dialogs = { share: shareDialog, files: filesDialog, help: helpDialog }
