// The numbers at the axes of drawings.
import { expect, test } from 'vitest'
import { labelWidth, labels, roundSteps } from '../src/charts/axes'

test('numbers at an axis differ, and stand in the labelWidth that they get', () => {
  expect(labels(roundSteps(-0.0012, 0.0004, 4))).toEqual(['−0.001', '−0.0005', '0'])
  expect(labels(roundSteps(0, 20, 4))).toEqual(['0', '5', '10', '15', '20'])
  expect(labels([0, -10, -1, -0.1, 0.1, 1].sort((a, b) => a - b))).toEqual(['−10', '−1', '−0.1', '0', '0.1', '1'])
  for (const span of [2e-5, 1e-4, 3e-3, 0.7, 4, 900, 1e6]) {
    for (const low of [0, -span / 3, -span]) {
      const steps = roundSteps(low, low + span, 4)
      const words = labels(steps)
      expect(new Set(words).size, words.join()).toBe(steps.length)
      steps.forEach((v, k) => expect(Number(words[k]!.replace('−', '-'))).toBeCloseTo(v, 12))
      expect(labelWidth(steps)).toBeGreaterThan(7 * Math.max(...words.map(w => w.length)))
    }
  }
})
