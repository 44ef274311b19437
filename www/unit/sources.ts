// The TypeScript files of the page, for tests that read them.
import { readdirSync } from 'node:fs'
import { fileURLToPath } from 'node:url'

const SRC = fileURLToPath(new URL('../src/', import.meta.url))

/** Their paths, absolute. */
export const sources = (): string[] =>
  readdirSync(SRC, { recursive: true, encoding: 'utf8' })
    .filter(name => name.endsWith('.ts'))
    .sort()
    .map(name => SRC + name)

/** A path as seen from src/. */
export const within = (path: string): string => path.slice(SRC.length)
