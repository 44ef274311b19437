// Several cores at once, for work that falls into independent pieces. Where workers are forbidden, the page's own
// core does one piece after the other and lets the page breathe between them.
import { wasmBytes } from './assets'
import { Cancelled, type Client } from './client'
import { WorkerClient } from './worker_client'

/** More than this gains little and costs memory. */
const MOST = 8
/** Milliseconds for which the page's own core keeps the page waiting. */
const SLICE = 12

export class Pool {
  /** The page's own core, for a page without workers; it has the figures' module by then. */
  readonly #own: Client
  #clients: Promise<Client[]> | null = null
  #stop: (() => void) | null = null

  constructor(own: Client) {
    this.#own = own
  }

  async #open(): Promise<Client[]> {
    if (this.#own.place === 'page') return [this.#own]
    const wasm = await wasmBytes('figures')
    const count = Math.max(1, Math.min(MOST, navigator.hardwareConcurrency || 1))
    const one = async () => {
      const client = await WorkerClient.open()
      await client.ask('figures', { wasm })
      return client
    }
    const opened = await Promise.allSettled(Array.from({ length: count }, one))
    const clients = opened.flatMap(o => (o.status === 'fulfilled' ? [o.value] : []))
    return clients.length > 0 ? clients : [this.#own]
  }

  /**
   * Does pieces 0 … count − 1, then `last` with what they gave, in their order. Returns that, and the number of
   * workers. One call at a time; `cancel` ends it.
   */
  async run<P, R>(
    count: number,
    piece: (core: Client, k: number) => Promise<P>,
    last: (core: Client, pieces: P[]) => Promise<R>,
    progress: (done: number) => void,
  ): Promise<{ result: R; workers: number }> {
    let cancelled = false
    const given = new Promise<never>((_, reject) => {
      this.#stop = () => {
        cancelled = true
        reject(new Cancelled('cancelled'))
      }
    })
    const work = async () => {
      this.#clients ??= this.#open()
      const clients = await this.#clients
      const pieces = new Array<P>(count)
      let [next, done] = [0, 0]
      const each = async (core: Client) => {
        let breathed = performance.now()
        while (next < count && !cancelled) {
          const k = next++
          pieces[k] = await piece(core, k)
          progress(++done)
          if (core.place === 'page' && performance.now() - breathed > SLICE) {
            await new Promise(resolve => setTimeout(resolve))
            breathed = performance.now()
          }
        }
      }
      await Promise.all(clients.map(each))
      if (cancelled) throw new Cancelled('cancelled')
      const workers = clients.filter(c => c.place === 'worker').length
      return { result: await last(clients[0]!, pieces), workers }
    }
    try {
      return await Promise.race([work(), given])
    } finally {
      this.#stop = null
    }
  }

  /** Gives up what runs, at once: a worker in the midst of a piece is ended, and new ones start with the next run. */
  cancel(): void {
    const clients = this.#clients
    if (this.#stop && clients) {
      this.#clients = null
      void clients.then(all => all.forEach(c => c instanceof WorkerClient && c.close()), () => {})
    }
    if (this.#stop && this.#own.place === 'page') void this.#own.ask('cancel', {})
    this.#stop?.()
  }
}
