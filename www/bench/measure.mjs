// What is timed, in Node and in a page alike.
import { initSync, Lab, Run } from '../pkg/ringroad.js'
import { Plain } from './plain.mjs'

/**
 * A repetition takes at least so many milliseconds; the fastest counts. Many short ones rather than a few long ones:
 * where others use the machine too, a long one is never left alone.
 */
const SHORTEST = 40
const REPETITIONS = 30

export const load = bytes => void initSync({ module: bytes })

/** How many times `run` has to be called for a repetition. */
function calibrate(run) {
  for (let calls = 1; ; calls *= 2) {
    const before = performance.now()
    run(calls)
    const taken = performance.now() - before
    if (taken >= SHORTEST / 4) return Math.ceil((calls * SHORTEST * 1.1) / taken)
  }
}

/** Nanoseconds per update of each; turn by turn, so that a busy machine hits all of them. */
function fastest(runs) {
  const calls = runs.map(r => calibrate(r.run))
  const best = runs.map(() => Infinity)
  for (let i = 0; i < REPETITIONS; i++) {
    runs.forEach(({ run, updates }, k) => {
      const before = performance.now()
      run(calls[k])
      best[k] = Math.min(best[k], ((performance.now() - before) * 1e6) / (calls[k] * updates))
    })
  }
  return best
}

/** Both must compute the same: displacements after a while, within what the order of roundings may do. */
function compare(run, plain) {
  const a = run.displacements()
  const b = plain.displacements()
  for (let j = 0; j < a.length; j++) {
    const should = b[j] - (j === 0 ? 1 : 0)
    if (!(Math.abs(a[j] - should) < 1e-6)) throw new Error(`vehicle ${j + 1}: ${a[j]} m instead of ${should} m`)
  }
}

/** One case of benches/cases.json, in ns per vehicle-update; the baseline where there is one. */
export function step({ warm_up, scenario }) {
  const { vehicles, lanes, exceptions, driver, start } = scenario
  const core = new Run(JSON.stringify(scenario))
  core.step(warm_up)
  const runs = [{ updates: vehicles, run: steps => void core.step(steps) }]
  if (lanes === 1 && !exceptions && start === 'uniform') {
    const plain = new Plain(vehicles, Math.round(driver.reaction_time / 0.01))
    plain.step(warm_up)
    compare(core, plain)
    runs.push({ updates: vehicles, run: steps => plain.step(steps) })
  }
  const [wasm, javascript] = fastest(runs)
  if (core.finished()) throw new Error('a bench must not end in a collision')
  core.free()
  return { wasm, javascript }
}

/** Many small runs, one after the other on one core: a seed each, so many steps each. */
export function batch({ scenario }, runs, steps) {
  const { vehicles, driver } = scenario
  const first = new Run(JSON.stringify(scenario))
  const core = () => {
    for (let seed = 0; seed < runs; seed++) {
      const run = first.with_seed(seed)
      run.step(steps)
      run.free()
    }
  }
  const plain = () => {
    for (let seed = 0; seed < runs; seed++) new Plain(vehicles, Math.round(driver.reaction_time / 0.01)).step(steps)
  }
  const times = f => calls => {
    for (let i = 0; i < calls; i++) f()
  }
  const updates = vehicles * runs * steps
  const [wasm, javascript] = fastest([{ updates, run: times(core) }, { updates, run: times(plain) }])
  first.free()
  return { wasm, javascript }
}

/** As in the worker: a slice ends with the column in which these milliseconds are over. */
const SLICE = 6

/**
 * The map of the largest growth rate, N = 2 … 133 by 200 reaction times, in steps of 0.01 s; and the curves of the diagram,
 * every mode, in steps and in continuous time. Milliseconds: the fastest of some repetitions, and its longest slice.
 */
export function diagram() {
  const lab = new Lab()
  const timed = run => {
    const before = performance.now()
    run()
    return performance.now() - before
  }
  let map = { total: Infinity, longest: 0 }
  for (let i = 0; i < REPETITIONS; i++) {
    let [total, longest, slice] = [0, 0, 0]
    for (let n = 2; n <= 133; n++) {
      const column = timed(() => lab.growth_rates(n, 1.5, 200, true))
      total += column
      slice += column
      longest = Math.max(longest, slice)
      if (slice >= SLICE) slice = 0
    }
    if (total < map.total) map = { total, longest }
  }
  const curves = () => [lab.diagram(), lab.diagram_modes(true), lab.diagram_modes(false)]
  const best = Math.min(...Array.from({ length: REPETITIONS }, () => timed(curves)))
  lab.free()
  return { map, curves: best }
}
