// The one door to the core. Whether it stands in a worker or on the main thread, views cannot tell.
import type { Answer, Ask, Name } from './protocol'

/** The core refused, with a sentence for people. */
export class Refusal extends Error {}
/** A long request was given up on the person's wish. */
export class Cancelled extends Error {}
/** The message that stands for `Cancelled` across the border. */
export const CANCELLED = 'cancelled'

export interface Client {
  /** Where the core runs. */
  readonly place: 'worker' | 'page'
  /** Milliseconds of computing that one frame may cost. */
  readonly budget: number
  ask<K extends Name>(name: K, ask: Ask<K>, progress?: (part: number) => void): Promise<Answer<K>>
}

export const failure = (message: string): Error =>
  message === CANCELLED ? new Cancelled(message) : new Refusal(message)
