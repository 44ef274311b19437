// Times the core as the page uses it, in Node and in Chromium: `npm run bench [-- part of a name]`. The cases are those of `cargo bench`,
// whose figures of the last time are shown beside them.
import { existsSync, readFileSync } from 'node:fs'
import { cpus } from 'node:os'
import { fileURLToPath } from 'node:url'
import { chromium } from 'playwright-core'
import { serve } from '../tests/serve.mjs'
import * as measure from './measure.mjs'

const at = path => fileURLToPath(new URL(path, import.meta.url))
const cases = JSON.parse(readFileSync(at('../../benches/cases.json'), 'utf8'))
const pattern = process.argv[2] ?? ''
const RUNS = 1000
const STEPS = 200

/** Fastest sample of a native case, ns per vehicle-update. */
function native(name, vehicles) {
  const file = at(`../../target/criterion/step/${name}/${vehicles}/new/sample.json`)
  if (!existsSync(file)) return undefined
  const { iters, times } = JSON.parse(readFileSync(file, 'utf8'))
  return Math.min(...times.map((t, i) => t / iters[i]))
}

const number = (x, digits = 2) => (x === undefined ? '–' : x.toFixed(digits))
const print = cells => console.log(cells.map((c, i) => (i === 0 ? c.padEnd(32) : c.padStart(11))).join(''))

function row(label, { wasm, javascript }, here) {
  print([label, number(wasm), number(javascript), number(javascript && javascript / wasm, 1), number(here), number(here && wasm / here, 1)])
}

async function theory(diagram) {
  const label = 'stability diagram'
  if (!label.includes(pattern)) return
  const { map, curves } = await diagram()
  console.log(`${label}, N = 2 … 133: map of growth rates ${number(map.total, 0)} ms, longest slice ${number(map.longest, 1)} ms; every curve ${number(curves, 1)} ms`)
}

async function table(title, step, batch, diagram) {
  console.log(`\n${title}; ns per vehicle-update`)
  print(['', 'wasm', 'JavaScript', 'ratio', 'native', 'ratio'])
  for (const one of cases) {
    const { vehicles } = one.scenario
    const label = `${one.name}, N = ${vehicles}`
    if (label.includes(pattern)) row(label, await step(one), native(`${one.name}, 128 bits`, vehicles))
  }
  const label = `${RUNS} runs of N = 50`
  if (label.includes(pattern)) row(label, await batch(cases[0], RUNS, STEPS))
  await theory(diagram)
}

const processors = cpus()
console.log(`${processors[0].model}, ${processors.length} cores, ${new Date().toISOString().slice(0, 10)}`)
console.log('JavaScript: one lane of equal drivers in plain JavaScript. Native: vectors of 128 bits, from the last `cargo bench`.')

measure.load(readFileSync(at('../pkg/ringroad_bg.wasm')))
await table(`Node ${process.versions.node}`, measure.step, measure.batch, measure.diagram)

const server = await serve(at('..'))
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox'] })
try {
  const page = await browser.newPage()
  page.on('pageerror', e => console.error(e.message))
  await page.goto(`${server.address}/bench/index.html`)
  await page.waitForFunction(() => window.measure)
  await table(
    `Chromium ${browser.version()}`,
    one => page.evaluate(c => window.measure.step(c), one),
    (...all) => page.evaluate(([c, runs, steps]) => window.measure.batch(c, runs, steps), all),
    () => page.evaluate(() => window.measure.diagram()),
  )
} finally {
  await browser.close()
  server.close()
}
