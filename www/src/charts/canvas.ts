// Short names for what drawings on a canvas do again and again.

/** A straight line in the present stroke style. */
export function line(c: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
  c.beginPath()
  c.moveTo(x0, y0)
  c.lineTo(x1, y1)
  c.stroke()
}

/** Draws within a rectangle only; `draw` may change the context's state, which is put back after it. */
export function clipped(c: CanvasRenderingContext2D, left: number, top: number, right: number, bottom: number, draw: () => void): void {
  c.save()
  c.beginPath()
  c.rect(left, top, right - left, bottom - top)
  c.clip()
  draw()
  c.restore()
}
