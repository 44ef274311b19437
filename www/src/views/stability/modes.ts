// Growth rate of each mode as measured in the run, and as theory predicts it.
import { drawing, el, style } from '../../ui/dom'
import type { ModalGrowth, LaneRoots } from '../../core/protocol'
import { text } from '../../text'
import { FONT, axes, frame, labelWidth, roundSteps, say, ticks, word } from '../../charts/axes'
import { clipped, line } from '../../charts/canvas'

const t = text.modes

/** A sentence on the measurement of the mode that grows fastest in theory. */
function status(measured: ModalGrowth, alike: boolean, fastest: number | null, time: number, lanes: number): string {
  if (fastest === null) return ''
  if (measured.modes.length === 0 && time >= measured.starts) return lanes > 1 ? t.changing : t.nothing
  const lead = measured.modes.find(m => m.mode === fastest)
  if (!lead) return time < measured.starts ? t.waiting(measured.starts) : ''
  if (lead.from === null || lead.to === null) {
    if (time < measured.starts) return t.waiting(measured.starts)
    return lead.ended_by === 'sank_into_rounding' ? t.quiet : t.large
  }
  // What the waves' size may have changed, and two standard errors.
  const error = lead.nonlinear_bound === null || lead.standard_error === null ? null : lead.nonlinear_bound + 2 * lead.standard_error
  return [t.ended[lead.ended_by](lead.from, lead.to, error), alike ? '' : t.differ].join(' ').trim()
}

/** Theory: a line through circles at these places (px). */
function drawPredicted(c: CanvasRenderingContext2D, places: readonly (readonly [number, number])[]): void {
  c.strokeStyle = style('--accent')
  c.beginPath()
  for (const place of places) c.lineTo(...place)
  c.stroke()
  c.fillStyle = style('--card')
  for (const place of places) {
    c.beginPath()
    c.arc(...place, 4, 0, 7)
    c.fill()
    c.stroke()
  }
}

/** A measured growth rate, its standard error, and how far the waves' size may have changed it, 1/s. */
interface Dot {
  readonly mode: number
  readonly rate: number
  readonly error: number
  readonly bound: number
}

/** The measurement: for each mode a diamond, its standard error as a line and the bound as a bar. */
function drawMeasured(c: CanvasRenderingContext2D, dots: readonly Dot[], x: (mode: number) => number, y: (rate: number) => number): void {
  c.strokeStyle = c.fillStyle = style('--ink')
  for (const { mode, rate, error, bound } of dots) {
    const [px, py] = [x(mode), y(rate)]
    c.globalAlpha = 0.22
    c.fillRect(px - 3, y(rate + bound), 6, y(rate - bound) - y(rate + bound))
    c.globalAlpha = 1
    line(c, px, y(rate - error), px, y(rate + error))
    c.beginPath()
    c.moveTo(px, py - 4)
    c.lineTo(px + 3, py)
    c.lineTo(px, py + 4)
    c.lineTo(px - 3, py)
    c.closePath()
    c.fill()
  }
}

export function modesView() {
  const canvas = el('canvas', { role: 'img', 'aria-label': t.describe('') })
  const said = el('p', { class: 'small', id: 'modes-status' })
  const element = el(
    'section',
    { id: 'modes', 'aria-labelledby': 'modes-title' },
    el('h3', { id: 'modes-title' }, t.title),
    el('div', { class: 'field' }, canvas),
    el('div', { class: 'keys marks' }, el('span', { class: 'theory', title: t.differHint }, t.predicted), el('span', { class: 'measured-mark', title: t.bound }, t.measured)),
    said,
  )
  let theory: LaneRoots | null = null
  let measured: ModalGrowth | null = null
  const redraw = drawing(canvas, (c, w, h) => {
    if (!theory || !measured) return
    if (theory.modes.length === 0) {
      say(c, t.none, w, h)
      return
    }
    const count = measured.followed
    const predicted = theory.modes.flatMap((mode, k) => {
      const rate = theory!.growth_per_s[k]
      return mode <= count && typeof rate === 'number' ? [{ mode, rate }] : []
    })
    const dots = measured.modes.flatMap(m => (m.rate === null ? [] : [{ mode: m.mode, rate: m.rate, error: m.standard_error ?? 0, bound: m.nonlinear_bound ?? 0 }]))
    const rates = [0, ...predicted.map(p => p.rate), ...dots.map(d => d.rate)]
    const span = Math.max(Math.max(...rates) - Math.min(...rates), 1e-4)
    const low = Math.min(...rates) - 0.08 * span
    const high = Math.max(...rates) + 0.16 * span
    const steps = roundSteps(low, high, 4)
    const f = frame(w, h, Math.max(46, labelWidth(steps)))
    const x = (mode: number) => f.left + ((f.right - f.left) * (mode - 0.5)) / count
    const y = (rate: number) => f.bottom - ((f.bottom - f.top) * (rate - low)) / (high - low)
    c.fillStyle = style('--bad-ground')
    c.fillRect(f.left, f.top, f.right - f.left, y(0) - f.top)
    const marks = roundSteps(1, count, 6).filter(Number.isInteger)
    axes(c, f, ticks(marks, x), ticks(steps, y), { x: t.axis, y: t.rate })
    c.lineWidth = 1.5
    c.strokeStyle = style('--ink')
    line(c, f.left, y(0), f.right, y(0))
    drawPredicted(c, predicted.map(p => [x(p.mode), y(p.rate)]))
    clipped(c, f.left, f.top, f.right, f.bottom, () => drawMeasured(c, dots, x, y))
    c.font = FONT
    c.textAlign = 'right'
    c.textBaseline = 'middle'
    if (y(0) - f.top > 16) word(c, text.roots.grows, f.right - 5, f.top + 10, style('--bad'))
  })
  return {
    element,
    redraw,
    show(roots: LaneRoots, growth: ModalGrowth, fastest: number | null, time: number, lanes: number) {
      theory = roots
      measured = growth
      const alike = roots.equal_drivers
      const list = growth.modes.flatMap(m => (m.rate === null ? [] : [t.one(m.mode, m.rate, m.predicted)]))
      canvas.setAttribute('aria-label', t.describe(list.join('; ')))
      const words = status(growth, alike, fastest, time, lanes)
      if (said.textContent !== words) said.textContent = words
      redraw()
    },
  }
}
