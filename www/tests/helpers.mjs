// What the browser tests share: the built page in Chromium, served with different security policies, and the helpers of the tests.
// The tests run under node:test, one browser for each file.
import { spawnSync } from 'node:child_process'
import { createHash } from 'node:crypto'
import { after, before, test as nodeTest } from 'node:test'
import { fileURLToPath } from 'node:url'
import { chromium } from 'playwright-core'
import { serve } from './serve.mjs'

export const root = fileURLToPath(new URL('../../', import.meta.url))
export const dist = `${root}dist`
const command = process.env.RINGROAD ?? `${root}target/release/ringroad`

const INLINE = "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval'; style-src 'unsafe-inline'; img-src data:"
const SITE = "default-src 'self'; img-src 'self' data:"
const html = body => ({ 'content-security-policy': body })
const HEADERS = {
  'policy-worker': html(`${INLINE}; worker-src blob:`),
  'policy-no-worker': html(INLINE),
  'policy-site': html(`${SITE}; script-src 'self' 'wasm-unsafe-eval'`),
  'policy-site-worker': html(`${SITE}; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self' blob:`),
  'policy-site-no-worker': html(`${SITE}; script-src 'self' 'wasm-unsafe-eval'; worker-src 'none'`),
  'policy-no-wasm': html(SITE),
}

export const equal = (is, should, what) => {
  if (is !== should) throw new Error(`${what}: ${JSON.stringify(is)} instead of ${JSON.stringify(should)}`)
}
export const holds = (condition, what) => {
  if (!condition) throw new Error(what)
}
export const hash = text => createHash('sha256').update(text).digest('hex')

/** Runs the command; its standard output. */
export function ringroad(...args) {
  const run = spawnSync(command, args, { encoding: 'utf8', maxBuffer: 1 << 30 })
  if (run.status !== 0) throw new Error(`ringroad ${args.join(' ')}: ${run.stderr || run.error}`)
  return run.stdout
}

let server
let browser

before(async () => {
  server = await serve(dist, HEADERS)
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox'] })
})
after(async () => {
  await browser.close()
  server.close()
})

/**
 * A test in the browser. `run` gets the server's address; `open`, which opens a page below that address or anywhere else, each in
 * a fresh context that is closed after the test; and `note`, which adds a line to the test's report.
 */
export const test = (name, run) =>
  nodeTest(name, async t => {
    const contexts = []
    const open = async (address, options = {}) => {
      const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options })
      contexts.push(context)
      const page = await context.newPage()
      page.problems = []
      page.on('pageerror', e => page.problems.push(e.message))
      await page.goto(/^(file|http|about|data):/.test(address) ? address : `${server.address}/${address}`)
      return page
    }
    try {
      await run({ address: server.address, open, note: words => t.diagnostic(words) })
    } finally {
      for (const context of contexts) await context.close()
    }
  })

// --- what tests do with an open page; `at` is a page or a frame in one

/** Waits until the core runs. */
export const ready = at => at.waitForFunction(() => window.ringroad?.frame, null, { timeout: 15_000 })

/** Plays as fast as it goes until that time, then pauses. */
export async function playTo(at, time, playback = 100) {
  await at.evaluate(([x]) => {
    window.ringroad.playback.setFactor(x)
    window.ringroad.playback.play()
  }, [playback])
  await at.waitForFunction(t => window.ringroad.frame.time >= t || window.ringroad.frame.finished, time, { timeout: 60_000 })
  await at.evaluate(() => window.ringroad.playback.pause())
  await at.waitForTimeout(100)
}

export const positions = at => at.evaluate(() => Array.from(window.ringroad.frame.positions))
export const stability = at => at.evaluate(() => document.querySelector('#summary').dataset.state)
export const snapshot = at => at.evaluate(() => window.ringroad.snapshot)

/** The table of the run so far, as the page makes it. */
export const csv = (at, measurement) => at.evaluate(m => window.ringroad.client.ask('csv', { measurement: JSON.stringify(m) }), measurement)

/** Rows of a table without its header. */
export const rows = text => text.split('\n').filter(line => line !== '' && !line.startsWith('#'))
