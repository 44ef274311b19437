// The stability tab: its point moves the ring across the threshold, and the run agrees with what it says.
import { equal, holds, playTo, ready, snapshot, test, verdict } from './harness.mjs'

const NUDGE = 'action=at%3D0%3A1%3Anudge%3D1'
// So small that what is not linear stays below what is asked of the measurement.
const TOUCH = 'action=at%3D0%3A1%3Anudge%3D0.1'
const still = { reducedMotion: 'reduce' }

/** Waits until the point can be dragged. */
const plane = at => at.waitForFunction(() => document.querySelector('#plane-point').hasAttribute('aria-valuetext'))

/** Takes the point to a place of the plane; `before` runs while it is still held. */
async function drag(page, vehicles, delay, before = () => {}) {
  await page.locator('#plane-point').scrollIntoViewIfNeeded()
  const middle = async () => {
    const box = await page.locator('#plane-point').boundingBox()
    return { x: box.x + box.width / 2, y: box.y + box.height / 2 }
  }
  const field = await page.locator('#plane canvas').boundingBox()
  const from = await middle()
  const { scenario, driver } = await snapshot(page)
  // Where the axes begin follows from the picture's own ticks: N = 0 at the left end, Δ = 0 at the lower end.
  const left = field.x + 30
  const bottom = field.y + field.height - 36
  const x = left + ((from.x - left) * vehicles) / scenario.vehicles
  const y = bottom - ((bottom - from.y) * delay) / driver.reaction_time
  await page.mouse.move(from.x, from.y)
  await page.mouse.down()
  for (let k = 1; k <= 10; k++) await page.mouse.move(from.x + ((x - from.x) * k) / 10, from.y + ((y - from.y) * k) / 10)
  await page.waitForTimeout(200)
  await before()
  await page.mouse.up()
  await page.waitForTimeout(200)
}

/** What the tab measures of the mode that theory calls the fastest. */
async function lead(page) {
  const { mode, rate } = (await snapshot(page)).verdict
  const { modes } = await page.evaluate(() => window.ringroad.client.ask('modes', {}))
  return { predicted: rate, ...modes.find(m => m.mode === mode) }
}

for (const [state, from, to, sign] of [
  ['stable', 0.75, 0.6, -1],
  ['unstable', 0.6, 0.75, 1],
]) {
  test(`the point dragged to the ${state} side turns the verdict, and growth over 200 s agrees`, async ({ open }) => {
    const page = await open(`index.html#reaction-time=${from}&${TOUCH}`, still)
    await ready(page)
    await plane(page)
    holds((await verdict(page)) !== state, `${state} before the point has moved`)
    let held
    await drag(page, 50, to, async () => {
      held = await verdict(page)
    })
    equal(held, state, 'verdict while the point is held')
    equal(await verdict(page), state, 'verdict')
    const { scenario, driver } = await snapshot(page)
    holds(Math.abs(driver.reaction_time - to) < 0.03, `Δ = ${driver.reaction_time}`)
    equal(scenario.vehicles, 50, 'N')
    equal(scenario.actions.join(), 'at=0:1:nudge=0.1', 'actions at t = 0')
    await playTo(page, 200)
    equal(await verdict(page), state, 'verdict after 200 s')
    const m = await lead(page)
    equal(Math.sign(m.rate), sign, `sign of the measured growth ${m.rate}`)
    const allowed = Math.max(0.01 * Math.abs(m.predicted), 3 * m.standard_error)
    holds(Math.abs(m.rate - m.predicted) <= allowed, `measured ${m.rate} ± ${m.standard_error}, predicted ${m.predicted}`)
    const words = await page.textContent('#verdict .measured')
    holds(words.includes(sign < 0 ? 'halves' : 'doubles'), words)

    // Under way a new Δ is one action, and the run goes on.
    const time = await page.evaluate(() => window.ringroad.frame.time)
    await drag(page, 50, from)
    const { actions } = (await snapshot(page)).scenario
    equal(actions.length, 2, `actions ${actions}`)
    holds(/^at=[\d.]+:all:reaction-time=0\.[67]\d?$/.test(actions[1]), actions[1])
    equal(await page.evaluate(() => window.ringroad.frame.time), time, 'time')
    holds((await verdict(page)) !== state, `${state} after the way back`)
  })
}

test('the point moves by keyboard: Δ and N, and N starts again', async ({ open }) => {
  const page = await open(`index.html#reaction-time=0.66&${NUDGE}`, still)
  await ready(page)
  await plane(page)
  await playTo(page, 5)
  await page.focus('#plane-point')
  const seen = {}
  for (let k = 0; k < 3; k++) {
    await page.keyboard.press('ArrowUp')
    await page.waitForTimeout(700)
    seen[(await snapshot(page)).driver.reaction_time] = await verdict(page)
  }
  equal(JSON.stringify(seen), JSON.stringify({ 0.67: 'stable', 0.68: 'unstable', 0.69: 'unstable' }), 'verdicts')
  equal(await page.getAttribute('#plane-point', 'aria-valuetext'), '50 vehicles, reaction time 0.69 seconds: unstable', 'value in words')
  // Fewer vehicles tolerate more.
  for (let k = 0; k < 8; k++) await page.keyboard.press('ArrowLeft')
  await page.waitForTimeout(900)
  const { scenario } = await snapshot(page)
  equal(scenario.vehicles, 42, 'N')
  equal(scenario.driver.reaction_time, 0.69, 'Δ of the new run')
  equal(scenario.actions.join(), 'at=0:1:nudge=1', 'actions of the new run')
  equal(await verdict(page), 'stable', 'verdict with fewer vehicles')
  equal(await page.inputValue('#p-vehicles-number'), '42', 'the number beside the slider')
})

test('the stability tab tells in words what it draws', async ({ open }) => {
  const page = await open(`index.html#reaction-time=0.75&${NUDGE}`)
  await ready(page)
  await playTo(page, 60)
  await page.waitForTimeout(900)
  const label = name => page.getAttribute(`#${name} canvas`, 'aria-label')
  holds(/0\.679\ss in the run’s steps, in continuous time at 0\.684\ss/.test(await label('plane')), await label('plane'))
  holds((await label('roots')).includes('Mode 8 has the largest growth rate, 0.0160'), await label('roots'))
  holds(/mode 8: 0\.01\d\d against 0\.0160/.test(await label('modes')), await label('modes'))
  holds((await page.textContent('#modes-status')).startsWith('Linear since'), await page.textContent('#modes-status'))
  await playTo(page, 240)
  await page.waitForTimeout(900)
  holds((await page.textContent('#modes-status')).startsWith('Left the linear regime'), await page.textContent('#modes-status'))
})

for (const [width, height] of [
  [1280, 800],
  [390, 844],
]) {
  test(`the stability tab fits ${width} × ${height}`, async ({ open }) => {
    const page = await open(`index.html#reaction-time=0.75&${NUDGE}`, { ...still, viewport: { width, height } })
    await ready(page)
    await plane(page)
    const cut = await page.evaluate(() => {
      const over = e => e.scrollWidth > e.clientWidth + 1 || e.scrollHeight > e.clientHeight + 1
      const panel = document.querySelector('#panel-stability')
      const wide = [...panel.querySelectorAll('section, h3, p, .keys')].filter(e => e.scrollWidth > e.clientWidth + 1)
      return { panel: over(panel), page: document.documentElement.scrollWidth > innerWidth, wide: wide.map(e => e.id || e.className) }
    })
    equal(JSON.stringify(cut), JSON.stringify({ panel: false, page: false, wide: [] }), 'what is cut')
  })
}
