// The script of the page and of its worker: both run the same file, so that the core's JavaScript is loaded once. A worker has no
// document.
import { open } from './page'
import { answerPage } from './core/worker'

if (typeof document === 'undefined') answerPage()
else open()
