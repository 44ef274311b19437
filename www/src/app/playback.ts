// Playback: while it runs, every frame of the screen asks the core for as many steps as its time is worth.
import type { Client } from '../core/client'
import type { Frame, Snapshot } from '../core/protocol'
import { Pace } from './pace'

/** What a person can choose, times real time. */
export const FACTORS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100] as const

/** What playback needs of the session. */
interface Played {
  readonly client: Client
  readonly frame: Frame | undefined
  readonly snapshot: Snapshot
  /** Whether the core is at work on a request other than steps. */
  readonly busy: boolean
  /** Whether a collision has ended the run; says so if it has. */
  crashed(): boolean
  show(frame: Frame): void
  refresh(now: number): Promise<void>
  emit(event: 'playing', playing: boolean): void
}

export class Playback {
  playing = false
  /** Times real time. */
  factor = 5
  #pace = new Pace()
  #last = 0
  /** Number of the chain of frames in progress: play, pause and play again must not leave two of them. */
  #chain = 0

  constructor(readonly session: Played) {}

  play(): void {
    if (this.playing || this.session.frame?.finished) return
    this.playing = true
    this.#pace.reset()
    this.#last = performance.now()
    this.session.emit('playing', true)
    const chain = ++this.#chain
    requestAnimationFrame(now => this.#tick(now, chain))
  }

  pause(): void {
    if (!this.playing) return
    this.playing = false
    this.session.emit('playing', false)
  }

  toggle(): void {
    if (this.playing) this.pause()
    else if (!this.session.crashed()) this.play()
  }

  async step(): Promise<void> {
    const { session } = this
    this.pause()
    if (session.busy || session.crashed()) return
    session.show(await session.client.ask('advance', { steps: 1, budget: 1000 }))
  }

  setFactor(factor: number): void {
    this.factor = factor
    this.reset()
    this.session.emit('playing', this.playing)
  }

  /** Forgets how well the machine kept up: the scenario or the factor is another one now. */
  reset(): void {
    this.#pace.reset()
  }

  /** Playback that the machine manages (times real time), or null while it keeps up. */
  behind(): number | null {
    return this.playing ? this.#pace.behind(this.factor) : null
  }

  async #tick(now: number, chain: number): Promise<void> {
    if (!this.playing || chain !== this.#chain) return
    const { session } = this
    const elapsed = now - this.#last
    this.#last = now
    // Browsers call hidden pages seldom or never. The time in which the page was hidden is not made up for.
    if (!document.hidden && !session.busy) {
      const steps = this.#pace.steps(Math.max(0, elapsed), this.factor, session.snapshot.scenario.time_step)
      if (steps > 0) {
        const frame = await session.client.ask('advance', { steps, budget: session.client.budget })
        this.#pace.report(steps, frame.finished ? steps : frame.taken)
        session.show(frame)
        await session.refresh(now)
        if (frame.finished) {
          this.pause()
          return
        }
      }
    }
    requestAnimationFrame(next => this.#tick(next, chain))
  }
}
