// The space-time map. The core paints it, a column for each interval of time; this file makes its frame, its axes and the reading
// under the pointer.
import { card, el } from '../ui/dom'
import { fixed } from '../text/format'
import type { Session } from '../app/session'
import { text } from '../text'
import { roundSteps } from '../charts/axes'
import { legendView } from '../charts/colour_bar'

const t = text.map

export async function mapView(session: Session): Promise<HTMLElement> {
  const { columns, bins } = session.start.map
  const canvas = el('canvas', { width: columns, height: bins, role: 'img', 'aria-label': t.canvas })
  const picture = el('div', { class: 'picture' }, canvas)
  const x = el('div', { class: 'axis x', 'aria-hidden': 'true' })
  const y = el('div', { class: 'axis y', 'aria-hidden': 'true' })
  const field = el('div', { class: 'map-field' }, y, picture, el('div'), x)
  const legend = legendView()
  const quantity = el(
    'select',
    { class: 'small-select', 'aria-label': text.ring.colour, onchange: () => void session.look({ map: quantity.value as 'difference' | 'speed' }) },
    el('option', { value: 'difference' }, text.ring.colours.difference),
    el('option', { value: 'speed' }, text.ring.colours.speed),
  )
  const lane = el('select', {
    class: 'small-select',
    'aria-label': t.lane,
    onchange: () => void session.look({ lane: Number(lane.value) }),
  })
  const coMoving = el('input', { type: 'checkbox', id: 'ride', onchange: () => void session.look({ coMoving: coMoving.checked }) })
  const foot = el(
    'div',
    { class: 'map-foot' },
    legend.element,
    el('label', { for: 'ride', title: t.coMovingHint }, coMoving, ` ${t.coMoving}`),
    lane,
    quantity,
  )
  const { card: section, note } = card('map', t.title, field, foot)

  // The canvas is handed over to the core, in its worker, which paints on it.
  await session.client.ask('canvas', { canvas: canvas.transferControlToOffscreen() })

  /** The window that the axes show, as the sum of its ends: it tells one window from another. */
  let shown = Number.NaN
  /** Columns of the map that the picture shows. */
  let visible = columns
  const drawAxes = () => {
    const { interval, scenario } = session.snapshot
    const [start, end] = session.window()
    const window = end - start
    if (start + end === shown) return
    shown = start + end
    visible = window / interval
    canvas.style.width = `${(100 * columns) / visible}%`
    const most = Math.max(3, Math.floor(picture.clientWidth / 85))
    // The part of the axis that its name leaves free: the name takes 75 px.
    const free = 1 - 75 / picture.clientWidth
    const times = roundSteps(start, start + window, most).filter(time => time - start < window * free)
    x.replaceChildren(
      ...times.map(time => el('span', { style: `left:${(100 * (time - start)) / window}%` }, fixed(time, 1))),
      el('span', { class: 'name', style: 'left:auto;right:0;transform:none' }, t.time),
    )
    const positions = roundSteps(0, scenario.length, picture.clientHeight > 200 ? 5 : 3)
    const numbers = positions.map(position => fixed(position, 0))
    field.style.setProperty('--digits', String(Math.max(3, ...numbers.map(number => number.length))))
    y.replaceChildren(
      el('span', { class: 'name' }, session.view.coMoving ? t.coMovingPosition : t.position),
      ...positions.map((position, k) => {
        const up = position / scenario.length
        return el('span', { style: `top:${Math.min(97, Math.max(3, 100 - 100 * up))}%` }, numbers[k])
      }),
    )
  }
  const redrawAxes = () => {
    shown = Number.NaN
    drawAxes()
  }
  new ResizeObserver(() => session.snapshot && redrawAxes()).observe(picture)

  const describe = () => {
    note.textContent = t.note[session.view.map]
  }
  let asking = false
  picture.addEventListener('pointermove', async event => {
    if (asking) return
    asking = true
    const box = picture.getBoundingClientRect()
    const column = Math.floor(((event.clientX - box.left) / box.width) * visible)
    const bin = Math.floor((1 - (event.clientY - box.top) / box.height) * bins)
    const reading = await session.client.ask('reading', { column, bin })
    asking = false
    if (reading && reading.speed !== null && reading.difference !== null) {
      note.textContent = t.reading(reading.time, reading.position, reading.speed, reading.difference)
    }
  })
  picture.addEventListener('pointerleave', describe)
  session.on('legends', legends => {
    quantity.value = session.view.map
    coMoving.checked = session.view.coMoving
    legend.show(legends.map, session.view.map)
    describe()
    if (session.snapshot) redrawAxes()
  })
  session.on('snapshot', ({ scenario }) => {
    lane.hidden = scenario.lanes === 1
    if (lane.options.length !== scenario.lanes) {
      lane.replaceChildren(...Array.from({ length: scenario.lanes }, (_, k) => el('option', { value: k }, `${t.lane} ${k + 1}`)))
    }
    lane.value = String(session.view.lane)
    redrawAxes()
  })
  session.on('frame', drawAxes)
  return section
}
