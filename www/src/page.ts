// The page: opens the core, builds the views, listens to keys.
import { base, type PageOptions, readHash, writeHash } from './app/url'
import { openCore } from './core/open'
import { el } from './ui/dom'
import { Session } from './app/session'
import { text } from './text'
import { actionsView } from './views/actions'
import { carView } from './views/car'
import { brakeWatched, controlsView, nudgeWatched } from './views/controls'
import { filesDialog, helpDialog, shareDialog } from './views/dialogs'
import { doors } from './views/links'
import { headerView } from './views/header'
import { lanesView } from './views/lanes'
import { liveView } from './views/live'
import { mapView } from './views/map'
import { ringView } from './views/ring'
import { speedsView } from './views/speeds'
import { stabilityView } from './views/stability/tab'
import { tabs } from './ui/tabs'
import { transportView } from './views/transport'
import { troubleView } from './views/trouble'
import { verdictView } from './views/verdict'

async function run(app: HTMLElement): Promise<void> {
  const { client, start } = await openCore()
  const dark = matchMedia('(prefers-color-scheme: dark)')
  const session = new Session(client, start, dark.matches)
  const options = readHash(location.hash)
  const own = document.body.dataset.view as PageOptions['view']
  let { view } = options
  if (view) document.body.dataset.view = view

  const verdict = verdictView(session)
  const share = shareDialog(session, base)
  const files = filesDialog(session)
  const help = helpDialog(session)
  const { link: figures, show } = doors(session, app)
  const header = headerView(session, { share, files, help, figures })
  const ring = ringView(session, transportView(session))
  const controls = controlsView(session, verdict.preview)
  const map = await mapView(session)
  const more = tabs([
    { id: 'stability', name: text.tabs.stability, panel: stabilityView(session, verdict.preview) },
    { id: 'lanes', name: text.tabs.lanes, panel: lanesView(session) },
    { id: 'car', name: text.tabs.car, panel: carView(session) },
    { id: 'actions', name: text.tabs.actions, panel: actionsView(session) },
  ])
  const messages = el('div', { class: 'messages' }, verdict.element, troubleView(session), header.note)
  // What else fits one screen gives way to them.
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
    share,
    files,
    help,
    liveView(session),
  )
  app.dataset.core = client.place

  // The link follows the session; a link typed into the address bar opens another one.
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
  document.addEventListener('keydown', event => key(session, help, event))
  // Who asks for less motion starts the motion.
  const figuresFirst = document.body.dataset.view === 'figures'
  if (figuresFirst) await show('figures')
  else if (!matchMedia('(prefers-reduced-motion: reduce)').matches) session.play()
  Object.assign(window, { ringroad: session })
}

function key(session: Session, help: HTMLDialogElement, event: KeyboardEvent): void {
  if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector('dialog[open]') || document.body.dataset.view === 'figures') return
  const at = event.target as HTMLElement
  // Where letters are typed they are letters; a focused button has the space bar for itself.
  const typing = at.matches('textarea, select, input:not([type=range]):not([type=checkbox])')
  if (typing || (event.key === ' ' && at.matches('button, summary, input, [role=tab]') && !at.matches('[type=range]'))) return
  const act: Record<string, () => void> = {
    ' ': () => session.toggle(),
    '.': () => void session.step(),
    r: () => void session.restart(true),
    n: () => void nudgeWatched(session),
    b: () => void brakeWatched(session),
    '?': () => help.showModal(),
  }
  const found = act[event.key.length === 1 ? event.key.toLowerCase() : event.key]
  if (!found) return
  event.preventDefault()
  found()
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
