// The plane of vehicles N and reaction time Δ with the critical curves. The point where the ring stands can be
// dragged, or moved with the arrow keys; letting go sets N and Δ as the sliders do.
import { drawing, el, style } from '../dom'
import type { Session } from '../session'
import type { Curves, Verdict } from '../shared/protocol'
import { text } from '../text'
import { type Frame, axes, frame, roundSteps, ticks, word } from './axes'
import { keys } from './chart'
import { valueOf } from './controls'

const t = text.plane
/** After the last key, ms: a row of keys is one setting. */
const SETTLE = 450
/** The reaction times shown reach at least so far, s. */
const HIGHEST = 1.5

interface Point {
  readonly vehicles: number
  readonly delay: number
}

export function planeView(session: Session, preview: (v: Verdict | null) => void) {
  const parameter = (name: string) => session.start.parameters.find(p => p.name === name)!
  const step = parameter('reaction_time').slider?.step ?? 0.01
  const decimals = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9))
  const canvas = el('canvas', { role: 'img' })
  const handle = el('div', {
    id: 'plane-point',
    class: 'point',
    role: 'slider',
    tabindex: 0,
    title: t.hint,
    'aria-label': t.handle,
    'aria-roledescription': t.kind,
    'aria-valuemin': 0,
  })
  const lines = el('div')
  const note = el('p', { class: 'small', hidden: true }, t.common)
  const element = el(
    'section',
    { id: 'plane', 'aria-labelledby': 'plane-title' },
    el('h3', { id: 'plane-title', title: t.hint }, t.title),
    el('div', { class: 'field' }, canvas, handle),
    lines,
    note,
  )
  let curves: Curves | null = null
  /** Where the point is held, before it is let go. */
  let draft: Point | null = null
  let state = ''
  let described = ''

  const now = (): Point => ({
    vehicles: session.snapshot.scenario.vehicles,
    delay: valueOf(session, parameter('reaction_time')),
  })
  const shown = () => draft ?? now()
  const last = () => curves?.vehicles.at(-1) ?? 133
  const highest = () => Math.max(HIGHEST, Math.ceil(now().delay * 2.2) / 2)
  const size = (): Frame => frame(canvas.clientWidth, canvas.clientHeight, 30)
  const across = (f: Frame, n: number) => f.left + ((f.right - f.left) * n) / last()
  const up = (f: Frame, delay: number) => f.bottom - ((f.bottom - f.top) * delay) / highest()

  const redraw = drawing(canvas, (c, w, h) => {
    if (!curves) return
    const f = frame(w, h, 30)
    const x = (n: number) => across(f, n)
    // What is infinite lies above everything.
    const y = (delay: number | null) => up(f, delay ?? 1e3)
    const path = (values: readonly (number | null)[]) => {
      curves!.vehicles.forEach((n, k) => {
        if (k === 0) c.moveTo(x(n), y(values[k]!))
        else c.lineTo(x(n), y(values[k]!))
      })
    }
    c.save()
    c.beginPath()
    c.rect(f.left, f.top, f.right - f.left, f.bottom - f.top)
    c.clip()
    c.fillStyle = style('--good-ground')
    c.fillRect(f.left, f.top, f.right - f.left, f.bottom - f.top)
    c.beginPath()
    path(curves.discrete_s)
    c.lineTo(x(curves.vehicles.at(-1)!), -1e4)
    c.lineTo(x(2), -1e4)
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
    c.restore()
    axes(c, f, ticks(roundSteps(0, last(), 5), x), ticks(roundSteps(0, highest(), 4), v => up(f, v)), { x: t.vehicles, y: t.reaction })
    c.save()
    c.beginPath()
    c.rect(f.left, f.top, f.right - f.left, f.bottom - f.top)
    c.clip()
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
    c.textAlign = 'left'
    c.textBaseline = 'bottom'
    c.fillStyle = style('--soft')
    c.fillText(t.drag, 0, f.bottom + 35)
    c.font = '600 13px system-ui, "DejaVu Sans", sans-serif'
    c.textBaseline = 'middle'
    c.textAlign = 'right'
    word(c, t.unstable, f.right - 8, f.top + 16, style('--bad'))
    word(c, t.stable, f.right - 8, f.bottom - 14, style('--good'))
  })

  const place = () => {
    const f = size()
    const { vehicles, delay } = shown()
    handle.style.left = `${across(f, Math.min(vehicles, last()))}px`
    handle.style.top = `${up(f, delay)}px`
    handle.setAttribute('aria-valuemax', String(highest()))
    handle.setAttribute('aria-valuenow', String(delay))
    handle.setAttribute('aria-valuetext', t.value(vehicles, delay, state))
    handle.dataset.state = state
  }
  const describe = () => {
    if (!curves) return
    const { vehicles } = shown()
    const at = curves.vehicles.findIndex(n => n >= vehicles)
    const [discrete, continuous, newell] = [curves.discrete_s, curves.continuous_s, curves.newell_s].map(c => c[at] ?? null)
    const words = t.describe(vehicles, discrete!, continuous!, newell!)
    if (words === described) return
    described = words
    canvas.setAttribute('aria-label', words)
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
  const speak = (v: Verdict) => {
    state = v.stable === null ? '' : v.stable ? t.stable : t.unstable
  }
  const show = () => {
    if (!session.snapshot) return
    if (!draft) speak(session.snapshot.verdict)
    note.hidden = session.snapshot.verdict.alike
    draw()
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
        const verdict = await session.client.ask('previewPoint', { vehicles: asked.vehicles, reactionTime: asked.delay })
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
    draft = {
      vehicles: within(Math.round(vehicles), 2, last()),
      delay: Number(within(delay, 0, highest()).toFixed(decimals)),
    }
    draw()
    void foresee()
  }
  let timer = 0
  const drop = async () => {
    clearTimeout(timer)
    timer = 0
    if (!draft) return
    const to = draft
    const from = now()
    // Δ first: the new start that N makes takes it along.
    if (to.delay === from.delay || (await session.set('reaction_time', String(to.delay)))) {
      if (to.vehicles !== from.vehicles) await session.set('vehicles', String(to.vehicles))
    }
    // It may have been taken up again meanwhile.
    if (draft === to) forget()
  }
  const forget = () => {
    clearTimeout(timer)
    timer = 0
    draft = null
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
    curves(next: Curves) {
      curves = next
      show()
    },
    show,
    redraw: draw,
  }
}
