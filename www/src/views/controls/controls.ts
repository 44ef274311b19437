// The controls: every parameter of the core's table, the start, and the buttons that nudge and brake the watched vehicle. A driver's
// parameter changes the traffic from now on; any other starts the run again.
import { brakeWatched, nudgeWatched } from '../../app/commands'
import type { Session } from '../../app/session'
import type { Parameter, StabilitySummary } from '../../core/protocol'
import { text } from '../../text'
import { button, card, el } from '../../ui/dom'
import { parameterControl } from './parameter'

const t = text.controls
/** Parameters that are always visible; the others appear with “More”. */
const FIRST = ['reaction_time', 'vehicles', 'sensitivity', 'lanes']

function startControl(session: Session): HTMLElement {
  const select = el(
    'select',
    { id: 'p-start', onchange: () => void session.set('start', select.value) },
    ...Object.entries(t.starts).map(([value, name]) => el('option', { value }, name)),
  )
  session.on('snapshot', ({ scenario }) => {
    if (![...select.options].some(o => o.value === scenario.start)) select.append(el('option', { value: scenario.start }, scenario.start))
    select.value = scenario.start
  })
  return el('div', { class: 'control' }, el('label', { for: 'p-start' }, t.start), select)
}

/** The buttons that nudge and brake the watched vehicle. */
function watchedButtons(session: Session): HTMLButtonElement[] {
  const nudge = button({ id: 'nudge', title: t.nudgeHint, onclick: () => void nudgeWatched(session) })
  const brake = button({ id: 'brake', title: t.brakeHint, onclick: () => void brakeWatched(session) })
  const name = () => {
    nudge.textContent = t.nudge(session.watched + 1)
    brake.textContent = t.brake(session.watched + 1)
  }
  session.on('watch', name)
  session.on('snapshot', name)
  session.on('frame', ({ collision }) => {
    nudge.disabled = brake.disabled = collision !== null
  })
  return [nudge, brake]
}

export function controlsView(session: Session, preview: (summary: StabilitySummary | null) => void): HTMLElement {
  const { parameters } = session.start
  const make = (p: Parameter) => parameterControl(session, p, preview)
  const first = FIRST.map(name => parameters.find(p => p.name === name)).filter(p => p !== undefined)
  const rest = parameters.filter(p => !FIRST.includes(p.name))
  const buttons = watchedButtons(session)
  const others = el(
    'div',
    { id: 'others', hidden: true },
    el('h3', {}, t.drivers),
    el('div', { class: 'controls' }, ...rest.filter(p => p.of === 'driver').map(make)),
    el('h3', {}, t.road),
    el('div', { class: 'controls' }, ...rest.filter(p => p.of === 'road').map(make), startControl(session)),
  )
  const more = button({ id: 'more-controls', 'aria-expanded': 'false', 'aria-controls': 'others' }, t.more)
  more.addEventListener('click', () => {
    others.hidden = !others.hidden
    more.textContent = others.hidden ? t.more : t.less
    more.setAttribute('aria-expanded', String(!others.hidden))
  })
  const { card: section } = card(
    'controls',
    t.title,
    el('div', { class: 'controls' }, ...first.map(make)),
    el('div', { class: 'buttons' }, ...buttons, more),
    others,
  )
  return section
}
