// What page and core say to each other. The core's own JSON keeps its names; heavy frames are typed arrays.

/** One row of the core's table of parameters. */
export interface Parameter {
  readonly name: string
  readonly symbol: string
  readonly unit: string
  readonly default: number
  readonly min: number
  readonly max: number
  readonly slider: { readonly min: number; readonly max: number; readonly step: number } | null
  readonly whole: boolean
  readonly meaning: string
  readonly of: 'road' | 'driver'
}

/** A scenario in the core's JSON form. */
export interface Scenario {
  readonly version: number
  readonly vehicles: number
  readonly length: number
  readonly lanes: number
  readonly time_step: number
  readonly until: number
  readonly seed: number
  readonly start: string
  readonly driver: Readonly<Record<string, number>>
  readonly exceptions: readonly string[]
  readonly actions: readonly string[]
}

export interface Preset {
  readonly name: string
  readonly title: string
  readonly notice: string
  readonly next: string
  readonly scenario: Scenario
}

/** What linear theory says of the ring as it is now. */
export interface Verdict {
  /** Of the run, which goes in steps; null where theory has nothing to say. */
  readonly stable: boolean | null
  /** Whether all drivers are alike. */
  readonly alike: boolean
  /** Delay in force, s: the mean where drivers differ. */
  readonly reaction_time: number
  /** Largest stable reaction time in continuous time, s; null: every one is stable. */
  readonly critical: number | null
  /** The same for the run's time step. */
  readonly critical_discrete: number | null
  /** Drivers that differ: by what factor all reaction times may grow before waves do. */
  readonly scale: number | null
  /** Largest growth rate of the run, 1/s; null where nothing can grow or decay. */
  readonly rate: number | null
  /** Number of jams of the fastest wave. */
  readonly mode: number | null
  /** Of the least stable lane. */
  readonly equilibrium_speed: number
  readonly flow: number
  readonly density: number
  /** Lane that the verdict speaks of, from 1. */
  readonly lane: number
  /** Vehicles in it. */
  readonly vehicles: number
}

/** Growth measured in the run. */
export interface Growth {
  /** 1/s. */
  readonly rate: number
  readonly standard_error: number
  /** How far the waves' size may have moved the rate, 1/s. */
  readonly nonlinear_bound: number
  /** Seconds looked back. */
  readonly window: number
  readonly mode: number
}

/** The stability plane of the lane that the verdict speaks of. */
export interface Plane {
  readonly curves: Curves
  /** The number of vehicles beyond which the lane is a jam. */
  readonly jam: number
  /** Of its drivers; where they differ, of those without an exception, s. */
  readonly reaction_time: number
}

/** Critical reaction times (s) over the number of vehicles in the lane; null where every one is stable. */
export interface Curves {
  readonly vehicles: readonly number[]
  readonly continuous_s: readonly (number | null)[]
  readonly discrete_s: readonly (number | null)[]
  readonly newell_s: readonly (number | null)[]
}

/** Characteristic roots of the lane that the verdict speaks of, 1/s. */
export interface Roots {
  readonly vehicles: number
  readonly equal_drivers: boolean
  readonly modes: readonly number[]
  /** The dominant root of each mode, in the run's steps. */
  readonly growth_per_s: readonly (number | null)[]
  readonly frequency_per_s: readonly (number | null)[]
  /** The next ones, in continuous time. */
  readonly next: readonly { readonly mode: number; readonly real_per_s: number; readonly imaginary_per_s: number }[]
}

/** Growth of one mode since the last change; null where there is none yet. */
export interface ModeGrowth {
  readonly mode: number
  /** 1/s. */
  readonly rate: number | null
  readonly standard_error: number | null
  /** By theory; where drivers differ, the root followed from this mode of equal drivers. */
  readonly predicted: number | null
  /** How far the waves' size may have moved the rate, 1/s. */
  readonly nonlinear_bound: number | null
  /** The time in which the mode was small enough to be linear, s. */
  readonly from: number | null
  readonly to: number | null
  readonly ended_by: string
}

export interface ModesGrowth {
  /** From when on it is looked at, s. */
  readonly starts: number
  readonly modes: readonly ModeGrowth[]
}

/** What changes by actions and settings only. */
export interface Snapshot {
  /** With all actions made so far. */
  readonly scenario: Scenario
  /** The part of a link after the #. */
  readonly link: string
  /** What every driver without an exception does now. */
  readonly driver: Readonly<Record<string, number>>
  readonly verdict: Verdict
  /** Numbers of the vehicles whose speeds are in the rows, from 1. */
  readonly watched: readonly number[]
  /** Seconds between the rows, and between the columns of the map. */
  readonly interval: number
  /** Window of the flow, s. */
  readonly flow_window: number
  /** Equilibrium speed with the vehicles spread evenly over all lanes, m/s. */
  readonly mean_equilibrium_speed: number
  /** Counts what changed the verdict or the drivers; see `Frame.changes`. */
  readonly changes: number
}

export interface Collision {
  readonly time: number
  readonly behind: number
  readonly ahead: number
  readonly lane: number
}

/** One picture of the traffic. */
export interface Frame {
  readonly time: number
  readonly step: number
  /** Steps taken for this frame. */
  readonly taken: number
  readonly finished: boolean
  /** Indices from 0. */
  readonly collision: Collision | null
  readonly positions: Float64Array
  readonly speeds: Float64Array
  readonly headways: Float64Array
  readonly perceived: Float64Array
  readonly frustration: Float64Array
  readonly distances: Float64Array
  /** Length and minimum headway of every vehicle, pair after pair, m. */
  readonly sizes: Float64Array
  readonly lanes: Float64Array
  readonly laneChanges: Float64Array
  /** Red, green, blue of every vehicle. */
  readonly colours: Uint8Array
  /** Rows since the frame before: time, mean speed, flow, ΔN, then the watched vehicles' speeds. */
  readonly rows: Float64Array
  /** Which run this is: it grows when one begins anew. */
  readonly epoch: number
  /** Differs from the snapshot's when that is out of date. */
  readonly changes: number
  readonly growth: Growth | null
  /** Whether waves are too large now for linear theory; `growth` is of before then. */
  readonly large: boolean
}

/** Columns of `Frame.rows` before the speeds. */
export const ROW = { time: 0, mean: 1, flow: 2, imbalance: 3, speeds: 4 } as const

export type Quantity = 'difference' | 'speed' | 'frustration'

/** How ring and map are painted. */
export interface View {
  /** Colour of the vehicles on the ring. */
  readonly ring: Quantity
  /** Colour of the map. */
  readonly map: 'difference' | 'speed'
  readonly dark: boolean
  /** Lane of the map, from 0. */
  readonly lane: number
  /** Whether the map rides along at the equilibrium speed. */
  readonly riding: boolean
}

/** A colour bar: RGB triples from low to high, and where numbers stand on it (0 … 1). */
export interface Legend {
  readonly colours: readonly number[]
  readonly ticks: readonly { readonly value: number; readonly place: number }[]
}
export interface Legends {
  readonly ring: Legend
  readonly map: Legend
}

/** Shape of the map. */
export interface MapShape {
  readonly columns: number
  readonly bins: number
}

export interface Start {
  readonly parameters: readonly Parameter[]
  readonly presets: readonly Preset[]
  readonly map: MapShape
  readonly version: string
}

export interface Opened {
  readonly snapshot: Snapshot
  /** What could not be used, with reasons. */
  readonly messages: readonly string[]
}

/** A figure of the paper, or beyond it. */
export interface FigureInfo {
  readonly id: string
  readonly title: string
  readonly caption: string
  readonly beyond: boolean
  /** Pieces of work. */
  readonly pieces: number
}

/** A claim of the paper beside what is measured; numbers with their units. */
export interface Claim {
  readonly claim: string
  readonly paper: string
  readonly ours: string
  readonly verdict: 'agrees' | 'differs' | 'open'
  readonly method: string
}

/** What can be read off a panel, and where it lies in units of the picture; the core says more in `plot.rs`. */
export type Mark =
  | {
      readonly kind: 'curve'
      readonly name: string
      readonly x: readonly number[]
      readonly y: readonly number[]
      /** Ends of the band or of the error bars; empty where there are none. */
      readonly low: readonly (number | null)[]
      readonly high: readonly (number | null)[]
      readonly right: readonly number[]
      readonly down: readonly number[]
    }
  | {
      readonly kind: 'map'
      readonly name: string
      /** Cells along x. */
      readonly width: number
      /** Centres of the first and the last cell. */
      readonly x: readonly [number, number]
      readonly y: readonly [number, number]
      /** Row by row, from the lowest y. */
      readonly values: readonly (number | null)[]
      /** Left and right edge; lower and upper edge. */
      readonly across: readonly [number, number]
      readonly up: readonly [number, number]
    }

/** The rectangle between the axes of a panel, in units of the picture, with the labels of its axes. */
export interface Field {
  readonly title: string
  readonly left: number
  readonly top: number
  readonly width: number
  readonly height: number
  readonly x: string
  readonly y: string
  readonly marks: readonly Mark[]
}

/** What a figure gives. */
export interface FigureOutcome {
  readonly svg: string
  readonly fields: readonly Field[]
  readonly claims: readonly Claim[]
  readonly tables: readonly { readonly name: string; readonly csv: string }[]
}

/** Every request with its answer. */
export interface Requests {
  start: { ask: { wasm: ArrayBuffer }; answer: Start }
  /** Reads a link; an empty one means the opening scenario. */
  link: { ask: { text: string }; answer: Opened }
  /** Opens a scenario's JSON or an exported CSV. */
  file: { ask: { text: string }; answer: Opened }
  preset: { ask: { name: string }; answer: Opened }
  /** At most so many steps, for at most so many milliseconds. */
  advance: { ask: { steps: number; budget: number }; answer: Frame }
  snapshot: { ask: Record<string, never>; answer: Snapshot }
  /** Does something now: `7:brake=3`. */
  act: { ask: { text: string }; answer: Snapshot }
  /** Sets a parameter: a driver's from now on, any other by starting again. */
  set: { ask: { name: string; value: string }; answer: Snapshot }
  /** What the verdict would be. */
  preview: { ask: { name: string; value: string }; answer: Verdict }
  /** The same for a point of the stability plane: so many vehicles on all lanes, or where they are now (null). */
  previewPoint: { ask: { vehicles: number | null; reactionTime: number }; answer: Verdict }
  plane: { ask: Record<string, never>; answer: Plane }
  /** Critical reaction times of mode 1, of mode 2, … over the numbers of vehicles of the plane: NaN where there is no
   * such mode. */
  planeModes: { ask: { steps: boolean }; answer: Float64Array }
  /** The largest growth rate (1/s) at `count` reaction times up to `highest` s, for the first of these numbers of
   * vehicles, for the second, …: as many as the budget (ms) allows, in slices, until that is halted or asked anew. */
  growthRates: {
    ask: { vehicles: readonly number[]; highest: number; count: number; steps: boolean; budget: number }
    answer: Float64Array
  }
  haltGrowthRates: { ask: Record<string, never>; answer: null }
  roots: { ask: Record<string, never>; answer: Roots }
  modes: { ask: Record<string, never>; answer: ModesGrowth }
  /** Goes to a time, by replaying from the start. */
  seek: { ask: { time: number }; answer: Snapshot }
  /** Takes one action out of the list and replays. */
  remove: { ask: { index: number }; answer: Snapshot }
  restart: { ask: { keep: boolean }; answer: Snapshot }
  /** Opens the end of the run. */
  extend: { ask: Record<string, never>; answer: Snapshot }
  view: { ask: View; answer: Legends }
  canvas: { ask: { canvas: OffscreenCanvas }; answer: null }
  /** Value of the map: column from the oldest shown, bin from x = 0. */
  probe: { ask: { column: number; bin: number }; answer: { time: number; position: number; speed: number; equilibrium: number } | null }
  /** Replays the run so far and measures it. */
  csv: { ask: { measurement: string }; answer: string }
  cancel: { ask: Record<string, never>; answer: null }
  /** Starts the figures' module; the next two need it. */
  figures: { ask: { wasm: ArrayBuffer }; answer: readonly FigureInfo[] }
  /** One piece of a figure's work, from 0. */
  piece: { ask: { figure: string; piece: number }; answer: Float64Array }
  /** All pieces put together. */
  assemble: { ask: { figure: string; pieces: Float64Array[] }; answer: FigureOutcome }
}
export type Name = keyof Requests
export type Ask<K extends Name> = Requests[K]['ask']
export type Answer<K extends Name> = Requests[K]['answer']

/** Page to worker. */
export interface Question {
  readonly id: number
  readonly name: Name
  readonly ask: unknown
}
/** Worker to page. */
export type Reply =
  | { readonly kind: 'ready' }
  | { readonly kind: 'answer'; readonly id: number; readonly answer: unknown }
  | { readonly kind: 'error'; readonly id: number; readonly message: string }
  | { readonly kind: 'progress'; readonly id: number; readonly part: number }
