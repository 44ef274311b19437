// Several workers at once, for the independent tasks of a figure. Where workers are forbidden, the core on the main thread
// does one task after the other, with pauses for the page between them.
import { wasmBytes } from './assets'
import { Cancelled, type Client } from './client'
import { WorkerClient } from './worker_client'

/** Most workers: more of them gain little and cost memory. */
const MOST = 8
/** Milliseconds after which the core on the main thread makes a pause. */
const SLICE = 12

export class Pool {
  /** The laboratory's client, used where workers are forbidden; the module of the figures is started in it by then. */
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
   * Does tasks 0 … count − 1, then `last` with their results, in the order of the tasks. Returns what `last` returns, and
   * the number of workers. One call at a time; `cancel` ends it.
   */
  async run<T, R>(
    count: number,
    task: (core: Client, k: number) => Promise<T>,
    last: (core: Client, results: T[]) => Promise<R>,
    progress: (done: number) => void,
  ): Promise<{ result: R; workers: number }> {
    let cancelled = false
    const stopped = new Promise<never>((_, reject) => {
      this.#stop = () => {
        cancelled = true
        reject(new Cancelled())
      }
    })
    const work = async () => {
      this.#clients ??= this.#open()
      const clients = await this.#clients
      const results = new Array<T>(count)
      let [next, done] = [0, 0]
      const each = async (core: Client) => {
        let paused = performance.now()
        while (next < count && !cancelled) {
          const k = next++
          results[k] = await task(core, k)
          progress(++done)
          if (core.place === 'page' && performance.now() - paused > SLICE) {
            await new Promise(resolve => setTimeout(resolve))
            paused = performance.now()
          }
        }
      }
      await Promise.all(clients.map(each))
      if (cancelled) throw new Cancelled()
      const workers = clients.filter(c => c.place === 'worker').length
      return { result: await last(clients[0]!, results), workers }
    }
    try {
      return await Promise.race([work(), stopped])
    } finally {
      this.#stop = null
    }
  }

  /** Ends the present run at once: its workers are closed, and new ones are started for the next run. */
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
