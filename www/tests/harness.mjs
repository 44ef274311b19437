// What the browser tests share: the built page in Chromium, opened in every way that it promises.
import { spawnSync } from 'node:child_process'
import { createHash } from 'node:crypto'
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

const tests = []
export const test = (name, run) => tests.push({ name, run })

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

export async function runAll(pattern) {
  const server = await serve(dist, HEADERS)
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox'] })
  let passed = 0
  let failed = 0
  for (const { name, run } of tests.filter(t => t.name.includes(pattern ?? ''))) {
    const opened = []
    const context = {
      address: server.address,
      browser,
      /** A page at an address below the server, or anywhere else. */
      async open(address, options = {}) {
        const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options })
        opened.push(context)
        const page = await context.newPage()
        page.problems = []
        page.on('pageerror', e => page.problems.push(e.message))
        await page.goto(/^(file|http|about|data):/.test(address) ? address : `${server.address}/${address}`)
        return page
      },
    }
    const before = Date.now()
    try {
      await run(context)
      passed++
      console.log(`ok      ${name} (${((Date.now() - before) / 1000).toFixed(1)} s)`)
    } catch (e) {
      failed++
      console.log(`FAILED  ${name}\n        ${String(e.stack ?? e).split('\n').slice(0, 4).join('\n        ')}`)
    }
    for (const context of opened) await context.close()
  }
  await browser.close()
  server.close()
  console.log(`\n${passed} passed, ${failed} failed`)
  process.exitCode = failed > 0 || passed === 0 ? 1 : 0
}

// --- what tests do with an open page; `at` is a page or a frame in one

/** Waits until the core runs. */
export const ready = at => at.waitForFunction(() => window.ringroad?.frame, null, { timeout: 15_000 })

/** Plays as fast as it goes until that time, then pauses. */
export async function playTo(at, time, playback = 100) {
  await at.evaluate(([x]) => {
    window.ringroad.setPlayback(x)
    window.ringroad.play()
  }, [playback])
  await at.waitForFunction(t => window.ringroad.frame.time >= t || window.ringroad.frame.finished, time, { timeout: 60_000 })
  await at.evaluate(() => window.ringroad.pause())
  await at.waitForTimeout(100)
}

export const positions = at => at.evaluate(() => Array.from(window.ringroad.frame.positions))
export const verdict = at => at.evaluate(() => document.querySelector('#verdict').dataset.state)
export const snapshot = at => at.evaluate(() => window.ringroad.snapshot)

/** The table of the run so far, as the page makes it. */
export const csv = (at, measurement) => at.evaluate(m => window.ringroad.client.ask('csv', { measurement: JSON.stringify(m) }), measurement)

/** Rows of a table without its header. */
export const rows = text => text.split('\n').filter(line => line !== '' && !line.startsWith('#'))
