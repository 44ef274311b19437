// How many steps each frame of the screen asks for. The time step is the core's and never changes: a faster playback
// takes more steps, and a machine that cannot keep up plays slower.

/** Time between two frames above which the rest is dropped, ms: a pause of the browser is not made up for. */
const LONGEST_FRAME = 100

export class Pace {
  /** Steps due but not asked for yet: the fraction of a step that is left over. */
  #due = 0
  #asked = 0
  #taken = 0
  /** Share of the steps asked for that were taken lately, 0 … 1. */
  #kept = 1

  /** Steps to ask for when `elapsed` ms have passed and the run plays at `factor` times real time. */
  steps(elapsed: number, factor: number, timeStep: number): number {
    this.#due += (Math.min(elapsed, LONGEST_FRAME) / 1000) * factor / timeStep
    const steps = Math.floor(this.#due)
    this.#due -= steps
    return steps
  }

  /** How many of the steps asked for were taken. The missing ones are not asked for again. */
  report(asked: number, taken: number): void {
    this.#asked += asked
    this.#taken += taken
    // Over a hundred steps or more, so that one slow frame alone does not count as falling behind.
    if (this.#asked >= 100) {
      this.#kept = 0.8 * this.#kept + 0.2 * (this.#taken / this.#asked)
      this.#asked = 0
      this.#taken = 0
    }
  }

  /** The playback that the machine manages (times real time), or null while it keeps up. */
  behind(factor: number): number | null {
    return this.#kept < 0.9 ? factor * this.#kept : null
  }

  reset(): void {
    this.#due = 0
    this.#asked = 0
    this.#taken = 0
    this.#kept = 1
  }
}
