// Two views in one document: the laboratory and the paper's figures. The one that is not shown costs nothing.
import { hashOf, type PageOptions } from '../address'
import { el } from '../dom'
import type { Session } from '../session'
import { text } from '../text'
import { figuresView } from './figures'

export interface Doors {
  /** The link to the other view. */
  readonly link: HTMLAnchorElement
  show(view: PageOptions['view']): Promise<void>
}

export function doors(session: Session, place: HTMLElement): Doors {
  let figures: HTMLElement | null = null
  const open = () => document.body.dataset.view === 'figures'
  const link = el('a', { class: 'button', id: 'open-figures', href: '#view=figures' }, text.header.figures)
  link.addEventListener('click', event => {
    // By hand: in a srcdoc frame a link to # leads to the page around it.
    event.preventDefault()
    location.hash = hashOf(session.snapshot.link, open() ? 'lab' : 'figures')
  })
  const show = async (view: PageOptions['view']) => {
    if (view) document.body.dataset.view = view
    link.textContent = open() ? text.header.lab : text.header.figures
    link.href = open() ? '#view=lab' : '#view=figures'
    if (!open()) return
    session.pause()
    if (figures) return
    figures = el('main', { id: 'figures' })
    place.append(figures)
    figures.replaceChildren(...(await figuresView(session)))
  }
  return { link, show }
}
