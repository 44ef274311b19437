// Playback: play, pause, step and restart; how fast; the time line with marks for the actions.
import { button, el } from '../ui/dom'
import { fixed } from '../text/format'
import { FACTORS } from '../app/playback'
import type { Session } from '../app/session'
import { text } from '../text'

const t = text.transport

export function transportView(session: Session): HTMLElement {
  const play = button({ class: 'main', id: 'play', onclick: () => session.playback.toggle() }, t.play)
  const step = button({ id: 'step', onclick: () => void session.playback.step() }, t.step)
  const restart = button({ id: 'restart', onclick: () => void session.restart(true) }, t.restart)
  const factor = el(
    'select',
    { id: 'playback', 'aria-label': t.playback, onchange: () => session.playback.setFactor(Number(factor.value)) },
    ...FACTORS.map(x => el('option', { value: x }, t.times(x))),
  )
  const time = el('span', { class: 'time', id: 'time' })
  const line = el('input', { type: 'range', min: 0, step: 0.5, 'aria-label': t.line, id: 'timeline' })
  const marks = el('div', { class: 'marks', 'aria-hidden': 'true' })
  const message = el('div', { class: 'message', role: 'status' })
  let furthest = 60
  let dragging = false
  line.addEventListener('input', () => {
    dragging = true
    time.textContent = t.time(Number(line.value), 1)
  })
  line.addEventListener('change', async () => {
    const wasPlaying = session.playback.playing
    session.playback.pause()
    await session.seek(Number(line.value))
    dragging = false
    if (wasPlaying) session.playback.play()
  })
  const scale = () => {
    line.max = String(furthest)
    const { actions } = session.snapshot.scenario
    marks.replaceChildren(
      ...actions
        .map(a => Number(/^at=([^:]+):/.exec(a)?.[1]))
        .filter(at => at > 0 && at <= furthest)
        .map(at => el('i', { style: `left:${(100 * at) / furthest}%` })),
    )
  }
  session.on('snapshot', () => {
    factor.value = String(session.playback.factor)
    scale()
  })
  session.on('playing', playing => {
    play.textContent = playing ? t.pause : t.play
    factor.value = String(session.playback.factor)
  })
  session.on('progress', part => {
    message.textContent = part === null ? '' : `${t.replaying} ${fixed(100 * part, 0)} %`
  })
  session.on('frame', frame => {
    play.disabled = frame.finished
    step.disabled = frame.finished
    if (frame.epoch !== epoch) {
      epoch = frame.epoch
      furthest = Math.max(60, furthestOf())
    }
    if (frame.time > furthest) {
      furthest = frame.time * 1.25
      scale()
    }
    if (!dragging) {
      time.textContent = t.time(frame.time, session.playback.factor < 1 || !session.playback.playing || frame.finished ? 2 : 1)
      line.value = String(frame.time)
      line.setAttribute('aria-valuetext', t.lineValue(frame.time))
    }
    const behind = session.playback.behind()
    const words = behind === null ? '' : t.behind(behind)
    if (message.textContent !== words) message.textContent = words
  })
  let epoch = -1
  // The time line keeps the length that it has reached: going back in time does not shorten it.
  const furthestOf = () => Math.min(furthest, session.snapshot.scenario.until)
  return el(
    'div',
    { class: 'transport', role: 'group', 'aria-label': t.title },
    el('div', { class: 'row' }, play, step, restart, factor),
    el('div', { class: 'row' }, el('div', { class: 'timeline' }, line, marks), time),
    message,
  )
}
