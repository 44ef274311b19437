// The charts: the cursor reads the measured values, moved by pointer, touch or keys.
import { equal, holds, playTo, ready, test } from './helpers.mjs'

const still = { reducedMotion: 'reduce' }

/** Minus signs and narrow spaces as plain ones. */
const plain = words => words.replaceAll('\u2212', '-').replaceAll('\u202f', ' ')
const tip = async (page, chart) => plain(await page.locator(`${chart} .tip`).innerText())

/** What the series holds at the row whose time the tip tells, as the tip should write it. */
const measured = (page, words) =>
  page.evaluate(at => {
    const { series, snapshot } = window.ringroad
    const row = series.time.findIndex(t => Math.abs(t - at) < 1e-6)
    const cars = snapshot.watched.map((n, k) => `car ${n}\t${series.speeds[k][row].toFixed(2)}`)
    return [...cars, `v∞\t${snapshot.mean_equilibrium_speed.toFixed(2)}`].join('\n')
  }, Number(/t = ([\d.]+) s/.exec(words)[1]))

test('the chart of speeds reads what was measured, under the mouse', async ({ open }) => {
  const page = await open('index.html', still)
  await ready(page)
  await playTo(page, 120)
  const box = await page.locator('#speeds canvas').boundingBox()
  holds(!(await page.isVisible('#speeds .tip')), 'a reading without a pointer')
  const seen = new Set()
  for (const part of [0.25, 0.5, 0.9]) {
    await page.mouse.move(box.x + part * box.width, box.y + box.height / 2)
    const words = await tip(page, '#speeds')
    const [time, ...values] = words.split('\n').filter(line => line !== '')
    equal(values.join('\n'), await measured(page, time), `values at ${time}`)
    seen.add(time)
    const [at, inside] = await page.evaluate(() => {
      const tip = document.querySelector('#speeds .tip').getBoundingClientRect()
      const card = document.querySelector('#speeds').getBoundingClientRect()
      return [tip.left, tip.left >= card.left && tip.right <= card.right && tip.bottom <= card.bottom]
    })
    holds(inside, `the reading at ${at} leaves its card`)
  }
  equal(seen.size, 3, 'different times')
  await page.mouse.move(5, 5)
  holds(!(await page.isVisible('#speeds .tip')), 'a reading after the mouse has left')
})

test('the charts are read by keys, for screen readers, too', async ({ open }) => {
  const page = await open('index.html', still)
  await ready(page)
  await page.evaluate(() => window.ringroad.preset('load-balance'))
  await playTo(page, 60)
  await page.focus('#speeds .chart')
  const value = async chart => plain(await page.getAttribute(chart, 'aria-valuetext')).replaceAll('\t', ' ')
  await page.keyboard.press('Home')
  holds((await value('#speeds .chart')).startsWith('t = 0 s: car 1 '), await value('#speeds .chart'))
  await page.keyboard.press('ArrowRight')
  const second = await page.evaluate(() => window.ringroad.series.time[1])
  holds((await value('#speeds .chart')).startsWith(`t = ${second} s:`), await value('#speeds .chart'))
  equal(Number(await page.getAttribute('#speeds .chart', 'aria-valuenow')), second, 'value')
  await page.keyboard.press('End')
  const last = await page.evaluate(() => window.ringroad.series.time.at(-1))
  equal(Number(await page.getAttribute('#speeds .chart', 'aria-valuenow')), last, 'value at the end')
  holds(await page.isVisible('#speeds .tip'), 'no cursor to be seen')

  await page.click('#tab-lanes')
  holds(!(await page.isVisible('#speeds .tip')), 'the cursor stays behind')
  await page.focus('#panel-lanes .chart >> nth=0')
  await page.keyboard.press('Home')
  equal(await value('#panel-lanes .chart >> nth=0'), 't = 0 s: ΔN 50', 'ΔN at the start')
  await page.focus('#panel-lanes .chart >> nth=1')
  await page.keyboard.press('Home')
  // The window of the flow has not passed yet.
  equal(await value('#panel-lanes .chart >> nth=1'), 't = 0 s: flow –', 'flow at the start')
  await page.keyboard.press('End')
  const flow = await page.evaluate(() => Math.round(window.ringroad.series.flow.at(-1) * 3600))
  holds((await value('#panel-lanes .chart >> nth=1')).endsWith(`flow ${flow}`), `${await value('#panel-lanes .chart >> nth=1')}, ${flow}`)
})

test('a touch of the chart leaves its reading', async ({ open }) => {
  const page = await open('index.html', { ...still, viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true })
  await ready(page)
  await playTo(page, 60)
  await page.locator('#speeds .chart').scrollIntoViewIfNeeded()
  const box = await page.locator('#speeds canvas').boundingBox()
  await page.touchscreen.tap(box.x + box.width / 2, box.y + box.height / 2)
  const words = await tip(page, '#speeds')
  const [time, ...values] = words.split('\n').filter(line => line !== '')
  equal(values.join('\n'), await measured(page, time), `values at ${time}`)
  await page.locator('#speeds h2').tap()
  await page.waitForSelector('#speeds .tip', { state: 'hidden' })
})

for (const [colorScheme, deviceScaleFactor] of [
  ['light', 1],
  ['dark', 2],
]) {
  test(`the chart has the screen’s pixels and the page’s colours, ${colorScheme}`, async ({ open }) => {
    const page = await open('index.html', { ...still, colorScheme, deviceScaleFactor })
    await ready(page)
    await playTo(page, 60)
    const { size, colours } = await page.evaluate(() => {
      const canvas = document.querySelector('#speeds canvas')
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height)
      const found = new Set()
      for (let k = 0; k < data.length; k += 4) if (data[k + 3] === 255) found.add(`#${[0, 1, 2].map(j => data[k + j].toString(16).padStart(2, '0')).join('')}`)
      return { size: canvas.width / canvas.clientWidth, colours: [...found] }
    })
    equal(size, deviceScaleFactor, 'pixels of the canvas for one of the page')
    const cars = colorScheme === 'dark' ? ['#7cc4f5', '#f0a941', '#4fd0a5', '#f08bc1', '#e6e04e'] : ['#0064a6', '#b45f00', '#007a57', '#b13a80', '#5a4fb0']
    const [grid, ink] = colorScheme === 'dark' ? ['#2a2f37', '#e8ebf0'] : ['#e6e8eb', '#1a2230']
    for (const colour of [...cars, grid, ink]) holds(colours.includes(colour), `nothing is drawn in ${colour}`)
  })
}
