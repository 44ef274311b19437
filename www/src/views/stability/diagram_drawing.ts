// Draws the stability diagram, layer by layer: regions or growth rates, axes, curves, and the lines from the point to the axes.
import { axes, roundSteps, ticks } from '../../charts/axes'
import { clipped } from '../../charts/canvas'
import type { Curves } from '../../core/protocol'
import { text } from '../../text'
import { style } from '../../ui/dom'
import type { Layout, Point } from './diagram_layout'
import type { GrowthMap } from './growth_map'

/** What one drawing of the diagram shows. */
export interface Picture {
  readonly layout: Layout
  readonly curves: Curves
  /** The number of vehicles beyond which the lane is a jam. */
  readonly jam: number
  readonly point: Point
  /** Growth rates as colours; null where stable and unstable regions are shown. */
  readonly growth: GrowthMap | null
  /** The curves of the single modes (s), one after the other, and their colour; null where they are not shown. */
  readonly modes: { readonly values: Float64Array; readonly colour: string } | null
  readonly dark: boolean
  /** The name of the horizontal axis. */
  readonly name: string
}

/** The right end of the regions: vehicles beyond it are a jam. */
export const jamAt = ({ layout, jam }: Picture): number => Math.min(layout.frame.right, layout.x(jam))

/** The height of a curve; null: no such value. A value far above the diagram counts as just above it: browsers take long to
 * draw dashes along a line of a million pixels. */
const height = ({ y, ends }: Layout, delay: number | null): number => y(Math.min(delay ?? Infinity, 4 * ends.delay))

/** Adds a curve to the path; it has gaps where there is no value. */
function addCurve(c: CanvasRenderingContext2D, { layout, curves }: Picture, values: ArrayLike<number | null>): void {
  let on = false
  curves.vehicles.forEach((n, k) => {
    const value = values[k]!
    const given = value !== null && Number.isFinite(value)
    if (given) {
      if (on) c.lineTo(layout.x(n), height(layout, value))
      else c.moveTo(layout.x(n), height(layout, value))
    }
    on = given
  })
}

function strokeCurve(c: CanvasRenderingContext2D, picture: Picture, values: ArrayLike<number | null>): void {
  c.beginPath()
  addCurve(c, picture, values)
  c.stroke()
}

function drawRegions(c: CanvasRenderingContext2D, picture: Picture): void {
  const { layout, curves } = picture
  const { left, top, right, bottom } = layout.frame
  const jam = jamAt(picture)
  c.fillStyle = style('--good-ground')
  c.fillRect(left, top, jam - left, bottom - top)
  const count = curves.discrete_s.filter(value => value !== null).length
  c.beginPath()
  addCurve(c, picture, curves.discrete_s)
  c.lineTo(jam, height(layout, curves.discrete_s[count - 1] ?? null))
  c.lineTo(jam, height(layout, null))
  c.lineTo(layout.x(2), height(layout, null))
  c.closePath()
  c.fillStyle = style('--bad-ground')
  c.fill()
  // Hatched, so that the region differs from the other one not in colour alone.
  c.clip()
  c.globalAlpha = 0.3
  c.strokeStyle = style('--bad')
  c.lineWidth = 1
  c.beginPath()
  const tall = c.canvas.clientHeight
  for (let k = left - tall; k < right; k += 9) {
    c.moveTo(k, bottom)
    c.lineTo(k + tall, bottom - tall)
  }
  c.stroke()
}

function drawModes(c: CanvasRenderingContext2D, picture: Picture): void {
  if (!picture.modes) return
  const { values, colour } = picture.modes
  c.lineWidth = 0.75
  c.globalAlpha = 0.55
  c.strokeStyle = colour
  const count = picture.curves.vehicles.length
  for (let k = 0; k + count <= values.length; k += count) strokeCurve(c, picture, values.subarray(k, k + count))
  c.globalAlpha = 1
}

function drawCurves(c: CanvasRenderingContext2D, picture: Picture): void {
  const { curves } = picture
  // The curves are often less than a pixel apart: the wider ones lie below, so that all can be seen.
  for (const [values, colour, dash, width] of [
    [curves.newell_s, style('--soft'), [2, 5], 5],
    [curves.continuous_s, style('--accent'), [8, 8], 3],
    [curves.discrete_s, style('--ink'), [], 1.5],
  ] as const) {
    c.setLineDash([...dash])
    c.lineWidth = width
    c.strokeStyle = colour
    strokeCurve(c, picture, values)
  }
  c.setLineDash([])
}

/** Lines from the point to both axes. */
function drawPointLines(c: CanvasRenderingContext2D, { layout, point }: Picture): void {
  const [x, y] = [layout.x(point.vehicles), layout.y(point.delay)]
  c.strokeStyle = style('--ink')
  c.globalAlpha = 0.5
  c.lineWidth = 1
  c.beginPath()
  c.moveTo(layout.frame.left, y)
  c.lineTo(x, y)
  c.lineTo(x, layout.frame.bottom)
  c.stroke()
}

/** Everything but the words in the diagram and below it. */
export function drawDiagram(c: CanvasRenderingContext2D, picture: Picture): void {
  const { layout, growth } = picture
  const { frame: f, ends, x, y } = layout
  const jam = jamAt(picture)
  clipped(c, f.left, f.top, f.right, f.bottom, () => {
    c.fillStyle = style('--track')
    c.fillRect(jam, f.top, f.right - jam, f.bottom - f.top)
  })
  clipped(c, f.left, f.top, jam, f.bottom, () => {
    if (growth) growth.draw(c, x(2), x(ends.vehicles), f.top, f.bottom, picture.dark)
    else drawRegions(c, picture)
  })
  axes(c, f, ticks(roundSteps(0, ends.vehicles, 5), x), ticks(roundSteps(0, ends.delay, 4), y), { x: picture.name, y: text.diagram.reaction })
  clipped(c, f.left, f.top, f.right, f.bottom, () => {
    drawModes(c, picture)
    drawCurves(c, picture)
    drawPointLines(c, picture)
  })
}
