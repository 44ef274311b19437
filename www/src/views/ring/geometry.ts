// Where lanes and vehicles lie on the canvas of the ring. Lengths along the road are to scale. Lanes are concentric, lane 1
// outermost, and wider than to scale.
import type { Frame, Scenario } from '../../core/protocol'

/** Largest distance from a vehicle at which the pointer finds it, px. */
const REACH = 18

export interface Geometry {
  /** Centre of the ring, px. */
  readonly cx: number
  readonly cy: number
  /** Radius of the outer edge of the road, px. */
  readonly outer: number
  /** Width of a lane, px. */
  readonly width: number
  readonly lanes: number
  /** Length of the ring, m. */
  readonly length: number
}

/** For a canvas of `w` × `h` px. */
export function geometry(w: number, h: number, { lanes, length }: Scenario): Geometry {
  const outer = Math.min(w, h) / 2 - 12
  const width = Math.min(lanes > 2 ? 15 : 18, (outer * 0.42) / lanes)
  return { cx: w / 2, cy: h / 2, outer, width, lanes, length }
}

/** Direction from the centre of the ring to a position (m): position 0 is at the top, travel goes clockwise. */
export const angle = (g: Geometry, x: number): number => (x / g.length) * 2 * Math.PI - Math.PI / 2

/** Radius of the middle of a lane, px; a vehicle that is drawn between two lanes has a fractional one. */
export const radius = (g: Geometry, lane: number): number => g.outer - (lane + 0.5) * g.width

/** The index of the vehicle nearest to a place on the canvas, or −1 where none is near. */
export function nearestVehicle(g: Geometry, { positions, lanes }: Frame, x: number, y: number): number {
  let best = -1
  let nearest = REACH ** 2
  positions.forEach((position, j) => {
    const r = radius(g, lanes[j]!)
    const a = angle(g, position)
    const distance = (g.cx + r * Math.cos(a) - x) ** 2 + (g.cy + r * Math.sin(a) - y) ** 2
    if (distance < nearest) {
      nearest = distance
      best = j
    }
  })
  return best
}
