// The lanes tab: vehicles in each lane now, the difference between the fullest and the emptiest lane, and the flow, over time.
import { el } from '../ui/dom'
import type { Session } from '../app/session'
import { text } from '../text'
import { palette } from '../charts/keys'
import { chart } from '../charts/line_chart'
import { most } from '../charts/trace'

const t = text.lanes

export function lanesView(session: Session): HTMLElement {
  const counts = el('div', { class: 'note', style: 'margin:0;text-align:left' })
  const imbalance = chart(t.imbalanceChart, '', 0)
  const flow = chart(t.flowChart, '', 0)
  const flowTitle = el('h3')
  const several = el('div', { class: 'stack' }, el('h3', {}, t.imbalance), imbalance.element)
  const element = el('div', {}, counts, several, el('div', { class: 'stack' }, flowTitle, flow.element))
  imbalance.element.style.minHeight = flow.element.style.minHeight = '80px'
  const restyle = () => {
    const colours = palette(session.view.dark)
    imbalance.restyle([{ label: t.symbol, colour: colours[0]!, width: 2 }])
    flow.restyle([{ label: t.flowName, colour: colours[1]!, width: 2 }])
  }
  const draw = () => {
    if (element.hidden) return
    const { time, imbalance: delta, flow: q } = session.series
    const window = session.window()
    const perHour = q.map(v => (v === null ? null : v * 3600))
    const { lanes } = session.snapshot.scenario
    imbalance.show(time, [delta], window, 0, Math.max(4, most(delta)) * 1.05)
    flow.show(time, [perHour], window, 0, Math.max(1000, most(perHour)) * 1.1)
    const { vehicles_per_lane, lane_changes } = session.frame.traffic
    counts.textContent = lanes === 1 ? t.one : `${t.counts(vehicles_per_lane)} · ${t.changes(lane_changes)}`
  }
  session.on('legends', () => session.snapshot && restyle())
  session.on('snapshot', ({ flow_window, scenario }) => {
    several.hidden = scenario.lanes === 1
    flowTitle.textContent = t.flow(flow_window)
  })
  let drawn = 0
  session.on('frame', () => {
    // The series has two values a second: ten drawings a second are enough.
    const now = performance.now()
    if (session.playback.playing && now - drawn < 100) return
    drawn = now
    draw()
  })
  new MutationObserver(() => {
    if (session.frame) draw()
  }).observe(element, { attributeFilter: ['hidden'] })
  return element
}
