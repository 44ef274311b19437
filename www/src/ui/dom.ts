// Elements made in one expression, cards, canvases, and colours of the style sheet.
type Child = Node | string | null | undefined
type Props = Record<string, string | number | boolean | ((event: never) => void) | undefined>

/** An element with properties and children. A function is a listener of the event that follows `on` in its name; true sets an
 * attribute without a value, false and undefined leave it out. */
export function el<K extends keyof HTMLElementTagNameMap>(tag: K, props: Props = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag)
  for (const [name, value] of Object.entries(props)) {
    if (typeof value === 'function') element.addEventListener(name.slice(2), value as unknown as EventListener)
    // Not as an attribute: the security policy of a site may forbid style attributes.
    else if (name === 'style') element.style.cssText = String(value)
    else if (value === true) element.setAttribute(name, '')
    else if (value !== undefined && value !== false) element.setAttribute(name, String(value))
  }
  element.append(...children.filter((c): c is Node | string => c !== null && c !== undefined))
  return element
}

/** A button that submits nothing. */
export const button = (props: Props, ...children: Child[]): HTMLButtonElement => el('button', { type: 'button', ...props }, ...children)

/** A card with a title and a note: the frame of every view. */
export function card(id: string, title: string, ...children: Child[]): { card: HTMLElement; note: HTMLElement } {
  const note = el('span', { class: 'note' })
  const section = el(
    'section',
    { id, class: 'card', 'aria-labelledby': `${id}-title` },
    el('header', {}, el('h2', { id: `${id}-title` }, title), note),
    ...children,
  )
  return { card: section, note }
}

/** Draws on a canvas with a pixel for each pixel of the screen, and draws again when its size changes. `draw` gets the size in CSS
 * pixels. The result draws again on request. */
export function drawing(canvas: HTMLCanvasElement, draw: (c: CanvasRenderingContext2D, w: number, h: number) => void): () => void {
  const context = canvas.getContext('2d')!
  const redraw = () => {
    const { clientWidth: w, clientHeight: h } = canvas
    if (w === 0 || h === 0) return
    const ratio = Math.max(1, window.devicePixelRatio || 1)
    const [pw, ph] = [Math.round(w * ratio), Math.round(h * ratio)]
    if (canvas.width !== pw || canvas.height !== ph) {
      canvas.width = pw
      canvas.height = ph
    }
    context.setTransform(ratio, 0, 0, ratio, 0, 0)
    context.clearRect(0, 0, w, h)
    draw(context, w, h)
  }
  new ResizeObserver(redraw).observe(canvas)
  return redraw
}

const known: Record<string, string> = {}
/** The value of a custom property of the style sheet, such as `--ink`. It is read once only: a value such as `light-dark(…)` stays
 * the same in both, and the canvas that draws with it takes the colour that is in force. */
export const style = (name: string): string =>
  (known[name] ??= getComputedStyle(document.documentElement).getPropertyValue(name).trim())
