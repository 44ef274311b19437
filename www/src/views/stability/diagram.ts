// The stability diagram: vehicles N and reaction time Δ with the neutral stability curves, of the lane that the stability summary
// is about. The point where that lane is now can be dragged, or moved with the arrow keys.
import { valueOf } from '../../app/parameters'
import type { Session } from '../../app/session'
import { frame } from '../../charts/axes'
import { keys } from '../../charts/keys'
import type { Curves, StabilityDiagram, Snapshot, StabilitySummary } from '../../core/protocol'
import { text } from '../../text'
import { drawing, el, style } from '../../ui/dom'
import { type Picture, drawDiagram } from './diagram_drawing'
import { drawLabels } from './diagram_labels'
import { type Ends, type Layout, type Point, layout } from './diagram_layout'
import { type Diagram, listen, movedPoint } from './diagram_point'
import { growthMap } from './growth_map'

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

/** The element, and those of its parts that change. `changed`: a person chose what to show. */
function elements(changed: () => void) {
  const canvas = el('canvas', { role: 'img' })
  const handle = pointHandle()
  const lines = el('div')
  const title = el('h3', { id: 'plane-title' }, t.title)
  const shading = shadingChoice(changed)
  const every = el('input', { id: 'plane-modes', type: 'checkbox', onchange: changed })
  const element = el(
    'section',
    { id: 'plane', 'aria-labelledby': 'plane-title' },
    title,
    el('div', { class: 'field' }, canvas, handle),
    lines,
    el('div', { class: 'choices-row' }, shading, el('label', { title: t.everyHint }, every, t.every)),
  )
  return { element, canvas, handle, lines, title, shading, every }
}

/** Number of the lane, from 1, where there are several. */
const laneOf = ({ scenario, stability }: Snapshot) => (scenario.lanes > 1 ? stability.lane : null)
const oneLaneStart = ({ scenario }: Snapshot) => scenario.start.startsWith('one-lane')
type State = '' | 'stable' | 'unstable'
const stateOf = ({ stable }: StabilitySummary): State => (stable === null ? '' : stable ? 'stable' : 'unstable')

/** A sentence where drivers differ, else empty. */
const differOf = ({ stability }: Snapshot) => (stability.homogeneous ? '' : ` ${t.alike}`)

function entitle(title: HTMLElement, handle: HTMLElement, snapshot: Snapshot): void {
  const lane = laneOf(snapshot)
  title.textContent = snapshot.stability.homogeneous ? t.title : t.titleAlike
  title.title = handle.title = (lane === null ? t.hint : t.hintLanes(lane, !oneLaneStart(snapshot))) + differOf(snapshot)
}

/** The axes reach to the last number of vehicles of the curves, and over a reaction time (s) and its surroundings. */
const endsOf = (data: StabilityDiagram | null, delay: number): Ends => ({
  vehicles: data?.curves.vehicles.at(-1) ?? 133,
  delay: Math.max(HIGHEST, Math.ceil(delay * 2.2) / 2),
})

/** The curves' names with their values at a number of vehicles, and the whole diagram in words. */
function described({ vehicles: numbers, discrete_s, continuous_s, newell_s }: Curves, vehicles: number, snapshot: Snapshot) {
  const at = numbers.findIndex(n => n >= vehicles)
  const [discrete, continuous, newell] = [discrete_s[at] ?? null, continuous_s[at] ?? null, newell_s[at] ?? null]
  return {
    words: t.describe(vehicles, laneOf(snapshot), discrete, continuous, newell) + differOf(snapshot),
    names: () =>
      keys([
        { label: t.discrete(discrete), colour: 'var(--ink)' },
        { label: t.continuous(continuous), colour: 'var(--accent)', dash: [8, 8] },
        { label: t.newell(newell), colour: 'var(--soft)', dash: [2, 5] },
      ]),
  }
}

function placeHandle(handle: HTMLElement, { x, y, ends }: Layout, { vehicles, delay }: Point, lane: number | null, state: State): void {
  handle.style.left = `${x(Math.min(vehicles, ends.vehicles))}px`
  handle.style.top = `${y(delay)}px`
  handle.setAttribute('aria-valuemax', String(ends.delay))
  handle.setAttribute('aria-valuenow', String(delay))
  handle.setAttribute('aria-valuetext', t.value(vehicles, lane, delay, state === '' ? '' : t[state]))
  handle.dataset.state = state
}

/** `preview` shows the stability summary for another place, or with null that of the run. */
export function diagramView(session: Session, preview: (summary: StabilitySummary | null) => void) {
  const reactionTime = session.start.parameters.find(p => p.name === 'reaction_time')!
  const show = () => {
    if (!session.snapshot) return
    if (!point.held()) state = stateOf(session.snapshot.stability)
    draw()
    void request()
  }
  const { element, canvas, handle, lines, title, shading, every } = elements(show)
  let data: StabilityDiagram | null = null
  /** Critical reaction times of the single modes, and what they were computed for. */
  let modes: Float64Array = new Float64Array()
  let modesOf = ''
  /** Stable or unstable at the point, and the whole diagram, in words. */
  let state: State = ''
  let words = ''

  const regions = () => shading.value === 'regions'
  /** Whether in the run's time steps, or in continuous time. */
  const inSteps = () => shading.value !== 'continuous'
  const now = (): Point => {
    const { scenario, stability } = session.snapshot
    // Where drivers are overridden, the lane may hold such drivers alone.
    const own = scenario.exceptions.length > 0 && data
    return { vehicles: stability.vehicles, delay: own ? own.reaction_time : valueOf(session, reactionTime) }
  }
  const shown = () => point.held() ?? now()
  const present = (): Layout => layout(frame(canvas.clientWidth, canvas.clientHeight, 30), endsOf(data, now().delay))
  const lane = () => laneOf(session.snapshot)
  const place = () => placeHandle(handle, present(), shown(), lane(), state)
  /** Tells how much of the map of growth rates is there. */
  const showProgress = () => {
    element.dataset.growth = regions() ? '' : growth.part() < 1 ? 'busy' : 'done'
    canvas.setAttribute('aria-label', regions() ? words : `${words} ${t.map(growth.part())}`)
  }
  const draw = () => {
    if (!session.snapshot || !data) return
    const description = described(data.curves, shown().vehicles, session.snapshot)
    entitle(title, handle, session.snapshot)
    if (description.words !== words) {
      words = description.words
      showProgress()
      lines.replaceChildren(description.names())
    }
    redraw()
    place()
  }
  /** Asks the core for what is chosen but not there yet. */
  const request = async () => {
    if (!data || canvas.clientWidth === 0) return
    const { vehicles } = data.curves
    const highest = present().ends.delay
    const steps = inSteps()
    const of = JSON.stringify([data.curves, steps])
    growth.show(regions() ? null : { key: `${of} ${highest}`, vehicles, highest, steps })
    showProgress()
    if (every.checked && of !== modesOf) {
      modesOf = of
      modes = await session.client.ask('diagramModes', { steps })
      redraw()
    }
  }

  const diagram: Diagram = {
    session,
    now,
    layout: present,
    total: vehicles => vehicles * (oneLaneStart(session.snapshot) ? 1 : session.snapshot.scenario.lanes),
    moved() {
      growth.halt()
      draw()
    },
    foreseen(summary) {
      state = stateOf(summary)
      preview(summary)
      place()
    },
    released() {
      preview(null)
      show()
    },
  }
  const point = movedPoint(diagram, reactionTime.slider?.step ?? 0.01)
  listen(handle, canvas, diagram, point)
  // While the point is held, the worker answers the point's requests alone.
  const growth = growthMap(session.client, () => !point.held() && canvas.clientWidth > 0, () => {
    showProgress()
    redraw()
  })
  const redraw = drawing(canvas, c => {
    if (!data) return
    const picture: Picture = {
      layout: present(),
      curves: data.curves,
      jam: data.jam,
      point: shown(),
      growth: regions() ? null : growth,
      modes: every.checked ? { values: modes, colour: style(inSteps() ? '--ink' : '--accent') } : null,
      dark: session.view.dark,
      name: (regions() ? t.vehicles : t.vehiclesShort)(lane()),
    }
    drawDiagram(c, picture)
    drawLabels(c, picture)
  })
  new ResizeObserver(draw).observe(canvas)
  return {
    element,
    /** Shows other curves. */
    of(next: StabilityDiagram) {
      data = next
      show()
    },
    /** Shows the scenario as it is now. */
    show,
    draw,
  }
}
