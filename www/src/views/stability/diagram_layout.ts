// Where numbers of vehicles N and reaction times Δ lie in the stability diagram.
import type { Frame } from '../../charts/axes'

export interface Point {
  readonly vehicles: number
  /** Reaction time Δ, s. */
  readonly delay: number
}

/** The upper ends of both axes, which begin at 0. */
export interface Ends {
  readonly vehicles: number
  /** s. */
  readonly delay: number
}

export interface Layout {
  readonly frame: Frame
  readonly ends: Ends
  /** Places in the picture, px. */
  x(vehicles: number): number
  y(delay: number): number
}

export const layout = (frame: Frame, ends: Ends): Layout => ({
  frame,
  ends,
  x: n => frame.left + ((frame.right - frame.left) * n) / ends.vehicles,
  y: delay => frame.bottom - ((frame.bottom - frame.top) * delay) / ends.delay,
})

/** The point at a place in the picture (px). */
export const pointAt = (frame: Frame, ends: Ends, x: number, y: number): Point => ({
  vehicles: ((x - frame.left) / (frame.right - frame.left)) * ends.vehicles,
  delay: ((frame.bottom - y) / (frame.bottom - frame.top)) * ends.delay,
})
