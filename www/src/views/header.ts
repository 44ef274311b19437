// The head of the page: its name, the list of presets, and the buttons that open the dialogs and the figures.
import { button, el } from '../ui/dom'
import type { Session } from '../app/session'
import { text } from '../text'

const t = text.header

/** Four corners, for the button of the full screen. */
function fullScreenIcon(): SVGElement {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg')
  svg.setAttribute('viewBox', '0 0 16 16')
  svg.setAttribute('width', '15')
  svg.setAttribute('height', '15')
  const path = document.createElementNS('http://www.w3.org/2000/svg', 'path')
  path.setAttribute('d', 'M2 6V2h4M10 2h4v4M14 10v4h-4M6 14H2v-4')
  path.setAttribute('fill', 'none')
  path.setAttribute('stroke', 'currentColor')
  path.setAttribute('stroke-width', '1.8')
  svg.append(path)
  return svg
}

/** `open` opens a dialog; `figures` is the link to the paper's figures. */
export function headerView(session: Session, open: (dialog: 'share' | 'files' | 'help') => void, figures: HTMLElement): { element: HTMLElement; note: HTMLElement } {
  const words = el('p')
  const note = el('div', { id: 'preset', role: 'status', hidden: true }, words, button({ 'aria-label': t.close, onclick: () => (note.hidden = true) }, '✕'))
  const presets = el(
    'select',
    {
      id: 'presets',
      'aria-label': t.presets,
      onchange: async () => {
        if (presets.value !== '' && (await session.preset(presets.value))) session.playback.play()
        presets.value = opened
      },
    },
    el('option', { value: '' }, t.choose),
    ...session.start.presets.map(p => el('option', { value: p.name }, p.title)),
  )
  let opened = ''
  /** The scenario without its end, which moves when the run is extended. */
  const scenario = () => JSON.stringify({ ...session.snapshot.scenario, until: 0 })
  let unchanged = ''
  // A preset that was changed is not that preset any more.
  session.on('snapshot', () => {
    if (opened === '' || scenario() === unchanged) return
    presets.value = opened = ''
    note.hidden = true
  })
  session.on('opened', name => {
    presets.value = opened = name
    unchanged = scenario()
    const preset = session.start.presets.find(p => p.name === name)
    note.hidden = !preset
    if (preset) words.replaceChildren(el('strong', {}, `${preset.title}. `), `${preset.notice} `, el('em', {}, `${t.next} `), preset.next)
  })
  const full = () => void (document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen()).catch(() => {})
  const element = el(
    'header',
    { class: 'top' },
    el('h1', {}, text.title),
    el('span', { class: 'subtitle' }, text.subtitle),
    presets,
    button({ id: 'open-share', onclick: () => open('share') }, t.share),
    button({ id: 'open-files', onclick: () => open('files') }, t.files),
    figures,
    document.fullscreenEnabled ? button({ class: 'wide-only', 'aria-label': t.fullscreen, title: t.fullscreen, onclick: full }, fullScreenIcon()) : null,
    button({ id: 'open-help', 'aria-label': t.help, onclick: () => open('help') }, '?'),
  )
  return { element, note }
}
