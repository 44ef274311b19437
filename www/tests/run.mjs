// Runs the browser tests: `npm run test:browser [-- part of a name]`.
import { runAll } from './harness.mjs'

await import('./places.mjs')
await import('./traffic.mjs')
await import('./stability.mjs')
await import('./charts.mjs')
await import('./input.mjs')
await import('./manners.mjs')
await import('./figures.mjs')
await runAll(process.argv[2])
