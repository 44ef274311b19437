// The control of one parameter: a slider and a number field that keep in step, and a button that goes back to the value that was
// opened. While the slider moves, the stability summary says what would hold.
import { valueOf, written } from '../../app/parameters'
import type { Session } from '../../app/session'
import type { Parameter, Verdict } from '../../core/protocol'
import { text } from '../../text'
import { fixed } from '../../text/format'
import { el } from '../../ui/dom'
import { numberField } from '../../ui/number_field'

const t = text.controls
/** Time after the last key on a slider until its value is set, ms: several keys in a row make one setting. */
const SETTLE = 450

export class ParameterControl {
  readonly element: HTMLElement
  #slider: HTMLInputElement | null
  #number: HTMLInputElement
  #wrong: HTMLElement
  #complain: (message: string) => void
  #back: HTMLButtonElement
  #unit: string
  /** The value that was opened. */
  #first: number
  /** Set while a value that was chosen by keys waits to be set. */
  #timer = 0
  /** Whether the pointer holds the slider. */
  #moving = false
  #asking = false
  #link = ''

  /** `preview` shows the stability summary for another value, or with null that of the run. */
  constructor(
    readonly session: Session,
    readonly parameter: Parameter,
    readonly preview: (summary: Verdict | null) => void,
  ) {
    const { symbol, meaning: title, min, max } = parameter
    const id = `p-${parameter.name}`
    const name = this.#name
    this.#first = parameter.default
    this.#unit = t.units[parameter.unit] ?? parameter.unit
    const slider = (this.#slider = parameter.slider ? el('input', { type: 'range', id, ...parameter.slider, title }) : null)
    const { number, wrong, complain } = numberField({
      id: slider ? `${id}-number` : id,
      min,
      max,
      'aria-label': slider ? t.number(name) : name,
    })
    this.#number = number
    this.#wrong = wrong
    this.#complain = complain
    this.#back = el('button', { type: 'button', class: 'back', 'aria-label': t.reset(name), title: t.reset(name), onclick: () => void this.#commit(String(this.#first)) }, '↺')
    this.element = el(
      'div',
      { class: 'control' },
      el('label', { for: id, title }, name, symbol ? '\u00a0' : null, symbol ? el('i', {}, symbol) : null),
      slider,
      el('div', { class: 'field' }, number, el('span', { 'aria-hidden': 'true' }, parameter.unit)),
      this.#back,
      wrong,
    )
    if (slider) this.#listenToSlider(slider)
    this.#listenToNumber()
    // A refused number goes when anything is set, done or opened; the passing of time leaves it.
    session.on('snapshot', snapshot => {
      if (snapshot.link !== this.#link) complain('')
      this.#link = snapshot.link
      this.#show()
    })
    session.on('opened', () => {
      complain('')
      this.#first = this.#value
      this.#show()
    })
  }

  get #name(): string {
    return t.names[this.parameter.name] ?? this.parameter.name
  }
  /** The value in force. */
  get #value(): number {
    return valueOf(this.session, this.parameter)
  }

  #tellSlider(slider: HTMLInputElement, value: number): void {
    slider.setAttribute('aria-valuetext', `${fixed(value, 3)} ${this.#unit}`.trim())
  }

  #show(): void {
    const value = this.#value
    const slider = this.#slider
    const number = this.#number
    // A slider that a person moves keeps the person's value.
    if (slider && this.#timer === 0 && !this.#moving) {
      slider.value = String(value)
      this.#tellSlider(slider, value)
    }
    // A refused number stays beside the sentence that refuses it.
    if (this.#wrong.hidden && (document.activeElement !== number || number.dataset.typed !== 'yes')) number.value = written(this.parameter, value)
    this.#back.style.visibility = value === this.#first ? 'hidden' : ''
  }

  async #commit(value: string): Promise<void> {
    clearTimeout(this.#timer)
    this.#timer = 0
    this.#moving = false
    this.#number.dataset.typed = ''
    this.#complain('')
    if (Number(value) !== this.#value) await this.session.set(this.parameter.name, value)
    this.#show()
    this.preview(null)
  }

  async #foresee(value: string): Promise<void> {
    if (this.#asking) return
    this.#asking = true
    try {
      this.preview(await this.session.client.ask('preview', { name: this.parameter.name, value }))
    } catch {
      // A value that the core refuses is refused with its reason when the slider is let go.
    } finally {
      this.#asking = false
    }
  }

  #listenToSlider(slider: HTMLInputElement): void {
    let byKey = false
    slider.addEventListener('keydown', () => {
      byKey = true
    })
    slider.addEventListener('pointerdown', () => {
      byKey = false
      this.#moving = true
    })
    slider.addEventListener('input', () => {
      const value = Number(slider.value)
      this.#complain('')
      this.#number.value = written(this.parameter, value)
      this.#tellSlider(slider, value)
      void this.#foresee(slider.value)
    })
    slider.addEventListener('change', () => {
      clearTimeout(this.#timer)
      const set = () => void this.#commit(slider.value)
      if (byKey) this.#timer = window.setTimeout(set, SETTLE)
      else set()
    })
    slider.addEventListener('blur', () => {
      if (this.#timer !== 0) void this.#commit(slider.value)
    })
  }

  #listenToNumber(): void {
    const number = this.#number
    const { min, max, whole, unit } = this.parameter
    number.addEventListener('input', () => {
      number.dataset.typed = 'yes'
    })
    number.addEventListener('change', () => {
      const value = number.valueAsNumber
      if (value >= min && value <= max && (!whole || Number.isInteger(value))) {
        void this.#commit(String(value))
        return
      }
      // The value in force stays; the sentence stands where the number was typed.
      number.dataset.typed = ''
      this.#complain(t.allowed(this.#name, whole, min, max, unit))
    })
    number.addEventListener('blur', () => {
      number.dataset.typed = ''
      if (this.#wrong.hidden) this.#show()
    })
  }
}
