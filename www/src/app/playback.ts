// How many steps a frame asks for. The step is the core's and never changes: a faster playback takes more of
// them, and a machine that cannot keep up plays slower.

/** The longest pause between two pictures that is made up for, ms. */
const LONGEST_FRAME = 100

export class Pace {
  #debt = 0
  #asked = 0
  #taken = 0
  /** How much of what was asked was done of late, 0 … 1. */
  #kept = 1

  /** Steps to ask for after `elapsed` ms at `playback` times real time. */
  steps(elapsed: number, playback: number, timeStep: number): number {
    this.#debt += (Math.min(elapsed, LONGEST_FRAME) / 1000) * playback / timeStep
    const steps = Math.floor(this.#debt)
    this.#debt -= steps
    return steps
  }

  /** What came of it. Steps that were not taken are not asked for again. */
  report(asked: number, taken: number): void {
    this.#asked += asked
    this.#taken += taken
    // Judged over a hundred steps or more, so that a single slow frame is no complaint.
    if (this.#asked >= 100) {
      this.#kept = 0.8 * this.#kept + 0.2 * (this.#taken / this.#asked)
      this.#asked = 0
      this.#taken = 0
    }
  }

  /** The playback that the machine manages, or null while it keeps up. */
  behind(playback: number): number | null {
    return this.#kept < 0.9 ? playback * this.#kept : null
  }

  reset(): void {
    this.#debt = 0
    this.#asked = 0
    this.#taken = 0
    this.#kept = 1
  }
}
