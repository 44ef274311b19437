import { expect, test } from 'vitest'
import { Pace } from '../src/app/pace'

test('as many steps as time passes, and no time is lost to rounding', () => {
  const pace = new Pace()
  let steps = 0
  for (let k = 0; k < 600; k++) steps += pace.steps(1000 / 60, 1, 0.01)
  expect(steps).toBeGreaterThanOrEqual(999)
  expect(steps).toBeLessThanOrEqual(1000)
})

test('slow playback takes a step now and then; fast playback takes more steps, never longer ones', () => {
  const slow = new Pace()
  const taken = Array.from({ length: 60 }, () => slow.steps(1000 / 60, 0.1, 0.01))
  expect(Math.max(...taken)).toBe(1)
  expect(taken.reduce((a, b) => a + b)).toBeGreaterThanOrEqual(9)
  expect(new Pace().steps(20, 100, 0.01)).toBe(200)
})

test('time that nobody saw is not made up for', () => {
  expect(new Pace().steps(60_000, 1, 0.01)).toBe(10)
})

test('a machine that falls behind is told from one that keeps up', () => {
  const pace = new Pace()
  for (let k = 0; k < 50; k++) pace.report(200, 200)
  expect(pace.behind(100)).toBeNull()
  for (let k = 0; k < 50; k++) pace.report(200, 50)
  expect(pace.behind(100)).toBeCloseTo(25, 0)
  pace.reset()
  expect(pace.behind(100)).toBeNull()
})
