// Reads values off a picture of a figure, by pointer, touch or keyboard: the nearest point of the nearest curve, or the cell of a
// map. The values and their places in the picture come from the core; this file finds the one that is meant.
import { el } from '../ui/dom'
import { significant } from '../text/significant'
import type { Field, Mark } from '../core/protocol'
import { figuresText as t } from '../text/figures'

/** A point of a curve or a cell of a map: the index of its panel, of the mark in the panel, and of the point or cell in the mark. */
interface Place {
  readonly field: number
  readonly mark: number
  readonly k: number
}

const NAMESPACE = 'http://www.w3.org/2000/svg'
const shape = (name: string, values: Record<string, string | number>): SVGElement => {
  const element = document.createElementNS(NAMESPACE, name)
  for (const [key, value] of Object.entries(values)) element.setAttribute(key, String(value))
  return element
}

const rows = (mark: Mark & { kind: 'map' }): number => mark.values.length / mark.width

/** The value at the centre of cell k of n. */
const centre = ([first, last]: readonly [number, number], k: number, n: number): number =>
  n > 1 ? first + ((last - first) * k) / (n - 1) : first

/** The cell, of n between two ends, in which a place lies; null outside. */
function cell([from, to]: readonly [number, number], n: number, place: number): number | null {
  const k = Math.floor(((place - from) / (to - from)) * n)
  return k >= 0 && k < n ? k : null
}

/** Square of the distance from (x, y) to the line segment from a to b. */
function toSegment(x: number, y: number, ax: number, ay: number, bx: number, by: number): number {
  const [dx, dy] = [bx - ax, by - ay]
  const length = dx * dx + dy * dy
  const u = length === 0 ? 0 : Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / length))
  return (x - ax - u * dx) ** 2 + (y - ay - u * dy) ** 2
}

/** The point or cell nearest to (x, y), in the panel that holds it; null outside all panels. */
export function nearest(fields: readonly Field[], x: number, y: number): Place | null {
  const field = fields.findIndex(f => x >= f.left && x <= f.left + f.width && y >= f.top && y <= f.top + f.height)
  if (field < 0) return null
  let best: Place | null = null
  let least = Infinity
  fields[field]!.marks.forEach((mark, m) => {
    if (mark.kind === 'map') {
      const [column, row] = [cell(mark.across, mark.width, x), cell(mark.up, rows(mark), y)]
      if (column !== null && row !== null && best === null) best = { field, mark: m, k: row * mark.width + column }
      return
    }
    const { right, down } = mark
    let [toCurve, toPoint, at] = [Infinity, Infinity, -1]
    right.forEach((px, k) => {
      const py = down[k]!
      const before = Math.max(0, k - 1)
      toCurve = Math.min(toCurve, toSegment(x, y, right[before]!, down[before]!, px, py))
      const distance = (x - px) ** 2 + (y - py) ** 2
      if (distance < toPoint) [toPoint, at] = [distance, k]
    })
    if (at >= 0 && toCurve < least) {
      least = toCurve
      best = { field, mark: m, k: at }
    }
  })
  return best
}

/** The place that a key leads to from `at`; null for a key without a meaning here. */
export function step(fields: readonly Field[], at: Place | null, key: string): Place | null {
  const all = fields.flatMap((f, field) => f.marks.map((m, mark) => ({ field, mark, count: m.kind === 'map' ? m.values.length : m.x.length }))).filter(m => m.count > 0)
  const first = all[0]
  if (!first || !['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'PageUp', 'PageDown', 'Home', 'End'].includes(key)) return null
  if (!at) return { ...first, k: 0 }
  const here = all.findIndex(m => m.field === at.field && m.mark === at.mark)
  const { count } = all[here]!
  const mark = fields[at.field]!.marks[at.mark]!
  const along = (k: number) => ({ ...at, k: Math.min(count - 1, Math.max(0, k)) })
  /** Another mark: at the nearest x if both are curves of one panel, else at its start. */
  const to = (next: (typeof all)[number] | undefined): Place => {
    if (!next) return at
    const other = fields[next.field]!.marks[next.mark]!
    if (next.field !== at.field || mark.kind === 'map' || other.kind === 'map') return { ...next, k: 0 }
    const x = mark.x[at.k]!
    const k = other.x.reduce((least, value, k) => (Math.abs(value - x) < Math.abs(other.x[least]! - x) ? k : least), 0)
    return { ...next, k }
  }
  switch (key) {
    case 'ArrowLeft':
    case 'ArrowRight': {
      const k = at.k + (key === 'ArrowLeft' ? -1 : 1)
      const leaves = mark.kind === 'map' && Math.floor(k / mark.width) !== Math.floor(at.k / mark.width)
      return leaves ? at : along(k)
    }
    case 'ArrowUp':
    case 'ArrowDown': {
      if (mark.kind !== 'map') return to(all[here + (key === 'ArrowUp' ? -1 : 1)])
      const k = at.k + (key === 'ArrowUp' ? mark.width : -mark.width)
      return k >= 0 && k < count ? along(k) : at
    }
    case 'PageUp':
      return to(all.find(m => m.field === all.filter(o => o.field < at.field).at(-1)?.field))
    case 'PageDown':
      return to(all.find(m => m.field > at.field))
    default:
      return along(key === 'Home' ? 0 : count - 1)
  }
}

/** The value at a place, in words. */
export function words(fields: readonly Field[], { field, mark: m, k }: Place): string {
  const { title, x, y, marks } = fields[field]!
  const mark = marks[m]!
  const number = (value: number | null) => (value === null ? t.noValue : significant(value, 4))
  if (mark.kind === 'map') {
    const [column, row] = [k % mark.width, Math.floor(k / mark.width)]
    const atX = number(centre(mark.x, column, mark.width))
    return t.cell(title, x, atX, y, number(centre(mark.y, row, rows(mark))), mark.name, number(mark.values[k]!))
  }
  const [low, high] = [mark.low[k], mark.high[k]]
  const interval = low == null || high == null ? '' : t.interval(number(low), number(high))
  return t.point(title, mark.name, x, number(mark.x[k]!), y, number(mark.y[k]!) + interval)
}

/** Marks a place in the picture: a circle around a point, or a frame around a cell. */
function pointer(fields: readonly Field[], { field, mark: m, k }: Place): SVGElement {
  const mark = fields[field]!.marks[m]!
  const look = { fill: 'none', stroke: '#1c2430', 'stroke-width': 2, class: 'pointer' }
  if (mark.kind !== 'map') return shape('circle', { ...look, cx: mark.right[k]!, cy: mark.down[k]!, r: 6 })
  const [wide, high] = [(mark.across[1] - mark.across[0]) / mark.width, (mark.up[0] - mark.up[1]) / rows(mark)]
  const x = mark.across[0] + wide * (k % mark.width) - 1
  const y = mark.up[0] - high * (Math.floor(k / mark.width) + 1) - 1
  return shape('rect', { ...look, x, y, width: wide + 2, height: high + 2 })
}

/** A picture in which values can be read, and the line below it that shows them. */
export function readable(name: string, picture: SVGSVGElement, fields: readonly Field[]): HTMLElement[] {
  const reading = el('p', { class: 'reading' }, t.hint)
  // For screen readers, and only for values reached by keys: a moving pointer would make them read without end.
  const told = el('p', { class: 'hidden', role: 'status' })
  let at: Place | null = null
  let marked: SVGElement | null = null

  const show = (place: Place | null, tell = false) => {
    at = place
    marked?.remove()
    marked = place && picture.appendChild(pointer(fields, place))
    reading.textContent = place ? words(fields, place) : t.hint
    told.textContent = tell && place ? reading.textContent : ''
  }
  const point = (event: PointerEvent) => {
    const matrix = picture.getScreenCTM()
    if (!matrix) return
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse())
    show(nearest(fields, x, y))
  }
  picture.addEventListener('pointermove', point)
  picture.addEventListener('pointerdown', point)
  // When a finger is lifted, the value stays.
  picture.addEventListener('pointerleave', event => event.pointerType === 'mouse' && show(null))

  const plot = el(
    'div',
    {
      class: 'plot',
      tabindex: 0,
      role: 'application',
      'aria-label': t.plot(name),
      'aria-roledescription': t.kind,
      'aria-description': t.keys,
      onkeydown: (event: KeyboardEvent) => {
        if (event.altKey || event.ctrlKey || event.metaKey) return
        const next = event.key === 'Escape' ? null : step(fields, at, event.key)
        if (!next && !(event.key === 'Escape' && at)) return
        event.preventDefault()
        event.stopPropagation()
        show(next, true)
        // On a narrow screen only a part of the picture is visible.
        if (marked) {
          const [box, frame] = [marked.getBoundingClientRect(), plot.getBoundingClientRect()]
          if (box.left < frame.left + 20 || box.right > frame.right - 20) plot.scrollLeft += (box.left + box.right - frame.left - frame.right) / 2
        }
      },
    },
    picture,
  )
  // A picture wider than the screen fades at the edge where there is more of it.
  const more = () => void plot.classList.toggle('more', plot.scrollLeft + plot.clientWidth < plot.scrollWidth - 1)
  plot.addEventListener('scroll', more)
  new ResizeObserver(more).observe(plot)
  return [plot, reading, told]
}
