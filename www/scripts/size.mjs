// What the page weighs on its way: page, script, style and WebAssembly, gzipped.
import { readFileSync, readdirSync } from 'node:fs'
import { fileURLToPath } from 'node:url'
import { gzipSync } from 'node:zlib'

// What it is meant to weigh, and what it may weigh at most until it does.
const GOAL = 200
const MOST = 350
const dist = fileURLToPath(new URL('../../dist/', import.meta.url))
const page = readFileSync(`${dist}index.html`, 'utf8')
const assets = readdirSync(`${dist}assets`)
// Script and style that the page names, and the WebAssembly that the script loads.
const files = ['index.html', ...assets.filter(name => page.includes(name) || name.endsWith('.wasm')).map(name => `assets/${name}`)]
let total = 0
for (const file of files) {
  const size = gzipSync(readFileSync(dist + file), { level: 9 }).length / 1000
  total += size
  console.log(`${size.toFixed(1).padStart(8)} kB  ${file}`)
}
console.log(`${total.toFixed(1).padStart(8)} kB  together, gzipped; the goal is ${GOAL} kB, more than ${MOST} kB fails`)
if (files.length < 4 || total > MOST) process.exitCode = 1
