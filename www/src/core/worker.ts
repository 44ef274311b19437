// The worker: hands questions to the host and its answers back.
import type { Frame, Question, Reply } from './protocol'
import { Host } from './host'

/** What a worker's global scope is to us. */
interface Scope {
  onmessage: (event: MessageEvent<Question>) => void
  postMessage(message: Reply, transfer?: Transferable[]): void
}

/** The typed arrays of a frame move to the page; nothing else does. */
const buffers = (answer: unknown): Transferable[] =>
  answer !== null && typeof answer === 'object' && 'positions' in answer
    ? Object.values(answer as Frame).flatMap(v => (ArrayBuffer.isView(v) ? [v.buffer as ArrayBuffer] : []))
    : []

export function answerPage(): void {
  const scope = self as unknown as Scope
  const host = new Host(false)
  scope.onmessage = async ({ data: { id, name, ask } }) => {
    try {
      const progress = (part: number) => scope.postMessage({ kind: 'progress', id, part })
      const answer = await host.answer(name, ask as never, progress)
      scope.postMessage({ kind: 'answer', id, answer }, buffers(answer))
    } catch (e) {
      scope.postMessage({ kind: 'error', id, message: String(e instanceof Error ? e.message : e) })
    }
  }
  scope.postMessage({ kind: 'ready' })
}
