// The module of the paper's figures, as the host uses it.
import { FigureOutcome as Outcome, FigureTask, figures, initSync } from '../../pkg-figures/figures.js'
import type { FigureInfo, FigureOutcome } from './protocol'

export function start(wasm: ArrayBuffer): readonly FigureInfo[] {
  initSync({ module: wasm })
  return JSON.parse(figures()) as FigureInfo[]
}

/** One task of a figure, from 0. The caller frees it. */
export const begin = (figure: string, task: number) => new FigureTask(figure, task)

/** The figure from the results of all its tasks, in their order. */
export function assemble(figure: string, results: Float64Array[]): FigureOutcome {
  const outcome = new Outcome(figure, results)
  try {
    const table = (_: unknown, k: number) => ({ name: outcome.table_name(k), csv: outcome.csv(k) })
    return { svg: outcome.svg(), fields: JSON.parse(outcome.fields()), claims: JSON.parse(outcome.claims()), tables: Array.from({ length: outcome.tables() }, table) }
  } finally {
    outcome.free()
  }
}
