// What all drawings with axes share: a frame with ticks, in the colours of the page.
import { fixed } from '../format'
import { style } from '../dom'

export const FONT = '12.5px system-ui, "DejaVu Sans", sans-serif'

export interface Frame {
  readonly left: number
  readonly top: number
  readonly right: number
  readonly bottom: number
  /** Little height: the name of the x axis stands in the row of its numbers. */
  readonly flat?: boolean
}
export interface Tick {
  readonly at: number
  readonly label: string
}

/** Round numbers between two ends, at most so many steps apart. */
export function roundSteps(low: number, high: number, most: number): number[] {
  const rough = (high - low) / most
  const power = 10 ** Math.floor(Math.log10(rough))
  const step = [1, 2, 3, 5, 6, 10].map(k => k * power).find(s => s >= rough) ?? 10 * power
  const steps = []
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) steps.push(k * step + 0)
  return steps
}

export const ticks = (values: readonly number[], place: (v: number) => number): Tick[] =>
  values.map(v => ({ at: place(v), label: fixed(v, 3) }))

/** Where a line one pixel wide fills pixels and does not straddle them. */
const crisp = (at: number): number => Math.round(at) + 0.5

/** Grid lines, numbers and the names of the axes; numbers that would touch their neighbour are left out. */
export function axes(c: CanvasRenderingContext2D, f: Frame, x: readonly Tick[], y: readonly Tick[], names: { x: string; y: string }): void {
  c.font = FONT
  c.lineWidth = 1
  c.strokeStyle = style('--track')
  c.beginPath()
  for (const { at } of x) {
    c.moveTo(crisp(at), f.top)
    c.lineTo(crisp(at), f.bottom)
  }
  for (const { at } of y) {
    c.moveTo(f.left, crisp(at))
    c.lineTo(f.right, crisp(at))
  }
  c.stroke()
  c.strokeStyle = style('--line')
  const [left, top] = [crisp(f.left), crisp(f.top)]
  c.strokeRect(left, top, crisp(f.right) - left, crisp(f.bottom) - top)
  c.fillStyle = style('--soft')
  c.textBaseline = 'top'
  c.textAlign = 'center'
  let end = Number.NEGATIVE_INFINITY
  const limit = f.flat ? f.right - c.measureText(names.x).width - 8 : f.right + 10
  for (const { at, label } of x) {
    const half = c.measureText(label).width / 2
    if (at - half < end + 5 || at + half > limit) continue
    c.fillText(label, at, f.bottom + 4)
    end = at + half
  }
  c.textBaseline = 'middle'
  c.textAlign = 'right'
  let last = Number.POSITIVE_INFINITY
  for (const { at, label } of y) {
    if (Math.abs(at - last) < 14) continue
    c.fillText(label, f.left - 5, at)
    last = at
  }
  c.fillStyle = style('--ink')
  c.textBaseline = f.flat ? 'top' : 'bottom'
  c.fillText(names.x, f.right, f.bottom + (f.flat ? 4 : 35))
  c.textAlign = 'left'
  c.textBaseline = 'bottom'
  c.fillText(names.y, f.flat ? 4 : 0, f.top - (f.flat ? 4 : 8))
}

/** A word with a halo of the card's colour, so that lines behind it do not touch it. */
export function word(c: CanvasRenderingContext2D, label: string, x: number, y: number, colour: string): void {
  c.strokeStyle = style('--card')
  c.lineWidth = 4
  c.lineJoin = 'round'
  c.strokeText(label, x, y)
  c.fillStyle = colour
  c.fillText(label, x, y)
}

export const frame = (w: number, h: number, left: number): Frame => ({ left, top: 25, right: w - 8, bottom: h - 36 })

/** The same in little height; with `name` there is room for that of the y axis. */
export const flat = (w: number, h: number, left: number, name: string): Frame =>
  ({ left, top: name === '' ? 8 : 20, right: w - 6, bottom: h - 21, flat: true })
