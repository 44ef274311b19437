// Two views in one document: the laboratory and the paper's figures. The figures are loaded when they are first shown.
import { hashOf, type PageOptions } from '../app/url'
import { el } from '../ui/dom'
import { loadFigures } from './figures/load'
import type { Session } from '../app/session'
import { text } from '../text'

export interface Doors {
  /** The link to the other view. */
  readonly link: HTMLAnchorElement
  show(view: PageOptions['view']): Promise<void>
}

export function doors(session: Session, place: HTMLElement): Doors {
  let figures: HTMLElement | null = null
  let loaded = false
  let left = false
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
    if (!open()) {
      // The run goes on as it was left.
      if (left) session.play()
      left = false
      return
    }
    left ||= session.playing
    session.pause()
    figures ??= place.appendChild(el('main', { id: 'figures' }))
    if (loaded) return
    loaded = true
    try {
      const { figuresView } = await loadFigures()
      figures.replaceChildren(...(await figuresView(session)))
    } catch (e) {
      // Whoever comes back tries again.
      loaded = false
      const why = e instanceof Error ? e.message : String(e)
      figures.replaceChildren(el('p', { role: 'alert' }, `${text.trouble.title}: ${why}`))
    }
  }
  return { link, show }
}
