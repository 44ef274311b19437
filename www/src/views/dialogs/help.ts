// The help dialog: what the page shows, its keys, and the version.
import { BRAKE } from '../../app/commands'
import type { Session } from '../../app/session'
import { text } from '../../text'
import { dialogsText } from '../../text/dialogs'
import { dialog } from '../../ui/dialog'
import { el } from '../../ui/dom'

const t = dialogsText.help

export function helpDialog(session: Session): HTMLDialogElement {
  return dialog(
    'help',
    t.title,
    el('p', {}, t.what),
    el('p', {}, t.threshold),
    el('p', {}, t.reading),
    el('p', {}, text.ring.hint(BRAKE)),
    el('table', {}, el('tbody', {}, ...t.keys.map(([key, what]) => el('tr', {}, el('td', {}, el('kbd', {}, key)), el('td', {}, what))))),
    el('p', { class: 'note' }, t.version(session.start.version, session.client.place)),
  )
}
