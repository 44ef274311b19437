// Where the page runs: sites, frames, files and security policies; and what it says where it cannot run.
import { readFileSync } from 'node:fs'
import { dist, equal, holds, positions, ready, root, test } from './helpers.mjs'

/** The ring moves: positions are read twice. */
async function moves(at, core) {
  await ready(at)
  const before = await positions(at)
  await at.waitForFunction(x => window.ringroad.frame.positions[0] !== x, before[0], { timeout: 5000 })
  const after = await positions(at)
  holds(after.length === 50 && after.every((x, j) => x !== before[j]), 'some vehicles stand')
  equal(await at.evaluate(() => document.querySelector('#app').dataset.core), core, 'where the core runs')
}

const PLACES = {
  'the site over http': ['index.html', 'worker'],
  'the embedded view over http': ['embed.html', 'worker'],
  'the site in a subfolder': ['policy-site-worker/index.html', 'worker'],
  'the site under a policy without blob workers': ['policy-site/index.html', 'worker'],
  'the site under a policy without workers': ['policy-site-no-worker/index.html', 'page'],
  'one file over http': ['ringroad.html', 'worker'],
  'one file from disk': [`file://${dist}/ringroad.html`, 'worker'],
  'one file under a policy with blob workers': ['policy-worker/ringroad.html', 'worker'],
  'one file under a policy without blob workers': ['policy-no-worker/ringroad.html', 'page'],
}
for (const [name, [address, core]] of Object.entries(PLACES)) {
  test(`moves: ${name}`, async ({ open }) => {
    const page = await open(address)
    await moves(page, core)
    equal(page.problems.join(), '', 'errors on the page')
  })
}

const frameOf = async (page, html) => {
  await page.setContent(html)
  const handle = await page.waitForSelector('iframe')
  return handle.contentFrame()
}

test('moves: one file in a script-only sandbox', async ({ open, address }) => {
  const page = await open(`${address}/course.html`)
  await moves(await frameOf(page, `<iframe sandbox="allow-scripts" width=1000 height=700 src="${address}/ringroad.html"></iframe>`), 'worker')
})

test('moves: one file as srcdoc in a script-only sandbox', async ({ open }) => {
  const page = await open('about:blank')
  const whole = readFileSync(`${dist}/ringroad.html`, 'utf8').replaceAll('&', '&amp;').replaceAll('"', '&quot;')
  await moves(await frameOf(page, `<iframe sandbox="allow-scripts" width=1000 height=700 srcdoc="${whole}"></iframe>`), 'worker')
})

test('moves: both frames of the course page, each with its own link', async ({ open }) => {
  const page = await open('course.html')
  const states = []
  for (const handle of await page.$$('iframe')) {
    await handle.scrollIntoViewIfNeeded()
    const frame = await handle.contentFrame()
    await moves(frame, 'worker')
    states.push(await frame.evaluate(() => document.querySelector('#summary').dataset.state))
  }
  equal(states.join(), 'stable,unstable', 'stability of the two frames')
})

test('the frame that is shared is as high as README’s', async ({ open }) => {
  const page = await open('index.html')
  await ready(page)
  await page.click('#open-share')
  const height = text => /<iframe[^>]* height="(\d+)"/.exec(text)?.[1]
  const own = height(readFileSync(`${root}README.md`, 'utf8'))
  holds(own, 'no frame in README')
  equal(height(await page.inputValue('#share-embed')), own, 'height')
})

test('what is shared from disk names no place on that disk in a course page', async ({ open }) => {
  const page = await open(`file://${dist}/ringroad.html#vehicles=40`)
  await ready(page)
  await page.click('#open-share')
  holds((await page.inputValue('#share-embed')).startsWith('<iframe src="ringroad.html#view=embed&amp;vehicles=40"'), await page.inputValue('#share-embed'))
  holds(await page.isVisible('#share-disk'), 'not a word about a web server')
  const site = await open('index.html#vehicles=40')
  await ready(site)
  await site.click('#open-share')
  holds((await site.inputValue('#share-embed')).startsWith(`<iframe src="${new URL('embed.html', site.url())}#vehicles=40"`), await site.inputValue('#share-embed'))
  holds(!(await site.isVisible('#share-disk')), 'a word about disks on a site')
})

test('the laboratory loads nothing of the figures, and says when they cannot be loaded', async ({ open, address }) => {
  const page = await open('about:blank')
  const asked = []
  page.on('request', request => asked.push(new URL(request.url()).pathname))
  const script = /^\/assets\/figures.*\.js$/
  let refuse = true
  await page.route(url => script.test(url.pathname), route => (refuse ? route.abort() : route.continue()))
  await page.goto(`${address}/index.html`)
  await ready(page)
  equal(asked.filter(path => script.test(path)).join(), '', 'loaded with the laboratory')
  await page.click('#open-figures')
  await page.waitForSelector('#figures [role=alert]')
  await page.click('#open-figures')
  await page.waitForSelector('#ring', { state: 'visible' })
  refuse = false
  await page.goto(`${address}/figures.html`)
  await page.waitForSelector('#figures .figure .run')
  holds(asked.some(path => script.test(path)), 'the figures came from elsewhere')
  equal(page.problems.join(), '', 'errors on the page')
})

test('a dialog is loaded when it is first opened, and the page says when it cannot be', async ({ open, address }) => {
  const page = await open('about:blank', { reducedMotion: 'reduce' })
  const asked = []
  page.on('request', request => asked.push(new URL(request.url()).pathname))
  const script = /^\/assets\/dialogs.*\.js$/
  await page.goto(`${address}/index.html`)
  await ready(page)
  equal(asked.filter(path => script.test(path)).join(), '', 'loaded with the laboratory')
  await page.click('#open-help')
  await page.waitForSelector('#help[open]')
  equal(asked.filter(path => script.test(path)).length, 1, 'scripts of the dialogs')
  const cut = await open('about:blank', { reducedMotion: 'reduce' })
  await cut.route(url => script.test(url.pathname), route => route.abort())
  await cut.goto(`${address}/index.html`)
  await ready(cut)
  await cut.click('#open-share')
  await cut.waitForSelector('#trouble:not([hidden])')
})

test('says why: the site under a policy without WebAssembly', async ({ open }) => {
  const page = await open('policy-no-wasm/index.html')
  await page.waitForSelector('[role=alert] a[href^="ringroad.html"]')
  const text = await page.textContent('#app')
  holds(text.includes('cannot start here') && text.includes('wasm-unsafe-eval'), text)
})

test('says why: the site from disk', async ({ open }) => {
  const page = await open(`file://${dist}/index.html`)
  await page.waitForTimeout(500)
  const text = await page.textContent('#app')
  holds(text.includes('WebAssembly') && text.includes('ringroad.html'), text)
})

test('says why: the site in a script-only sandbox', async ({ open, address }) => {
  const page = await open(`${address}/course.html`)
  const frame = await frameOf(page, `<iframe sandbox="allow-scripts" src="${address}/index.html"></iframe>`)
  await frame.waitForSelector('.boot')
  await page.waitForTimeout(500)
  holds((await frame.textContent('#app')).includes('ringroad.html'), 'no pointer to the one file')
})
