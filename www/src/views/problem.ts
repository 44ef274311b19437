// Problems in sentences: what was refused, and why.
import { button, el } from '../ui/dom'
import type { Session } from '../app/session'
import { text } from '../text'

export function problemView(session: Session): HTMLElement {
  const list = el('ul')
  const element = el(
    'div',
    { id: 'trouble', role: 'alert', hidden: true },
    el('div', {}, el('strong', {}, text.problem.title), list),
    button({ 'aria-label': text.problem.dismiss, onclick: () => (element.hidden = true) }, '✕'),
  )
  session.on('problem', messages => {
    element.hidden = messages.length === 0
    list.replaceChildren(...messages.map(message => el('li', {}, message)))
  })
  return element
}
