// The point of the stability diagram while it is moved, by pointer or by keys. While it is held, the stability summary is that of
// the place where it is; when it is let go, N and Δ are set as the sliders set them.
import type { Session } from '../../app/session'
import { decimals } from '../../text/format'
import type { Verdict } from '../../core/protocol'
import { type Ends, type Layout, type Point, pointAt } from './diagram_layout'

/** Time after the last key until the point is let go, ms: several keys in a row make one setting. */
const SETTLE = 450

/** What the point needs of the diagram. */
export interface Diagram {
  readonly session: Session
  /** The vehicles and the reaction time of the lane as it is now. */
  now(): Point
  layout(): Layout
  ends(): Ends
  /** Vehicles on all lanes with which the lane gets so many when the run starts again. */
  total(vehicles: number): number
  /** The point has moved. */
  moved(): void
  /** The summary for the place where it is held. */
  foreseen(summary: Verdict): void
  /** It is not held any more. */
  released(): void
}

const within = (value: number, low: number, high: number) => Math.min(high, Math.max(low, value))

export class MovedPoint {
  /** Where the point is held; null while it is not. */
  held: Point | null = null
  /** Where it was before. */
  #origin: Point | null = null
  #timer = 0
  #asking = false

  /** `step`: the least change of the reaction time, s. */
  constructor(
    readonly diagram: Diagram,
    readonly step: number,
  ) {}

  take(): void {
    if (!this.held) this.#origin = this.diagram.now()
  }

  move({ vehicles, delay }: Point): void {
    const { diagram } = this
    const ends = diagram.ends()
    this.#origin ??= diagram.now()
    this.held = {
      vehicles: within(Math.round(vehicles), 2, ends.vehicles),
      delay: Number(within(delay, 0, ends.delay).toFixed(decimals(this.step))),
    }
    diagram.moved()
    void this.#foresee()
  }

  /** Lets it go: the run gets its N and Δ. */
  async drop(): Promise<void> {
    this.#stopTimer()
    const { held } = this
    if (!held) return
    const { session } = this.diagram
    const vehicles = this.#total(held.vehicles)
    // Δ first: the run that a new N starts begins with the Δ then in force.
    if (held.delay === this.diagram.now().delay || (await session.set('reaction_time', String(held.delay)))) {
      if (vehicles !== null) await session.set('vehicles', String(vehicles))
    }
    // The person may have moved it again meanwhile.
    if (this.held === held) this.forget()
    else this.#origin = this.diagram.now()
  }

  /** Puts it back to where the lane is. */
  forget(): void {
    this.#stopTimer()
    this.#origin = this.held = null
    this.diagram.released()
  }

  /** Lets it go when no key follows for a while. */
  dropLater(): void {
    this.#stopTimer()
    this.#timer = window.setTimeout(() => void this.drop(), SETTLE)
  }

  /** Lets it go now, if that is due. */
  dropDue(): void {
    if (this.#timer !== 0) void this.drop()
  }

  #stopTimer(): void {
    clearTimeout(this.#timer)
    this.#timer = 0
  }

  /** Vehicles on all lanes to set; null where the lane has so many already. */
  #total(vehicles: number): number | null {
    return vehicles === this.#origin?.vehicles ? null : this.diagram.total(vehicles)
  }

  async #foresee(): Promise<void> {
    if (this.#asking) return
    this.#asking = true
    // One request at a time, always for the latest place: the places between are left out.
    for (let asked: Point | null = null; this.held && this.held !== asked; ) {
      asked = this.held
      try {
        const summary = await this.diagram.session.client.ask('previewPoint', { vehicles: this.#total(asked.vehicles), reactionTime: asked.delay })
        if (!this.held) break
        this.diagram.foreseen(summary)
      } catch {
        // A setting that the core refuses is refused with its reason when the point is let go.
      }
    }
    this.#asking = false
  }
}

/** Pointer and keys: `handle` is the point, `canvas` the picture under it. */
export function listen(handle: HTMLElement, canvas: HTMLElement, point: MovedPoint): void {
  const { diagram, step } = point
  /** From the pointer to the middle of the point, and the frame when it was taken: words below the picture may come and go and
   * move it, but the point stays under the pointer. */
  let grip: { dx: number; dy: number; frame: Layout['frame'] } | null = null
  handle.addEventListener('pointerdown', event => {
    if (event.button !== 0) return
    const box = handle.getBoundingClientRect()
    const picture = canvas.getBoundingClientRect()
    point.take()
    grip = {
      dx: box.left + box.width / 2 - event.clientX - picture.left,
      dy: box.top + box.height / 2 - event.clientY - picture.top,
      frame: diagram.layout().frame,
    }
    handle.setPointerCapture(event.pointerId)
    handle.focus()
    event.preventDefault()
  })
  handle.addEventListener('pointermove', event => {
    if (grip) point.move(pointAt(grip.frame, diagram.ends(), event.clientX + grip.dx, event.clientY + grip.dy))
  })
  handle.addEventListener('pointerup', () => {
    grip = null
    void point.drop()
  })
  handle.addEventListener('pointercancel', () => {
    grip = null
    point.forget()
  })
  handle.addEventListener('keydown', event => {
    const by = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, step],
      ArrowDown: [0, -step],
      PageUp: [0, 10 * step],
      PageDown: [0, -10 * step],
    }[event.key]
    if (event.key === 'Escape' && point.held) point.forget()
    if (!by || event.ctrlKey || event.metaKey || event.altKey) return
    event.preventDefault()
    const times = event.shiftKey ? 10 : 1
    const { vehicles, delay } = point.held ?? diagram.now()
    point.move({ vehicles: vehicles + times * by[0]!, delay: delay + times * by[1]! })
    point.dropLater()
  })
  handle.addEventListener('blur', () => point.dropDue())
}
