import { chromium } from 'playwright-core'
import { serve } from './serve.mjs'
import { fileURLToPath } from 'node:url'
const dist = fileURLToPath(new URL('../../dist', import.meta.url))
const server = await serve(dist, {})
const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox'] })
const cases = JSON.parse(process.argv[2])
for (const { name, hash, w = 1280, h = 800, dark = false, run = 0, pick = {}, only = false } of cases) {
  const context = await browser.newContext({ viewport: { width: w, height: h }, colorScheme: dark ? 'dark' : 'light', reducedMotion: 'reduce' })
  const page = await context.newPage()
  page.on('pageerror', e => console.log(name, 'error', e.message))
  await page.goto(`${server.address}/index.html#${hash}`)
  await page.waitForFunction(() => window.ringroad?.frame)
  if (run) {
    await page.evaluate(() => { window.ringroad.setPlayback(100); window.ringroad.play() })
    await page.waitForFunction(t => window.ringroad.frame.time >= t || window.ringroad.frame.finished, run)
    await page.evaluate(() => window.ringroad.pause())
  }
  for (const [s, v] of Object.entries(pick)) v === true ? await page.check(s) : await page.selectOption(s, v)
  await page.waitForTimeout(pick['#plane-ground'] ? 3500 : 900)
  await (only ? page.locator('#panel-stability') : page).screenshot({ path: `/tmp/theory/${name}.png`, ...(w < 600 && !only ? { fullPage: true } : {}) })
  await context.close()
}
await browser.close()
server.close()
