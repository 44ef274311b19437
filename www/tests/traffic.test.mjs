// The page against the theory, and against the command.
import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { csv, equal, hash, holds, playTo, ready, ringroad, rows, snapshot, stability, test } from './helpers.mjs'

const NUDGE = 'action=at%3D0%3A1%3Anudge%3D1'

test('the stability summary turns as Δ passes the threshold by keyboard', async ({ open }) => {
  const page = await open(`index.html#reaction-time=0.65&${NUDGE}`, { reducedMotion: 'reduce' })
  await ready(page)
  await page.focus('#p-reaction_time')
  const seen = {}
  for (let k = 0; k < 5; k++) {
    // What the slider would do is said while it moves, and holds once it is let go.
    await page.keyboard.press('ArrowRight')
    await page.waitForTimeout(700)
    seen[await page.inputValue('#p-reaction_time')] = await stability(page)
  }
  equal(JSON.stringify(seen), JSON.stringify({ 0.66: 'stable', 0.67: 'stable', 0.68: 'unstable', 0.69: 'unstable', 0.7: 'unstable' }), 'stability')
  const text = await page.textContent('#summary')
  holds(text.includes('0.679') && text.includes('0.684'), `both thresholds: ${text}`)
})

for (const [delta, state] of [
  [0.6, 'stable'],
  [0.75, 'unstable'],
]) {
  test(`growth measured over 200 s agrees with the stability summary at Δ = ${delta} s`, async ({ open }) => {
    const page = await open(`index.html#reaction-time=${delta}&${NUDGE}`)
    await ready(page)
    await playTo(page, 200)
    equal(await stability(page), state, 'stability')
    const growth = await page.evaluate(() => window.ringroad.frame.growth)
    const rate = (await snapshot(page)).stability.rate
    equal(Math.sign(growth.rate), state === 'stable' ? -1 : 1, `sign of the measured growth ${growth.rate}`)
    holds(Math.abs(growth.rate - rate) < 0.1 * Math.abs(rate), `measured ${growth.rate}, predicted ${rate}`)
    const words = await page.textContent('#summary .measured')
    holds(words.includes(state === 'stable' ? 'halves' : 'doubles'), words)
  })
}

test('a brake and a new Δ made by hand: the CSV saved equals the command’s', async ({ open }) => {
  const page = await open('index.html#reaction-time=0.4&vehicles=40', { acceptDownloads: true })
  await ready(page)
  await page.evaluate(() => window.ringroad.playback.setFactor(1))
  // Press on a car and hold.
  const box = await page.locator('#ring-canvas').boundingBox()
  await page.waitForTimeout(300)
  const [x, y] = await page.evaluate(() => {
    window.ringroad.playback.pause()
    const canvas = document.querySelector('#ring-canvas')
    const { frame, snapshot } = window.ringroad
    const outer = Math.min(canvas.clientWidth, canvas.clientHeight) / 2 - 12
    const width = Math.min(18, outer * 0.42)
    const a = (frame.positions[6] / snapshot.scenario.length) * 2 * Math.PI - Math.PI / 2
    return [canvas.clientWidth / 2 + (outer - width / 2) * Math.cos(a), canvas.clientHeight / 2 + (outer - width / 2) * Math.sin(a)]
  })
  await page.mouse.move(box.x + x, box.y + y)
  await page.mouse.down()
  await page.waitForTimeout(600)
  await page.mouse.up()
  await playTo(page, 15)
  await page.focus('#p-reaction_time')
  for (let k = 0; k < 3; k++) await page.keyboard.press('ArrowRight')
  await page.waitForTimeout(700)
  const { actions } = (await snapshot(page)).scenario
  holds(actions.length === 2 && /^at=[\d.]+:7:brake=3$/.test(actions[0]) && /^at=[\d.]+:all:reaction-time=0.43$/.test(actions[1]), `actions ${actions}`)
  await playTo(page, 40)

  const folder = mkdtempSync(join(tmpdir(), 'ringroad-'))
  for (const [table, options] of [
    ['trajectories', ['--every', '0.5']],
    ['speed-map', ['--every', '0.5']],
    ['speeds', ['--every', '0.5', '--vehicle', '1,9,17,25,33']],
  ]) {
    await page.click('#open-files')
    await page.selectOption('#table', table)
    await page.fill('#every', '0.5')
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-csv')])
    const saved = readFileSync(await download.path(), 'utf8')
    await page.keyboard.press('Escape')
    holds(rows(saved).length > 80, `${table}: ${rows(saved).length} rows`)
    const scenario = join(folder, 'scenario.json')
    writeFileSync(scenario, saved.split('\n').find(line => line.startsWith('# scenario ')).slice(11))
    const own = join(folder, `${table}.csv`)
    ringroad('run', '--scenario', scenario, '--table', table, ...options, '--out', own)
    equal(hash(saved), hash(readFileSync(own, 'utf8')), `${table}: hash of the page’s file`)
  }
})

test('the link reopens to the same trajectories', async ({ open, address }) => {
  const page = await open('index.html#reaction-time=0.3&vehicles=45')
  await ready(page)
  await playTo(page, 10)
  await page.evaluate(async () => {
    await window.ringroad.act('3:brake=2')
    await window.ringroad.set('sensitivity', '1.2')
  })
  await playTo(page, 30)
  const trajectories = { table: 'trajectories', every: 1 }
  const first = rows(await csv(page, trajectories))
  const link = await page.evaluate(() => location.href)
  holds(link.includes('action=at%3D') && link.includes('vehicles=45'), link)
  await page.click('#open-share')
  equal(await page.inputValue('#share-link'), link, 'link to share')
  const again = await open(link.replace(address, ''.padEnd(0)).replace(/^\//, ''))
  await ready(again)
  await playTo(again, 30)
  const second = rows(await csv(again, trajectories))
  const both = Math.min(first.length, second.length)
  holds(both > 45 * 30, `${both} rows`)
  equal(hash(second.slice(0, both).join()), hash(first.slice(0, both).join()), 'hash of the trajectories')
})

test('playback × 1 and × 100 give the same table', async ({ open }) => {
  const tables = []
  const series = []
  for (const playback of [1, 100]) {
    const page = await open(`index.html#reaction-time=0.72&lanes=2&start=random&action=at%3D2%3A5%3Abrake%3D2`)
    await ready(page)
    await page.evaluate(() => window.ringroad.restart(true))
    await playTo(page, 6, playback)
    tables.push(rows(await csv(page, { table: 'trajectories', every: 0.1 })).slice(0, 50 * 55))
    series.push(await page.evaluate(() => window.ringroad.series.speeds.map(s => s.slice(0, 12)).join()))
  }
  equal(hash(tables[1].join()), hash(tables[0].join()), 'tables')
  equal(series[1], series[0], 'speeds as drawn')
})

test('going back, removing an action and resetting replay the same run', async ({ open }) => {
  const page = await open(`index.html#reaction-time=0.6&${NUDGE}`)
  await ready(page)
  await playTo(page, 20)
  await page.evaluate(() => window.ringroad.seek(10))
  const before = await page.evaluate(() => Array.from(window.ringroad.frame.positions))
  await page.evaluate(() => window.ringroad.act('9:brake=4'))
  await playTo(page, 20)
  await page.evaluate(() => window.ringroad.remove(1))
  await page.evaluate(() => window.ringroad.seek(10))
  equal(await page.evaluate(() => Array.from(window.ringroad.frame.positions).join()), before.join(), 'positions at 10 s')
  await page.evaluate(() => window.ringroad.act('9:brake=4'))
  await page.click('#restart')
  await page.waitForFunction(() => window.ringroad.frame.time < 5)
  equal((await snapshot(page)).scenario.actions.length, 2, 'actions kept')
  await page.evaluate(() => window.ringroad.restart(false))
  equal((await snapshot(page)).scenario.actions.join(), 'at=0:1:nudge=1', 'actions of the start')
})

test('a crash is shown, marked, and can be left', async ({ open }) => {
  const page = await open(`index.html#reaction-time=1.2&${NUDGE}`)
  await ready(page)
  await playTo(page, 600)
  const { collision } = await page.evaluate(() => ({ collision: window.ringroad.frame.collision }))
  holds(collision && collision.ahead !== collision.behind, 'no crash at Δ = 1.2 s')
  holds((await page.textContent('#summary')).includes('Crash at t ='), 'the crash is not told')
  await page.evaluate(() => window.ringroad.seek(5))
  equal(await page.evaluate(() => window.ringroad.frame.finished), false, 'finished after going back')
})

test('several lanes: changes happen, ΔN and flow are drawn', async ({ open }) => {
  const page = await open('index.html')
  await ready(page)
  await page.selectOption('#presets', 'load-balance')
  await page.waitForFunction(() => window.ringroad.snapshot.scenario.lanes === 2)
  await playTo(page, 60)
  const { first, last, changes, lanes } = await page.evaluate(() => {
    const { series, frame } = window.ringroad
    return { first: series.imbalance[0], last: series.imbalance.at(-1), changes: frame.laneChanges.reduce((a, b) => a + b), lanes: [...frame.lanes].filter(l => l === 1).length }
  })
  equal(first, 50, 'ΔN at the start')
  holds(last < 20 && changes > 10 && lanes > 15, `ΔN ${last}, ${changes} changes, ${lanes} in lane 2`)
  await page.click('#tab-lanes')
  await page.waitForSelector('#panel-lanes canvas')
})

test('what is set again at the same instant stands once, in the list and in the link', async ({ open }) => {
  const page = await open('index.html#reaction-time=0.5', { reducedMotion: 'reduce' })
  await ready(page)
  await page.evaluate(async () => {
    await window.ringroad.seek(5)
    for (const delay of ['0.6', '0.65', '0.7']) await window.ringroad.set('reaction_time', delay)
    await window.ringroad.act('7:nudge=1')
    await window.ringroad.act('7:nudge=1')
    await window.ringroad.act('10%:max-speed=33,brake=3')
  })
  await page.click('#tab-actions')
  const said = await page.locator('ul.actions li > span:nth-child(2)').allTextContents()
  equal(said.join('; ').replaceAll('\u202f', ' '), 'all cars: reaction time 0.7 s; car 7: nudge by 1 m; car 7: nudge by 1 m; 10% of the cars: top speed 33 m/s, brake for 3 s', 'the list')
  const link = decodeURIComponent(await page.evaluate(() => location.href))
  equal(link.match(/reaction-time=[\d.]+/g).join(), 'reaction-time=0.5,reaction-time=0.7', 'the link')
})

test('the clock has two decimals at the end of a run', async ({ open }) => {
  const page = await open('index.html#until=20')
  await ready(page)
  await page.evaluate(() => {
    window.ringroad.playback.setFactor(100)
    window.ringroad.playback.play()
  })
  await page.waitForFunction(() => window.ringroad.frame.finished)
  equal((await page.textContent('.transport .time')).replace('\u202f', ' '), 't = 20.00 s', 'the clock')
})
