// The session: what is open, whether it plays, how fast. Views listen to it and ask it to do things.
import { Cancelled, type Client } from '../core/client'
import { Pace } from './playback'
import type { Answer, Ask, ColourBars, Frame, Name, Opened, Rows, Snapshot, Start, View } from '../core/protocol'
import { text } from '../text'

/** Columns since the start of the run, at most as many as the map shows. */
export type Series = Readonly<Rows>

interface Events {
  /** Something other than the traffic changed. */
  snapshot: Snapshot
  frame: Frame
  /** Something else is open: the name of an experiment, or empty for a link or a file. */
  opened: string
  /** Play, pause, playback, falling behind. */
  playing: boolean
  legends: ColourBars
  watch: number
  /** A sentence for the place where people look for what went wrong; empty to clear. */
  trouble: readonly string[]
  /** A part between 0 and 1 of a replay, or null when it is over. */
  progress: number | null
}
type Listener<K extends keyof Events> = (value: Events[K]) => void

/** A run that has just begun is not squeezed to the left of an empty map, s. */
const SHORTEST_WINDOW = 60

export const PLAYBACKS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100] as const

export class Session {
  snapshot!: Snapshot
  frame!: Frame
  legends!: ColourBars
  view: View
  playing = false
  playback = 5
  /** The vehicle that the page follows, index from 0. */
  watched = 0
  /** Takes what went wrong elsewhere, while a dialog that shows it itself is open. */
  onTrouble: ((messages: readonly string[]) => void) | null = null
  series: Series = empty(0)
  #pace = new Pace()
  #last = 0
  #busy = false
  #epoch = -1
  /** Which chain of frames is alive: a second play must not start a second one. */
  #chain = 0
  #refreshed = 0
  #listeners = new Map<keyof Events, Set<(value: never) => void>>()

  constructor(
    readonly client: Client,
    readonly start: Start,
    dark: boolean,
  ) {
    this.view = { ring: 'difference', map: 'difference', dark, lane: 0, coMoving: false }
  }

  on<K extends keyof Events>(event: K, listener: Listener<K>): void {
    const set = this.#listeners.get(event) ?? new Set()
    this.#listeners.set(event, set.add(listener as (value: never) => void))
  }

  #emit<K extends keyof Events>(event: K, value: Events[K]): void {
    if (event === 'trouble' && this.onTrouble) {
      const messages = value as readonly string[]
      // What stood on the page is cleared all the same.
      if (messages.length > 0) return this.onTrouble(messages)
    }
    for (const listener of this.#listeners.get(event) ?? []) (listener as Listener<K>)(value)
  }

  /** Asks the core; a refusal is shown to people and comes back as null. */
  async #ask<K extends Name>(name: K, ask: Ask<K>): Promise<Answer<K> | null> {
    this.#busy = true
    try {
      const answer = await this.client.ask(name, ask, part => this.#emit('progress', part))
      this.#emit('trouble', [])
      return answer
    } catch (e) {
      if (!(e instanceof Cancelled)) this.#emit('trouble', [e instanceof Error ? e.message : String(e)])
      return null
    } finally {
      this.#busy = false
      this.#emit('progress', null)
    }
  }

  // --- what is open

  async open(name: 'link' | 'file', text: string): Promise<boolean> {
    return this.#opened(await this.#ask(name, { text }), '')
  }
  async preset(name: string): Promise<boolean> {
    return this.#opened(await this.#ask('preset', { name }), name)
  }
  async #opened(opened: Opened | null, preset: string): Promise<boolean> {
    if (!opened) return false
    if (this.watched >= opened.snapshot.scenario.vehicles) this.watched = 0
    if (this.view.lane >= opened.snapshot.scenario.lanes) this.view = { ...this.view, lane: 0 }
    await this.#changed(opened.snapshot)
    this.#emit('opened', preset)
    if (opened.messages.length > 0) this.#emit('trouble', opened.messages)
    return true
  }

  // --- what is done to it

  /** Does something now, such as `7:brake=3`. */
  async act(action: string): Promise<boolean> {
    return !this.#over() && this.#change('act', { text: action })
  }
  /** After a collision nothing goes on; says so. */
  #over(): boolean {
    const over = !!this.frame?.collision
    if (over) this.#emit('trouble', [text.trouble.over])
    return over
  }
  /** Sets a parameter: a driver's from now on, any other by starting again. */
  set(name: string, value: string): Promise<boolean> {
    return this.#change('set', { name, value })
  }
  remove(index: number): Promise<boolean> {
    return this.#change('remove', { index })
  }
  seek(time: number): Promise<boolean> {
    return this.#change('seek', { time })
  }
  restart(keep: boolean): Promise<boolean> {
    return this.#change('restart', { keep })
  }
  async extend(): Promise<void> {
    if (await this.#change('extend', {})) this.play()
  }

  async #change<K extends 'act' | 'set' | 'remove' | 'seek' | 'restart' | 'extend'>(
    name: K,
    ask: Ask<K>,
  ): Promise<boolean> {
    const snapshot: Snapshot | null = await this.#ask(name, ask)
    if (!snapshot) {
      // What was typed is put back to what holds.
      if (this.snapshot) this.#emit('snapshot', this.snapshot)
      return false
    }
    await this.#changed(snapshot)
    return true
  }

  async #changed(snapshot: Snapshot): Promise<void> {
    this.snapshot = snapshot
    this.#pace.reset()
    if (this.view.lane >= snapshot.scenario.lanes) this.view = { ...this.view, lane: 0 }
    if (this.watched >= snapshot.scenario.vehicles) this.watched = 0
    this.legends = await this.client.ask('view', this.view)
    this.#emit('legends', this.legends)
    const frame = await this.client.ask('advance', { steps: 0, budget: 0 })
    this.#emit('snapshot', snapshot)
    this.#show(frame)
  }

  async look(change: Partial<View>): Promise<void> {
    this.view = { ...this.view, ...change }
    this.legends = await this.client.ask('view', this.view)
    this.#emit('legends', this.legends)
    const frame = await this.client.ask('advance', { steps: 0, budget: 0 })
    this.#show(frame)
  }

  watch(vehicle: number): void {
    this.watched = vehicle
    this.#emit('watch', vehicle)
  }


  // --- playing

  play(): void {
    if (this.playing || this.frame?.finished) return
    this.playing = true
    this.#pace.reset()
    this.#last = performance.now()
    this.#emit('playing', true)
    const chain = ++this.#chain
    requestAnimationFrame(now => this.#tick(now, chain))
  }
  pause(): void {
    if (!this.playing) return
    this.playing = false
    this.#emit('playing', false)
  }
  toggle(): void {
    if (this.playing) this.pause()
    else if (!this.#over()) this.play()
  }
  async step(): Promise<void> {
    this.pause()
    if (this.#busy || this.#over()) return
    this.#show(await this.client.ask('advance', { steps: 1, budget: 1000 }))
  }
  setPlayback(playback: number): void {
    this.playback = playback
    this.#pace.reset()
    this.#emit('playing', this.playing)
  }
  /** The time that map and charts show, s: the whole run until the map is full, then its latest part. */
  window(): [number, number] {
    const { interval, map_window: most } = this.snapshot
    const now = (this.series.time.at(-1) ?? 0) + interval
    return now > most ? [now - most, now] : [0, Math.max(now, SHORTEST_WINDOW)]
  }
  /** Playback that the machine manages, or null while it keeps up. */
  behind(): number | null {
    return this.playing ? this.#pace.behind(this.playback) : null
  }

  async #tick(now: number, chain: number): Promise<void> {
    if (!this.playing || chain !== this.#chain) return
    const elapsed = now - this.#last
    this.#last = now
    // A hidden page stops; browsers hold its frames back anyway, and time that nobody saw is not made up for.
    if (!document.hidden && !this.#busy) {
      const steps = this.#pace.steps(Math.max(0, elapsed), this.playback, this.snapshot.scenario.time_step)
      if (steps > 0) {
        const frame = await this.client.ask('advance', { steps, budget: this.client.budget })
        this.#pace.report(steps, frame.finished ? steps : frame.taken)
        this.#show(frame)
        await this.#refresh(now)
        if (frame.finished) {
          this.pause()
          return
        }
      }
    }
    requestAnimationFrame(next => this.#tick(next, chain))
  }

  /** A timed action or a lane change has made the snapshot out of date. */
  async #refresh(now: number): Promise<void> {
    if (this.frame.changes === this.snapshot.changes || now - this.#refreshed < 400) return
    this.#refreshed = now
    this.snapshot = await this.client.ask('snapshot', {})
    this.#emit('snapshot', this.snapshot)
  }

  #show(frame: Frame): void {
    if (frame.epoch !== this.#epoch) {
      this.#epoch = frame.epoch
      this.series = empty(this.snapshot.watched.length)
    }
    this.frame = frame
    append(this.series, frame.rows, this.start.map.columns)
    this.#emit('frame', frame)
  }
}

function empty(watched: number): Series {
  return { time: [], mean: [], flow: [], imbalance: [], speeds: Array.from({ length: watched }, () => []) }
}

const columns = (rows: Series) => [rows.time, rows.mean, rows.flow, rows.imbalance, ...rows.speeds]

/** Appends what the core has recorded and drops what is older than the map shows. */
export function append(series: Series, rows: Series, most: number): void {
  const added = columns(rows)
  columns(series).forEach((column, k) => {
    column.push(...(added[k] as number[]))
    column.splice(0, column.length - most)
  })
}
