// The second module, with the paper's figures and the export of tables, as the host uses it.
import { Export, FigureOutcome as Outcome, FigureTask, figures, initSync } from '../../pkg-figures/figures.js'
import type { FigureInfo, FigureOutcome } from './protocol'

let started = false

/** Starts the compiled module, unless it has started. */
function load(wasm: ArrayBuffer): void {
  if (!started) initSync({ module: wasm })
  started = true
}

export function start(wasm: ArrayBuffer): readonly FigureInfo[] {
  load(wasm)
  return JSON.parse(figures()) as FigureInfo[]
}

/** A run of a scenario (JSON) that is repeated for a measurement (JSON). `bytes` gives the compiled module, if it has not
 * started. The caller frees it. */
export async function exportOf(scenario: string, measurement: string, bytes: () => Promise<ArrayBuffer>): Promise<Export> {
  if (!started) load(await bytes())
  return new Export(scenario, measurement)
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
