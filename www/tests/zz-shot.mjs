import { chromium } from 'playwright-core'
import { serve } from './serve.mjs'
import { dist, ready, playTo } from './harness.mjs'
const server = await serve(dist, {})
const browser = await chromium.launch({ executablePath: '/usr/bin/chromium', args: ['--no-sandbox'] })
for (const [name, viewport, scheme, hash] of [
  ['wide', { width: 1280, height: 800 }, 'light', 'reaction-time=0.75&action=at%3D0%3A1%3Anudge%3D1'],
  ['dark', { width: 1280, height: 800 }, 'dark', 'reaction-time=0.6&action=at%3D0%3A1%3Anudge%3D1'],
  ['phone', { width: 390, height: 844 }, 'light', 'reaction-time=0.75&action=at%3D0%3A1%3Anudge%3D1'],
]) {
  const context = await browser.newContext({ viewport, colorScheme: scheme })
  const page = await context.newPage()
  page.on('pageerror', e => console.log('ERROR', e.message))
  page.on('console', m => m.type() === 'error' && console.log('CONSOLE', m.text()))
  await page.goto(`${server.address}/index.html#${hash}`)
  await ready(page)
  await playTo(page, 120)
  await page.waitForTimeout(900)
  console.log(name, await page.evaluate(() => [document.querySelector('#modes-status').textContent, document.querySelector('#modes canvas').ariaLabel, document.querySelector('#roots canvas').ariaLabel, document.querySelector('#plane canvas').ariaLabel, document.querySelector('#plane-point').getAttribute('aria-valuetext')]))
  await page.screenshot({ path: `/tmp/stab-${name}.png`, fullPage: name === 'phone' })
  await context.close()
}
await browser.close()
server.close()
