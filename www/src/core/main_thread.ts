// The core on the main thread, in slices: for pages in which workers are forbidden.
import type { Answer, Ask, Name } from './protocol'
import { type Client, failure, messageOf } from './client'
import { Host } from './host'

export class LocalClient implements Client {
  readonly place = 'page'
  readonly budget = 8
  #host = new Host(true)

  async ask<K extends Name>(name: K, ask: Ask<K>, progress?: (part: number) => void): Promise<Answer<K>> {
    try {
      return await this.#host.answer(name, ask, progress ?? (() => {}))
    } catch (e) {
      throw failure(messageOf(e))
    }
  }
}
