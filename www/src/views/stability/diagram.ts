// The plane of vehicles N and reaction time Δ with the critical curves, of the lane that the verdict speaks of. The point
// where that lane stands can be dragged, or moved with the arrow keys; letting go sets N and Δ as the sliders do.
import { drawing, el, style } from '../../ui/dom'
import type { Session } from '../../app/session'
import type { Curves, StabilityDiagram, StabilitySummary } from '../../core/protocol'
import { text } from '../../text'
import { type Frame, axes, frame, roundSteps, spot, ticks, word } from '../../charts/axes'
import { keys } from '../../charts/line_chart'
import { valueOf } from '../controls'
import { TO, colour, growthMap, rateAt } from './growth_map'

const t = text.plane
/** After the last key, ms: a row of keys is one setting. */
const SETTLE = 450
/** The reaction times shown reach at least so far, s. */
const HIGHEST = 1.5

interface Point {
  readonly vehicles: number
  readonly delay: number
}

export function planeView(session: Session, preview: (v: StabilitySummary | null) => void) {
  const parameter = (name: string) => session.start.parameters.find(p => p.name === name)!
  const step = parameter('reaction_time').slider?.step ?? 0.01
  const decimals = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9))
  const canvas = el('canvas', { role: 'img' })
  const handle = el('div', {
    id: 'plane-point',
    class: 'point',
    role: 'slider',
    tabindex: 0,
    'aria-label': t.handle,
    'aria-roledescription': t.kind,
    'aria-valuemin': 0,
  })
  const lines = el('div')
  const title = el('h3', { id: 'plane-title' }, t.title)
  const option = (value: keyof typeof t.grounds) => el('option', { value }, t.grounds[value])
  const ground = el(
    'select',
    { id: 'plane-ground', class: 'small-select', 'aria-label': t.ground, onchange: () => show() },
    option('regions'),
    el('optgroup', { label: t.rates }, option('steps'), option('continuous')),
  )
  const every = el('input', { id: 'plane-modes', type: 'checkbox', onchange: () => show() })
  const element = el(
    'section',
    { id: 'plane', 'aria-labelledby': 'plane-title' },
    title,
    el('div', { class: 'field' }, canvas, handle),
    lines,
    el('div', { class: 'choices-row' }, ground, el('label', { title: t.everyHint }, every, t.every)),
  )
  let plane: StabilityDiagram | null = null
  let curves: Curves | null = null
  /** The point when it was taken up, and where it is held, before it is let go. */
  let origin: Point | null = null
  let draft: Point | null = null
  let state = ''
  let described = ''

  const now = (): Point => {
    const { scenario, verdict } = session.snapshot
    // An exception may be all that there is in a lane.
    const own = scenario.exceptions.length > 0 && plane
    return { vehicles: verdict.vehicles, delay: own ? own.reaction_time : valueOf(session, parameter('reaction_time')) }
  }
  const shown = () => draft ?? now()
  const last = () => curves?.vehicles.at(-1) ?? 133
  const highest = () => Math.max(HIGHEST, Math.ceil(now().delay * 2.2) / 2)
  /** The lane where there are several. */
  const lane = () => (session.snapshot.scenario.lanes > 1 ? session.snapshot.verdict.lane : null)
  const intoOne = () => session.snapshot.scenario.start.startsWith('one-lane')
  /** Vehicles on all lanes that give that lane so many when the run starts again; null where it has them now. */
  const total = (vehicles: number): number | null =>
    vehicles === origin?.vehicles ? null : vehicles * (intoOne() ? 1 : session.snapshot.scenario.lanes)
  const xName = () => (ground.value === 'regions' ? t.vehicles : t.vehiclesShort)(lane())
  const inSteps = () => ground.value !== 'continuous'
  const size = (): Frame => frame(canvas.clientWidth, canvas.clientHeight, 30)
  const across = (f: Frame, n: number) => f.left + ((f.right - f.left) * n) / last()
  const up = (f: Frame, delay: number) => f.bottom - ((f.bottom - f.top) * delay) / highest()

  // While the point is held the worker is left to it.
  const growth = growthMap(
    session.client,
    () => draft === null && canvas.clientWidth > 0,
    () => {
      mark()
      redraw()
    },
  )
  /** Curves of the single modes, and what they are of. */
  let modes: Float64Array = new Float64Array()
  let modesOf = ''

  const redraw = drawing(canvas, (c, w, h) => {
    if (!curves || !plane) return
    const f = frame(w, h, 30)
    const x = (n: number) => across(f, n)
    // What lies far above lies just above: dashes along a line of a million pixels would keep the painter for long.
    const y = (delay: number | null) => up(f, Math.min(delay ?? Infinity, 4 * highest()))
    const path = (values: ArrayLike<number | null>) => {
      let on = false
      curves!.vehicles.forEach((n, k) => {
        const value = values[k]!
        if (value === null || !Number.isFinite(value)) on = false
        else if (on) c.lineTo(x(n), y(value))
        else {
          c.moveTo(x(n), y(value))
          on = true
        }
      })
    }
    const jam = Math.min(f.right, x(plane.jam))
    const clip = (right: number) => {
      c.save()
      c.beginPath()
      c.rect(f.left, f.top, right - f.left, f.bottom - f.top)
      c.clip()
    }
    clip(f.right)
    c.fillStyle = style('--track')
    c.fillRect(jam, f.top, f.right - jam, f.bottom - f.top)
    c.restore()
    clip(jam)
    if (ground.value === 'regions') {
      c.fillStyle = style('--good-ground')
      c.fillRect(f.left, f.top, jam - f.left, f.bottom - f.top)
      const ends = curves.vehicles.filter((_, k) => curves!.discrete_s[k] !== null)
      c.beginPath()
      path(curves.discrete_s)
      c.lineTo(jam, y(curves.discrete_s[ends.length - 1] ?? null))
      c.lineTo(jam, y(null))
      c.lineTo(x(2), y(null))
      c.closePath()
      c.fillStyle = style('--bad-ground')
      c.fill()
      // Hatched: the region is not told by its colour alone.
      c.clip()
      c.globalAlpha = 0.3
      c.strokeStyle = style('--bad')
      c.lineWidth = 1
      c.beginPath()
      for (let k = f.left - h; k < f.right; k += 9) {
        c.moveTo(k, f.bottom)
        c.lineTo(k + h, f.bottom - h)
      }
      c.stroke()
    } else growth.draw(c, x(2), x(last()), f.top, f.bottom, session.view.dark)
    c.restore()
    axes(c, f, ticks(roundSteps(0, last(), 5), x), ticks(roundSteps(0, highest(), 4), v => up(f, v)), { x: xName(), y: t.reaction })
    clip(f.right)
    if (every.checked) {
      c.lineWidth = 0.75
      c.globalAlpha = 0.55
      c.strokeStyle = inSteps() ? style('--ink') : style('--accent')
      const count = curves.vehicles.length
      for (let k = 0; k + count <= modes.length; k += count) {
        c.beginPath()
        path(modes.subarray(k, k + count))
        c.stroke()
      }
      c.globalAlpha = 1
    }
    // Often within a pixel of each other: the wider lie below, so that each can be seen.
    for (const [values, colour, dash, width] of [
      [curves.newell_s, style('--soft'), [2, 5], 5],
      [curves.continuous_s, style('--accent'), [8, 8], 3],
      [curves.discrete_s, style('--ink'), [], 1.5],
    ] as const) {
      c.beginPath()
      path(values)
      c.setLineDash([...dash])
      c.lineWidth = width
      c.strokeStyle = colour
      c.stroke()
    }
    c.setLineDash([])
    // Cross hairs to the axes.
    const { vehicles, delay } = shown()
    c.strokeStyle = style('--ink')
    c.globalAlpha = 0.5
    c.lineWidth = 1
    c.beginPath()
    c.moveTo(f.left, up(f, delay))
    c.lineTo(x(vehicles), up(f, delay))
    c.lineTo(x(vehicles), f.bottom)
    c.stroke()
    c.restore()
    const name = c.measureText(xName()).width
    if (ground.value === 'regions') {
      c.textAlign = 'left'
      c.textBaseline = 'bottom'
      c.fillStyle = style('--soft')
      if (c.measureText(t.drag).width + name < f.right - 8) c.fillText(t.drag, 0, f.bottom + 35)
    } else bar(c, f.right - name - 12, f.bottom + 27)
    c.font = '600 13px system-ui, "DejaVu Sans", sans-serif'
    c.textBaseline = 'middle'
    c.textAlign = 'center'
    const plain = ground.value !== 'regions'
    words(c, f, jam, [
      [t.unstable, plain ? style('--ink') : style('--bad'), true],
      [t.stable, plain ? style('--ink') : style('--good'), false],
    ])
    const width = f.right - jam
    if (width < 14) return
    // Upright where there is no room across.
    c.save()
    c.translate(jam + width / 2, f.top + (f.bottom - f.top) * 0.72)
    if (width < c.measureText(t.jam).width + 8) c.rotate(-Math.PI / 2)
    word(c, t.jam, 0, 0, style('--soft'))
    c.restore()
  })

  /** The colours of the growth rates, with their ends. */
  const bar = (c: CanvasRenderingContext2D, right: number, middle: number) => {
    const [low, high] = [t.rate(-TO), `${t.rate(TO)} ${t.rateUnit}`]
    c.textAlign = 'left'
    c.textBaseline = 'middle'
    c.fillStyle = style('--soft')
    const left = c.measureText(low).width + 4
    const end = right - c.measureText(high).width - 4
    c.fillText(low, 0, middle)
    c.fillText(high, end + 4, middle)
    for (let px = left; px < end; px++) {
      c.fillStyle = `rgb(${colour(rateAt((2 * (px - left)) / (end - left) - 1), session.view.dark).join(' ')})`
      c.fillRect(px, middle - 5, 1.5, 9)
    }
    c.strokeStyle = style('--line')
    c.lineWidth = 1
    c.strokeRect(left, middle - 5, end - left, 9)
  }

  /** Writes words into the regions above and below the curve. */
  const words = (c: CanvasRenderingContext2D, f: Frame, right: number, list: readonly (readonly [string, string, boolean])[]) => {
    const { vehicles, discrete_s } = curves!
    const point = { x: across(f, shown().vehicles), y: up(f, shown().delay) }
    // The curve's height at every pixel.
    const heights: number[] = []
    for (let px = 0, k = 0; f.left + px <= right; px++) {
      const n = (px * last()) / (f.right - f.left)
      while (k < vehicles.length - 1 && vehicles[k]! < n) k++
      heights.push(Math.min(f.bottom, Math.max(f.top, up(f, discrete_s[k] ?? 0))))
    }
    for (const [label, ink, above] of list) {
      const half = Math.ceil(c.measureText(label).width / 2) + 4
      const at = spot(heights, half, above, f.top, f.bottom, { x: point.x - f.left, y: point.y })
      if (at) word(c, label, f.left + at.x, at.y, ink)
    }
  }

  /** Says how far the map is. */
  const mark = () => {
    const on = ground.value !== 'regions'
    element.dataset.growth = !on ? '' : growth.part() < 1 ? 'busy' : 'done'
    canvas.setAttribute('aria-label', on ? `${described} ${t.map(growth.part())}` : described)
  }
  /** Asks for what is switched on. */
  const want = async () => {
    if (!curves || canvas.clientWidth === 0) return
    const of = JSON.stringify([curves, inSteps()])
    growth.show(ground.value === 'regions' ? null : { key: `${of} ${highest()}`, vehicles: curves.vehicles, highest: highest(), steps: inSteps() })
    mark()
    if (every.checked && of !== modesOf) {
      modesOf = of
      modes = await session.client.ask('diagramModes', { steps: inSteps() })
      redraw()
    }
  }

  const place = () => {
    const f = size()
    const { vehicles, delay } = shown()
    handle.style.left = `${across(f, Math.min(vehicles, last()))}px`
    handle.style.top = `${up(f, delay)}px`
    handle.setAttribute('aria-valuemax', String(highest()))
    handle.setAttribute('aria-valuenow', String(delay))
    handle.setAttribute('aria-valuetext', t.value(vehicles, lane(), delay, state))
    handle.dataset.state = state
  }
  const describe = () => {
    if (!curves) return
    const { vehicles } = shown()
    const at = curves.vehicles.findIndex(n => n >= vehicles)
    const [discrete, continuous, newell] = [curves.discrete_s, curves.continuous_s, curves.newell_s].map(c => c[at] ?? null)
    const { alike } = session.snapshot.verdict
    const differ = alike ? '' : ` ${t.alike}`
    const hint = (lane() === null ? t.hint : t.hintLanes(lane()!, !intoOne())) + differ
    title.title = handle.title = hint
    title.textContent = alike ? t.title : t.titleAlike
    const words = t.describe(vehicles, lane(), discrete!, continuous!, newell!) + differ
    if (words === described) return
    described = words
    mark()
    const names = keys([
      { label: t.discrete(discrete!), colour: 'var(--ink)' },
      { label: t.continuous(continuous!), colour: 'var(--accent)', dash: [8, 8] },
      { label: t.newell(newell!), colour: 'var(--soft)', dash: [2, 5] },
    ])
    lines.replaceChildren(names)
  }
  const draw = () => {
    if (!session.snapshot || !curves) return
    describe()
    redraw()
    place()
  }
  const speak = (v: StabilitySummary) => {
    state = v.stable === null ? '' : v.stable ? t.stable : t.unstable
  }
  const show = () => {
    if (!session.snapshot) return
    if (!draft) speak(session.snapshot.verdict)
    draw()
    void want()
  }

  // --- moving the point

  const within = (value: number, low: number, high: number) => Math.min(high, Math.max(low, value))
  let asking = false
  const foresee = async () => {
    if (asking) return
    asking = true
    // The last place counts, not every place on the way.
    for (let asked: Point | null = null; draft && draft !== asked; ) {
      asked = draft
      try {
        const verdict = await session.client.ask('previewPoint', { vehicles: total(asked.vehicles), reactionTime: asked.delay })
        if (!draft) break
        speak(verdict)
        preview(verdict)
        place()
      } catch {
        // What cannot be is refused when the point is let go.
      }
    }
    asking = false
  }
  const move = (vehicles: number, delay: number) => {
    origin ??= now()
    draft = {
      vehicles: within(Math.round(vehicles), 2, last()),
      delay: Number(within(delay, 0, highest()).toFixed(decimals)),
    }
    growth.halt()
    draw()
    void foresee()
  }
  let timer = 0
  const drop = async () => {
    clearTimeout(timer)
    timer = 0
    if (!draft) return
    const to = draft
    const vehicles = total(to.vehicles)
    // Δ first: the new start that N makes takes it along.
    if (to.delay === now().delay || (await session.set('reaction_time', String(to.delay)))) {
      if (vehicles !== null) await session.set('vehicles', String(vehicles))
    }
    // It may have been taken up again meanwhile.
    if (draft === to) forget()
    else origin = now()
  }
  const forget = () => {
    clearTimeout(timer)
    timer = 0
    origin = draft = null
    preview(null)
    show()
  }
  /** From the pointer to the middle of the point, and the picture when it was taken: words that come and go may move
   * the picture, but not what the hand does. */
  let grip: { dx: number; dy: number; frame: Frame } | null = null
  handle.addEventListener('pointerdown', event => {
    if (event.button !== 0) return
    const box = handle.getBoundingClientRect()
    const picture = canvas.getBoundingClientRect()
    origin = draft ? origin : now()
    grip = {
      dx: box.left + box.width / 2 - event.clientX - picture.left,
      dy: box.top + box.height / 2 - event.clientY - picture.top,
      frame: size(),
    }
    handle.setPointerCapture(event.pointerId)
    handle.focus()
    event.preventDefault()
  })
  handle.addEventListener('pointermove', event => {
    if (!grip) return
    const f = grip.frame
    const x = event.clientX + grip.dx
    const y = event.clientY + grip.dy
    move(((x - f.left) / (f.right - f.left)) * last(), ((f.bottom - y) / (f.bottom - f.top)) * highest())
  })
  handle.addEventListener('pointerup', () => {
    grip = null
    void drop()
  })
  handle.addEventListener('pointercancel', () => {
    grip = null
    forget()
  })
  handle.addEventListener('keydown', event => {
    const by = {
      ArrowLeft: [-1, 0],
      ArrowRight: [1, 0],
      ArrowUp: [0, step],
      ArrowDown: [0, -step],
      PageUp: [0, 10 * step],
      PageDown: [0, -10 * step],
    }[event.key]
    if (event.key === 'Escape' && draft) forget()
    if (!by || event.ctrlKey || event.metaKey || event.altKey) return
    event.preventDefault()
    const times = event.shiftKey ? 10 : 1
    const { vehicles, delay } = shown()
    move(vehicles + times * by[0]!, delay + times * by[1]!)
    clearTimeout(timer)
    timer = window.setTimeout(() => void drop(), SETTLE)
  })
  handle.addEventListener('blur', () => {
    if (timer !== 0) void drop()
  })
  new ResizeObserver(draw).observe(canvas)

  return {
    element,
    of(next: StabilityDiagram) {
      plane = next
      curves = next.curves
      show()
    },
    show,
    redraw: draw,
  }
}
