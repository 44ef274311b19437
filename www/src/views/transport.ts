// Play, pause, step, restart; the playback speed; the time line with the actions on it.
import { el } from '../ui/dom'
import { fixed } from '../text/format'
import { PLAYBACKS, type Session } from '../app/session'
import { text } from '../text'

const t = text.transport

export function transportView(session: Session): HTMLElement {
  const play = el('button', { type: 'button', class: 'main', id: 'play', onclick: () => session.toggle() }, t.play)
  const step = el('button', { type: 'button', id: 'step', onclick: () => void session.step() }, t.step)
  const restart = el('button', { type: 'button', id: 'restart', onclick: () => void session.restart(true) }, t.restart)
  const playback = el(
    'select',
    { id: 'playback', 'aria-label': t.playback, onchange: () => session.setPlayback(Number(playback.value)) },
    ...PLAYBACKS.map(x => el('option', { value: x }, t.times(x))),
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
    const wasPlaying = session.playing
    session.pause()
    await session.seek(Number(line.value))
    dragging = false
    if (wasPlaying) session.play()
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
    playback.value = String(session.playback)
    scale()
  })
  session.on('playing', playing => {
    play.textContent = playing ? t.pause : t.play
    playback.value = String(session.playback)
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
      time.textContent = t.time(frame.time, session.playback < 1 || !session.playing || frame.finished ? 2 : 1)
      line.value = String(frame.time)
      line.setAttribute('aria-valuetext', t.lineValue(frame.time))
    }
    const behind = session.behind()
    const words = behind === null ? '' : t.behind(behind)
    if (message.textContent !== words) message.textContent = words
  })
  let epoch = -1
  // The time line keeps the length that was reached, so that going back does not shrink it.
  const furthestOf = () => Math.min(furthest, session.snapshot.scenario.until)
  return el(
    'div',
    { class: 'transport', role: 'group', 'aria-label': t.title },
    el('div', { class: 'row' }, play, step, restart, playback),
    el('div', { class: 'row' }, el('div', { class: 'timeline' }, line, marks), time),
    message,
  )
}
