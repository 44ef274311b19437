// What the page asks the core through. Two classes implement it: WorkerClient and LocalClient (the core on the main
// thread).
import type { Answer, Ask, Name } from './protocol'

/** The core refused a request; the message is a sentence for people. */
export class Refusal extends Error {}
/** A request was cancelled. */
export class Cancelled extends Error {}

export interface Client {
  /** Where the core runs. */
  readonly place: 'worker' | 'page'
  /** Milliseconds of computing that one frame may take. */
  readonly budget: number
  /** Rejects with `Refusal` or `Cancelled`. `progress` gets the part that is done, 0 … 1. */
  ask<K extends Name>(name: K, ask: Ask<K>, progress?: (part: number) => void): Promise<Answer<K>>
}

/** The message of an error for a `Reply`. */
export const messageOf = (e: unknown): string | null => (e instanceof Cancelled ? null : String(e instanceof Error ? e.message : e))
/** The error that such a message stands for. */
export const failure = (message: string | null): Error => (message === null ? new Cancelled() : new Refusal(message))
