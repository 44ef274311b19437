// The core in a worker. Where a policy forbids workers, the browser reports it by an error event, not by an exception; so
// the client is ready only after the worker's first message.
import type { Answer, Ask, Name, Question, Reply } from './protocol'
import { startWorker } from './assets'
import { type Client, failure } from './client'

interface Waiting {
  readonly resolve: (answer: never) => void
  readonly reject: (error: Error) => void
  readonly progress: ((part: number) => void) | undefined
}

export class WorkerClient implements Client {
  readonly place = 'worker'
  readonly budget = 14
  #worker: Worker
  #waiting = new Map<number, Waiting>()
  #next = 0

  private constructor(worker: Worker) {
    this.#worker = worker
    worker.onmessage = ({ data }: MessageEvent<Reply>) => this.#receive(data)
  }

  /** Starts a worker. Rejects where workers are forbidden, or after `patience` milliseconds without a message. */
  static open(patience = 4000): Promise<WorkerClient> {
    return new Promise((resolve, reject) => {
      const worker = startWorker()
      const give = (reason: string) => {
        worker.terminate()
        reject(new Error(reason))
      }
      const timer = setTimeout(() => give('the worker does not answer'), patience)
      worker.onerror = event => {
        event.preventDefault()
        clearTimeout(timer)
        give(event.message || 'workers are not allowed here')
      }
      worker.onmessage = () => {
        clearTimeout(timer)
        resolve(new WorkerClient(worker))
      }
    })
  }

  ask<K extends Name>(name: K, ask: Ask<K>, progress?: (part: number) => void): Promise<Answer<K>> {
    return new Promise((resolve, reject) => {
      const question: Question = { id: this.#next++, name, ask }
      this.#waiting.set(question.id, { resolve: resolve as (answer: never) => void, reject, progress })
      // A canvas moves to the worker. Everything else is copied, since the main thread may need the bytes again.
      const moved = name === 'canvas' ? [(ask as Ask<'canvas'>).canvas] : []
      this.#worker.postMessage(question, moved)
    })
  }

  /** Ends the worker. Open requests stay without an answer. */
  close(): void {
    this.#worker.terminate()
    this.#waiting.clear()
  }

  #receive(reply: Reply): void {
    if (reply.kind === 'ready') return
    const waiting = this.#waiting.get(reply.id)
    if (!waiting) return
    if (reply.kind === 'progress') {
      waiting.progress?.(reply.part)
      return
    }
    this.#waiting.delete(reply.id)
    if (reply.kind === 'answer') waiting.resolve(reply.answer as never)
    else waiting.reject(failure(reply.message))
  }
}
