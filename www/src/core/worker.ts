// The worker's side: passes the page's questions to the host, and the host's answers back.
import type { Question, Reply } from './protocol'
import { messageOf } from './client'
import { Host } from './host'

/** The part of a worker's global scope that is used here. */
interface Scope {
  onmessage: (event: MessageEvent<Question>) => void
  postMessage(message: Reply, transfer?: Transferable[]): void
}

/** The buffers of the typed arrays directly in an answer (those of a frame): they move to the page uncopied. */
const buffers = (answer: unknown): Transferable[] =>
  Object.values(answer ?? {}).flatMap(v => (ArrayBuffer.isView(v) ? [v.buffer as ArrayBuffer] : []))

export function answerPage(): void {
  const scope = self as unknown as Scope
  const host = new Host(false)
  scope.onmessage = async ({ data: { id, name, ask } }) => {
    try {
      const progress = (part: number) => scope.postMessage({ kind: 'progress', id, part })
      const answer = await host.answer(name, ask as never, progress)
      scope.postMessage({ kind: 'answer', id, answer }, name === 'advance' ? buffers(answer) : [])
    } catch (e) {
      scope.postMessage({ kind: 'error', id, message: messageOf(e) })
    }
  }
  scope.postMessage({ kind: 'ready' })
}
