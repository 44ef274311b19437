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
