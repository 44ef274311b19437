// A line chart over time, the same window as the map's. A cursor reads its values: under the pointer, by touch, or
// moved with the arrow keys.
import { drawing, el, style } from '../ui/dom'
import { exactly, fixed, unit } from '../text/format'
import { text } from '../text'
import { type Frame, axes, flat, room, roundSteps, ticks } from './axes'

const t = text.chart

export interface Line {
  readonly label: string
  readonly colour: string
  readonly dash?: readonly number[]
  readonly width?: number
}
/** What a line shows: a value for each time, null or NaN where there is none; or one value that always holds. */
export type Values = readonly (number | null)[] | number
export interface Chart {
  readonly element: HTMLElement
  /** Draws: times, the values of each line, the span of time (s), and the lower and upper end of the vertical axis. */
  show(time: readonly number[], values: readonly Values[], window: [number, number], low: number, high: number): void
  /** Draws with these lines, in the colours of the page as it is now. */
  restyle(lines: readonly Line[]): void
}

/** The last of some ascending times that is not after `at`; −1 if all are. */
export function before(time: readonly number[], at: number): number {
  let [low, high] = [0, time.length]
  while (low < high) {
    const middle = (low + high) >> 1
    if (time[middle]! <= at) low = middle + 1
    else high = middle
  }
  return low - 1
}

/** The greatest value; −∞ if there is none. */
export function most(values: readonly (number | null)[]): number {
  let found = Number.NEGATIVE_INFINITY
  for (const value of values) if (value !== null && value > found) found = value
  return found
}

/**
 * Draws values from the row `first` on. Of the rows within half a pixel only the first, the least, the greatest and
 * the last are drawn: a long run costs no more than a short one, and no peak is lost.
 */
export function trace(
  c: Pick<CanvasPath, 'moveTo' | 'lineTo'>,
  time: readonly number[],
  values: readonly (number | null)[],
  first: number,
  x: (time: number) => number,
  y: (value: number) => number,
): void {
  // The column of half a pixel that is being gathered; none where the line begins anew.
  let column = Number.NaN
  let px = 0
  let low = 0
  let high = 0
  let last = 0
  // One row more than there are, so that the last column is drawn, too.
  for (let k = Math.max(0, first); k <= time.length; k++) {
    const value = values[k] ?? Number.NaN
    const at = Number.isNaN(value) ? Number.NaN : x(time[k]!)
    const py = y(value)
    const own = Math.round(2 * at)
    if (own === column) {
      if (py < low) low = py
      if (py > high) high = py
      last = py
      continue
    }
    if (low < high) {
      c.lineTo(px, low)
      c.lineTo(px, high)
      c.lineTo(px, last)
    }
    // From a little to the left, so that a value between two gaps is seen, too.
    if (!Number.isNaN(at)) {
      if (Number.isNaN(column)) c.moveTo(at - 0.5, py)
      c.lineTo(at, py)
    }
    column = own
    px = at
    low = high = last = py
  }
}

/** `name`: what stands above the vertical axis, the unit, unless it is told elsewhere; `digits`: decimals that are read. */
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
  let lines: readonly Line[] = []
  let time: readonly number[] = []
  let values: readonly Values[] = []
  let [start, end, low, high] = [0, 1, 0, 1]
  let f: Frame = flat(0, 0, 0, '')
  /** The cursor's place between the ends of the time axis, 0 … 1. */
  let cursor: number | null = null
  let names: readonly HTMLElement[] = []

  const x = (s: number) => f.left + ((f.right - f.left) * (s - start)) / (end - start)
  const y = (v: number) => f.bottom - ((f.bottom - f.top) * (v - low)) / (high - low)
  /** The row nearest to the cursor. */
  const row = () => {
    const at = start + cursor! * (end - start)
    const k = before(time, at)
    return k < 0 || (k + 1 < time.length && time[k + 1]! - at < at - time[k]!) ? k + 1 : k
  }
  const value = (k: number, at: number) => {
    const of = values[k]
    return (typeof of === 'number' ? of : of?.[at]) ?? Number.NaN
  }
  const reading = (k: number, at: number) => {
    const v = value(k, at)
    return `${lines[k]!.label}\t${Number.isNaN(v) ? '–' : exactly(v, digits)}`
  }
  const moment = (at: number) => t.time(unit(fixed(time[at]!, 2), 's'))

  const redraw = drawing(canvas, (c, w, h) => {
    tip.hidden = cursor === null || time.length === 0
    if (w < 60 || h < 50) return
    // First the numbers: the frame leaves them their width, and they find their places in it.
    const steps = roundSteps(low, high, Math.max(2, Math.floor((h - 28) / 34)))
    f = flat(w, h, room(steps), name)
    const times = roundSteps(start, end, Math.max(2, Math.floor((f.right - f.left) / 42)))
    axes(c, f, ticks(times, x), ticks(steps, y), { x: text.map.time, y: name })
    c.save()
    c.beginPath()
    c.rect(f.left, f.top - 1, f.right - f.left, f.bottom - f.top + 2)
    c.clip()
    c.lineJoin = 'round'
    const first = before(time, start)
    lines.forEach((line, k) => {
      const own = values[k]
      c.strokeStyle = line.colour
      c.lineWidth = line.width ?? 1.75
      c.setLineDash((line.dash ?? []) as number[])
      c.beginPath()
      if (typeof own === 'number') {
        c.moveTo(f.left, y(own))
        c.lineTo(f.right, y(own))
      } else if (own) trace(c, time, own, first, x, y)
      c.stroke()
    })
    c.restore()
    if (tip.hidden) return
    const at = row()
    const px = Math.round(x(time[at]!)) + 0.5
    c.strokeStyle = style('--soft')
    c.lineWidth = 1
    c.beginPath()
    c.moveTo(px, f.top)
    c.lineTo(px, f.bottom)
    c.stroke()
    c.strokeStyle = style('--card')
    lines.forEach((line, k) => {
      const v = value(k, at)
      if (typeof values[k] === 'number' || Number.isNaN(v)) return
      c.fillStyle = line.colour
      c.beginPath()
      c.arc(px, y(v), 3.5, 0, 7)
      c.fill()
      c.stroke()
    })
    when.textContent = moment(at)
    names.forEach((name, k) => (name.textContent = reading(k, at)))
    // Beside the cursor, on the side with more room.
    const wide = tip.offsetWidth
    tip.style.left = `${Math.max(0, Math.min(w - wide, px < w / 2 ? px + 10 : px - 10 - wide))}px`
  })

  /** Puts the cursor somewhere and, for who cannot see it, says what it reads. */
  const put = (place: number | null, spoken = false) => {
    cursor = place === null ? null : Math.min(1, Math.max(0, place))
    if (spoken && cursor !== null && time.length > 0) {
      const at = row()
      element.setAttribute('aria-valuemax', fixed(time.at(-1)!, 2))
      element.setAttribute('aria-valuenow', fixed(time[at]!, 2))
      element.setAttribute('aria-valuetext', `${moment(at)}: ${lines.map((_, k) => reading(k, at)).join(', ')} ${name}`.trim())
    }
    redraw()
  }
  const point = (event: PointerEvent) =>
    put((event.clientX - canvas.getBoundingClientRect().left - f.left) / Math.max(1, f.right - f.left))
  element.addEventListener('pointermove', point)
  element.addEventListener('pointerdown', event => {
    point(event)
    element.focus({ preventScroll: true })
  })
  // A finger that has gone leaves the reading, which it covered.
  element.addEventListener('pointerleave', event => event.pointerType === 'mouse' && put(null))
  element.addEventListener('focus', () => put(cursor ?? 1, true))
  element.addEventListener('blur', () => put(null))
  element.addEventListener('keydown', event => {
    const by = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -20, PageUp: 20, Home: -1e9, End: 1e9 }[event.key]
    if (by === undefined || time.length === 0 || event.ctrlKey || event.metaKey || event.altKey) return
    event.preventDefault()
    cursor ??= 1
    const next = Math.min(time.length - 1, Math.max(0, row() + by))
    put((time[next]! - start) / (end - start), true)
  })
  return {
    element,
    show(nextTime, nextValues, window, nextLow, nextHigh) {
      time = nextTime
      values = nextValues
      ;[start, end] = window
      low = nextLow
      high = nextHigh
      redraw()
    },
    restyle(next) {
      lines = next
      const list = keys(lines)
      names = [...list.children] as HTMLElement[]
      // The values stand in a column of their own.
      list.style.tabSize = `${44 + 7.5 * Math.max(...lines.map(line => line.label.length))}px`
      tip.replaceChildren(when, list)
      redraw()
    },
  }
}

/** Names of the lines, each with a piece of it. */
export const keys = (lines: readonly Line[]): HTMLElement =>
  el('div', { class: 'keys' }, ...lines.map(line => el('span', { style: `--piece:${piece(line)}` }, line.label)))

/** The pattern of a line as a background. */
function piece({ colour, dash = [] }: Line): string {
  let at = 0
  const stops = dash.map((length, k) => `${k % 2 === 0 ? colour : '#0000'} ${at}px ${(at += length)}px`)
  return stops.length === 0 ? `linear-gradient(${colour} 0 0)` : `repeating-linear-gradient(90deg,${stops.join()})`
}

/** Line colours that colour-blind eyes tell apart (after Okabe and Ito), for either ground. */
export const palette = (dark: boolean): readonly string[] =>
  dark ? ['#7cc4f5', '#f0a941', '#4fd0a5', '#f08bc1', '#e6e04e'] : ['#0064a6', '#b45f00', '#007a57', '#b13a80', '#5a4fb0']
