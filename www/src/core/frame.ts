// A frame: the state of the run, and typed arrays with a value for every vehicle. The arrays' types are those that
// wasm-bindgen declares for the compiled core.
import type { Lab } from '../../pkg/ringroad.js'
import type { FrameState } from './generated'

/** Values of every vehicle, in the order of their numbers. */
export const vehicleArrays = (lab: Lab) => ({
  /** Positions on the ring, m. */
  positions: lab.positions(),
  /** Speeds, m/s. */
  speeds: lab.speeds(),
  /** Headways, m. */
  headways: lab.headways(),
  /** Perceived headways, m. */
  perceived: lab.perceived_headways(),
  /** Frustrations φ. */
  frustration: lab.frustrations(),
  /** P(φ), the probability of an attempt to change lanes within one second. */
  attempt: lab.attempt_probabilities(),
  /** Distances driven since t = 0, m. */
  distances: lab.distances(),
  /** Lengths of the vehicles, m. */
  lengths: lab.lengths(),
  /** Minimum headways, m. */
  minHeadways: lab.min_headways(),
  /** Lanes, from 0. */
  lanes: lab.lanes(),
  /** Lane changes since t = 0. */
  laneChanges: lab.lane_changes(),
  /** Red, green, blue: three numbers a vehicle. */
  colours: lab.colours(),
})

/** One picture of the traffic. */
export interface Frame extends Readonly<FrameState>, Readonly<ReturnType<typeof vehicleArrays>> {
  /** Steps taken for this frame. */
  readonly taken: number
}
