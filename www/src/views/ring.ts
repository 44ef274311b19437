// The ring seen from above, to scale along the road: every car a rectangle of its length with a whisker as long
// as the minimum headway in front. Lanes are concentric, lane 1 outermost; their width is exaggerated.
import { card, drawing, el, style } from '../ui/dom'
import { fixed } from '../text/format'
import type { Session } from '../app/session'
import type { Frame, Quantity } from '../core/protocol'
import { text } from '../text'
import { legendView } from '../charts/colour_bar'

const t = text.ring
const HOLD = 350
/** Seconds that a car stands when it is pressed. */
export const BRAKE = 3
/** Screen milliseconds that a change of lane takes to be drawn, so that the eye can follow it. */
const GLIDE = 450
/** Above this many vehicles each is a point. */
const POINTS = 1200

export function ringView(session: Session, transport: HTMLElement): HTMLElement {
  const canvas = el('canvas', { id: 'ring-canvas', tabindex: 0, role: 'application', 'aria-label': t.canvas })
  const speed = el('b')
  const kmh = el('span')
  const flow = el('span')
  const density = el('span')
  const middle = el('div', { class: 'ring-middle' }, el('span', {}, t.mean), speed, kmh, flow, density)
  const field = el('div', { class: 'ring-field', title: t.hint(BRAKE) }, canvas, middle)
  const legend = legendView()
  const colour = el(
    'select',
    {
      class: 'small-select',
      'aria-label': t.colour,
      onchange: () => void session.look({ ring: colour.value as Quantity }),
    },
    ...(['difference', 'speed', 'frustration'] as const).map(q => el('option', { value: q }, t.colours[q])),
  )
  const { card: section, note } = card('ring', t.title, field, legend.element, transport)
  section.querySelector('header')!.append(colour)

  /** Lanes as drawn: they glide to where the cars are. */
  let drawn = new Float32Array(0)
  let last = 0
  let colours = { road: '', line: '', ink: '', card: '', bad: '' }
  let hover = -1
  let gliding = false

  const geometry = (w: number, h: number) => {
    const { lanes } = session.snapshot.scenario
    const outer = Math.min(w, h) / 2 - 12
    const width = Math.min(lanes > 2 ? 15 : 18, (outer * 0.42) / lanes)
    return { cx: w / 2, cy: h / 2, outer, width, lanes }
  }
  const angle = (x: number) => (x / session.snapshot.scenario.length) * 2 * Math.PI - Math.PI / 2

  const redraw = drawing(canvas, (c, w, h) => {
    const frame: Frame | undefined = session.frame
    if (!frame) return
    const { cx, cy, outer, width, lanes } = geometry(w, h)
    const now = performance.now()
    const part = Math.min(1, (now - last) / GLIDE)
    last = now
    gliding = false
    if (drawn.length !== frame.lanes.length) drawn = Float32Array.from(frame.lanes)
    // Road, lane marks.
    c.lineWidth = width * lanes
    c.strokeStyle = colours.road
    c.beginPath()
    c.arc(cx, cy, outer - (width * lanes) / 2, 0, 2 * Math.PI)
    c.stroke()
    c.lineWidth = 1
    c.strokeStyle = colours.line
    for (let k = 0; k <= lanes; k++) {
      c.setLineDash(k === 0 || k === lanes ? [] : [5, 7])
      c.beginPath()
      c.arc(cx, cy, outer - k * width, 0, 2 * Math.PI)
      c.stroke()
    }
    c.setLineDash([])
    const metre = (2 * Math.PI * (outer - width / 2)) / session.snapshot.scenario.length
    const many = frame.positions.length > POINTS
    for (let j = 0; j < frame.positions.length; j++) {
      const lane = frame.lanes[j]!
      const away = lane - drawn[j]!
      if (away !== 0) {
        const move = Math.sign(away) * part
        drawn[j] = Math.abs(away) <= Math.abs(move) ? lane : drawn[j]! + move
        gliding ||= drawn[j] !== lane
      }
      const r = outer - (drawn[j]! + 0.5) * width
      const a = angle(frame.positions[j]!)
      const fill = `rgb(${frame.colours[3 * j]} ${frame.colours[3 * j + 1]} ${frame.colours[3 * j + 2]})`
      if (many) {
        c.fillStyle = fill
        c.fillRect(cx + r * Math.cos(a) - 1, cy + r * Math.sin(a) - 1, 2, 2)
        continue
      }
      c.save()
      c.translate(cx, cy)
      c.rotate(a)
      c.translate(r, 0)
      // Along the road is +y now.
      const long = Math.max(3, frame.lengths[j]! * metre)
      const thick = Math.min(width * 0.6, Math.max(0.9 * long, 6.5))
      const whisker = frame.minHeadways[j]! * metre
      c.strokeStyle = colours.line
      c.beginPath()
      c.moveTo(0, long / 2)
      c.lineTo(0, Math.max(whisker, long / 2))
      c.stroke()
      c.fillStyle = fill
      c.strokeStyle = colours.ink
      c.lineWidth = 0.75
      c.beginPath()
      c.roundRect(-thick / 2, -long / 2, thick, long, 1.2)
      c.fill()
      c.stroke()
      const crashed = frame.collision && (j === frame.collision.behind || j === frame.collision.ahead)
      if (j === session.watched || j === hover || crashed) {
        c.lineWidth = 2.25
        c.strokeStyle = crashed ? colours.bad : colours.ink
        c.beginPath()
        c.roundRect(-thick / 2 - 4, -long / 2 - 4, thick + 8, long + 8, 4)
        c.stroke()
      }
      c.restore()
    }
    const inner = outer - width * lanes
    kmh.hidden = density.hidden = inner < 75
    if (inner > 95) {
      c.textAlign = 'center'
      c.textBaseline = 'middle'
      const r = inner - 14
      let travel: number | null = cy - r
      if (!many && session.watched < frame.positions.length) {
        const a = angle(frame.positions[session.watched]!)
        const [x, y] = [(r - 8 * Math.abs(Math.cos(a))) * Math.cos(a), r * Math.sin(a)]
        c.fillStyle = colours.ink
        c.font = '600 13px system-ui, sans-serif'
        c.fillText(t.car(session.watched + 1), cx + x, cy + y)
        // The watched car's name has the place at the top; below it there is room on a large ring only.
        if (Math.abs(x) < 60 && y < 17 - r) travel = inner > 108 ? cy + y + 17 : null
      }
      c.fillStyle = colours.line
      c.font = '13px system-ui, sans-serif'
      if (travel !== null) c.fillText(t.travel, cx, travel)
    }
    if (gliding && !session.playing) requestAnimationFrame(redraw)
  })

  /** The car nearest to a place on the canvas, or −1. */
  const at = (event: PointerEvent): number => {
    const box = canvas.getBoundingClientRect()
    const { cx, cy, outer, width } = geometry(box.width, box.height)
    const [x, y] = [event.clientX - box.left, event.clientY - box.top]
    let best = -1
    let nearest = 18 ** 2
    session.frame.positions.forEach((position, j) => {
      const r = outer - (session.frame.lanes[j]! + 0.5) * width
      const a = angle(position)
      const distance = (cx + r * Math.cos(a) - x) ** 2 + (cy + r * Math.sin(a) - y) ** 2
      if (distance < nearest) {
        nearest = distance
        best = j
      }
    })
    return best
  }
  let timer = 0
  canvas.addEventListener('pointerdown', event => {
    const car = at(event)
    if (car < 0) return
    session.watch(car)
    timer = window.setTimeout(() => void session.act(`${car + 1}:brake=${BRAKE}`), HOLD)
  })
  for (const end of ['pointerup', 'pointercancel', 'pointerleave'] as const) {
    canvas.addEventListener(end, () => clearTimeout(timer))
  }
  canvas.addEventListener('contextmenu', event => event.preventDefault())
  canvas.addEventListener('pointermove', event => {
    const car = at(event)
    if (car !== hover) {
      hover = car
      redraw()
    }
  })
  canvas.addEventListener('pointerleave', () => {
    hover = -1
    redraw()
  })
  canvas.addEventListener('keydown', event => {
    const way = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key]
    if (way === undefined) return
    event.preventDefault()
    const n = session.snapshot.scenario.vehicles
    session.watch((session.watched + way + n) % n)
  })

  const ink = () => {
    colours = { road: style('--track'), line: style('--line'), ink: style('--ink'), card: style('--card'), bad: style('--bad') }
    // Whiskers and marks need to be seen on the road.
    colours.line = style('--soft')
  }
  session.on('legends', legends => {
    ink()
    colour.value = session.view.ring
    legend.show(legends.ring, session.view.ring)
  })
  session.on('snapshot', ({ scenario }) => {
    note.textContent = t.size(scenario.vehicles, fixed(scenario.length / 1000, 2), scenario.lanes)
  })
  session.on('watch', redraw)
  session.on('frame', ({ traffic }) => {
    speed.textContent = t.speed(traffic.mean_speed)
    kmh.textContent = t.kmh(traffic.mean_speed)
    flow.textContent = t.flow(traffic.flow)
    density.textContent = t.density(traffic.density)
    redraw()
  })
  return section
}
