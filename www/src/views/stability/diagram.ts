// The stability diagram: vehicles N and reaction time Δ with the neutral stability curves, of the lane that the stability summary
// is about. The point where that lane is now can be dragged, or moved with the arrow keys.
import { valueOf } from '../../app/parameters'
import type { Session } from '../../app/session'
import { frame } from '../../charts/axes'
import { keys } from '../../charts/keys'
import type { Curves, Plane, Verdict } from '../../core/protocol'
import { text } from '../../text'
import { drawing, el, style } from '../../ui/dom'
import { type Picture, drawDiagram } from './diagram_drawing'
import { drawLabels } from './diagram_labels'
import { type Ends, type Layout, type Point, layout } from './diagram_layout'
import { type Diagram, MovedPoint, listen } from './diagram_point'
import { type GrowthMap, growthMap } from './growth_map'

const t = text.diagram
/** The axis of reaction times reaches at least to this value, s. */
const HIGHEST = 1.5

function pointHandle(): HTMLElement {
  return el('div', {
    id: 'plane-point',
    class: 'point',
    role: 'slider',
    tabindex: 0,
    'aria-label': t.handle,
    'aria-roledescription': t.kind,
    'aria-valuemin': 0,
  })
}

function shadingChoice(changed: () => void): HTMLSelectElement {
  const option = (value: keyof typeof t.shadings) => el('option', { value }, t.shadings[value])
  return el(
    'select',
    { id: 'plane-ground', class: 'small-select', 'aria-label': t.shading, onchange: changed },
    option('regions'),
    el('optgroup', { label: t.rates }, option('steps'), option('continuous')),
  )
}

export class DiagramView implements Diagram {
  readonly element: HTMLElement
  #canvas = el('canvas', { role: 'img' })
  #handle = pointHandle()
  #lines = el('div')
  #title = el('h3', { id: 'plane-title' }, t.title)
  #shading = shadingChoice(() => this.show())
  #everyMode = el('input', { id: 'plane-modes', type: 'checkbox', onchange: () => this.show() })
  #plane: Plane | null = null
  #growth: GrowthMap
  #point: MovedPoint
  /** Critical reaction times of the single modes, and what they were computed for. */
  #modes: Float64Array = new Float64Array()
  #modesOf = ''
  /** Stable or unstable at the point, and the whole diagram, in words. */
  #state = ''
  #described = ''
  #redraw: () => void

  /** `preview` shows the stability summary for another place, or with null that of the run. */
  constructor(
    readonly session: Session,
    readonly preview: (summary: Verdict | null) => void,
  ) {
    this.element = el(
      'section',
      { id: 'plane', 'aria-labelledby': 'plane-title' },
      this.#title,
      el('div', { class: 'field' }, this.#canvas, this.#handle),
      this.#lines,
      el('div', { class: 'choices-row' }, this.#shading, el('label', { title: t.everyHint }, this.#everyMode, t.every)),
    )
    this.#point = new MovedPoint(this, this.#reactionTime.slider?.step ?? 0.01)
    this.#growth = growthMap(
      session.client,
      // While the point is held, the worker answers its requests alone.
      () => this.#point.held === null && this.#canvas.clientWidth > 0,
      () => {
        this.#showProgress()
        this.#redraw()
      },
    )
    this.#redraw = drawing(this.#canvas, c => {
      const picture = this.#picture()
      if (!picture) return
      drawDiagram(c, picture)
      drawLabels(c, picture)
    })
    listen(this.#handle, this.#canvas, this.#point)
    new ResizeObserver(() => this.draw()).observe(this.#canvas)
  }

  // --- what the moved point needs

  now(): Point {
    const { scenario, verdict } = this.session.snapshot
    // Where drivers are overridden, the lane may hold such drivers alone.
    const own = scenario.exceptions.length > 0 && this.#plane
    return { vehicles: verdict.vehicles, delay: own ? own.reaction_time : valueOf(this.session, this.#reactionTime) }
  }

  ends(): Ends {
    return { vehicles: this.#curves?.vehicles.at(-1) ?? 133, delay: Math.max(HIGHEST, Math.ceil(this.now().delay * 2.2) / 2) }
  }

  layout(): Layout {
    return layout(frame(this.#canvas.clientWidth, this.#canvas.clientHeight, 30), this.ends())
  }

  total(vehicles: number): number {
    return vehicles * (this.#oneLaneStart ? 1 : this.session.snapshot.scenario.lanes)
  }

  moved(): void {
    this.#growth.halt()
    this.draw()
  }

  foreseen(summary: Verdict): void {
    this.#setState(summary)
    this.preview(summary)
    this.#placeHandle()
  }

  released(): void {
    this.preview(null)
    this.show()
  }

  // --- what the tab asks for

  /** Shows other curves. */
  of(plane: Plane): void {
    this.#plane = plane
    this.show()
  }

  /** Shows the scenario as it is now, and asks the core for what is chosen but not there yet. */
  show(): void {
    if (!this.session.snapshot) return
    if (!this.#point.held) this.#setState(this.session.snapshot.verdict)
    this.draw()
    void this.#request()
  }

  draw(): void {
    if (!this.session.snapshot || !this.#curves) return
    this.#describe(this.#curves)
    this.#redraw()
    this.#placeHandle()
  }

  // --- its parts

  get #reactionTime() {
    return this.session.start.parameters.find(p => p.name === 'reaction_time')!
  }
  get #curves(): Curves | null {
    return this.#plane && this.#plane.curves
  }
  /** Number of the lane, from 1, where there are several. */
  get #lane(): number | null {
    const { scenario, verdict } = this.session.snapshot
    return scenario.lanes > 1 ? verdict.lane : null
  }
  get #oneLaneStart(): boolean {
    return this.session.snapshot.scenario.start.startsWith('one-lane')
  }
  get #regions(): boolean {
    return this.#shading.value === 'regions'
  }
  /** Whether in the run's time steps, or in continuous time. */
  get #inSteps(): boolean {
    return this.#shading.value !== 'continuous'
  }
  get #shownPoint(): Point {
    return this.#point.held ?? this.now()
  }

  #picture(): Picture | null {
    if (!this.#plane) return null
    return {
      layout: this.layout(),
      curves: this.#plane.curves,
      jam: this.#plane.jam,
      point: this.#shownPoint,
      growth: this.#regions ? null : this.#growth,
      modes: this.#everyMode.checked ? { values: this.#modes, colour: style(this.#inSteps ? '--ink' : '--accent') } : null,
      dark: this.session.view.dark,
      name: (this.#regions ? t.vehicles : t.vehiclesShort)(this.#lane),
    }
  }

  #setState({ stable }: Verdict): void {
    this.#state = stable === null ? '' : stable ? t.stable : t.unstable
  }

  /** Tells how much of the map of growth rates is there. */
  #showProgress(): void {
    const part = this.#growth.part()
    this.element.dataset.growth = this.#regions ? '' : part < 1 ? 'busy' : 'done'
    this.#canvas.setAttribute('aria-label', this.#regions ? this.#described : `${this.#described} ${t.map(part)}`)
  }

  async #request(): Promise<void> {
    const curves = this.#curves
    if (!curves || this.#canvas.clientWidth === 0) return
    const steps = this.#inSteps
    const highest = this.ends().delay
    const of = JSON.stringify([curves, steps])
    this.#growth.show(this.#regions ? null : { key: `${of} ${highest}`, vehicles: curves.vehicles, highest, steps })
    this.#showProgress()
    if (this.#everyMode.checked && of !== this.#modesOf) {
      this.#modesOf = of
      this.#modes = await this.session.client.ask('planeModes', { steps })
      this.#redraw()
    }
  }

  #placeHandle(): void {
    const { x, y, ends } = this.layout()
    const { vehicles, delay } = this.#shownPoint
    const handle = this.#handle
    handle.style.left = `${x(Math.min(vehicles, ends.vehicles))}px`
    handle.style.top = `${y(delay)}px`
    handle.setAttribute('aria-valuemax', String(ends.delay))
    handle.setAttribute('aria-valuenow', String(delay))
    handle.setAttribute('aria-valuetext', t.value(vehicles, this.#lane, delay, this.#state))
    handle.dataset.state = this.#state
  }

  /** Title, hint, the curves' names with their values at the point, and all of it in words. */
  #describe({ vehicles: numbers, discrete_s, continuous_s, newell_s }: Curves): void {
    const { vehicles } = this.#shownPoint
    const lane = this.#lane
    const at = numbers.findIndex(n => n >= vehicles)
    const [discrete, continuous, newell] = [discrete_s[at] ?? null, continuous_s[at] ?? null, newell_s[at] ?? null]
    const { alike } = this.session.snapshot.verdict
    const differ = alike ? '' : ` ${t.alike}`
    this.#title.title = this.#handle.title = (lane === null ? t.hint : t.hintLanes(lane, !this.#oneLaneStart)) + differ
    this.#title.textContent = alike ? t.title : t.titleAlike
    const words = t.describe(vehicles, lane, discrete, continuous, newell) + differ
    if (words === this.#described) return
    this.#described = words
    this.#showProgress()
    this.#lines.replaceChildren(
      keys([
        { label: t.discrete(discrete), colour: 'var(--ink)' },
        { label: t.continuous(continuous), colour: 'var(--accent)', dash: [8, 8] },
        { label: t.newell(newell), colour: 'var(--soft)', dash: [2, 5] },
      ]),
    )
  }
}
