// The core's side of the door: answers questions, one after the other, and cuts long ones into slices so that
// whoever shares its thread stays alive. It computes nothing; it asks the compiled core.
import { Export, Lab, initSync, parameters, presets, version } from '../../pkg/ringroad.js'
import { CANCELLED } from './client'
import { figures } from './assets'
import type { Answer, Ask, Frame, Name, Opened, Snapshot } from './protocol'

/** Milliseconds of a slice of a long computation. */
const SLICE = 12
/** Of a slice of the map of growth rates, which is done beside the traffic. */
const MAP_SLICE = 6
/** Updates of a vehicle that take a millisecond or a few. */
const UPDATES = 100_000

type Progress = (part: number) => void
type Answers = { [K in Name]: (ask: Ask<K>, progress: Progress) => Answer<K> | Promise<Answer<K>> }

export class Host {
  #lab: Lab | undefined
  #cancelled = false
  /** Which map of growth rates goes on. */
  #map = 0
  /** Steps that take about a millisecond: measured, since it depends on vehicles and machine. */
  #chunk = 16
  /** Whether it stands on the page's own thread, where nothing but a pause lets anyone in. */
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

  /** Steps until `done` or until time is up. Returns the steps taken. */
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

  /** Lets other tasks in; throws if one of them asked to stop. */
  async #breathe(): Promise<void> {
    await new Promise(resolve => setTimeout(resolve))
    if (this.#cancelled) {
      this.#cancelled = false
      throw new Error(CANCELLED)
    }
  }

  /** Replays up to a step of the run. */
  async #replay(step: number, progress: Progress): Promise<void> {
    this.#cancelled = false
    for (let done = this.#core.step_index(); done < step; ) {
      const taken = this.#run(step - done, SLICE)
      if (taken === 0) break
      done += taken
      progress(done / step)
      await this.#breathe()
    }
  }

  #answers: Answers = {
    start: ({ wasm }) => {
      initSync({ module: wasm })
      this.#lab = new Lab()
      return {
        parameters: JSON.parse(parameters()),
        presets: JSON.parse(presets()),
        map: { columns: this.#lab.map_columns(), bins: this.#lab.map_bins() },
        version: version(),
      }
    },
    link: ({ text }) => this.#opened(this.#core.open_link(text)),
    file: ({ text }) => this.#opened(this.#core.open_file(text)),
    preset: ({ name }) => this.#opened(this.#core.open_preset(name)),
    advance: ({ steps, budget }) => {
      const taken = steps > 0 ? this.#run(steps, budget) : 0
      return this.#frame(taken)
    },
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
    plane: () => {
      const [jam, reaction_time, ...all] = this.#core.plane()
      const count = all.length / 4
      const column = (k: number) => all.slice(k * count, (k + 1) * count).map(v => (Number.isFinite(v) ? v : null))
      const curves = { vehicles: all.slice(0, count), continuous_s: column(1), discrete_s: column(2), newell_s: column(3) }
      return { jam: jam!, reaction_time: reaction_time!, curves }
    },
    planeModes: ({ steps }) => this.#core.plane_modes(steps),
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
    view: ({ ring, map, dark, lane, riding }) => JSON.parse(this.#core.view(ring, map, dark, lane, riding)),
    canvas: ({ canvas }) => {
      this.#core.attach(canvas)
      return null
    },
    probe: ({ column, bin }) => JSON.parse(this.#core.probe(column, bin)),
    csv: async ({ measurement }, progress) => {
      this.#cancelled = false
      const run = new Export(this.#core.scenario_so_far(), measurement)
      try {
        for (;;) {
          const end = performance.now() + SLICE
          let part = run.step(256)
          while (part < 1 && performance.now() < end) part = run.step(256)
          progress(part)
          await this.#breathe()
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
    piece: async ({ figure, piece }) => {
      const work = (await figures()).begin(figure, piece)
      this.#cancelled = false
      try {
        for (let end = performance.now() + SLICE; ; ) {
          const given = work.advance(UPDATES)
          if (given) return given as Float64Array
          if (this.#shared && performance.now() >= end) {
            await this.#breathe()
            end = performance.now() + SLICE
          }
        }
      } finally {
        work.free()
      }
    },
    assemble: async ({ figure, pieces }) => (await figures()).assemble(figure, pieces),
  }

  #frame(taken: number): Frame {
    const lab = this.#core
    lab.paint()
    return {
      time: lab.time(),
      step: lab.step_index(),
      taken,
      finished: lab.finished(),
      collision: JSON.parse(lab.collision()),
      positions: lab.positions(),
      speeds: lab.speeds(),
      headways: lab.headways(),
      perceived: lab.perceived_headways(),
      frustration: lab.frustrations(),
      distances: lab.distances(),
      sizes: lab.sizes(),
      lanes: lab.lanes(),
      laneChanges: lab.lane_changes(),
      colours: lab.colours(),
      rows: lab.take_rows(),
      epoch: lab.epoch(),
      changes: lab.changes(),
      growth: JSON.parse(lab.growth()),
      large: lab.large_waves(),
    }
  }
}
