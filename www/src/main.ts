// The one script of the page. The worker runs the same script, so that the core's glue is loaded once only;
// what it finds tells which of the two it is.
import { open } from './page'
import { answerPage } from './core/worker'

if (typeof document === 'undefined') answerPage()
else open()
