// The stability tab: its point moves the ring across the threshold, and the run agrees with theory.
import { equal, holds, playTo, ready, snapshot, stability, test } from './helpers.mjs'

const NUDGE = 'action=at%3D0%3A1%3Anudge%3D1'
// So small that the nonlinear part stays below the accuracy that the test asks for.
const TOUCH = 'action=at%3D0%3A1%3Anudge%3D0.1'
const still = { reducedMotion: 'reduce' }

/** Waits until the point can be dragged. */
const diagram = at => at.waitForFunction(() => document.querySelector('#plane-point').hasAttribute('aria-valuetext'))

/** Drags the point to a place of the stability diagram; `before` runs while it is still held. */
async function drag(page, vehicles, delay, before = () => {}) {
  await page.locator('#plane-point').scrollIntoViewIfNeeded()
  const middle = async () => {
    const box = await page.locator('#plane-point').boundingBox()
    return { x: box.x + box.width / 2, y: box.y + box.height / 2 }
  }
  const field = await page.locator('#plane canvas').boundingBox()
  const from = await middle()
  const { stability: now, driver } = await snapshot(page)
  // Where the axes begin follows from the picture's own ticks: N = 0 at the left end, Δ = 0 at the lower end.
  const left = field.x + 30
  const bottom = field.y + field.height - 36
  const x = left + ((from.x - left) * vehicles) / now.vehicles
  const y = bottom - ((bottom - from.y) * delay) / driver.reaction_time
  await page.mouse.move(from.x, from.y)
  await page.mouse.down()
  for (let k = 1; k <= 10; k++) await page.mouse.move(from.x + ((x - from.x) * k) / 10, from.y + ((y - from.y) * k) / 10)
  await page.waitForTimeout(200)
  await before()
  await page.mouse.up()
  await page.waitForTimeout(200)
}

/** What the tab measures of the mode that grows fastest in theory. */
async function lead(page) {
  const { mode, rate } = (await snapshot(page)).stability
  const { modes } = await page.evaluate(() => window.ringroad.client.ask('modes', {}))
  return { predicted: rate, ...modes.find(m => m.mode === mode) }
}

for (const [state, from, to, sign] of [
  ['stable', 0.75, 0.6, -1],
  ['unstable', 0.6, 0.75, 1],
]) {
  test(`the point dragged to the ${state} side changes the summary, and growth over 200 s agrees`, async ({ open }) => {
    const page = await open(`index.html#reaction-time=${from}&${TOUCH}`, still)
    await ready(page)
    await diagram(page)
    holds((await stability(page)) !== state, `${state} before the point has moved`)
    let held
    await drag(page, 50, to, async () => {
      held = await stability(page)
    })
    equal(held, state, 'stability while the point is held')
    equal(await stability(page), state, 'stability')
    const { scenario, driver } = await snapshot(page)
    holds(Math.abs(driver.reaction_time - to) < 0.03, `Δ = ${driver.reaction_time}`)
    equal(scenario.vehicles, 50, 'N')
    equal(scenario.actions.join(), 'at=0:1:nudge=0.1', 'actions at t = 0')
    await playTo(page, 200)
    equal(await stability(page), state, 'stability after 200 s')
    const m = await lead(page)
    equal(Math.sign(m.rate), sign, `sign of the measured growth ${m.rate}`)
    const allowed = Math.max(0.01 * Math.abs(m.predicted), 3 * m.standard_error)
    holds(Math.abs(m.rate - m.predicted) <= allowed, `measured ${m.rate} ± ${m.standard_error}, predicted ${m.predicted}`)
    const words = await page.textContent('#summary .measured')
    holds(words.includes(sign < 0 ? 'halves' : 'doubles'), words)

    // Under way a new Δ is one action, and the run goes on.
    const time = await page.evaluate(() => window.ringroad.frame.time)
    await drag(page, 50, from)
    const { actions } = (await snapshot(page)).scenario
    equal(actions.length, 2, `actions ${actions}`)
    holds(/^at=[\d.]+:all:reaction-time=0\.[67]\d?$/.test(actions[1]), actions[1])
    equal(await page.evaluate(() => window.ringroad.frame.time), time, 'time')
    holds((await stability(page)) !== state, `${state} after the way back`)
  })
}

test('with two lanes the stability diagram is of the lane that the summary is about', async ({ open }) => {
  const page = await open(`index.html#reaction-time=0.75&lanes=2&${NUDGE}`, still)
  await ready(page)
  await diagram(page)
  const value = () => page.getAttribute('#plane-point', 'aria-valuetext')
  equal(await value(), '25 vehicles in lane 1, reaction time 0.75 seconds: stable', 'where the lane stands')
  const sentence = await page.textContent('#summary .sentence')
  const tolerated = sentence.match(/tolerates ([\d.]+)/)[1]
  holds((await page.textContent('#plane .keys')).includes(tolerated), `${sentence} / ${await page.textContent('#plane .keys')}`)
  let held
  await drag(page, 40, 0.9, async () => {
    held = await stability(page)
  })
  const { scenario, stability: after } = await snapshot(page)
  holds(Math.abs(after.vehicles - 40) <= 1 && scenario.vehicles === 2 * after.vehicles, `${after.vehicles} of ${scenario.vehicles}`)
  equal(held, 'unstable', 'stability while the point is held')
  equal(await stability(page), 'unstable', 'stability')
  holds((await value()).startsWith(`${after.vehicles} vehicles in lane 1`), await value())
  // Δ alone leaves the vehicles where they are.
  await playTo(page, 5)
  await drag(page, after.vehicles, 0.5)
  const now = await snapshot(page)
  equal(now.scenario.vehicles, scenario.vehicles, 'N after Δ alone')
  holds(now.scenario.actions.at(-1).includes('reaction-time='), now.scenario.actions.join())
})

test('with heterogeneous drivers the diagram says that it is for homogeneous ones, and theory is beside the measurement', async ({ open }) => {
  const page = await open(`index.html#reaction-time=0.75&driver=1-25%3Areaction-time%3D0.3&${TOUCH}`, still)
  await ready(page)
  await diagram(page)
  equal(await page.textContent('#plane-title'), 'If all drivers were equal', 'title')
  holds(/for equal drivers/.test(await page.getAttribute('#plane canvas', 'aria-label')), 'said in words')
  await playTo(page, 60)
  await page.waitForTimeout(900)
  const label = await page.getAttribute('#modes canvas', 'aria-label')
  holds(/mode 1: .?0\.\d+ against .?0\.00/.test(label), label)
  const { modes } = await page.evaluate(() => window.ringroad.client.ask('modes', {}))
  const roots = await page.evaluate(() => window.ringroad.client.ask('roots', {}))
  for (const { mode, predicted } of modes.filter(m => m.rate !== null)) {
    const root = roots.growth_per_s[roots.modes.indexOf(mode)]
    holds(Math.abs(predicted - root) < 1e-9, `mode ${mode}: ${predicted} in the table, ${root} among the roots`)
  }
})

/** Chooses what the diagram shows and waits until it is complete. */
async function choose(page, ground, { wait = true } = {}) {
  await page.selectOption('#plane-ground', ground)
  if (wait) await page.waitForFunction(() => document.querySelector('#plane').dataset.growth === 'done', null, { timeout: 60_000 })
}

/** The colour of the diagram at a number of vehicles and a reaction time; the axes reach to 133 and 1.5 s. */
const at = (page, vehicles, delay) =>
  page.evaluate(
    ([n, s]) => {
      const canvas = document.querySelector('#plane canvas')
      const scale = canvas.width / canvas.clientWidth
      const [left, right, top, bottom] = [30, canvas.clientWidth - 8, 25, canvas.clientHeight - 36]
      const [x, y] = [left + ((right - left) * n) / 133, bottom - ((bottom - top) * s) / 1.5]
      return Array.from(canvas.getContext('2d').getImageData(Math.round(x * scale), Math.round(y * scale), 1, 1).data)
    },
    [vehicles, delay],
  )

for (const colorScheme of ['light', 'dark']) {
  test(`the map of growth rates is blue below the curve and orange above it, ${colorScheme}`, async ({ open }) => {
    const page = await open(`index.html#reaction-time=0.2&${NUDGE}`, { ...still, colorScheme })
    await ready(page)
    await diagram(page)
    for (const ground of ['steps', 'continuous']) {
      await choose(page, ground)
      for (const [n, s, grows] of [
        [8, 0.4, false],
        [24, 0.7, false],
        [64, 1.03, true],
        [98, 0.83, true],
        [127, 1.43, true],
      ]) {
        const [r, , b] = await at(page, n, s)
        holds(grows ? r > b : b > r, `${ground}, ${n} vehicles, ${s} s: red ${r}, blue ${b}`)
      }
      holds(/orange, growing/.test(await page.getAttribute('#plane canvas', 'aria-label')), 'said in words')
    }
    const before = await at(page, 98, 0.83)
    await page.check('#plane-modes')
    await page.waitForTimeout(600)
    const count = await page.evaluate(async () => (await window.ringroad.client.ask('diagramModes', { steps: true })).length)
    equal(count, 132 * 66, 'a value for every number of vehicles and mode')
    await page.uncheck('#plane-modes')
    await choose(page, 'regions', { wait: false })
    await page.waitForTimeout(100)
    holds((await at(page, 98, 0.83)).join() !== before.join(), 'switched off')
  })
}

test('the map of growth rates leaves the worker time for other requests, and stops at once', async ({ open, note }) => {
  const page = await open(`index.html#reaction-time=0.75&${NUDGE}`, still)
  await ready(page)
  await diagram(page)
  /** How long the worker lets another question wait, and the page a timer, while `during` goes on (ms). */
  const waits = during =>
    page.evaluate(async source => {
      const going = new Function(`return ${source}`)
      const { client } = window.ringroad
      let [worker, own, answers] = [0, 0, 0]
      let over = false
      const asking = (async () => {
        while (!over) {
          const before = performance.now()
          await client.ask('advance', { steps: 0, budget: 0 })
          worker = Math.max(worker, performance.now() - before)
          answers++
          await new Promise(resolve => setTimeout(resolve, 5))
        }
      })()
      const started = performance.now()
      for (let last = started; going() && last < started + 60_000; ) {
        await new Promise(resolve => setTimeout(resolve))
        own = Math.max(own, performance.now() - last)
        last = performance.now()
      }
      over = true
      await asking
      return { worker, own, answers, total: performance.now() - started }
    }, during)
  // What the machine does without the map, for about as long.
  await page.evaluate(() => {
    window.until = performance.now() + 800
  })
  const idle = await waits('performance.now() < window.until')
  await choose(page, 'steps', { wait: false })
  const busy = await waits("document.querySelector('#plane').dataset.growth === 'busy'")
  note(`map: ${JSON.stringify(busy)}, without: ${JSON.stringify(idle)}`)
  holds(busy.answers >= 5, `${busy.answers} answers meanwhile`)
  holds(busy.worker < 3 * idle.worker + 120 && busy.own < 3 * idle.own + 120, `${JSON.stringify(busy)}, without: ${JSON.stringify(idle)}`)

  // Halted: the answer has fewer columns than asked for.
  const short = await page.evaluate(async () => {
    const { client } = window.ringroad
    const vehicles = Array.from({ length: 132 }, (_, k) => k + 2)
    const map = client.ask('growthRates', { vehicles, highest: 1.5, count: 200, steps: true, budget: 60_000 })
    await client.ask('haltGrowthRates', {})
    return (await map).length / 200
  })
  holds(short < 66, `${short} of 132 columns before the halt`)
  // While the point is held nothing is computed; then the map is completed.
  await drag(page, 50, 0.6, async () => {
    await choose(page, 'continuous', { wait: false })
    await page.waitForTimeout(1500)
    equal(await page.getAttribute('#plane', 'data-growth'), 'busy', 'while the point is held')
  })
  await choose(page, 'continuous')
  // Other curves have another map.
  await page.evaluate(() => window.ringroad.set('sensitivity', '1.5'))
  await page.waitForFunction(() => document.querySelector('#plane').dataset.growth === 'busy')
  await choose(page, 'continuous')
})

test('the point moves by keyboard: Δ and N, and N starts again', async ({ open }) => {
  const page = await open(`index.html#reaction-time=0.66&${NUDGE}`, still)
  await ready(page)
  await diagram(page)
  await playTo(page, 5)
  await page.focus('#plane-point')
  const seen = {}
  for (let k = 0; k < 3; k++) {
    await page.keyboard.press('ArrowUp')
    await page.waitForTimeout(700)
    seen[(await snapshot(page)).driver.reaction_time] = await stability(page)
  }
  equal(JSON.stringify(seen), JSON.stringify({ 0.67: 'stable', 0.68: 'unstable', 0.69: 'unstable' }), 'stability')
  equal(await page.getAttribute('#plane-point', 'aria-valuetext'), '50 vehicles, reaction time 0.69 seconds: unstable', 'value in words')
  // Fewer vehicles tolerate more.
  for (let k = 0; k < 8; k++) await page.keyboard.press('ArrowLeft')
  await page.waitForTimeout(900)
  const { scenario } = await snapshot(page)
  equal(scenario.vehicles, 42, 'N')
  equal(scenario.driver.reaction_time, 0.69, 'Δ of the new run')
  equal(scenario.actions.join(), 'at=0:1:nudge=1', 'actions of the new run')
  equal(await stability(page), 'stable', 'stability with fewer vehicles')
  equal(await page.inputValue('#p-vehicles-number'), '42', 'the number beside the slider')
})

test('the stability tab says in words what it draws', async ({ open }) => {
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

test('theory is drawn while nothing can be measured, and a line says why', async ({ open }) => {
  const page = await open('index.html#lanes=3&vehicles=60&start=one-lane', still)
  await ready(page)
  await page.evaluate(() => window.ringroad.seek(60))
  await page.waitForFunction(() => document.querySelector('#modes-status').textContent.startsWith('Lane changes go on'))
  // The curve has a colour of its own.
  const coloured = await page.$eval('#modes canvas', canvas => {
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height)
    let count = 0
    for (let k = 0; k < data.length; k += 4) if (data[k + 3] > 128 && data[k + 2] - data[k] > 60) count++
    return count
  })
  holds(coloured > 100, `${coloured} pixels of theory`)
})

for (const [width, height] of [
  [1280, 800],
  [390, 844],
]) {
  test(`the stability tab fits ${width} × ${height}`, async ({ open }) => {
    const page = await open(`index.html#reaction-time=0.75&${NUDGE}`, { ...still, viewport: { width, height } })
    await ready(page)
    await diagram(page)
    const cut = await page.evaluate(() => {
      const over = e => e.scrollWidth > e.clientWidth + 1 || e.scrollHeight > e.clientHeight + 1
      const panel = document.querySelector('#panel-stability')
      const wide = [...panel.querySelectorAll('section, h3, p, .keys')].filter(e => e.scrollWidth > e.clientWidth + 1)
      return { panel: over(panel), page: document.documentElement.scrollWidth > innerWidth, wide: wide.map(e => e.id || e.className) }
    })
    equal(JSON.stringify(cut), JSON.stringify({ panel: false, page: false, wide: [] }), 'what is cut')
  })
}
