// Reading values off the picture of a figure.
import { describe, expect, it } from 'vitest'
import { significant } from '../src/text/significant'
import type { Field } from '../src/core/protocol'
import { nearest, step, words } from '../src/charts/readout'

const curve = (name: string, down: number[]) => ({
  kind: 'curve' as const,
  name,
  x: [0, 1, 2],
  y: down.map(d => 100 - d),
  low: [],
  high: [],
  right: [0, 50, 100],
  down,
})
const fields: Field[] = [
  { title: 'Left', left: 0, top: 0, width: 100, height: 100, x: 'time (s)', y: 'speed (m/s)', marks: [curve('a', [20, 20, 20]), curve('b', [80, 30, 80])] },
  {
    title: 'Right',
    left: 200,
    top: 0,
    width: 100,
    height: 100,
    x: 'x (m)',
    y: 'y (m)',
    marks: [{ kind: 'map', name: 'flow (veh/s)', width: 2, x: [0.5, 1.5], y: [10, 20], values: [1, 2, null, 4], across: [200, 300], up: [100, 0] }],
  },
]

describe('what is nearest', () => {
  it('is a point of the nearest curve, not the nearest point of all', () => {
    // Between two points of b, on its line; the point of a at 50 is nearer than both.
    expect(nearest(fields, 35, 46)).toEqual({ field: 0, mark: 1, k: 1 })
    expect(nearest(fields, 35, 22)).toEqual({ field: 0, mark: 0, k: 1 })
  })
  it('is the cell of a map, the lowest row first', () => {
    expect(nearest(fields, 260, 90)).toEqual({ field: 1, mark: 0, k: 1 })
    expect(nearest(fields, 210, 10)).toEqual({ field: 1, mark: 0, k: 2 })
  })
  it('is nothing between the panels', () => expect(nearest(fields, 150, 50)).toBeNull())
})

describe('keys', () => {
  const walk = (...keys: string[]) => keys.reduce((at, key) => step(fields, at, key), null as ReturnType<typeof step>)
  it('begin at the first point and stop at the last', () => {
    expect(walk('ArrowLeft')).toMatchObject({ field: 0, mark: 0, k: 0 })
    expect(walk('ArrowRight', 'End', 'ArrowRight')).toMatchObject({ mark: 0, k: 2 })
  })
  it('keep the abscissa from curve to curve', () => expect(walk('Home', 'ArrowRight', 'ArrowDown')).toMatchObject({ field: 0, mark: 1, k: 1 }))
  it('go about a map without leaving its rows', () => {
    expect(walk('Home', 'PageDown', 'ArrowRight', 'ArrowRight')).toMatchObject({ field: 1, k: 1 })
    expect(walk('Home', 'PageDown', 'ArrowUp', 'ArrowUp')).toMatchObject({ field: 1, k: 2 })
    expect(walk('Home', 'PageDown', 'PageUp')).toMatchObject({ field: 0, mark: 0 })
  })
  it('mean nothing otherwise', () => expect(step(fields, null, 'a')).toBeNull())
})

describe('words', () => {
  it('name panel, curve, axes and values', () =>
    expect(words(fields, { field: 0, mark: 1, k: 1 })).toBe('Left, b · time (s): 1 · speed (m/s): 70'))
  it('say the value of a cell, and that there is none', () => {
    expect(words(fields, { field: 1, mark: 0, k: 1 })).toBe('Right · x (m): 1.5 · y (m): 10 · flow (veh/s): 2')
    expect(words(fields, { field: 1, mark: 0, k: 2 })).toContain('flow (veh/s): none')
  })
  it('have four digits', () =>
    expect([0, 1.40000001, -0.0123456, 123456, 1e-9].map(v => significant(v, 4))).toEqual(['0', '1.4', '−0.01235', '1.235e5', '1e−9']))
})
