// The session: what is open and how it is looked at. Views listen to its events and ask it for changes; it asks the core.
import { Cancelled, type Client } from '../core/client'
import type { Answer, Ask, Frame, ColourBars, Name, Opened, Snapshot, Start, View } from '../core/protocol'
import { text } from '../text'
import { Emitter } from './events'
import { Playback } from './playback'
import { type Series, append, empty, timeWindow } from './series'

/** Shortest time between two snapshots that are asked for while the run plays, ms. */
const REFRESH = 400

interface Events {
  /** Something other than the traffic changed. */
  snapshot: Snapshot
  frame: Frame
  /** Another scenario is open: the name of its preset, or empty for a link or a file. */
  opened: string
  /** Played, paused, another playback, or behind it. */
  playing: boolean
  legends: ColourBars
  watch: number
  /** Sentences that say what was refused and why; an empty list clears them. */
  problem: readonly string[]
  /** Part of a replay that is done, 0 … 1, or null when it has ended. */
  progress: number | null
}

export class Session extends Emitter<Events> {
  snapshot!: Snapshot
  frame!: Frame
  legends!: ColourBars
  view: View
  /** The vehicle that the page follows, index from 0. */
  watched = 0
  /** Receives problems in place of the page while a dialog is open that shows them itself. */
  onProblem: ((messages: readonly string[]) => void) | null = null
  series: Series = empty(0)
  /** Whether a request other than steps is on its way. */
  busy = false
  readonly playback: Playback
  #epoch = -1
  #refreshed = 0

  constructor(
    readonly client: Client,
    readonly start: Start,
    dark: boolean,
  ) {
    super()
    this.view = { ring: 'difference', map: 'difference', dark, lane: 0, coMoving: false }
    this.playback = new Playback(this)
  }

  #problem(messages: readonly string[]): void {
    // An empty list clears the page even while a dialog takes the problems.
    if (this.onProblem && messages.length > 0) this.onProblem(messages)
    else this.emit('problem', messages)
  }

  /** Asks the core; a refusal is shown on the page and comes back as null. */
  async #ask<K extends Name>(name: K, ask: Ask<K>): Promise<Answer<K> | null> {
    this.busy = true
    try {
      const answer = await this.client.ask(name, ask, part => this.emit('progress', part))
      this.#problem([])
      return answer
    } catch (e) {
      if (!(e instanceof Cancelled)) this.#problem([e instanceof Error ? e.message : String(e)])
      return null
    } finally {
      this.busy = false
      this.emit('progress', null)
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
    await this.#changed(opened.snapshot)
    this.emit('opened', preset)
    if (opened.messages.length > 0) this.#problem(opened.messages)
    return true
  }

  // --- changes; each tells whether the core accepted it

  /** Applies an action now, such as `7:brake=3`. */
  async act(action: string): Promise<boolean> {
    return !this.crashed() && this.#change('act', { text: action })
  }
  /** Whether a collision has ended the run; if so, a problem on the page says it. */
  crashed(): boolean {
    const crashed = !!this.frame?.collision
    if (crashed) this.#problem([text.problem.over])
    return crashed
  }
  /** Sets a parameter: a driver's from now on, any other by starting the run again. */
  set(name: string, value: string): Promise<boolean> {
    return this.#change('set', { name, value })
  }
  /** Takes an action back, given by its index, and replays the run without it. */
  remove(index: number): Promise<boolean> {
    return this.#change('remove', { index })
  }
  /** Goes to a time (s). */
  seek(time: number): Promise<boolean> {
    return this.#change('seek', { time })
  }
  /** Starts the run again; `keep`: with the actions made so far. */
  restart(keep: boolean): Promise<boolean> {
    return this.#change('restart', { keep })
  }
  /** Moves the end of the run and plays on. */
  async extend(): Promise<void> {
    if (await this.#change('extend', {})) this.playback.play()
  }

  async #change<K extends 'act' | 'set' | 'remove' | 'seek' | 'restart' | 'extend'>(
    name: K,
    ask: Ask<K>,
  ): Promise<boolean> {
    const snapshot: Snapshot | null = await this.#ask(name, ask)
    if (!snapshot) {
      // Controls show the value that is still in force.
      if (this.snapshot) this.emit('snapshot', this.snapshot)
      return false
    }
    await this.#changed(snapshot)
    return true
  }

  async #changed(snapshot: Snapshot): Promise<void> {
    this.snapshot = snapshot
    this.playback.reset()
    if (this.view.lane >= snapshot.scenario.lanes) this.view = { ...this.view, lane: 0 }
    if (this.watched >= snapshot.scenario.vehicles) this.watched = 0
    const frame = await this.#repaint()
    this.emit('snapshot', snapshot)
    this.show(frame)
  }

  // --- how it is looked at

  async look(change: Partial<View>): Promise<void> {
    this.view = { ...this.view, ...change }
    this.show(await this.#repaint())
  }

  watch(vehicle: number): void {
    this.watched = vehicle
    this.emit('watch', vehicle)
  }

  /** The times (s) that map and charts begin and end at. */
  window(): [number, number] {
    return timeWindow(this.series, this.snapshot.interval, this.snapshot.map_window)
  }

  /** Tells the core how to paint, and gets the present frame in its colours. */
  async #repaint(): Promise<Frame> {
    this.legends = await this.client.ask('view', this.view)
    this.emit('legends', this.legends)
    return this.client.ask('advance', { steps: 0, budget: 0 })
  }

  /** Asks for a new snapshot when a timed action or a lane change has made the present one out of date. */
  async refresh(now: number): Promise<void> {
    if (this.frame.changes === this.snapshot.changes || now - this.#refreshed < REFRESH) return
    this.#refreshed = now
    this.snapshot = await this.client.ask('snapshot', {})
    this.emit('snapshot', this.snapshot)
  }

  show(frame: Frame): void {
    if (frame.epoch !== this.#epoch) {
      this.#epoch = frame.epoch
      this.series = empty(this.snapshot.watched.length)
    }
    this.frame = frame
    append(this.series, frame.rows, this.start.map.columns)
    this.emit('frame', frame)
  }
}
