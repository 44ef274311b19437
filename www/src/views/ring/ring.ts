// The ring seen from above, with the mean values of the traffic in its middle and playback below it.
import { BRAKE } from '../../app/commands'
import type { Session } from '../../app/session'
import { legendView } from '../../charts/colour_bar'
import type { Frame, Quantity } from '../../core/protocol'
import { text } from '../../text'
import { fixed } from '../../text/format'
import { card, drawing, el, style } from '../../ui/dom'
import { type Colours, drawLabels, drawRoad, drawVehicles, lanesInTransition } from './drawing'
import { geometry } from './geometry'
import { listen } from './pointer'

const t = text.ring

/** The mean values in the middle: the element, and what fills it. */
function middleView() {
  const speed = el('b')
  const [kmh, flow, density] = [el('span'), el('span'), el('span')]
  return {
    element: el('div', { class: 'ring-middle' }, el('span', {}, t.mean), speed, kmh, flow, density),
    /** `inner`: radius of the space, px. */
    fit(inner: number) {
      kmh.hidden = density.hidden = inner < 75
    },
    show({ traffic }: Frame) {
      speed.textContent = t.speed(traffic.mean_speed)
      kmh.textContent = t.kmh(traffic.mean_speed)
      flow.textContent = t.flow(traffic.flow)
      density.textContent = t.density(traffic.density)
    },
  }
}

export function ringView(session: Session, transport: HTMLElement): HTMLElement {
  const canvas = el('canvas', { id: 'ring-canvas', tabindex: 0, role: 'application', 'aria-label': t.canvas })
  const middle = middleView()
  const field = el('div', { class: 'ring-field', title: t.hint(BRAKE) }, canvas, middle.element)
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

  const lanes = lanesInTransition()
  let colours: Colours = { road: '', line: '', ink: '', bad: '' }
  let hovered = -1
  const redraw = drawing(canvas, (c, w, h) => {
    const { frame, watched } = session as { frame?: Frame; watched: number }
    if (!frame) return
    const g = geometry(w, h, session.snapshot.scenario)
    const { drawn, moving } = lanes.advance(frame)
    drawRoad(c, g, colours)
    drawVehicles(c, g, frame, drawn, colours, { watched, hovered })
    middle.fit(g.outer - g.width * g.lanes)
    drawLabels(c, g, frame, watched, colours)
    if (moving && !session.playback.playing) requestAnimationFrame(redraw)
  })
  listen(canvas, session, vehicle => {
    hovered = vehicle
    redraw()
  })

  session.on('legends', legends => {
    // Lines are drawn in a text colour, so that they stand out from the road.
    colours = { road: style('--track'), line: style('--soft'), ink: style('--ink'), bad: style('--bad') }
    colour.value = session.view.ring
    legend.show(legends.ring, session.view.ring)
  })
  session.on('snapshot', ({ scenario }) => {
    note.textContent = t.size(scenario.vehicles, fixed(scenario.length / 1000, 2), scenario.lanes)
  })
  session.on('watch', redraw)
  session.on('frame', frame => {
    middle.show(frame)
    redraw()
  })
  return section
}
