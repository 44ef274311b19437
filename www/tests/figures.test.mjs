// The paper's figures on the page, held against the command.
import { mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs'
import { tmpdir } from 'node:os'
import { join } from 'node:path'
import { dist, equal, hash, holds, ringroad, test } from './helpers.mjs'

/** Runs a figure on an open page to its end. */
async function runs(page, id) {
  await page.click(`#figure-${id} .run`)
  await page.waitForSelector(`#figure-${id}[data-done][data-state=idle]`, { timeout: 60_000 })
}

/** What one of the save buttons of a figure gives. */
async function saved(page, id, name) {
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    page.click(`#figure-${id} .files button:text-is("${name}")`),
  ])
  equal(download.suggestedFilename(), name, 'name of the file')
  return readFileSync(await download.path())
}

/** What the command writes for a figure: file by file, and its claims. */
function written(id) {
  const folder = mkdtempSync(join(tmpdir(), 'ringroad-'))
  try {
    const claims = JSON.parse(ringroad('reproduce', id, '--out', folder, '--json'))
    const files = readdirSync(folder).filter(name => name !== 'claims.json')
    return { claims, files: new Map(files.map(name => [name, readFileSync(join(folder, name))])) }
  } finally {
    rmSync(folder, { recursive: true })
  }
}

const WORDS = { agrees: '✓ agrees', differs: '✗ differs', 'not determined by the paper': '? not determined by the paper' }

const PLACES = {
  'a page of its own': 'figures.html',
  'one file from disk': `file://${dist}/ringroad.html#view=figures`,
  'a policy without workers': 'policy-no-worker/ringroad.html#view=figures',
}
for (const [name, address] of Object.entries(PLACES)) {
  test(`figures: pictures, tables and claims are those of the command, in ${name}`, async ({ open }) => {
    const page = await open(address)
    await page.waitForSelector('#figure-fundamental-diagram .run')
    for (const id of ['fundamental-diagram', 'load-balance']) {
      await runs(page, id)
      const { claims, files } = written(id)
      holds(files.size >= 3, `the command wrote ${files.size} files`)
      for (const [file, bytes] of files) {
        equal(hash(await saved(page, id, file)), hash(bytes), file)
      }
      const rows = await page.$$eval(`#figure-${id} .claims tbody tr`, all =>
        all.map(row => [...row.children].map(cell => cell.textContent)),
      )
      equal(rows.length, claims.length, `claims of ${id}`)
      rows.forEach(([, paper, , verdict, method], k) => {
        equal(paper, claims[k].paper, 'the paper')
        equal(verdict, WORDS[claims[k].verdict], 'verdict')
        equal(method, claims[k].method, 'method')
      })
    }
    equal(page.problems.join(), '', 'errors on the page')
  })
}

test('figures: a picture with maps is saved as PNG', async ({ open }) => {
  const page = await open('policy-site-worker/figures.html')
  await page.waitForSelector('#figure-waves .run')
  await runs(page, 'waves')
  const png = await saved(page, 'waves', 'waves.png')
  equal(png.subarray(1, 4).toString(), 'PNG', 'first bytes')
  const shape = await page.$eval('#figure-waves svg', svg => [svg.viewBox.baseVal.width, svg.viewBox.baseVal.height])
  equal([png.readUInt32BE(16), png.readUInt32BE(20)].join(), shape.map(x => Math.round(2 * x)).join(), 'pixels')
  // Blue of the jams within the first map, and not the white of the page.
  const colours = await page.evaluate(async base64 => {
    const image = new Image()
    image.src = `data:image/png;base64,${base64}`
    await image.decode()
    const canvas = document.createElement('canvas')
    canvas.width = image.naturalWidth
    canvas.height = image.naturalHeight
    const context = canvas.getContext('2d')
    context.drawImage(image, 0, 0)
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height)
    let coloured = 0
    for (let k = 0; k < data.length; k += 4) if (data[k + 2] - data[k] > 60) coloured++
    return coloured / (data.length / 4)
  }, png.toString('base64'))
  holds(colours > 0.01, `only ${colours} of the picture is blue`)
})

/** The rows of a table of a figure, as the command writes it, each by name of column. */
function table(id, name) {
  const [head, ...rows] = written(id).files.get(`${name}.csv`).toString().split('\n').filter(line => line !== '' && !line.startsWith('#'))
  const names = head.split(',')
  return rows.map(row => Object.fromEntries(row.split(',').map((value, k) => [names[k], Number(value)])))
}

/** A number as the page writes it: four digits, no trailing zeros. */
const digits = value => String(Number(value.toPrecision(4))).replace('-', '\u2212')

test('figures: values are read off the picture by pointer, by finger and by keyboard', async ({ open }) => {
  const page = await open('figures.html', { hasTouch: true })
  const figure = '#figure-load-balance'
  await page.waitForSelector(`${figure} .run`)
  await runs(page, 'load-balance')
  const at30 = table('load-balance', 'load-balance').find(row => row.time_s === 30)
  const [low, high] = [-1, 1].map(sign => digits(at30.imbalance_mean + sign * at30.imbalance_half_interval))
  const expected = `Difference between the lanes, r = 0.1, p = 0.2 · time (s): 30 · ΔN (vehicles): ${digits(at30.imbalance_mean)} (${low} to ${high})`
  const reading = () => page.textContent(`${figure} .reading`)
  const told = () => page.textContent(`${figure} .plot ~ [role=status]`)

  // By keyboard: the second curve, sixty half seconds on, there and back again.
  await page.focus(`${figure} .plot`)
  await page.keyboard.press('ArrowRight')
  await page.keyboard.press('ArrowDown')
  await page.keyboard.press('Home')
  for (let k = 0; k < 62; k++) await page.keyboard.press('ArrowRight')
  for (let k = 0; k < 2; k++) await page.keyboard.press('ArrowLeft')
  equal(await told(), expected, 'what a live region says')
  equal(await reading(), expected, 'what is to be seen')
  const mark = await page.locator(`${figure} svg .pointer`).boundingBox()
  await page.keyboard.press('PageDown')
  holds((await told()).startsWith('Flow at L/2'), await told())
  await page.keyboard.press('Escape')
  equal(await told(), '', 'after Escape')
  equal(await page.locator(`${figure} svg .pointer`).count(), 0, 'marks')

  // By pointer: a few pixels away are near enough, and screen readers get nothing.
  const [x, y] = [mark.x + mark.width / 2, mark.y + mark.height / 2]
  await page.mouse.move(x + 0.5, y + 1)
  equal(await reading(), expected, 'under the pointer')
  equal(await told(), '', 'told aloud')
  await page.mouse.move(5, 5)
  holds((await reading()).startsWith('Point at the picture'), await reading())

  // By finger: what was found stays.
  await page.touchscreen.tap(x, y)
  equal(await reading(), expected, 'under the finger')
  equal(page.problems.join(), '', 'errors on the page')
})

test('figures: a map tells the value of a cell', async ({ open }) => {
  const page = await open('figures.html')
  const figure = '#figure-waves'
  await page.waitForSelector(`${figure} .run`)
  await runs(page, 'waves')
  const { left, top, width, height } = await page.$eval(`${figure} svg image`, image => {
    image.scrollIntoView({ block: 'center' })
    return image.getBoundingClientRect().toJSON()
  })
  const panels = await page.$$eval(`${figure} svg image`, all => all.length)
  equal(panels, 6, 'maps')
  // The first map is that of Δ = 0 s: its flow hardly changes; any cell is a row of the table.
  const still = table('waves', 'waves-flow-0')
  for (const [right, up] of [[0.5, 0.5], [0.99, 0.1], [0.3, 0.9]]) {
    await page.mouse.move(left + width * right, top + height * (1 - up))
    const said = await page.textContent(`${figure} .reading`)
    const [, time, position, flow] = said.match(/time \(s\): ([\d.]+) · position \(m\): ([\d.]+) · .*: ([\d.]+)$/) ?? []
    holds(flow !== undefined, said)
    const near = still.filter(row => Math.abs(row.time_s - time) <= 5 && Math.abs(row.position_m - position) <= 20)
    holds(near.some(row => digits(row.flow_veh_per_s) === flow), `${said}; the table has ${near.map(row => row.flow_veh_per_s)}`)
  }
  // By keyboard, from cell to cell.
  await page.focus(`${figure} .plot`)
  const value = async key => {
    await page.keyboard.press(key)
    return page.textContent(`${figure} .plot ~ [role=status]`)
  }
  const [before, after] = [await value('ArrowUp'), await value('ArrowDown')]
  holds(before !== after && before.includes('position (m)'), `${before} / ${after}`)
  equal(await value('ArrowUp'), before, 'and up again')
})

/** Presses the cancel button of a figure that runs; milliseconds until it is idle. */
const cancelled = (page, figure) =>
  page.evaluate(async f => {
    const before = performance.now()
    document.querySelector(`${f} .stop`).click()
    while (document.querySelector(f).dataset.state !== 'idle') await new Promise(r => setTimeout(r, 1))
    return performance.now() - before
  }, figure)

const CANCEL = {
  'with workers': 'figures.html',
  'without workers': 'policy-no-worker/ringroad.html#view=figures',
}
for (const [how, address] of Object.entries(CANCEL)) {
  test(`figures: cancel takes effect at once, and the figure can be run again, ${how}`, async ({ open }) => {
    const page = await open(address)
    for (const id of ['frustration-flow', 'stability']) {
      const figure = `#figure-${id}`
      await page.waitForSelector(`${figure} .run`)
      await page.click(`${figure} .run`)
      await page.waitForFunction(f => document.querySelector(`${f} progress`).value > 0, figure)
      const taken = await cancelled(page, figure)
      holds(taken < 100, `cancel took ${taken} ms`)
      equal(await page.textContent(`${figure} .status`), 'Cancelled.', 'what is said')
      equal(await page.locator(`${figure} .plot`).count(), 0, 'pictures')
    }
    await runs(page, 'fundamental-diagram')
    equal(page.problems.join(), '', 'errors on the page')
  })
}

test('figures: waiting figures are cancelled with the one that runs', async ({ open }) => {
  const page = await open('figures.html')
  await page.click('#figures-all')
  await page.waitForSelector('#figure-stability[data-state=running]', { timeout: 60_000 })
  await page.click('#figures-cancel')
  await page.waitForFunction(() => document.querySelectorAll('.figure:not([data-state=idle])').length === 0)
  const done = await page.$$eval('.figure[data-done]', all => all.map(f => f.id))
  equal(done.join(), 'figure-fundamental-diagram,figure-waves', 'done')
  holds(/^\d+ claims: \d+ agree/.test(await page.textContent('#figures-summary')), 'no summary')
})

test('figures: the laboratory is unchanged after a visit to the figures', async ({ open }) => {
  const page = await open('index.html#vehicles=40')
  await page.waitForFunction(() => window.ringroad?.frame?.time > 0.5)
  await page.click('#open-figures')
  await page.waitForSelector('#figures .figure')
  equal(await page.evaluate(() => window.ringroad.playback.playing), false, 'playing')
  holds(!(await page.isVisible('#ring')), 'the ring is still to be seen')
  const time = await page.evaluate(() => window.ringroad.frame.time)
  await page.waitForTimeout(200)
  equal(await page.evaluate(() => window.ringroad.frame.time), time, 'time')
  await page.goBack()
  await page.waitForSelector('#ring', { state: 'visible' })
  holds(!(await page.isVisible('#figures')), 'the figures are still to be seen')
  await page.waitForFunction(time => window.ringroad.frame.time > time, time)
  // A paused run stays paused.
  await page.click('#play')
  const paused = await page.evaluate(() => window.ringroad.frame.time)
  await page.click('#open-figures')
  await page.waitForSelector('#figures', { state: 'visible' })
  await page.click('#open-figures')
  await page.waitForSelector('#ring', { state: 'visible' })
  equal(await page.evaluate(() => window.ringroad.playback.playing), false, 'playing although it was paused')
  equal(await page.evaluate(() => window.ringroad.frame.time), paused, 'time')
  equal(await page.evaluate(() => window.ringroad.snapshot.scenario.vehicles), 40, 'vehicles')
})

for (const [width, height] of [[1280, 800], [390, 844]]) {
  test(`figures: fit ${width} × ${height}`, async ({ open }) => {
    const page = await open('figures.html', { viewport: { width, height } })
    await page.waitForSelector('#figure-fundamental-diagram .run')
    await runs(page, 'fundamental-diagram')
    const over = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)
    holds(over <= 0, `${over} px too wide`)
  })
}

test('figures: dark on a dark page, and a picture wider than a phone fades at its edge', async ({ open }) => {
  for (const [colorScheme, dark] of [['light', false], ['dark', true]]) {
    const page = await open('figures.html', { colorScheme, viewport: { width: 390, height: 844 } })
    await page.waitForSelector('#figure-fundamental-diagram .run')
    await runs(page, 'fundamental-diagram')
    const plot = page.locator('#figure-fundamental-diagram .plot')
    const mean = await page.evaluate(async base64 => {
      const image = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), c => c.charCodeAt(0))]))
      const context = new OffscreenCanvas(image.width, image.height).getContext('2d')
      context.drawImage(image, 0, 0)
      return context.getImageData(0, 0, image.width, image.height).data.reduce((sum, v, k) => (k % 4 < 3 ? sum + v : sum), 0) / (image.width * image.height * 3)
    }, (await plot.screenshot()).toString('base64'))
    holds(dark ? mean < 70 : mean > 190, `${colorScheme}: mean brightness ${mean}`)
    const fades = () => plot.evaluate(e => e.classList.contains('more'))
    equal(await fades(), true, 'fades at the start')
    await plot.evaluate(e => void (e.scrollLeft = e.scrollWidth))
    await page.waitForTimeout(100)
    equal(await fades(), false, 'fades at the end')
  }
})
