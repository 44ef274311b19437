// The stability summary: what theory says of this ring, and the growth that the run has shown so far. While a control is moved,
// it is about the value that the control would set.
import { button, el } from '../ui/dom'
import type { Session } from '../app/session'
import type { StabilitySummary } from '../core/protocol'
import { text } from '../text'

const t = text.summary

export function summaryView(session: Session): { element: HTMLElement; preview: (summary: StabilitySummary | null) => void } {
  const mark = el('strong')
  const sentence = el('span', { class: 'sentence' })
  const measured = el('span', { class: 'measured' })
  const more = button({ hidden: true, onclick: () => void session.extend() }, t.goOn)
  const element = el('div', { id: 'summary', class: 'message' }, mark, el('div', {}, sentence, measured), more)
  let preview: StabilitySummary | null = null

  const put = (node: HTMLElement, value: string) => {
    if (node.textContent !== value) node.textContent = value
  }
  const show = () => {
    const { snapshot, frame } = session
    const crash = frame?.collision ?? null
    const v = preview ?? snapshot.stability
    const state = v.stable === null ? 'open' : v.stable ? 'stable' : 'unstable'
    element.dataset.state = state
    put(mark, `${state === 'unstable' ? '▲' : state === 'stable' ? '●' : '–'} ${t[state]}`)
    const lane = snapshot.scenario.lanes > 1 ? `${t.lane(v.lane)} ` : ''
    const theory = `${lane}${t.critical(v)} ${t.wave(v)}`
    const over = frame?.finished && !crash
    put(sentence, crash && !preview ? `${t.crash(crash.time, crash.behind + 1, crash.ahead + 1)} ${t.crashAdvice}` : theory)
    const growth = preview || crash || v.stable === null ? '' : frame?.growth ? t.measured(frame.growth, frame.large) : frame?.large ? t.large : over ? '' : t.measuring
    put(measured, [growth, over ? t.end(frame.time) : ''].filter(part => part !== '').join('; '))
    more.hidden = !over
  }
  session.on('snapshot', () => {
    preview = null
    show()
  })
  session.on('frame', show)
  return {
    element,
    preview(v) {
      preview = v
      show()
    },
  }
}
