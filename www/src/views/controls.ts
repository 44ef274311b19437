// A slider and a number field for every parameter of the core's table. A driver's parameter changes the traffic
// when the slider is let go; any other starts the run again. While a slider moves, the verdict says what would be.
import { card, el } from '../ui/dom'
import { fixed } from '../text/format'
import type { Session } from '../app/session'
import type { Parameter, StabilitySummary } from '../core/protocol'
import { text } from '../text'
import { numberField } from '../ui/number_field'
import { BRAKE } from './ring'

const t = text.controls
/** Parameters at hand; the others are behind “More”. */
const FIRST = ['reaction_time', 'vehicles', 'sensitivity', 'lanes']
/** After the last key on a slider, ms: a row of keys is one setting. */
const SETTLE = 450
/** Metres of a nudge. */
const NUDGE = 1

export const valueOf = (session: Session, parameter: Parameter): number =>
  parameter.of === 'driver'
    ? session.snapshot.driver[parameter.name]!
    : (session.snapshot.scenario as unknown as Record<string, number>)[parameter.name]!

/** As many decimals as the slider's step has, and more only if the value needs them. */
export function shown(parameter: Parameter, value: number): string {
  const step = parameter.slider?.step ?? 1
  const decimals = Math.max(0, Math.min(6, Math.ceil(-Math.log10(step) - 1e-9)))
  const short = value.toFixed(decimals)
  return Number(short) === value ? String(Number(short)) : String(value)
}

function control(session: Session, parameter: Parameter, preview: (v: StabilitySummary | null) => void): HTMLElement {
  const id = `p-${parameter.name}`
  const name = t.names[parameter.name] ?? parameter.name
  const unitName = t.units[parameter.unit] ?? parameter.unit
  const slider = parameter.slider
    ? el('input', { type: 'range', id, ...parameter.slider, title: parameter.meaning })
    : null
  const { number, wrong, complain } = numberField({
    id: slider ? `${id}-number` : id,
    min: parameter.min,
    max: parameter.max,
    'aria-label': slider ? t.number(name) : name,
  })
  const label = el('label', { for: id, title: parameter.meaning }, name, parameter.symbol ? '\u00a0' : null, parameter.symbol ? el('i', {}, parameter.symbol) : null)
  const back = el('button', { type: 'button', class: 'back', 'aria-label': t.reset(name), title: t.reset(name), onclick: () => void commit(String(first)) }, '↺')

  /** What was opened. */
  let first = parameter.default
  let timer = 0
  const show = (value: number) => {
    // A slider that is being moved is not taken out of the hand.
    if (slider && timer === 0 && !moving) {
      slider.value = String(value)
      slider.setAttribute('aria-valuetext', `${fixed(value, 3)} ${unitName}`.trim())
    }
    // What was refused stays with its sentence.
    if (wrong.hidden && (document.activeElement !== number || number.dataset.typed !== 'yes')) number.value = shown(parameter, value)
    back.style.visibility = value === first ? 'hidden' : ''
  }
  const commit = async (value: string) => {
    clearTimeout(timer)
    timer = 0
    moving = false
    number.dataset.typed = ''
    complain('')
    if (Number(value) === valueOf(session, parameter)) {
      show(valueOf(session, parameter))
      preview(null)
      return
    }
    await session.set(parameter.name, value)
    show(valueOf(session, parameter))
    preview(null)
  }
  let moving = false
  let asking = false
  const foresee = async (value: string) => {
    if (asking) return
    asking = true
    try {
      preview(await session.client.ask('preview', { name: parameter.name, value }))
    } catch {
      // What cannot be is refused when the slider is let go.
    } finally {
      asking = false
    }
  }
  if (slider) {
    let byKey = false
    slider.addEventListener('keydown', () => {
      byKey = true
    })
    slider.addEventListener('pointerdown', () => {
      byKey = false
      moving = true
    })
    slider.addEventListener('input', () => {
      complain('')
      number.value = shown(parameter, Number(slider.value))
      slider.setAttribute('aria-valuetext', `${fixed(Number(slider.value), 3)} ${unitName}`.trim())
      void foresee(slider.value)
    })
    slider.addEventListener('change', () => {
      clearTimeout(timer)
      if (byKey) timer = window.setTimeout(() => void commit(slider.value), SETTLE)
      else void commit(slider.value)
    })
    slider.addEventListener('blur', () => {
      if (timer !== 0) void commit(slider.value)
    })
  }
  number.addEventListener('input', () => {
    number.dataset.typed = 'yes'
  })
  number.addEventListener('change', () => {
    const value = number.valueAsNumber
    const fits = value >= parameter.min && value <= parameter.max && (!parameter.whole || Number.isInteger(value))
    if (!fits) {
      // The last good state stays; the sentence stands where the number was typed.
      number.dataset.typed = ''
      complain(t.allowed(name, parameter.whole, parameter.min, parameter.max, parameter.unit))
      return
    }
    void commit(String(value))
  })
  number.addEventListener('blur', () => {
    number.dataset.typed = ''
    if (wrong.hidden) show(valueOf(session, parameter))
  })
  // A refused number goes when anything is set, done or opened; time alone leaves it.
  let link = ''
  session.on('snapshot', snapshot => {
    if (snapshot.link !== link) complain('')
    link = snapshot.link
    show(valueOf(session, parameter))
  })
  session.on('opened', () => {
    complain('')
    show((first = valueOf(session, parameter)))
  })
  return el(
    'div',
    { class: 'control' },
    label,
    slider,
    el('div', { class: 'field' }, number, el('span', { 'aria-hidden': 'true' }, parameter.unit)),
    back,
    wrong,
  )
}

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

export function controlsView(session: Session, preview: (v: StabilitySummary | null) => void): HTMLElement {
  const { parameters } = session.start
  const make = (p: Parameter) => control(session, p, preview)
  const first = FIRST.map(name => parameters.find(p => p.name === name)).filter(p => p !== undefined)
  const rest = parameters.filter(p => !FIRST.includes(p.name))
  const nudge = el('button', { type: 'button', id: 'nudge', title: t.nudgeHint, onclick: () => void nudgeWatched(session) })
  const brake = el('button', { type: 'button', id: 'brake', title: t.brakeHint, onclick: () => void brakeWatched(session) })
  const name = () => {
    nudge.textContent = t.nudge(session.watched + 1)
    brake.textContent = t.brake(session.watched + 1)
  }
  session.on('watch', name)
  session.on('snapshot', name)
  session.on('frame', ({ collision }) => {
    nudge.disabled = brake.disabled = collision !== null
  })
  const others = el(
    'div',
    { id: 'others', hidden: true },
    el('h3', {}, t.drivers),
    el('div', { class: 'controls' }, ...rest.filter(p => p.of === 'driver').map(make)),
    el('h3', {}, t.road),
    el('div', { class: 'controls' }, ...rest.filter(p => p.of === 'road').map(make), startControl(session)),
  )
  const more = el('button', { type: 'button', id: 'more-controls', 'aria-expanded': 'false', 'aria-controls': 'others' }, t.more)
  more.addEventListener('click', () => {
    others.hidden = !others.hidden
    more.textContent = others.hidden ? t.more : t.less
    more.setAttribute('aria-expanded', String(!others.hidden))
  })
  const { card: section } = card(
    'controls',
    t.title,
    el('div', { class: 'controls' }, ...first.map(make)),
    el('div', { class: 'buttons' }, nudge, brake, more),
    others,
  )
  return section
}

export const nudgeWatched = (session: Session) => session.act(`${session.watched + 1}:nudge=${NUDGE}`)
export const brakeWatched = (session: Session) => session.act(`${session.watched + 1}:brake=${BRAKE}`)
