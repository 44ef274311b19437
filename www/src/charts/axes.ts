// What all drawings with axes share: the frame with its ticks, words in the picture, and the places of both.
import { fixed } from '../text/format'
import { style } from '../ui/dom'

export const FONT = '12.5px system-ui, "DejaVu Sans", sans-serif'

export interface Frame {
  readonly left: number
  readonly top: number
  readonly right: number
  readonly bottom: number
  /** For little height: the name of the x axis stands in the row of its numbers. */
  readonly flat?: boolean
}
export interface Tick {
  readonly at: number
  readonly label: string
}

/** Round numbers between two ends, equally far apart, with at most `most` steps between them. */
export function roundSteps(low: number, high: number, most: number): number[] {
  const rough = (high - low) / most
  const power = 10 ** Math.floor(Math.log10(rough))
  const step = [1, 2, 3, 5, 6, 10].map(k => k * power).find(s => s >= rough) ?? 10 * power
  const steps = []
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) steps.push(k * step + 0)
  return steps
}

/** Numbers at an axis, with as many decimals as neighbours need to differ. */
export function labels(values: readonly number[]): string[] {
  const step = Math.min(...values.map((v, k) => Math.abs(v - (values[k - 1] ?? 0)) || Number.POSITIVE_INFINITY))
  const decimals = Math.min(20, Math.max(3, Math.ceil(-Math.log10(step) - 1e-9)))
  return values.map(v => fixed(v, decimals))
}
/** The width that such numbers need at a vertical axis, px. */
export const labelWidth = (values: readonly number[]): number => 9 + 7.5 * Math.max(0, ...labels(values).map(label => label.length))

export function ticks(values: readonly number[], place: (v: number) => number): Tick[] {
  const words = labels(values)
  return values.map((v, k) => ({ at: place(v), label: words[k]! }))
}

/** The place near `at` where a line one pixel wide covers one row of pixels, not two in part. */
const crisp = (at: number): number => Math.round(at) + 0.5

/** Grid lines, numbers and the names of the axes; a number that would touch its neighbour is left out. */
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
  // With little height the name goes to the right of the numbers, because the topmost number may be at the upper edge.
  c.fillText(names.y, f.flat ? f.left : 0, f.top - (f.flat ? 4 : 8))
}

/** A word with an outline in the card's colour, so that it can be read on top of lines. */
export function word(c: CanvasRenderingContext2D, label: string, x: number, y: number, colour: string): void {
  c.strokeStyle = style('--card')
  c.lineWidth = 4
  c.lineJoin = 'round'
  c.strokeText(label, x, y)
  c.fillStyle = colour
  c.fillText(label, x, y)
}

/** A frame in a canvas of `w` × `h` px. `left`: width of the numbers at the y axis, px. */
export const frame = (w: number, h: number, left: number): Frame => ({ left, top: 25, right: w - 8, bottom: h - 36 })

/** The height that a word needs, px. */
export const WORD = 20

/**
 * The place (px) for the middle of a word above or below a curve: as far to the right as the word fits between the curve and `top` or
 * `bottom` and does not cover the point `free`; null where it fits nowhere. `heights`: heights of the curve, pixel by pixel from
 * x = 0; `half`: half of the word's width.
 */
export function spot(heights: readonly number[], half: number, above: boolean, top: number, bottom: number, free: { x: number; y: number }): { x: number; y: number } | null {
  for (let x = heights.length - 1 - half; x >= half; x--) {
    const part = heights.slice(x - half, x + half + 1)
    const space = above ? Math.min(...part) - top : bottom - Math.max(...part)
    const y = above ? top + Math.min(16, space / 2) : bottom - Math.min(14, space / 2)
    const near = Math.abs(x - free.x) < half + WORD && Math.abs(y - free.y) < 1.5 * WORD
    if (space >= WORD && !near) return { x, y }
  }
  return null
}

/** A sentence in place of a picture that has nothing to show, broken into lines. */
export function say(c: CanvasRenderingContext2D, sentence: string, w: number, h: number): void {
  c.font = FONT
  c.fillStyle = style('--soft')
  c.textAlign = 'left'
  c.textBaseline = 'middle'
  const lines = ['']
  for (const part of sentence.split(' ')) {
    const longer = `${lines.at(-1)} ${part}`.trim()
    if (c.measureText(longer).width < w - 8) lines[lines.length - 1] = longer
    else lines.push(part)
  }
  lines.forEach((line, k) => c.fillText(line, 2, h / 2 + 18 * (k - (lines.length - 1) / 2)))
}

/** A frame for little height. `name`: that of the y axis; an empty one needs no space above. */
export const flat = (w: number, h: number, left: number, name: string): Frame =>
  ({ left, top: name === '' ? 8 : 20, right: w - 6, bottom: h - 21, flat: true })
