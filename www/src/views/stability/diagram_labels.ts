// Writes the words of the stability diagram: stable, unstable, jam, and below the axis a hint or the colours of growth rates.
import { type Frame, spot, word } from '../../charts/axes'
import { text } from '../../text'
import { style } from '../../ui/dom'
import { type Picture, jamAt } from './diagram_drawing'
import { TO, colour, rateAt } from './growth_map'

const t = text.diagram

/** The colour bar of the growth rates with the numbers at its ends. `right`: its end; `middle`: its height, px. */
function drawBar(c: CanvasRenderingContext2D, right: number, middle: number, dark: boolean): void {
  const [low, high] = [t.rate(-TO), `${t.rate(TO)} ${t.rateUnit}`]
  c.textAlign = 'left'
  c.textBaseline = 'middle'
  c.fillStyle = style('--soft')
  const left = c.measureText(low).width + 4
  const end = right - c.measureText(high).width - 4
  c.fillText(low, 0, middle)
  c.fillText(high, end + 4, middle)
  for (let px = left; px < end; px++) {
    c.fillStyle = `rgb(${colour(rateAt((2 * (px - left)) / (end - left) - 1), dark).join(' ')})`
    c.fillRect(px, middle - 5, 1.5, 9)
  }
  c.strokeStyle = style('--line')
  c.lineWidth = 1
  c.strokeRect(left, middle - 5, end - left, 9)
}

/** The heights of the neutral stability curve within the frame, pixel by pixel from the left axis to `right`. */
function curveHeights({ layout, curves }: Picture, right: number): number[] {
  const { frame: f, ends, y } = layout
  const heights: number[] = []
  for (let px = 0, k = 0; f.left + px <= right; px++) {
    const n = (px * ends.vehicles) / (f.right - f.left)
    while (k < curves.vehicles.length - 1 && curves.vehicles[k]! < n) k++
    heights.push(Math.min(f.bottom, Math.max(f.top, y(curves.discrete_s[k] ?? 0))))
  }
  return heights
}

/** The names of the regions, above and below the curve; a name that does not fit is left out. */
function drawRegionNames(c: CanvasRenderingContext2D, picture: Picture): void {
  const { layout, point, growth } = picture
  const f = layout.frame
  const heights = curveHeights(picture, jamAt(picture))
  const free = { x: layout.x(point.vehicles) - f.left, y: layout.y(point.delay) }
  for (const [label, ink, above] of [
    [t.unstable, '--bad', true],
    [t.stable, '--good', false],
  ] as const) {
    const half = Math.ceil(c.measureText(label).width / 2) + 4
    const at = spot(heights, half, above, f.top, f.bottom, free)
    if (at) word(c, label, f.left + at.x, at.y, style(growth ? '--ink' : ink))
  }
}

/** The name of the region of jams, upright where it is narrow. */
function drawJamName(c: CanvasRenderingContext2D, f: Frame, jam: number): void {
  const width = f.right - jam
  if (width < 14) return
  c.save()
  c.translate(jam + width / 2, f.top + (f.bottom - f.top) * 0.72)
  if (width < c.measureText(t.jam).width + 8) c.rotate(-Math.PI / 2)
  word(c, t.jam, 0, 0, style('--soft'))
  c.restore()
}

export function drawLabels(c: CanvasRenderingContext2D, picture: Picture): void {
  const f = picture.layout.frame
  const name = c.measureText(picture.name).width
  if (picture.growth) drawBar(c, f.right - name - 12, f.bottom + 27, picture.dark)
  else {
    c.textAlign = 'left'
    c.textBaseline = 'bottom'
    c.fillStyle = style('--soft')
    if (c.measureText(t.drag).width + name < f.right - 8) c.fillText(t.drag, 0, f.bottom + 35)
  }
  c.font = '600 13px system-ui, "DejaVu Sans", sans-serif'
  c.textBaseline = 'middle'
  c.textAlign = 'center'
  drawRegionNames(c, picture)
  drawJamName(c, f, jamAt(picture))
}
