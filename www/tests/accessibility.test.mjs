// Accessibility: axe-core, the keyboard, reduced motion, and boxes that fit and do not overlap.
import { readFileSync } from 'node:fs'
import { fileURLToPath } from 'node:url'
import { equal, holds, playTo, ready, test } from './helpers.mjs'

const axe = readFileSync(fileURLToPath(new URL('../node_modules/axe-core/axe.min.js', import.meta.url)), 'utf8')

async function clean(page, what) {
  await page.evaluate(axe)
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ['violations'] }))
  equal(violations.map(v => `${v.id}: ${v.nodes.map(n => n.target).join(' ')}`).join('; '), '', `axe-core on ${what}`)
}

for (const colorScheme of ['light', 'dark']) {
  test(`axe-core finds nothing: the page, its tabs and dialogs, ${colorScheme}`, async ({ open }) => {
    const page = await open('index.html', { colorScheme })
    await ready(page)
    await playTo(page, 20)
    await page.click('#more-controls')
    for (const tab of await page.locator('[role=tab]').all()) {
      await tab.click()
      await clean(page, await tab.textContent())
    }
    for (const dialog of ['share', 'files', 'help']) {
      await page.click(`#open-${dialog}`)
      await page.waitForSelector(`#${dialog}[open]`)
      await clean(page, dialog)
      await page.keyboard.press('Escape')
    }
    await page.selectOption('#presets', { index: 1 })
    await page.waitForSelector('#preset:not([hidden])')
    await clean(page, 'an experiment')
    await page.evaluate(() => window.ringroad.set('vehicles', '300'))
    await page.waitForSelector('#trouble:not([hidden])')
    await clean(page, 'a refusal')
  })
}
test('axe-core finds nothing: the embedded view and the course page', async ({ open }) => {
  const embed = await open('embed.html')
  await ready(embed)
  await clean(embed, 'embed.html')
  await clean(await open('course.html'), 'course.html')
})

test('everything is reached by keyboard', async ({ open }) => {
  const page = await open('index.html', { reducedMotion: 'reduce' })
  await ready(page)
  await page.click('#more-controls')
  const wanted = await page.evaluate(() =>
    [...document.querySelectorAll('button, select, input, textarea, a, [tabindex]')]
      .filter(e => e.checkVisibility({ visibilityProperty: true }) && !e.closest('dialog') && !e.disabled && e.tabIndex >= 0)
      .map((e, k) => {
        e.dataset.stop = k
        return e.outerHTML.slice(0, 90)
      }),
  )
  const reached = new Set()
  await page.evaluate(() => document.activeElement?.blur())
  for (let k = 0; k < wanted.length + 5; k++) {
    await page.keyboard.press('Tab')
    const stop = await page.evaluate(() => document.activeElement?.dataset?.stop)
    if (stop !== undefined) reached.add(Number(stop))
  }
  const missed = wanted.filter((_, k) => !reached.has(k))
  equal(missed.join('\n'), '', 'never focused')
  holds(wanted.length > 25, `${wanted.length} stops only`)
})

test('keys play, step, nudge, brake and help; sliders speak with units', async ({ open }) => {
  const page = await open('index.html', { reducedMotion: 'reduce' })
  await ready(page)
  await page.evaluate(() => document.activeElement?.blur())
  equal(await page.evaluate(() => window.ringroad.playback.playing), false, 'playing although less motion is asked for')
  await page.keyboard.press('.')
  await page.waitForFunction(() => window.ringroad.frame.step === 1)
  await page.keyboard.press('Space')
  await page.waitForFunction(() => window.ringroad.playback.playing && window.ringroad.frame.step > 5)
  await page.keyboard.press('Space')
  equal(await page.evaluate(() => window.ringroad.playback.playing), false, 'playing after the second space')
  await page.keyboard.press('b')
  await page.keyboard.press('n')
  await page.waitForFunction(() => window.ringroad.snapshot.scenario.actions.length === 3)
  await page.keyboard.press('?')
  await page.waitForSelector('#help[open]')
  await page.keyboard.press('Escape')
  equal(await page.getAttribute('#p-reaction_time', 'aria-valuetext'), '0.75 seconds', 'value of the slider')
  await page.focus('#ring-canvas')
  await page.keyboard.press('ArrowRight')
  equal(await page.evaluate(() => window.ringroad.watched), 1, 'watched car')
})

test('numbers do not cover the name of the map’s axis, nor the unit of the charts', async ({ open }) => {
  for (const length of [1000, 5000, 10000, 300000]) {
    const page = await open('about:blank', { reducedMotion: 'reduce' })
    await page.addInitScript(() => {
      window.written = []
      const { fillText: write, clearRect: clear } = CanvasRenderingContext2D.prototype
      CanvasRenderingContext2D.prototype.clearRect = function (...box) {
        if (this.canvas.closest('#speeds')) window.written = []
        return clear.apply(this, box)
      }
      CanvasRenderingContext2D.prototype.fillText = function (words, x, y) {
        if (this.canvas.closest('#speeds')) {
          const { actualBoundingBoxLeft: l, actualBoundingBoxRight: r, actualBoundingBoxAscent: a, actualBoundingBoxDescent: d } = this.measureText(words)
          window.written.push({ words, left: x - l, right: x + r, top: y - a, bottom: y + d })
        }
        return write.call(this, words, x, y)
      }
    })
    await page.goto(`${(await open('course.html')).url().replace('course.html', 'index.html')}#length=${length}`)
    await ready(page)
    await page.waitForTimeout(300)
    const covered = await page.evaluate(() => {
      const [name, ...numbers] = [...document.querySelectorAll('#map .axis.y span')].map(e => e.getBoundingClientRect())
      return numbers.filter(n => n.left < name.right).length
    })
    equal(covered, 0, `numbers beside the name of the map's axis, ring of ${length} m`)
    const over = await page.evaluate(() => {
      const unit = window.written.findLast(w => w.words === 'm/s')
      return window.written.filter(w => w.words !== 'm/s' && w.left < unit.right && w.right > unit.left && w.top < unit.bottom && w.bottom > unit.top).map(w => w.words)
    })
    equal(over.join(), '', 'numbers under the unit of the speeds')
  }
})

test('a hidden page stops and goes on where it was', async ({ open }) => {
  const page = await open('index.html')
  await ready(page)
  await page.evaluate(() => Object.defineProperty(document, 'hidden', { configurable: true, get: () => true }))
  await page.waitForTimeout(200)
  const step = await page.evaluate(() => window.ringroad.frame.step)
  await page.waitForTimeout(500)
  equal(await page.evaluate(() => window.ringroad.frame.step), step, 'steps while hidden')
  await page.evaluate(() => Object.defineProperty(document, 'hidden', { configurable: true, get: () => false }))
  await page.waitForFunction(s => window.ringroad.frame.step > s, step)
  holds((await page.evaluate(() => window.ringroad.frame.step)) < step + 500, 'the time in which the page was hidden was made up for')
})

test('a machine that cannot keep up says so', async ({ open }) => {
  const page = await open('index.html#vehicles=60000&length=1200000')
  await ready(page)
  await page.evaluate(() => {
    window.ringroad.playback.setFactor(100)
    window.ringroad.playback.play()
  })
  await page.waitForFunction(() => document.querySelector('.transport .message').textContent.includes('manages'), null, { timeout: 20_000 })
})

/** Faults of the layout: visible elements that leave the page, are cut, or cover others. */
const boxes = () => {
  const faults = []
  const seen = e => e.checkVisibility({ visibilityProperty: true }) && !e.closest('.hidden, dialog:not([open])')
  const name = e => `${e.tagName.toLowerCase()}${e.id ? `#${e.id}` : ''} “${(e.textContent ?? '').trim().slice(0, 24)}”`
  const width = document.documentElement.clientWidth
  if (document.documentElement.scrollWidth > width) faults.push(`the page is ${document.documentElement.scrollWidth} wide`)
  for (const e of document.querySelectorAll('body *')) {
    if (!seen(e) || e.closest('.picture, svg, [data-view=embed] .top')) continue
    const box = e.getBoundingClientRect()
    if (box.width === 0 || box.height === 0) continue
    if (box.right > width + 0.5 || box.left < -0.5) faults.push(`${name(e)} leaves the page: ${box.left}…${box.right}`)
    if (e.children.length === 0 && e.textContent.trim() !== '' && (e.scrollWidth > e.clientWidth + 1 || e.scrollHeight > e.clientHeight + 3) && getComputedStyle(e).display !== 'inline') {
      faults.push(`${name(e)} is cut: ${e.scrollWidth}×${e.scrollHeight} in ${e.clientWidth}×${e.clientHeight}`)
    }
  }
  // Cards and controls do not overlap; neither do the numbers of an axis or a colour bar.
  const apart = list => {
    for (let i = 0; i < list.length; i++) {
      for (let k = i + 1; k < list.length; k++) {
        const [a, b] = [list[i].getBoundingClientRect(), list[k].getBoundingClientRect()]
        const over = Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1
        if (over) faults.push(`${name(list[i])} covers ${name(list[k])}`)
      }
    }
  }
  apart([...document.querySelectorAll('.card, #summary, [data-view=lab] .top')].filter(seen))
  apart([...document.querySelectorAll('.stability section')].filter(seen))
  for (const e of [...document.querySelectorAll('.card :is(button, select, label)')].filter(seen)) {
    if (!e.closest('[role=tabpanel]') && e.getBoundingClientRect().bottom > e.closest('.card').getBoundingClientRect().bottom) faults.push(`${name(e)} hangs out of its card`)
  }
  for (const e of [...document.querySelectorAll('input[type=number]')].filter(seen)) {
    if (e.scrollWidth > e.clientWidth + 1) faults.push(`${name(e)} cuts ${e.value}`)
  }
  // A choice is as wide as its words.
  for (const select of [...document.querySelectorAll('select')].filter(seen)) {
    const free = select.cloneNode(true)
    free.removeAttribute('id')
    free.style.cssText = 'position: absolute; width: auto; max-width: none'
    select.after(free)
    if (free.offsetWidth > select.offsetWidth + 1) faults.push(`${name(select)} is ${select.offsetWidth} wide for ${free.offsetWidth}`)
    free.remove()
  }
  apart([...document.querySelectorAll('button, select, input, .time, label')].filter(e => seen(e) && !e.closest('label *') && !e.querySelector('input')))
  for (const axis of document.querySelectorAll('.axis, .ticks')) apart([...axis.children].filter(seen))
  return faults
}

for (const [width, height, address] of [
  [1280, 800, 'index.html'],
  [1440, 900, 'index.html'],
  [1024, 700, 'index.html'],
  [390, 844, 'index.html'],
  [360, 640, 'index.html'],
  [768, 480, 'embed.html'],
  [390, 700, 'embed.html'],
]) {
  test(`boxes fit: ${address} at ${width} × ${height}`, async ({ open }) => {
    const page = await open(address, { viewport: { width, height } })
    await ready(page)
    for (const lanes of [1, 3]) {
      if (lanes > 1) await page.evaluate(() => window.ringroad.preset('three-lanes'))
      await playTo(page, 30)
      equal((await page.evaluate(boxes)).join('\n        '), '', `boxes with ${lanes} lanes`)
    }
    if (width === 1280 || width === 768) {
      const tall = await page.evaluate(() => document.documentElement.scrollHeight)
      holds(tall <= height, `the page is ${tall} px tall: something main lies below the fold`)
    }
    if (width === 1280) {
      // With the note of every experiment.
      for (const preset of await page.evaluate(() => window.ringroad.start.presets.map(p => p.name))) {
        await page.selectOption('#presets', preset)
        await page.waitForFunction(p => document.querySelector('#presets').value === p && !document.querySelector('#preset').hidden, preset)
        await page.waitForTimeout(50)
        const tall = await page.evaluate(() => document.documentElement.scrollHeight)
        holds(tall <= height, `the page is ${tall} px tall with the note of ${preset}`)
      }
    }
    if (address === 'index.html') {
      await page.click('#more-controls')
      for (const tab of await page.locator('[role=tab]').all()) {
        await tab.click()
        equal((await page.evaluate(boxes)).join('\n        '), '', `boxes with ${await tab.textContent()}`)
      }
    }
  })
}

for (const [width, height] of [
  [1280, 800],
  [1024, 700],
  [390, 844],
]) {
  test(`messages and choices do not move the layout: ${width} × ${height}`, async ({ open }) => {
    const heights = new Set()
    // Growth up to a crash; decay up to the end of the run; a summary whose lane changes; heterogeneous drivers.
    for (const link of ['reaction-time=0.75&action=at%3D0%3A1%3Anudge%3D1', 'reaction-time=0.6&until=100&action=at%3D0%3A1%3Anudge%3D1', 'lanes=3&vehicles=60&reaction-time=0.3&start=one-lane', 'reaction-time=0.6&driver=10%25:sensitivity=2']) {
      const page = await open(`index.html#${link}`, { viewport: { width, height }, reducedMotion: 'reduce' })
      await ready(page)
      for (let t = 0; t <= 300; t += 10) {
        await page.evaluate(t => window.ringroad.seek(t), t)
        heights.add(await page.evaluate(() => document.querySelector('#summary').offsetHeight))
      }
      const widths = new Set()
      for (const tab of await page.locator('[role=tab]').all()) {
        await tab.click()
        widths.add(await page.evaluate(() => ['speeds', 'more', 'map'].map(id => document.getElementById(id).offsetWidth).join()))
      }
      equal(widths.size, 1, `widths of the columns ${[...widths].join('; ')}`)
    }
    equal(heights.size, 1, `heights of the stability summary ${[...heights]}`)
  })
}

test('on the ring the name of the watched car and the direction of travel do not cover each other', async ({ open }) => {
  const page = await open('about:blank', { reducedMotion: 'reduce' })
  await page.addInitScript(() => {
    window.written = {}
    const write = CanvasRenderingContext2D.prototype.fillText
    CanvasRenderingContext2D.prototype.fillText = function (words, x, y) {
      if (this.canvas.id === 'ring-canvas') window.written[words] = { x, y, half: this.measureText(words).width / 2 }
      return write.call(this, words, x, y)
    }
  })
  const address = await open('course.html')
  await page.goto(address.url().replace('course.html', 'index.html'))
  await ready(page)
  for (const car of [0, 1, 2, 3, 47, 48, 49, 25]) {
    const { name, travel } = await page.evaluate(car => {
      window.written = {}
      window.ringroad.watch(car)
      return { name: window.written[`car ${car + 1}`], travel: window.written['travel →'] }
    }, car)
    holds(name && travel, `car ${car + 1}: a label is missing`)
    holds(Math.abs(name.x - travel.x) >= name.half + travel.half || Math.abs(name.y - travel.y) >= 14, `car ${car + 1}: ${JSON.stringify({ name, travel })}`)
  }
})
