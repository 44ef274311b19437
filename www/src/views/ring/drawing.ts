// Draws the ring on its canvas: the road, the vehicles, and the words inside it.
import { line } from '../../charts/canvas'
import type { Frame } from '../../core/protocol'
import { text } from '../../text'
import { type Geometry, angle, radius } from './geometry'

const t = text.ring
/** Above this many vehicles each is drawn as a point. */
const POINTS = 1200
/** Time that a lane change takes on the screen, ms: long enough for the eye to follow it. */
const TRANSITION = 450

/** Colours of the page's style that the ring is drawn in. */
export interface Colours {
  readonly road: string
  readonly line: string
  readonly ink: string
  readonly bad: string
}

/** Vehicles that are drawn with a frame around them, by index; −1 is none. */
export interface Marked {
  readonly watched: number
  readonly hovered: number
}

/** The lanes as they are drawn: a vehicle that changes lanes moves over gradually. */
export function lanesInTransition() {
  let drawn = new Float32Array(0)
  let last = 0
  return {
    /** The lane of each vehicle to draw now, and whether some have not arrived yet. */
    advance({ lanes }: Frame): { drawn: Float32Array; moving: boolean } {
      const now = performance.now()
      const part = Math.min(1, (now - last) / TRANSITION)
      last = now
      let moving = false
      if (drawn.length !== lanes.length) drawn = Float32Array.from(lanes)
      lanes.forEach((lane, j) => {
        const away = lane - drawn[j]!
        if (away === 0) return
        const move = Math.sign(away) * part
        drawn[j] = Math.abs(away) <= Math.abs(move) ? lane : drawn[j]! + move
        moving ||= drawn[j] !== lane
      })
      return { drawn, moving }
    },
  }
}

/** The road and the marks between its lanes. */
export function drawRoad(c: CanvasRenderingContext2D, g: Geometry, colours: Colours): void {
  const { cx, cy, outer, width, lanes } = g
  const circle = (r: number) => {
    c.beginPath()
    c.arc(cx, cy, r, 0, 2 * Math.PI)
    c.stroke()
  }
  c.lineWidth = width * lanes
  c.strokeStyle = colours.road
  circle(outer - (width * lanes) / 2)
  c.lineWidth = 1
  c.strokeStyle = colours.line
  for (let k = 0; k <= lanes; k++) {
    c.setLineDash(k === 0 || k === lanes ? [] : [5, 7])
    circle(outer - k * width)
  }
  c.setLineDash([])
}

/** Every vehicle: a rectangle of its length, and in front a line as long as its minimum headway. */
export function drawVehicles(c: CanvasRenderingContext2D, g: Geometry, frame: Frame, lanes: Float32Array, colours: Colours, { watched, hovered }: Marked): void {
  const metre = (2 * Math.PI * radius(g, 0)) / g.length
  const many = frame.positions.length > POINTS
  frame.positions.forEach((position, j) => {
    const r = radius(g, lanes[j]!)
    const a = angle(g, position)
    const fill = `rgb(${frame.colours[3 * j]} ${frame.colours[3 * j + 1]} ${frame.colours[3 * j + 2]})`
    if (many) {
      c.fillStyle = fill
      c.fillRect(g.cx + r * Math.cos(a) - 1, g.cy + r * Math.sin(a) - 1, 2, 2)
      return
    }
    c.save()
    c.translate(g.cx, g.cy)
    c.rotate(a)
    c.translate(r, 0)
    // Now the direction of travel is +y.
    const length = Math.max(3, frame.lengths[j]! * metre)
    const thickness = Math.min(g.width * 0.6, Math.max(0.9 * length, 6.5))
    const box = (margin: number, corner: number) => {
      c.beginPath()
      c.roundRect(-thickness / 2 - margin, -length / 2 - margin, thickness + 2 * margin, length + 2 * margin, corner)
    }
    c.strokeStyle = colours.line
    line(c, 0, length / 2, 0, Math.max(frame.minHeadways[j]! * metre, length / 2))
    c.fillStyle = fill
    c.strokeStyle = colours.ink
    c.lineWidth = 0.75
    box(0, 1.2)
    c.fill()
    c.stroke()
    const crashed = frame.collision && (j === frame.collision.behind || j === frame.collision.ahead)
    if (j === watched || j === hovered || crashed) {
      c.lineWidth = 2.25
      c.strokeStyle = crashed ? colours.bad : colours.ink
      box(4, 4)
      c.stroke()
    }
    c.restore()
  })
}

/** Inside the ring, where it is large enough: the name of the watched vehicle beside it, and the direction of travel. */
export function drawLabels(c: CanvasRenderingContext2D, g: Geometry, { positions }: Frame, watched: number, colours: Colours): void {
  const { cx, cy } = g
  const inner = g.outer - g.width * g.lanes
  if (inner <= 95) return
  c.textAlign = 'center'
  c.textBaseline = 'middle'
  const r = inner - 14
  let travel: number | null = cy - r
  if (positions.length <= POINTS && watched < positions.length) {
    const a = angle(g, positions[watched]!)
    const [x, y] = [(r - 8 * Math.abs(Math.cos(a))) * Math.cos(a), r * Math.sin(a)]
    c.fillStyle = colours.ink
    c.font = '600 13px system-ui, sans-serif'
    c.fillText(t.car(watched + 1), cx + x, cy + y)
    // Where the name takes the place at the top, the direction goes below it, or is left out on a smaller ring.
    if (Math.abs(x) < 60 && y < 17 - r) travel = inner > 108 ? cy + y + 17 : null
  }
  c.fillStyle = colours.line
  c.font = '13px system-ui, sans-serif'
  if (travel !== null) c.fillText(t.travel, cx, travel)
}
