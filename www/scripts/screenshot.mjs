// Takes docs/lab.png for the README: the built page, four minutes into a phantom jam.
import { mkdirSync } from 'node:fs'
import { fileURLToPath } from 'node:url'
import { chromium } from 'playwright-core'
import { serve } from '../tests/serve.mjs'

const root = fileURLToPath(new URL('../../', import.meta.url))
const server = await serve(`${root}dist`)
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox'] })
const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, colorScheme: 'light', reducedMotion: 'reduce' })
await page.goto(`${server.address}/index.html`)
await page.waitForFunction(() => window.ringroad?.frame)
await page.evaluate(() => window.ringroad.seek(250))
await page.waitForTimeout(1000)
mkdirSync(`${root}docs`, { recursive: true })
await page.screenshot({ path: `${root}docs/lab.png` })
await browser.close()
server.close()
console.log('docs/lab.png')
