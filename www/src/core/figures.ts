// The core's side of the door for the paper's figures.
import { FigureOutcome as Outcome, FigureWork, figures, initSync } from '../../pkg-figures/figures.js'
import type { FigureInfo, FigureOutcome } from './protocol'

export function start(wasm: ArrayBuffer): readonly FigureInfo[] {
  initSync({ module: wasm })
  return JSON.parse(figures()) as FigureInfo[]
}

/** One piece of a figure's work. To be freed. */
export const begin = (figure: string, piece: number) => new FigureWork(figure, piece)

export function assemble(figure: string, pieces: Float64Array[]): FigureOutcome {
  const outcome = new Outcome(figure, pieces)
  try {
    const table = (_: unknown, k: number) => ({ name: outcome.table_name(k), csv: outcome.csv(k) })
    return { svg: outcome.svg(), fields: JSON.parse(outcome.fields()), claims: JSON.parse(outcome.claims()), tables: Array.from({ length: outcome.tables() }, table) }
  } finally {
    outcome.free()
  }
}
