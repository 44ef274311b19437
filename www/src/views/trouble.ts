// What went wrong, in sentences. What was good stays.
import { el } from '../ui/dom'
import type { Session } from '../app/session'
import { text } from '../text'

export function troubleView(session: Session): HTMLElement {
  const list = el('ul')
  const element = el(
    'div',
    { id: 'trouble', role: 'alert', hidden: true },
    el('div', {}, el('strong', {}, text.trouble.title), list),
    el('button', { type: 'button', 'aria-label': text.trouble.dismiss, onclick: () => (element.hidden = true) }, '✕'),
  )
  session.on('trouble', messages => {
    element.hidden = messages.length === 0
    list.replaceChildren(...messages.map(message => el('li', {}, message)))
  })
  return element
}
