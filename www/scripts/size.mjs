// The size of the laboratory's first load, gzipped: every file that a browser fetches to open it. The files that the paper's figures
// add are fetched when the figures are opened; they are listed, too.
import { readFileSync } from 'node:fs'
import { fileURLToPath } from 'node:url'
import { gzipSync } from 'node:zlib'
import { chromium } from 'playwright-core'
import { serve } from '../tests/serve.mjs'

/** The largest size that is allowed, kB. */
const MOST = 200
const dist = fileURLToPath(new URL('../../dist/', import.meta.url))

/** The files of dist/ that are fetched until an element is there. */
async function fetched(browser, server, name, element) {
  const page = await browser.newPage()
  const files = new Set()
  page.on('request', request => {
    const { href } = new URL(request.url())
    if (href.startsWith(server.address)) files.add(href.slice(server.address.length + 1))
  })
  await page.goto(`${server.address}/${name}`)
  await page.waitForSelector(element)
  await page.waitForLoadState('networkidle')
  await page.close()
  return [...files]
}

function weigh(files) {
  let total = 0
  for (const file of files) {
    const size = gzipSync(readFileSync(dist + file), { level: 9 }).length / 1000
    total += size
    console.log(`${size.toFixed(1).padStart(8)} kB  ${file}`)
  }
  return total
}

const server = await serve(dist)
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox'] })
try {
  const laboratory = await fetched(browser, server, 'index.html', '#ring')
  const figures = await fetched(browser, server, 'figures.html', '#figures .figure')
  const total = weigh(laboratory)
  console.log(`${total.toFixed(1).padStart(8)} kB  the laboratory, gzipped; more than ${MOST} kB fails\n`)
  const more = weigh(figures.filter(file => !laboratory.includes(file)))
  console.log(`${more.toFixed(1).padStart(8)} kB  what the figures add`)
  const missing = ['.html', '.js', '.css', '.wasm'].filter(kind => !laboratory.some(file => file.endsWith(kind)))
  if (missing.length > 0) console.log(`not fetched: ${missing.join(', ')}`)
  if (missing.length > 0 || total > MOST) process.exitCode = 1
} finally {
  await browser.close()
  server.close()
}
