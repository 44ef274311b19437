// The point of the stability diagram while it is moved, by pointer or by keys. While it is held, the stability summary is that of
// the place where it is; when it is let go, N and Δ are set as the sliders set them.
import type { Session } from '../../app/session'
import { decimals } from '../../text/format'
import type { StabilitySummary } from '../../core/protocol'
import { type Layout, type Point, pointAt } from './diagram_layout'

/** Time after the last key until the point is let go, ms: several keys in a row make one setting. */
const SETTLE = 450

/** What the point needs of the diagram. */
export interface Diagram {
  readonly session: Session
  /** The vehicles and the reaction time of the lane as it is now. */
  now(): Point
  layout(): Layout
  /** Vehicles on all lanes with which the lane gets so many when the run starts again. */
  total(vehicles: number): number
  /** The point has moved. */
  moved(): void
  /** The summary for the place where it is held. */
  foreseen(summary: StabilitySummary): void
  /** It is not held any more. */
  released(): void
}

const within = (value: number, low: number, high: number) => Math.min(high, Math.max(low, value))

export type MovedPoint = ReturnType<typeof movedPoint>

/** `step`: the least change of the reaction time, s. */
export function movedPoint(diagram: Diagram, step: number) {
  const { session } = diagram
  /** Where the point is held, null while it is not; and where it was before. */
  let held: Point | null = null
  let origin: Point | null = null
  let timer = 0
  let asking = false
  /** Vehicles on all lanes to set; null where the lane has so many already. */
  const total = (vehicles: number) => (vehicles === origin?.vehicles ? null : diagram.total(vehicles))
  const stopTimer = () => {
    clearTimeout(timer)
    timer = 0
  }
  const foresee = async () => {
    if (asking) return
    asking = true
    // One request at a time, always for the latest place: the places between are left out.
    for (let asked: Point | null = null; held && held !== asked; ) {
      asked = held
      try {
        const summary = await session.client.ask('previewPoint', { vehicles: total(asked.vehicles), reactionTime: asked.delay })
        if (!held) break
        diagram.foreseen(summary)
      } catch {
        // A setting that the core refuses is refused with its reason when the point is let go.
      }
    }
    asking = false
  }
  /** Puts it back to where the lane is. */
  const forget = () => {
    stopTimer()
    origin = held = null
    diagram.released()
  }
  /** Lets it go: the run gets its N and Δ. */
  const drop = async () => {
    stopTimer()
    const to = held
    if (!to) return
    const vehicles = total(to.vehicles)
    // Δ first: the run that a new N starts begins with the Δ then in force.
    if (to.delay === diagram.now().delay || (await session.set('reaction_time', String(to.delay)))) {
      if (vehicles !== null) await session.set('vehicles', String(vehicles))
    }
    // The person may have moved it again meanwhile.
    if (held === to) forget()
    else origin = diagram.now()
  }
  return {
    step,
    held: () => held,
    take() {
      if (!held) origin = diagram.now()
    },
    move(vehicles: number, delay: number) {
      const ends = diagram.layout().ends
      origin ??= diagram.now()
      held = {
        vehicles: within(Math.round(vehicles), 2, ends.vehicles),
        delay: Number(within(delay, 0, ends.delay).toFixed(decimals(step))),
      }
      diagram.moved()
      void foresee()
    },
    drop,
    forget,
    /** Lets it go when no key follows for a while. */
    dropLater() {
      stopTimer()
      timer = window.setTimeout(() => void drop(), SETTLE)
    },
    /** Lets it go now, if that is due. */
    dropDue() {
      if (timer !== 0) void drop()
    },
  }
}

/** Pointer and keys: `handle` is the point, `canvas` the picture under it. */
export function listen(handle: HTMLElement, canvas: HTMLElement, diagram: Diagram, point: MovedPoint): void {
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
    if (!grip) return
    const { vehicles, delay } = pointAt(grip.frame, diagram.layout().ends, event.clientX + grip.dx, event.clientY + grip.dy)
    point.move(vehicles, delay)
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
    const { step } = point
    const by = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, step],
      ArrowDown: [0, -step],
      PageUp: [0, 10 * step],
      PageDown: [0, -10 * step],
    }[event.key]
    if (event.key === 'Escape' && point.held()) point.forget()
    if (!by || event.ctrlKey || event.metaKey || event.altKey) return
    event.preventDefault()
    const times = event.shiftKey ? 10 : 1
    const { vehicles, delay } = point.held() ?? diagram.now()
    point.move(vehicles + times * by[0]!, delay + times * by[1]!)
    point.dropLater()
  })
  handle.addEventListener('blur', () => point.dropDue())
}
