// A line chart over time. A cursor reads the values: it is under the pointer, where the chart was touched, or moved with
// the arrow keys.
import { drawing, el, style } from '../ui/dom'
import { exactly, fixed, unit } from '../text/format'
import { text } from '../text'
import { type Frame, axes, flat, labelWidth, roundSteps, ticks } from './axes'
import { clipped, line } from './canvas'
import { type Line, keys } from './keys'
import { before, trace } from './trace'

const t = text.chart

/** What a line shows: a value for each time, null or NaN where there is none; or one value for all times. */
export type Values = readonly (number | null)[] | number
export interface Chart {
  readonly element: HTMLElement
  /** Draws: times, the values of each line, the first and last time shown (s), and the ends of the vertical axis. */
  show(time: readonly number[], values: readonly Values[], window: [number, number], low: number, high: number): void
  /** Draws with these lines, in the present colours of the page. */
  restyle(lines: readonly Line[]): void
}

/** What a chart shows, and where. */
class Plot {
  lines: readonly Line[] = []
  time: readonly number[] = []
  values: readonly Values[] = []
  /** First and last time on the horizontal axis, s. */
  window: readonly [number, number] = [0, 1]
  low = 0
  high = 1
  frame: Frame = flat(0, 0, 0, '')
  /** The cursor's place between the ends of the time axis, 0 … 1; null where there is none. */
  cursor: number | null = null

  /** `digits`: decimals of the values that are read. */
  constructor(readonly digits: number) {}

  x = (s: number): number => {
    const { frame, window } = this
    return frame.left + ((frame.right - frame.left) * (s - window[0])) / (window[1] - window[0])
  }
  y = (v: number): number => {
    const { frame, low, high } = this
    return frame.bottom - ((frame.bottom - frame.top) * (v - low)) / (high - low)
  }
  /** The place of a time between the ends of the time axis. */
  place(s: number): number {
    const [start, end] = this.window
    return (s - start) / (end - start)
  }
  /** The row nearest to the cursor. */
  row(): number {
    const { time, window, cursor } = this
    const at = window[0] + cursor! * (window[1] - window[0])
    const k = before(time, at)
    return k < 0 || (k + 1 < time.length && time[k + 1]! - at < at - time[k]!) ? k + 1 : k
  }
  /** The value of line `k` in a row; NaN where there is none. */
  value(k: number, row: number): number {
    const of = this.values[k]
    return (typeof of === 'number' ? of : of?.[row]) ?? Number.NaN
  }
  /** The name of line `k` and its value in a row, in words. */
  reading(k: number, row: number): string {
    const v = this.value(k, row)
    return `${this.lines[k]!.label}\t${Number.isNaN(v) ? '–' : exactly(v, this.digits)}`
  }
  /** The time of a row in words. */
  moment = (row: number): string => t.time(unit(fixed(this.time[row]!, 2), 's'))
}

function drawLines(c: CanvasRenderingContext2D, { lines, time, values, window, frame: f, x, y }: Plot): void {
  clipped(c, f.left, f.top - 1, f.right, f.bottom + 1, () => {
    c.lineJoin = 'round'
    const first = before(time, window[0])
    lines.forEach(({ colour, width, dash }, k) => {
      const own = values[k]
      c.strokeStyle = colour
      c.lineWidth = width ?? 1.75
      c.setLineDash((dash ?? []) as number[])
      if (typeof own === 'number') line(c, f.left, y(own), f.right, y(own))
      else if (own) {
        c.beginPath()
        trace(c, time, own, first, x, y)
        c.stroke()
      }
    })
  })
}

/** The cursor in a row: a vertical line, and a point on each line that has a value there. `px`: its place. */
function drawCursor(c: CanvasRenderingContext2D, plot: Plot, row: number, px: number): void {
  const { top, bottom } = plot.frame
  c.strokeStyle = style('--soft')
  c.lineWidth = 1
  line(c, px, top, px, bottom)
  c.strokeStyle = style('--card')
  plot.lines.forEach(({ colour }, k) => {
    const v = plot.value(k, row)
    if (typeof plot.values[k] === 'number' || Number.isNaN(v)) return
    c.fillStyle = colour
    c.beginPath()
    c.arc(px, plot.y(v), 3.5, 0, 7)
    c.fill()
    c.stroke()
  })
}

/** Pointer, touch and keys. `put` places the cursor, between 0 and 1 or null for none; `spoken`: for screen readers, too. */
function listen(element: HTMLElement, canvas: HTMLElement, plot: Plot, put: (place: number | null, spoken?: boolean) => void): void {
  const point = (event: PointerEvent) => {
    const { left, right } = plot.frame
    put((event.clientX - canvas.getBoundingClientRect().left - left) / Math.max(1, right - left))
  }
  element.addEventListener('pointermove', point)
  element.addEventListener('pointerdown', event => {
    point(event)
    element.focus({ preventScroll: true })
  })
  // A finger covers the reading, so that the reading stays when the finger is lifted.
  element.addEventListener('pointerleave', event => event.pointerType === 'mouse' && put(null))
  element.addEventListener('focus', () => put(plot.cursor ?? 1, true))
  element.addEventListener('blur', () => put(null))
  element.addEventListener('keydown', event => {
    const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -20, PageUp: 20, Home: -1e9, End: 1e9 }[event.key]
    const { time } = plot
    if (by === undefined || time.length === 0 || event.ctrlKey || event.metaKey || event.altKey) return
    event.preventDefault()
    plot.cursor ??= 1
    put(plot.place(time[Math.min(time.length - 1, Math.max(0, plot.row() + by))]!), true)
  })
}

/** `name`: what stands above the vertical axis, such as the unit; `digits`: decimals of the values that are read. */
export function chart(label: string, name: string, digits: number): Chart {
  const canvas = el('canvas')
  const when = el('b')
  const tip = el('div', { class: 'tip', hidden: true, 'aria-hidden': 'true' })
  const element = el(
    'div',
    {
      class: 'chart',
      tabindex: 0,
      role: 'slider',
      'aria-roledescription': t.kind,
      'aria-label': label,
      'aria-valuemin': 0,
      'aria-valuemax': 0,
      'aria-valuenow': 0,
      'aria-valuetext': t.hint,
    },
    canvas,
    tip,
  )
  const plot = new Plot(digits)
  let names: readonly HTMLElement[] = []

  const redraw = drawing(canvas, (c, w, h) => {
    const { cursor, time, low, high } = plot
    tip.hidden = cursor === null || time.length === 0
    if (w < 60 || h < 50) return
    // The numbers come first: the frame leaves them their width, and their places follow from the frame.
    const steps = roundSteps(low, high, Math.max(2, Math.floor((h - 28) / 34)))
    const f = (plot.frame = flat(w, h, labelWidth(steps), name))
    const times = roundSteps(...plot.window, Math.max(2, Math.floor((f.right - f.left) / 42)))
    axes(c, f, ticks(times, plot.x), ticks(steps, plot.y), { x: text.map.time, y: name })
    drawLines(c, plot)
    if (tip.hidden) return
    const row = plot.row()
    const px = Math.round(plot.x(time[row]!)) + 0.5
    drawCursor(c, plot, row, px)
    when.textContent = plot.moment(row)
    names.forEach((name, k) => (name.textContent = plot.reading(k, row)))
    // Beside the cursor, on the side with more space.
    const wide = tip.offsetWidth
    tip.style.left = `${Math.max(0, Math.min(w - wide, px < w / 2 ? px + 10 : px - 10 - wide))}px`
  })
  listen(element, canvas, plot, (place, spoken) => {
    const { time, lines } = plot
    plot.cursor = place === null ? null : Math.min(1, Math.max(0, place))
    if (spoken && place !== null && time.length > 0) {
      const row = plot.row()
      element.setAttribute('aria-valuemax', fixed(time.at(-1)!, 2))
      element.setAttribute('aria-valuenow', fixed(time[row]!, 2))
      element.setAttribute('aria-valuetext', `${plot.moment(row)}: ${lines.map((_, k) => plot.reading(k, row)).join(', ')} ${name}`.trim())
    }
    redraw()
  })
  return {
    element,
    show(time, values, window, low, high) {
      Object.assign(plot, { time, values, window, low, high })
      redraw()
    },
    restyle(lines) {
      plot.lines = lines
      const list = keys(lines)
      names = [...list.children] as HTMLElement[]
      // The values stand in a column of their own.
      list.style.tabSize = `${44 + 7.5 * Math.max(...lines.map(line => line.label.length))}px`
      tip.replaceChildren(when, list)
      redraw()
    },
  }
}
