// The page: opens the core, builds the views, and follows the link and the keys.
import { type PageOptions, readHash, writeHash } from './app/url'
import { pressed } from './app/commands'
import { openCore } from './core/open'
import { el } from './ui/dom'
import { Session } from './app/session'
import { text } from './text'
import { actionsView } from './views/actions'
import { carView } from './views/car'
import { controlsView } from './views/controls/controls'
import { dialogOpener } from './views/dialogs/open'
import { figuresLink } from './views/figures_link'
import { headerView } from './views/header'
import { lanesView } from './views/lanes'
import { liveView } from './views/live'
import { mapView } from './views/map'
import { problemView } from './views/problem'
import { ringView } from './views/ring/ring'
import { speedsView } from './views/speeds'
import { stabilityView } from './views/stability/tab'
import { summaryView } from './views/summary'
import { tabs } from './ui/tabs'
import { transportView } from './views/transport'

async function run(app: HTMLElement): Promise<void> {
  const { client, start } = await openCore()
  const dark = matchMedia('(prefers-color-scheme: dark)')
  const session = new Session(client, start, dark.matches)
  const options = readHash(location.hash)
  const own = document.body.dataset.view as PageOptions['view']
  let { view } = options
  if (view) document.body.dataset.view = view

  const summary = summaryView(session)
  const open = dialogOpener(session, app)
  const { link: figures, show } = figuresLink(session, app)
  const header = headerView(session, open, figures)
  const ring = ringView(session, transportView(session))
  const controls = controlsView(session, summary.preview)
  const map = await mapView(session)
  const more = tabs([
    { id: 'stability', name: text.tabs.stability, panel: stabilityView(session, summary.preview) },
    { id: 'lanes', name: text.tabs.lanes, panel: lanesView(session) },
    { id: 'car', name: text.tabs.car, panel: carView(session) },
    { id: 'actions', name: text.tabs.actions, panel: actionsView(session) },
  ])
  const messages = el('div', { class: 'messages' }, summary.element, problemView(session), header.note)
  // The style sheet makes the views below smaller by the height of the messages.
  new ResizeObserver(() => app.style.setProperty('--messages', `${messages.offsetHeight}px`)).observe(messages)
  app.replaceChildren(
    header.element,
    el(
      'main',
      {},
      messages,
      el('div', { class: 'left' }, ring, controls),
      el('div', { class: 'right' }, map, speedsView(session), more),
    ),
    liveView(session),
  )
  app.dataset.core = client.place

  // The address follows the session; a link typed into the address bar opens another scenario.
  let written = options.scenario
  session.on('snapshot', ({ link }) => {
    if (link === written) return
    written = link
    writeHash(link, view)
  })
  window.addEventListener('hashchange', () => {
    const { view: wanted, scenario } = readHash(location.hash)
    view = wanted
    void show(wanted ?? own)
    if (scenario !== written) {
      written = scenario
      void session.open('link', scenario)
    }
  })
  await session.open('link', options.scenario)

  dark.addEventListener('change', () => void session.look({ dark: dark.matches }))
  document.addEventListener('keydown', event => pressed(session, () => void open('help'), event))
  // A person who has asked the system for less motion starts the run with a button; for all others it plays at once.
  const figuresFirst = document.body.dataset.view === 'figures'
  if (figuresFirst) await show('figures')
  else if (!matchMedia('(prefers-reduced-motion: reduce)').matches) session.playback.play()
  Object.assign(window, { ringroad: session })
}

export function open(): void {
  const app = document.getElementById('app')!
  run(app).catch((e: unknown) => {
    const why = e instanceof Error ? e.message : String(e)
    app.replaceChildren(
      el(
        'div',
        { class: 'boot', role: 'alert' },
        el('h1', {}, text.title),
        el('p', {}, text.boot.failed(why)),
        el('p', {}, text.boot.advice),
        el('p', {}, el('a', { href: `ringroad.html${location.hash}` }, text.boot.oneFile)),
      ),
    )
  })
}
