// The messages between page and core: every request with its answer, and the envelopes in which they travel to a worker
// and back. What the answers hold is declared in generated.ts, from the core's own structs.
import type { Frame } from './frame'
import type {
  Claim,
  ColourBars,
  Field,
  FigureInfo,
  MapReading,
  ModalGrowth,
  Quantity,
  LaneRoots,
  Snapshot,
  StabilityDiagram,
  StabilitySummary,
  Start,
} from './generated'

export type * from './generated'
export type { Frame } from './frame'

/** What ring and map show. */
export interface View {
  /** What the colour of the vehicles on the ring stands for. */
  readonly ring: Quantity
  /** What the colour of the map stands for. */
  readonly map: Exclude<Quantity, 'frustration'>
  /** Whether the page is dark. */
  readonly dark: boolean
  /** Lane of the map, from 0. */
  readonly lane: number
  /** Whether the map is drawn in the co-moving frame, which moves at the equilibrium speed. */
  readonly coMoving: boolean
}

/** A scenario was opened. */
export interface Opened {
  readonly snapshot: Snapshot
  /** What could not be used, with reasons. */
  readonly messages: readonly string[]
}

/** An assembled figure. */
export interface FigureOutcome {
  readonly svg: string
  readonly fields: readonly Field[]
  readonly claims: readonly Claim[]
  readonly tables: readonly { readonly name: string; readonly csv: string }[]
}

type Nothing = Record<string, never>

/** Every request with its answer. */
export interface Requests {
  /** Starts the compiled core. The first request. */
  start: { ask: { wasm: ArrayBuffer }; answer: Start }
  /** Opens a link; an empty one means the opening scenario. */
  link: { ask: { text: string }; answer: Opened }
  /** Opens the text of a file: a scenario as JSON, or a table as CSV. */
  file: { ask: { text: string }; answer: Opened }
  preset: { ask: { name: string }; answer: Opened }
  /** Takes at most so many steps, for at most so many milliseconds. */
  advance: { ask: { steps: number; budget: number }; answer: Frame }
  snapshot: { ask: Nothing; answer: Snapshot }
  /** An action now: `7:brake=3`. */
  act: { ask: { text: string }; answer: Snapshot }
  /** Sets a parameter: a driver's from now on, any other by starting again. */
  set: { ask: { name: string; value: string }; answer: Snapshot }
  /** What theory would say after `set`. */
  preview: { ask: { name: string; value: string }; answer: StabilitySummary }
  /** What theory would say at a point of the stability diagram: so many vehicles on all lanes, or (null) the vehicles
   * where they are now. */
  previewPoint: { ask: { vehicles: number | null; reactionTime: number }; answer: StabilitySummary }
  diagram: { ask: Nothing; answer: StabilityDiagram }
  /** Critical reaction times of mode 1, of mode 2, … over the numbers of vehicles of the stability diagram: NaN where
   * there is no such mode. */
  diagramModes: { ask: { steps: boolean }; answer: Float64Array }
  /** The largest growth rate (1/s) at `count` reaction times up to `highest` s, for the first of these numbers of
   * vehicles, for the second, …: as many as the budget (ms) allows, in slices, until `haltGrowthRates` or another
   * request of this name. */
  growthRates: {
    ask: { vehicles: readonly number[]; highest: number; count: number; steps: boolean; budget: number }
    answer: Float64Array
  }
  haltGrowthRates: { ask: Nothing; answer: null }
  roots: { ask: Nothing; answer: LaneRoots }
  /** Growth of every mode since the last change. */
  modes: { ask: Nothing; answer: ModalGrowth }
  /** Goes to a time by repeating the run from the start. */
  seek: { ask: { time: number }; answer: Snapshot }
  /** Takes one action out of the list (its place, from 0) and repeats the run. */
  remove: { ask: { index: number }; answer: Snapshot }
  /** Back to t = 0, with all actions or with those at t = 0 only. */
  restart: { ask: { keep: boolean }; answer: Snapshot }
  /** Puts off the end of the run. */
  extend: { ask: Nothing; answer: Snapshot }
  view: { ask: View; answer: ColourBars }
  /** Draws the map on this canvas from now on. */
  canvas: { ask: { canvas: OffscreenCanvas }; answer: null }
  /** What the map shows in a column (from the oldest shown) and a cell (from x = 0). */
  reading: { ask: { column: number; bin: number }; answer: MapReading | null }
  /** Repeats the run so far and measures it: a table as CSV. */
  csv: { ask: { measurement: string }; answer: string }
  /** Ends a request that takes long; that request fails with `Cancelled`. */
  cancel: { ask: Nothing; answer: null }
  /** Starts the module of the figures. The next two requests need it. */
  figures: { ask: { wasm: ArrayBuffer }; answer: readonly FigureInfo[] }
  /** One task of a figure, from 0. */
  task: { ask: { figure: string; task: number }; answer: Float64Array }
  /** Assembles a figure from the results of all its tasks. */
  assemble: { ask: { figure: string; results: Float64Array[] }; answer: FigureOutcome }
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
/** Worker to page. An error's message is a sentence for people, or null where the request was cancelled. */
export type Reply =
  | { readonly kind: 'ready' }
  | { readonly kind: 'answer'; readonly id: number; readonly answer: unknown }
  | { readonly kind: 'error'; readonly id: number; readonly message: string | null }
  | { readonly kind: 'progress'; readonly id: number; readonly part: number }
