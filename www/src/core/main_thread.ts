// The core on the main thread, in slices: for pages that forbid workers.
import type { Answer, Ask, Name } from './protocol'
import { Host } from './host'
import { type Client, failure } from './client'

export class LocalClient implements Client {
  readonly place = 'page'
  readonly budget = 8
  #host = new Host(true)

  async ask<K extends Name>(name: K, ask: Ask<K>, progress?: (part: number) => void): Promise<Answer<K>> {
    try {
      return await this.#host.answer(name, ask, progress ?? (() => {}))
    } catch (e) {
      throw failure(String(e instanceof Error ? e.message : e))
    }
  }
}
