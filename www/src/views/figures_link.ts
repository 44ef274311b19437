// The link between the two views of the page, the laboratory and the paper's figures. The figures are loaded when they are
// first shown.
import { hashOf, type PageOptions } from '../app/url'
import { el } from '../ui/dom'
import { loadFigures } from './figures/load'
import type { Session } from '../app/session'
import { text } from '../text'

export interface FiguresLink {
  /** The link to the view that is not shown. */
  readonly link: HTMLAnchorElement
  show(view: PageOptions['view']): Promise<void>
}

/** `place`: the element that gets the figures. */
export function figuresLink(session: Session, place: HTMLElement): FiguresLink {
  let figures: HTMLElement | null = null
  let loaded = false
  /** Whether the run was playing when the laboratory was left. */
  let wasPlaying = false
  const open = () => document.body.dataset.view === 'figures'
  const link = el('a', { class: 'button', id: 'open-figures', href: '#view=figures' }, text.header.figures)
  link.addEventListener('click', event => {
    // Not left to the browser: in a srcdoc frame a link to # leads to the page around the frame.
    event.preventDefault()
    location.hash = hashOf(session.snapshot.link, open() ? 'lab' : 'figures')
  })
  const show = async (view: PageOptions['view']) => {
    if (view) document.body.dataset.view = view
    link.textContent = open() ? text.header.lab : text.header.figures
    link.href = open() ? '#view=lab' : '#view=figures'
    if (!open()) {
      if (wasPlaying) session.playback.play()
      wasPlaying = false
      return
    }
    wasPlaying ||= session.playback.playing
    session.playback.pause()
    figures ??= place.appendChild(el('main', { id: 'figures' }))
    if (loaded) return
    loaded = true
    try {
      const { figuresView } = await loadFigures()
      figures.replaceChildren(...(await figuresView(session)))
    } catch (e) {
      // Tried again when the figures are shown the next time.
      loaded = false
      const why = e instanceof Error ? e.message : String(e)
      figures.replaceChildren(el('p', { role: 'alert' }, `${text.problem.title}: ${why}`))
    }
  }
  return { link, show }
}
