// How many steps playback asks for.
import { expect, test } from 'vitest'
import { Pace } from '../src/app/pace'

test('the steps add up to the time that has passed, without loss by rounding', () => {
  const pace = new Pace()
  let steps = 0
  for (let k = 0; k < 600; k++) steps += pace.steps(1000 / 60, 1, 0.01)
  expect(steps).toBeGreaterThanOrEqual(999)
  expect(steps).toBeLessThanOrEqual(1000)
})

test('slow playback takes a step in some frames only; fast playback takes more steps of the same length', () => {
  const slow = new Pace()
  const taken = Array.from({ length: 60 }, () => slow.steps(1000 / 60, 0.1, 0.01))
  expect(Math.max(...taken)).toBe(1)
  expect(taken.reduce((a, b) => a + b)).toBeGreaterThanOrEqual(9)
  expect(new Pace().steps(20, 100, 0.01)).toBe(200)
})

test('a long pause between two frames is not made up for', () => {
  expect(new Pace().steps(60_000, 1, 0.01)).toBe(10)
})

test('a machine that falls behind is recognized', () => {
  const pace = new Pace()
  for (let k = 0; k < 50; k++) pace.report(200, 200)
  expect(pace.behind(100)).toBeNull()
  for (let k = 0; k < 50; k++) pace.report(200, 50)
  expect(pace.behind(100)).toBeCloseTo(25, 0)
  pace.reset()
  expect(pace.behind(100)).toBeNull()
})
