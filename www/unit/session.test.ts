// The session against a client that answers without a core.
import { beforeEach, expect, test, vi } from 'vitest'
import { type Client, Cancelled, Refusal } from '../src/core/client'
import { append } from '../src/app/series'
import { Session } from '../src/app/session'
import type { Answer, Ask, Frame, Name, Snapshot, Start } from '../src/core/protocol'

/** A client that answers from a table and remembers what it was asked. */
class FakeClient implements Client {
  readonly place = 'page'
  readonly budget = 8
  asked: [Name, unknown][] = []
  step = 0
  epoch = 0
  refuse: Error | null = null
  async ask<K extends Name>(name: K, ask: Ask<K>): Promise<Answer<K>> {
    this.asked.push([name, ask])
    if (this.refuse && name !== 'advance' && name !== 'view') throw this.refuse
    if (name === 'advance') {
      const { steps } = ask as Ask<'advance'>
      this.step += steps
      return frame(this.step, steps, this.epoch) as Answer<K>
    }
    if (name === 'view') return { ring: { colours: [], ticks: [] }, map: { colours: [], ticks: [] } } as unknown as Answer<K>
    if (name === 'link' || name === 'file' || name === 'preset') return { snapshot: snapshot(), messages: name === 'link' ? ['a bad entry'] : [] } as unknown as Answer<K>
    return snapshot() as Answer<K>
  }
}
const frame = (step: number, taken: number, epoch: number) =>
  ({ step, taken, time: step * 0.01, finished: false, collision: null, epoch, changes: 1, rows: { time: [step * 0.01], mean: [10], flow: [null], imbalance: [0], speeds: [[11]] } }) as unknown as Frame
const snapshot = () => ({ scenario: { vehicles: 10, lanes: 1, time_step: 0.01 }, watched: [1], interval: 0.5, map_window: 2, changes: 1 }) as unknown as Snapshot
const start = { map: { columns: 4, bins: 10 } } as Start

let frames: ((now: number) => void)[] = []
let now = 0
beforeEach(() => {
  frames = []
  now = 0
  vi.stubGlobal('document', { hidden: false })
  vi.stubGlobal('performance', { now: () => now })
  vi.stubGlobal('requestAnimationFrame', (f: (now: number) => void) => frames.push(f))
})
const tick = async (ms: number) => {
  now += ms
  for (const f of frames.splice(0)) f(now)
  await new Promise(resolve => setTimeout(resolve))
}
const opened = async () => {
  const client = new FakeClient()
  const session = new Session(client, start, false)
  await session.open('link', '')
  client.asked = []
  return { client, session }
}

test('problems with a link are reported, and the rest of it is opened', async () => {
  const session = new Session(new FakeClient(), start, false)
  const seen: (readonly string[])[] = []
  session.on('problem', messages => seen.push(messages))
  expect(await session.open('link', 'x=1')).toBe(true)
  expect(seen.at(-1)).toEqual(['a bad entry'])
  expect(session.snapshot.scenario.vehicles).toBe(10)
})

test('playback asks for the steps that the time is worth; a hidden page asks for none', async () => {
  const { client, session } = await opened()
  session.playback.setFactor(2)
  session.playback.play()
  await tick(50)
  expect(client.asked).toContainEqual(['advance', { steps: 10, budget: 8 }])
  client.asked = []
  vi.stubGlobal('document', { hidden: true })
  await tick(50)
  expect(client.asked).toEqual([])
  vi.stubGlobal('document', { hidden: false })
  await tick(50)
  expect(client.asked[0]).toEqual(['advance', { steps: 10, budget: 8 }])
})

test('pause and play in quick succession leave one chain of frames', async () => {
  const { session } = await opened()
  session.playback.play()
  session.playback.pause()
  session.playback.play()
  await tick(20)
  expect(frames.length).toBe(1)
})

test('a refusal is reported and changes nothing; a cancelled request is not reported', async () => {
  const { client, session } = await opened()
  const before = session.snapshot
  const seen: string[] = []
  session.on('problem', messages => seen.push(...messages))
  client.refuse = new Refusal('vehicles: 300 is not allowed')
  expect(await session.set('vehicles', '300')).toBe(false)
  expect(seen).toEqual(['vehicles: 300 is not allowed'])
  expect(session.snapshot).toBe(before)
  client.refuse = new Cancelled()
  expect(await session.seek(5)).toBe(false)
  expect(seen.length).toBe(1)
})

test('an open dialog receives the problems, and the page is still cleared', async () => {
  const { client, session } = await opened()
  const [page, dialog, names]: [(readonly string[])[], (readonly string[])[], string[]] = [[], [], []]
  session.on('problem', messages => page.push(messages))
  session.on('opened', name => names.push(name))
  session.onProblem = messages => dialog.push(messages)
  expect(await session.open('file', '{}')).toBe(true)
  client.refuse = new Refusal('no scenario')
  expect(await session.open('file', '?')).toBe(false)
  expect([page, dialog]).toEqual([[[]], [['no scenario']]])
  client.refuse = null
  await session.preset('three-lanes')
  expect(names).toEqual(['', 'three-lanes'])
})

test('a restarted run restarts its charts', async () => {
  const { client, session } = await opened()
  await session.playback.step()
  expect(session.series.time.length).toBe(2)
  client.epoch = 1
  await session.restart(true)
  expect(session.series.time.length).toBe(1)
})

test('the series keep as many values as the map has columns', () => {
  const series = { time: [], mean: [], flow: [], imbalance: [], speeds: [[], []] } as Parameters<typeof append>[0]
  const count = (from: number) => Array.from({ length: 10 }, (_, k) => from + 6 * k)
  append(series, { time: count(0), mean: count(1), flow: count(2), imbalance: count(3), speeds: [count(4), count(5)] }, 4)
  expect(series.time).toEqual([36, 42, 48, 54])
  expect(series.speeds).toEqual([
    [40, 46, 52, 58],
    [41, 47, 53, 59],
  ])
})
