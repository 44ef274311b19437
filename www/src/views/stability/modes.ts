// Growth of each mode as the run shows it, beside what theory says.
import { drawing, el, style } from '../../ui/dom'
import type { ModalGrowth, Roots } from '../../core/protocol'
import { text } from '../../text'
import { axes, frame, room, roundSteps, say, ticks, word } from '../../charts/axes'

const t = text.modes

/** What the run has to say of the mode that theory calls the fastest. */
function status(measured: ModalGrowth, alike: boolean, fastest: number | null, time: number, lanes: number): string {
  if (fastest === null) return ''
  if (measured.modes.length === 0 && time >= measured.starts) return lanes > 1 ? t.changing : t.nothing
  const lead = measured.modes.find(m => m.mode === fastest)
  if (!lead) return time < measured.starts ? t.waiting(measured.starts) : ''
  if (lead.from === null || lead.to === null) {
    if (time < measured.starts) return t.waiting(measured.starts)
    return lead.ended_by === 'sank_into_rounding' ? t.quiet : t.large
  }
  // What the waves' size may have done, and the scatter.
  const error = lead.nonlinear_bound === null || lead.standard_error === null ? null : lead.nonlinear_bound + 2 * lead.standard_error
  return [t.ended[lead.ended_by](lead.from, lead.to, error), alike ? '' : t.differ].join(' ').trim()
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
  let theory: Roots | null = null
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
    const f = frame(w, h, Math.max(46, room(steps)))
    const x = (mode: number) => f.left + ((f.right - f.left) * (mode - 0.5)) / count
    const y = (rate: number) => f.bottom - ((f.bottom - f.top) * (rate - low)) / (high - low)
    c.fillStyle = style('--bad-ground')
    c.fillRect(f.left, f.top, f.right - f.left, y(0) - f.top)
    const marks = roundSteps(1, count, 6).filter(Number.isInteger)
    axes(c, f, ticks(marks, x), ticks(steps, y), { x: t.axis, y: t.rate })
    c.strokeStyle = style('--ink')
    c.lineWidth = 1.5
    c.beginPath()
    c.moveTo(f.left, y(0))
    c.lineTo(f.right, y(0))
    c.stroke()
    c.strokeStyle = style('--accent')
    c.lineWidth = 1.5
    c.beginPath()
    predicted.forEach((p, k) => (k === 0 ? c.moveTo(x(p.mode), y(p.rate)) : c.lineTo(x(p.mode), y(p.rate))))
    c.stroke()
    for (const p of predicted) {
      c.beginPath()
      c.arc(x(p.mode), y(p.rate), 4, 0, 7)
      c.fillStyle = style('--card')
      c.fill()
      c.stroke()
    }
    c.save()
    c.beginPath()
    c.rect(f.left, f.top, f.right - f.left, f.bottom - f.top)
    c.clip()
    c.strokeStyle = c.fillStyle = style('--ink')
    for (const d of dots) {
      const [px, py] = [x(d.mode), y(d.rate)]
      c.globalAlpha = 0.22
      c.fillRect(px - 3, y(d.rate + d.bound), 6, y(d.rate - d.bound) - y(d.rate + d.bound))
      c.globalAlpha = 1
      c.beginPath()
      c.moveTo(px, y(d.rate - d.error))
      c.lineTo(px, y(d.rate + d.error))
      c.stroke()
      c.beginPath()
      c.moveTo(px, py - 4)
      c.lineTo(px + 3, py)
      c.lineTo(px, py + 4)
      c.lineTo(px - 3, py)
      c.closePath()
      c.fill()
    }
    c.restore()
    c.font = '12.5px system-ui, "DejaVu Sans", sans-serif'
    c.textAlign = 'right'
    c.textBaseline = 'middle'
    if (y(0) - f.top > 16) word(c, text.roots.grows, f.right - 5, f.top + 10, style('--bad'))
  })
  return {
    element,
    redraw,
    show(roots: Roots, growth: ModalGrowth, fastest: number | null, time: number, lanes: number) {
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
