// Draws long columns of values as a line, and finds rows and maxima in them.

/** The index of the last of some ascending times that is not after `at`; −1 if all are. */
export function before(time: readonly number[], at: number): number {
  let [low, high] = [0, time.length]
  while (low < high) {
    const middle = (low + high) >> 1
    if (time[middle]! <= at) low = middle + 1
    else high = middle
  }
  return low - 1
}

/** The greatest value; −∞ if there is none. */
export function most(values: readonly (number | null)[]): number {
  let found = Number.NEGATIVE_INFINITY
  for (const value of values) if (value !== null && value > found) found = value
  return found
}

/**
 * Draws values from the row `first` on. Of the rows within half a pixel only the first, the least, the greatest and
 * the last are drawn: a long run costs no more than a short one, and no peak is lost.
 */
export function trace(
  c: Pick<CanvasPath, 'moveTo' | 'lineTo'>,
  time: readonly number[],
  values: readonly (number | null)[],
  first: number,
  x: (time: number) => number,
  y: (value: number) => number,
): void {
  // The column of half a pixel whose rows are being collected; NaN where the line starts again after a gap.
  let column = Number.NaN
  let px = 0
  let low = 0
  let high = 0
  let last = 0
  // One row more than there are, so that the last column is drawn, too.
  for (let k = Math.max(0, first); k <= time.length; k++) {
    const value = values[k] ?? Number.NaN
    const at = Number.isNaN(value) ? Number.NaN : x(time[k]!)
    const py = y(value)
    const own = Math.round(2 * at)
    if (own === column) {
      if (py < low) low = py
      if (py > high) high = py
      last = py
      continue
    }
    if (low < high) {
      c.lineTo(px, low)
      c.lineTo(px, high)
      c.lineTo(px, last)
    }
    // From half a pixel to the left, so that a single value between two gaps is visible.
    if (!Number.isNaN(at)) {
      if (Number.isNaN(column)) c.moveTo(at - 0.5, py)
      c.lineTo(at, py)
    }
    column = own
    px = at
    low = high = last = py
  }
}
