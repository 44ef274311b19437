// The traffic in words, every few seconds, for screen readers.
import { el } from '../ui/dom'
import type { Session } from '../app/session'
import { text } from '../text'

/** Time between two sentences, ms. */
const EVERY = 8000
/** Below this speed a vehicle counts as standing, m/s. */
const STANDS = 0.1

export function liveView(session: Session): HTMLElement {
  const element = el('div', { id: 'live', class: 'hidden', role: 'status', 'aria-live': 'polite' })
  let last = 0
  session.on('frame', frame => {
    const now = performance.now()
    if (!session.playback.playing || now - last < EVERY) return
    last = now
    const { speeds } = frame
    let [sum, low, high, standing] = [0, Number.POSITIVE_INFINITY, 0, 0]
    for (const v of speeds) {
      sum += v
      low = Math.min(low, v)
      high = Math.max(high, v)
      if (v < STANDS) standing++
    }
    element.textContent = `${text.live.state(frame.time, sum / speeds.length, low, high)} ${text.live.standing(standing)}`
  })
  session.on('playing', playing => {
    last = playing ? performance.now() : last
    element.textContent = playing ? text.live.playing : text.live.paused
  })
  return element
}
