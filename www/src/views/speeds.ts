// The speeds of the watched vehicles over time, and the equilibrium speed.
import { card, style } from '../ui/dom'
import type { Session } from '../app/session'
import { text } from '../text'
import { type Line, keys, palette } from '../charts/keys'
import { chart } from '../charts/line_chart'
import { most } from '../charts/trace'

const t = text.speeds
const DASHES = [undefined, [10, 3], [4, 3], [12, 3, 3, 3], [2, 2]]

export function speedsView(session: Session): HTMLElement {
  const plot = chart(t.chart, t.unit, 2)
  let names = keys([])
  const { card: section, note } = card('speeds', t.title, plot.element, names)
  const restyle = () => {
    const colours = palette(session.view.dark)
    const lines: Line[] = session.snapshot.watched.map((n, k) => {
      const dash = DASHES[k]
      return { label: t.car(n), colour: colours[k]!, ...(dash ? { dash } : {}) }
    })
    plot.restyle([...lines, { label: t.equilibrium, colour: style('--ink'), dash: [6, 6], width: 1 }])
    const next = keys(lines)
    names.replaceWith(next)
    names = next
  }
  let watched = ''
  const draw = () => {
    const { time, speeds } = session.series
    const { mean_equilibrium_speed: equilibrium } = session.snapshot
    // The axis never gets shorter within a run: a wave that leaves the window does not change the scale.
    highest = Math.ceil(Math.max(4, 2 * equilibrium, highest, ...speeds.map(most)) / 2) * 2
    plot.show(time, [...speeds, equilibrium], session.window(), 0, highest)
  }
  let highest = 0
  let epoch = -1
  session.on('snapshot', snapshot => {
    note.textContent = t.note(snapshot.mean_equilibrium_speed)
    if (watched !== String(snapshot.watched)) {
      watched = String(snapshot.watched)
      restyle()
    }
  })
  session.on('legends', () => session.snapshot && restyle())
  let rows = -1
  session.on('frame', frame => {
    if (epoch !== frame.epoch) {
      epoch = frame.epoch
      highest = 0
      rows = -1
    }
    // Drawn only when the series has a new value.
    const last = session.series.time.at(-1) ?? -1
    if (last === rows) return
    rows = last
    draw()
  })
  return section
}
