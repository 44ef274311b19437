// Numbers, actions, links and the stability summary in words.
import { expect, test } from 'vitest'
import { readHash } from '../src/app/url'
import { exactly, fixed, span } from '../src/text/format'
import type { StabilitySummary } from '../src/core/protocol'
import { en } from '../src/text/en'
import { inWords } from '../src/views/actions'
import { written } from '../src/app/parameters'
import { roundSteps } from '../src/charts/axes'

test('numbers have the decimals that are asked for, without trailing zeros', () => {
  expect(fixed(1.5, 3)).toBe('1.5')
  expect(fixed(100, 0)).toBe('100')
  expect(fixed(-0.0001, 2)).toBe('0')
  expect(exactly(-1, 2)).toBe('\u22121.00')
  expect([span(4.25), span(43.2), span(600), span(72_000), span(1e6)].map(s => s.replace('\u202f', ' '))).toEqual(['4.3 s', '43 s', '10 min', '20 h', '12 d'])
})

test('actions in words', () => {
  const parameters = [{ name: 'reaction_time', unit: 's' }, { name: 'frustration_rate', unit: '' }]
  expect(inWords('at=40:7:brake=3', parameters)).toEqual({ when: '40 s', what: 'car 7: brake for 3 s' })
  expect(inWords('at=30.5:all:reaction-time=0.75', parameters).what).toBe('all cars: reaction time 0.75\u202fs')
  expect(inWords('at=1:2:frustration-rate=0.5', parameters).what).toBe('car 2: frustration rate 0.5')
  expect(inWords('at=0:3-7:nudge=-1,brake=2', parameters).what).toBe('cars 3-7: nudge by -1 m, brake for 2 s')
})

test('a number has the decimals of its slider, and more only if it needs them', () => {
  const parameter = { slider: { min: 0, max: 1.5, step: 0.01 } } as Parameters<typeof written>[0]
  expect(written(parameter, 0.75)).toBe('0.75')
  expect(written(parameter, 0.1 + 0.2)).toBe('0.30000000000000004')
  expect(written(parameter, 0.12345)).toBe('0.12345')
})

test('axes have round numbers', () => {
  expect(roundSteps(0, 1000, 5)).toEqual([0, 200, 400, 600, 800, 1000])
  expect(roundSteps(37, 337, 6)).toEqual([50, 100, 150, 200, 250, 300])
  for (let high = 1; high < 1e6; high *= 1.7) expect(roundSteps(0, high, 5).length).toBeLessThanOrEqual(6)
})

test('the page takes the entries that it reads out of a link', () => {
  expect(readHash('#view=embed&vehicles=30&action=at%3D1')).toEqual({ view: 'embed', scenario: 'vehicles=30&action=at%3D1' })
  expect(readHash('')).toEqual({ view: null, scenario: '' })
  expect(readHash('#view=elsewhere').scenario).toBe('view=elsewhere')
})

const summary: StabilitySummary = {
  stable: false,
  homogeneous: true,
  reaction_time: 0.75,
  critical: 0.683869,
  critical_discrete: 0.678869,
  scale: null,
  rate: Math.LN2 / 43,
  mode: 8,
  equilibrium_speed: 10.7,
  flow: 0.54,
  density: 0.05,
  lane: 1,
  vehicles: 50,
}
const plain = (s: string) => s.replaceAll('\u202f', ' ')

test('the stability summary is a sentence with both critical reaction times', () => {
  expect(plain(en.summary.critical(summary))).toBe('Drivers react after 0.75 s; this ring tolerates 0.679 s (τ = 0.684 s).')
  expect(plain(en.summary.wave(summary))).toBe('Its fastest wave, 8 jams, doubles every 43 s.')
  expect(plain(en.summary.wave({ ...summary, stable: true, rate: -Math.LN2 / 20, mode: 1 }))).toContain('1 jam, halves every 20 s')
  expect(en.summary.critical({ ...summary, stable: null })).toContain('No wave')
  expect(plain(en.summary.critical({ ...summary, critical_discrete: 0 }))).toContain('no delay')
})

test('the measured growth states its window and its uncertainty', () => {
  const growth = { rate: 0.016, standard_error: 0.0001, nonlinear_bound: 0.0004, window: 60, mode: 8 }
  expect(plain(en.summary.measured(growth, false))).toBe('measured: doubles every 43 s')
  expect(plain(en.summary.measured({ ...growth, window: 20 }, false))).toContain('20 s')
  expect(en.summary.measured({ ...growth, standard_error: 0.02 }, false)).toContain('neither')
  expect(en.summary.measured(growth, true)).toContain('now large waves')
  expect(plain(en.summary.measured({ ...growth, nonlinear_bound: 0.004 }, false))).toBe('measured: doubles every 34–59 s')
  expect(plain(en.summary.measured({ ...growth, rate: -0.005, nonlinear_bound: 0.002 }, false))).toBe('measured: halves every 96 s–4 min')
  expect(en.summary.measured({ ...growth, nonlinear_bound: 0.01, standard_error: 0.004 }, false)).toContain('not clear yet')
  expect(en.summary.measured({ ...growth, nonlinear_bound: 0.02 }, false)).toContain('too large to tell')
})
