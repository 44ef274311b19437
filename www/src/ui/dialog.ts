// A dialog with a title and a button that closes it; a click beside it closes it, too.
import { text } from '../text'
import { button, el } from './dom'

export function dialog(id: string, title: string, ...children: (Node | null)[]): HTMLDialogElement {
  const close = button({ 'aria-label': text.header.close, onclick: () => element.close() }, '✕')
  const element = el('dialog', { id, 'aria-labelledby': `${id}-title` }, el('header', {}, el('h2', { id: `${id}-title` }, title), close), ...children)
  element.addEventListener('click', event => {
    if (event.target === element) element.close()
  })
  return element
}
