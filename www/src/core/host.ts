// Answers the page's questions with the compiled core, in a worker or on the main thread. Long computations are cut
// into slices, with a pause after each, so that other questions (and, on the main thread, the page) are served meanwhile.
import { Lab, initSync, start } from '../../pkg/ringroad.js'
import { figures, wasmBytes } from './assets'
import { Cancelled } from './client'
import { type Frame, vehicleArrays } from './frame'
import type { Answer, Ask, Name, Opened, Snapshot } from './protocol'

/** Milliseconds of a slice of a long computation. */
const SLICE = 12
/** Milliseconds of a slice of the map of growth rates, which is computed while the traffic runs. */
const MAP_SLICE = 6
/** Updates of a vehicle that take a few milliseconds. */
const UPDATES = 100_000

type Progress = (part: number) => void
type Answers = { [K in Name]: (ask: Ask<K>, progress: Progress) => Answer<K> | Promise<Answer<K>> }

export class Host {
  #lab: Lab | undefined
  #cancelled = false
  /** Number of the latest request for growth rates; earlier ones end. */
  #map = 0
  /** Steps that take about a millisecond. Adapted by measuring, since they depend on the vehicles and the machine. */
  #chunk = 16
  /** Whether it runs on the main thread, where the page is served only in pauses. */
  readonly #shared: boolean

  constructor(shared: boolean) {
    this.#shared = shared
  }

  async answer<K extends Name>(name: K, ask: Ask<K>, progress: Progress): Promise<Answer<K>> {
    const answer = this.#answers[name] as (ask: Ask<K>, progress: Progress) => Answer<K>
    return answer(ask, progress)
  }

  get #core(): Lab {
    if (!this.#lab) throw new Error('the core has not started')
    return this.#lab
  }

  #snapshot(): Snapshot {
    return JSON.parse(this.#core.snapshot()) as Snapshot
  }

  #opened(json: string): Opened {
    return { snapshot: this.#snapshot(), messages: JSON.parse(json) as string[] }
  }

  /** Takes so many steps, or as many as the budget (ms) allows. Returns how many were taken. */
  #run(steps: number, budget: number): number {
    const lab = this.#core
    const end = performance.now() + budget
    let taken = 0
    let before = performance.now()
    while (taken < steps) {
      const asked = Math.min(this.#chunk, steps - taken)
      const got = lab.step(asked)
      taken += got
      const now = performance.now()
      if (asked === this.#chunk) {
        if (now - before < 0.5) this.#chunk = Math.min(2 * this.#chunk, 65536)
        else if (now - before > 2) this.#chunk = Math.max(1, this.#chunk >> 1)
      }
      before = now
      if (got < asked || now >= end) break
    }
    return taken
  }

  /** Lets other tasks run; throws if one of them has cancelled this one. */
  async #pause(): Promise<void> {
    await new Promise(resolve => setTimeout(resolve))
    if (this.#cancelled) {
      this.#cancelled = false
      throw new Cancelled()
    }
  }

  /** Repeats the run up to a step. */
  async #replay(step: number, progress: Progress): Promise<void> {
    this.#cancelled = false
    for (let done = this.#core.step_index(); done < step; ) {
      const taken = this.#run(step - done, SLICE)
      if (taken === 0) break
      done += taken
      progress(done / step)
      await this.#pause()
    }
  }

  #answers: Answers = {
    start: ({ wasm }) => {
      initSync({ module: wasm })
      this.#lab = new Lab()
      return JSON.parse(start())
    },
    link: ({ text }) => this.#opened(this.#core.open_link(text)),
    file: ({ text }) => this.#opened(this.#core.open_file(text)),
    preset: ({ name }) => this.#opened(this.#core.open_preset(name)),
    advance: ({ steps, budget }) => this.#frame(steps > 0 ? this.#run(steps, budget) : 0),
    snapshot: () => this.#snapshot(),
    act: ({ text }) => {
      this.#core.act(text)
      return this.#snapshot()
    },
    set: ({ name, value }) => {
      this.#core.set(name, value)
      return this.#snapshot()
    },
    preview: ({ name, value }) => JSON.parse(this.#core.preview(name, value)),
    previewPoint: ({ vehicles, reactionTime }) => JSON.parse(this.#core.preview_point(vehicles?.toString(), String(reactionTime))),
    diagram: () => JSON.parse(this.#core.diagram()),
    diagramModes: ({ steps }) => this.#core.diagram_modes(steps),
    growthRates: async ({ vehicles, highest, count, steps, budget }) => {
      const job = ++this.#map
      const end = performance.now() + budget
      const rates = new Float64Array(vehicles.length * count)
      let done = 0
      do {
        const slice = performance.now() + MAP_SLICE
        do rates.set(this.#core.growth_rates(vehicles[done]!, highest, count, steps), done++ * count)
        while (done < vehicles.length && performance.now() < slice)
        await new Promise(resolve => setTimeout(resolve))
      } while (done < vehicles.length && performance.now() < end && job === this.#map)
      return rates.slice(0, done * count)
    },
    haltGrowthRates: () => {
      this.#map++
      return null
    },
    roots: () => JSON.parse(this.#core.roots()),
    modes: () => JSON.parse(this.#core.modal_growth()),
    seek: async ({ time }, progress) => {
      const step = this.#core.step_at(time)
      if (step < this.#core.step_index()) this.#core.rewind()
      await this.#replay(step, progress)
      return this.#snapshot()
    },
    remove: async ({ index }, progress) => {
      const step = this.#core.step_index()
      this.#core.remove_action(index)
      await this.#replay(step, progress)
      return this.#snapshot()
    },
    restart: ({ keep }) => {
      this.#core.restart(keep)
      return this.#snapshot()
    },
    extend: () => {
      this.#core.extend()
      return this.#snapshot()
    },
    view: ({ ring, map, dark, lane, coMoving }) => JSON.parse(this.#core.view(ring, map, dark, lane, coMoving)),
    canvas: ({ canvas }) => {
      this.#core.attach(canvas)
      return null
    },
    reading: ({ column, bin }) => JSON.parse(this.#core.reading(column, bin)),
    csv: async ({ measurement }, progress) => {
      this.#cancelled = false
      // As it is now, whatever comes while the module is loaded.
      const scenario = this.#core.scenario_so_far()
      const run = await (await figures()).exportOf(scenario, measurement, () => wasmBytes('figures'))
      try {
        for (;;) {
          const end = performance.now() + SLICE
          let part = run.step(256)
          while (part < 1 && performance.now() < end) part = run.step(256)
          progress(part)
          await this.#pause()
          if (part >= 1) return run.csv()
        }
      } finally {
        run.free()
      }
    },
    cancel: () => {
      this.#cancelled = true
      return null
    },
    figures: async ({ wasm }) => (await figures()).start(wasm),
    task: async ({ figure, task }) => {
      const work = (await figures()).begin(figure, task)
      this.#cancelled = false
      try {
        for (let end = performance.now() + SLICE; ; ) {
          const result = work.advance(UPDATES)
          if (result) return result as Float64Array
          if (this.#shared && performance.now() >= end) {
            await this.#pause()
            end = performance.now() + SLICE
          }
        }
      } finally {
        work.free()
      }
    },
    assemble: async ({ figure, results }) => (await figures()).assemble(figure, results),
  }

  #frame(taken: number): Frame {
    const lab = this.#core
    lab.paint()
    return { ...JSON.parse(lab.take_state()), ...vehicleArrays(lab), taken }
  }
}
