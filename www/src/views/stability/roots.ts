// The characteristic roots in the complex plane. A mode grows if its root lies right of the imaginary axis. Both axes are
// logarithmic away from 0, so that a root close to the imaginary axis differs visibly from one on it.
import { drawing, el, style } from '../../ui/dom'
import type { LaneRoots } from '../../core/protocol'
import { text } from '../../text'
import { FONT, axes, frame, say, ticks, word } from '../../charts/axes'
import { line } from '../../charts/canvas'

const t = text.roots
/** Below these values the axes are about linear, above them logarithmic, 1/s. */
const REAL = 0.01
const IMAGINARY = 0.1

const log = (value: number, from: number) => Math.sign(value) * Math.log1p(Math.abs(value) / from)

export function rootsView() {
  const canvas = el('canvas', { role: 'img' })
  const element = el(
    'section',
    { id: 'roots', 'aria-labelledby': 'roots-title' },
    el('h3', { id: 'roots-title' }, t.title),
    el('div', { class: 'field' }, canvas),
    el(
      'div',
      { class: 'keys marks' },
      el('span', { class: 'leading' }, t.dominant),
      el('span', { class: 'next' }, t.next),
    ),
  )
  let roots: LaneRoots | null = null
  const redraw = drawing(canvas, (c, w, h) => {
    if (!roots) return
    const f = frame(w, h, 30)
    const leading = roots.modes.flatMap((mode, k) => {
      const [re, im] = [roots!.growth_per_s[k], roots!.frequency_per_s[k]]
      // The roots of modes q and N − q are conjugate; the upper half shows them all.
      return typeof re === 'number' && typeof im === 'number' ? [{ mode, re, im: Math.abs(im) }] : []
    })
    const next = roots.next.map(root => ({ re: root.real_per_s, im: Math.abs(root.imaginary_per_s) }))
    const all = [...leading, ...next]
    if (all.length === 0) {
      say(c, t.none, w, h)
      return
    }
    const low = log(Math.min(-0.1, ...all.map(r => r.re)) * 1.5, REAL)
    // Leaves space for the word beside the axis.
    const high = log(Math.max(0.1, ...all.map(r => r.re)) * 3, REAL)
    const top = log(Math.max(1, ...all.map(r => r.im)) * 1.4, IMAGINARY)
    const x = (re: number) => f.left + ((f.right - f.left) * (log(re, REAL) - low)) / (high - low)
    const y = (im: number) => f.bottom - ((f.bottom - f.top) * log(im, IMAGINARY)) / top
    c.fillStyle = style('--bad-ground')
    c.fillRect(x(0), f.top, f.right - x(0), f.bottom - f.top)
    const inside = (v: number) => log(v, REAL) > low && log(v, REAL) < high
    const reals = [0, -10, -1, -0.1, 0.1, 1, 10].filter(inside).sort((a, b) => a - b)
    axes(c, f, ticks(reals, x), ticks([0, 0.1, 1, 10, 100].filter(v => log(v, IMAGINARY) < top), y), { x: t.real, y: t.imaginary })
    c.strokeStyle = style('--ink')
    c.lineWidth = 2
    line(c, x(0), f.top, x(0), f.bottom)
    c.strokeStyle = style('--soft')
    c.lineWidth = 1.25
    c.beginPath()
    for (const root of next) {
      const [px, py] = [x(root.re), y(root.im)]
      c.moveTo(px - 2.5, py - 2.5)
      c.lineTo(px + 2.5, py + 2.5)
      c.moveTo(px + 2.5, py - 2.5)
      c.lineTo(px - 2.5, py + 2.5)
    }
    c.stroke()
    for (const root of leading) {
      const [px, py] = [x(root.re), y(root.im)]
      c.beginPath()
      // Growing modes differ in shape, not in colour alone.
      if (root.re > 0) {
        c.moveTo(px, py - 5)
        c.lineTo(px + 4.5, py + 3.5)
        c.lineTo(px - 4.5, py + 3.5)
        c.closePath()
        c.fillStyle = style('--bad')
      } else {
        c.arc(px, py, 3.2, 0, 7)
        c.fillStyle = style('--good')
      }
      c.fill()
    }
    c.font = FONT
    c.textBaseline = 'middle'
    c.textAlign = 'right'
    word(c, t.fades, x(0) - 6, f.top + 11, style('--good'))
    c.textAlign = 'left'
    word(c, t.grows, x(0) + 5, f.top + 11, style('--bad'))
  })
  return {
    element,
    redraw,
    show(next: LaneRoots) {
      roots = next
      const rates = next.growth_per_s.map(rate => rate ?? Number.NEGATIVE_INFINITY)
      const right = next.modes.filter((_, k) => rates[k]! > 0)
      const k = rates.indexOf(Math.max(...rates))
      const words = k < 0 ? t.none : t.describe(right, next.modes.length, t.largest(next.modes[k]!, rates[k]!))
      canvas.setAttribute('aria-label', words)
      redraw()
    },
  }
}
