// What the drawings of the stability tab share: a frame with ticks, in the colours of the page.
import { fixed } from '../format'
import { style } from '../dom'

export const FONT = '12.5px system-ui, "DejaVu Sans", sans-serif'

export interface Frame {
  readonly left: number
  readonly top: number
  readonly right: number
  readonly bottom: number
}
export interface Tick {
  readonly at: number
  readonly label: string
}

export const ticks = (values: readonly number[], place: (v: number) => number): Tick[] =>
  values.map(v => ({ at: place(v), label: fixed(v, 3) }))

/** Grid lines, numbers and the names of the axes; numbers that would touch their neighbour are left out. */
export function axes(c: CanvasRenderingContext2D, f: Frame, x: readonly Tick[], y: readonly Tick[], names: { x: string; y: string }): void {
  c.font = FONT
  c.lineWidth = 1
  c.strokeStyle = style('--track')
  c.beginPath()
  for (const { at } of x) {
    c.moveTo(at, f.top)
    c.lineTo(at, f.bottom)
  }
  for (const { at } of y) {
    c.moveTo(f.left, at)
    c.lineTo(f.right, at)
  }
  c.stroke()
  c.strokeStyle = style('--line')
  c.strokeRect(f.left, f.top, f.right - f.left, f.bottom - f.top)
  c.fillStyle = style('--soft')
  c.textBaseline = 'top'
  c.textAlign = 'center'
  let end = Number.NEGATIVE_INFINITY
  for (const { at, label } of x) {
    const half = c.measureText(label).width / 2
    if (at - half < end + 5 || at + half > f.right + 10) continue
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
  c.textBaseline = 'bottom'
  c.fillText(names.x, f.right, f.bottom + 35)
  c.textAlign = 'left'
  c.fillText(names.y, 0, f.top - 8)
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

/** Height that a word needs, px. */
export const WORD = 20

/**
 * The middle of a word above or below a curve, as far right as it has room and leaves a point free; null where there is no such
 * place. `heights` are the curve's, pixel by pixel from x = 0; `half` is half of the word's width.
 */
export function spot(heights: readonly number[], half: number, above: boolean, top: number, bottom: number, free: { x: number; y: number }): { x: number; y: number } | null {
  for (let x = heights.length - 1 - half; x >= half; x--) {
    const part = heights.slice(x - half, x + half + 1)
    const gap = above ? Math.min(...part) - top : bottom - Math.max(...part)
    const y = above ? top + Math.min(16, gap / 2) : bottom - Math.min(14, gap / 2)
    const near = Math.abs(x - free.x) < half + WORD && Math.abs(y - free.y) < 1.5 * WORD
    if (gap >= WORD && !near) return { x, y }
  }
  return null
}

/** A sentence in a picture that has nothing to show, in lines as wide as it. */
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
