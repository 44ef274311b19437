// The traffic in words, every few seconds, for screen readers.
import { el } from '../ui/dom'
import type { Session } from '../app/session'
import { text } from '../text'

/** Time between two sentences, ms. */
const EVERY = 8000

export function liveView(session: Session): HTMLElement {
  const element = el('div', { id: 'live', class: 'hidden', role: 'status', 'aria-live': 'polite' })
  let last = 0
  session.on('frame', frame => {
    const now = performance.now()
    if (!session.playback.playing || now - last < EVERY) return
    last = now
    const { mean_speed, lowest_speed, highest_speed, standing } = frame.traffic
    element.textContent = `${text.live.state(frame.time, mean_speed, lowest_speed, highest_speed)} ${text.live.standing(standing)}`
  })
  session.on('playing', playing => {
    last = playing ? performance.now() : last
    element.textContent = playing ? text.live.playing : text.live.paused
  })
  return element
}
