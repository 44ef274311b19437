// The words in the stability diagram and the colours of its growth rates.
import { expect, test } from 'vitest'
import { WORD, spot } from '../src/charts/axes'
import { TO, colour, rateAt } from '../src/views/stability/growth_map'

test('a word lies within its region and does not cover the point, or is left out', () => {
  const [top, bottom] = [25, 155]
  // Curves that fall like τ(N), at the top, in the middle and at the bottom; and places of the point.
  for (const scale of [0.2, 0.5, 1, 2, 5, 30]) {
    for (const width of [40, 150, 310]) {
      const heights = Array.from({ length: width }, (_, x) => Math.min(bottom, Math.max(top, bottom - (scale * 4000) / (x + 10))))
      for (const half of [22, 36]) {
        for (const above of [true, false]) {
          for (const free of [{ x: width - half, y: top + 16 }, { x: width / 2, y: bottom - 14 }]) {
            const at = spot(heights, half, above, top, bottom, free)
            if (!at) continue
            expect(at.x - half).toBeGreaterThanOrEqual(0)
            expect(at.x + half).toBeLessThan(width)
            const [y0, y1] = [at.y - WORD / 2, at.y + WORD / 2]
            expect(y0).toBeGreaterThanOrEqual(top)
            expect(y1).toBeLessThanOrEqual(bottom)
            for (let x = at.x - half; x <= at.x + half; x++) {
              if (above) expect(heights[x]!).toBeGreaterThanOrEqual(y1)
              else expect(heights[x]!).toBeLessThanOrEqual(y0)
            }
            expect(Math.abs(at.x - free.x) > half || Math.abs(at.y - free.y) > WORD).toBe(true)
          }
        }
      }
    }
  }
  const flat = new Array<number>(150).fill(90)
  expect(spot(flat, 30, true, 25, 155, { x: 0, y: 0 })).toEqual({ x: 119, y: 41 })
  expect(spot(new Array<number>(150).fill(30), 30, true, 25, 155, { x: 0, y: 0 })).toBeNull()
})

test('colours of growth rates: blue for decay, orange for growth, by signed logarithm', () => {
  for (const dark of [false, true]) {
    for (const rate of [1e-3, 0.01, 0.1, 1]) {
      const [r, , b] = colour(rate, dark)
      expect(r).toBeGreaterThan(b)
      const [fr, , fb] = colour(-rate, dark)
      expect(fb).toBeGreaterThan(fr)
    }
    expect(colour(5, dark)).toEqual(colour(TO, dark))
    const rest = colour(0, dark)
    expect(Math.max(...rest) - Math.min(...rest)).toBeLessThan(10)
  }
  expect(rateAt(1)).toBeCloseTo(TO, 12)
  expect(rateAt(-1)).toBeCloseTo(-TO, 12)
  expect(rateAt(0)).toBe(0)
})
