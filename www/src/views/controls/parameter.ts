// The control of one parameter: a slider and a number field that keep in step, and a button that goes back to the value that was
// opened. While the slider moves, the stability summary says what would hold.
import { valueOf, written } from '../../app/parameters'
import type { Session } from '../../app/session'
import type { Parameter, StabilitySummary } from '../../core/protocol'
import { text } from '../../text'
import { fixed } from '../../text/format'
import { button, el } from '../../ui/dom'
import { numberField } from '../../ui/number_field'

const t = text.controls
/** Time after the last key on a slider until its value is set, ms: several keys in a row make one setting. */
const SETTLE = 450

/** `moved` gets the value while the slider moves, `chosen` the value to set. `busy` tells whether a person is moving the slider, or a
 * value that was chosen by keys waits to be set; `rest` ends that. */
function listenToSlider(slider: HTMLInputElement, moved: (value: number) => void, chosen: (value: string) => void) {
  let timer = 0
  let byKey = false
  let held = false
  const set = () => chosen(slider.value)
  slider.addEventListener('keydown', () => {
    byKey = true
  })
  slider.addEventListener('pointerdown', () => {
    byKey = false
    held = true
  })
  slider.addEventListener('input', () => moved(Number(slider.value)))
  slider.addEventListener('change', () => {
    clearTimeout(timer)
    if (byKey) timer = window.setTimeout(set, SETTLE)
    else set()
  })
  slider.addEventListener('blur', () => {
    if (timer !== 0) set()
  })
  return {
    busy: () => held || timer !== 0,
    rest() {
      clearTimeout(timer)
      timer = 0
      held = false
    },
  }
}

/** `preview` shows the stability summary for another value, or with null that of the run. */
export function parameterControl(session: Session, parameter: Parameter, preview: (summary: StabilitySummary | null) => void): HTMLElement {
  const { symbol, meaning: title, unit, min, max, whole } = parameter
  const id = `p-${parameter.name}`
  const name = t.names[parameter.name] ?? parameter.name
  const slider = parameter.slider ? el('input', { type: 'range', id, ...parameter.slider, title }) : null
  const { number, wrong, complain } = numberField({
    id: slider ? `${id}-number` : id,
    min,
    max,
    'aria-label': slider ? t.number(name) : name,
  })
  const back = button({ class: 'back', 'aria-label': t.reset(name), title: t.reset(name), onclick: () => void commit(String(first)) }, '↺')

  /** The value that was opened. */
  let first = parameter.default
  const tell = (value: number) => slider?.setAttribute('aria-valuetext', `${fixed(value, 3)} ${t.units[unit] ?? unit}`.trim())
  const show = () => {
    const value = valueOf(session, parameter)
    // A slider that a person moves keeps the person's value.
    if (slider && !sliding?.busy()) {
      slider.value = String(value)
      tell(value)
    }
    // A refused number stays beside the sentence that refuses it.
    if (wrong.hidden && (document.activeElement !== number || number.dataset.typed !== 'yes')) number.value = written(parameter, value)
    back.style.visibility = value === first ? 'hidden' : ''
  }
  const commit = async (value: string) => {
    sliding?.rest()
    number.dataset.typed = ''
    complain('')
    if (Number(value) !== valueOf(session, parameter)) await session.set(parameter.name, value)
    show()
    preview(null)
  }
  let asking = false
  const foresee = async (value: string) => {
    if (asking) return
    asking = true
    try {
      preview(await session.client.ask('preview', { name: parameter.name, value }))
    } catch {
      // A value that the core refuses is refused with its reason when the slider is let go.
    } finally {
      asking = false
    }
  }
  const moved = (value: number) => {
    complain('')
    number.value = written(parameter, value)
    tell(value)
    void foresee(String(value))
  }
  const sliding = slider && listenToSlider(slider, moved, value => void commit(value))
  number.addEventListener('input', () => {
    number.dataset.typed = 'yes'
  })
  number.addEventListener('change', () => {
    const value = number.valueAsNumber
    if (value >= min && value <= max && (!whole || Number.isInteger(value))) {
      void commit(String(value))
      return
    }
    // The value in force stays; the sentence stands where the number was typed.
    number.dataset.typed = ''
    complain(t.allowed(name, whole, min, max, unit))
  })
  number.addEventListener('blur', () => {
    number.dataset.typed = ''
    if (wrong.hidden) show()
  })
  // A refused number goes when anything is set, done or opened; the passing of time leaves it.
  let link = ''
  session.on('snapshot', snapshot => {
    if (snapshot.link !== link) complain('')
    link = snapshot.link
    show()
  })
  session.on('opened', () => {
    complain('')
    first = valueOf(session, parameter)
    show()
  })
  return el(
    'div',
    { class: 'control' },
    el('label', { for: id, title }, name, symbol ? '\u00a0' : null, symbol ? el('i', {}, symbol) : null),
    slider,
    el('div', { class: 'field' }, number, el('span', { 'aria-hidden': 'true' }, unit)),
    back,
    wrong,
  )
}
