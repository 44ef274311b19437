// Drawing a column of values as a line.
import { expect, test } from 'vitest'
import { before, most, trace } from '../src/charts/trace'

/** What is drawn: lines, each a list of points. */
function drawn(time: readonly number[], values: readonly (number | null)[], first = 0, scale = 10): [number, number][][] {
  const lines: [number, number][][] = []
  const path = {
    moveTo: () => void lines.push([]),
    lineTo: (x: number, y: number) => void lines.at(-1)!.push([x, y]),
  }
  trace(path, time, values, first, t => t * scale, v => v)
  return lines
}

test('few values are drawn as they are, with gaps where there is none', () => {
  expect(drawn([0, 1, 2, 3, 4, 5], [1, 2, null, 4, Number.NaN, 6])).toEqual([[[0, 1], [10, 2]], [[30, 4]], [[50, 6]]])
  expect(drawn([0, 1, 2], [null, null, null])).toEqual([])
  expect(drawn([0, 1, 2], [1, 2, 3], 1)).toEqual([[[10, 2], [20, 3]]])
  expect(drawn([0, 1, 2], [1, 2])).toEqual([[[0, 1], [10, 2]]])
})

test('many values in a column of pixels: no peak is lost, and the line ends at the last value', () => {
  const count = 10_000
  const time = Array.from({ length: count }, (_, k) => k)
  const values = time.map(k => Math.sin(k * 0.7) * (1 + (k % 97)))
  values[4321] = 500
  values[8765] = -500
  values[6000] = Number.NaN
  const lines = drawn(time, values, 0, 0.01)
  expect(lines.length).toBe(2)
  const points = lines.flat()
  // A hundred pixels, two columns in each, four points at most in each.
  expect(points.length).toBeLessThan(4 * 2 * 102)
  const ys = points.map(([, y]) => y)
  expect([Math.max(...ys), Math.min(...ys)]).toEqual([500, -500])
  expect(lines[1]!.at(-1)![1]).toBe(values.at(-1))
  expect(lines[0]!.at(-1)![1]).toBe(values[5999])
  expect(points.every(([x], k) => k === 0 || x >= points[k - 1]![0])).toBe(true)
})

test('the row before a time, and the greatest value', () => {
  const time = [0, 0.5, 1, 1.5]
  expect([-1, 0, 0.6, 1, 1.5, 9].map(t => before(time, t))).toEqual([-1, 0, 1, 2, 3, 3])
  expect(before([], 1)).toBe(-1)
  expect(most([null, 3, Number.NaN, 5, 4])).toBe(5)
  expect(most([null])).toBe(Number.NEGATIVE_INFINITY)
})
