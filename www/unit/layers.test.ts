// The layers of the page. A file imports from its own folder and from folders below, never from above nor from another folder of
// the same line, and no files import each other in a circle.
//
//   main.ts, page.ts   decides between page and worker | opens the core and puts the views together
//   views/             one file or folder a view: what is seen, and what a person can do there
//   app/, charts/      the session (what is open, playback, series, commands, address) | drawings with axes, colour bars, read-outs
//   ui/                elements, dialogs, tabs, number fields, files: parts that know no traffic
//   text/              the texts of one language, and how numbers are written
//   core/              the client of the core, its worker, and the types of what they send each other
//
// The modules pkg/ and pkg-figures/ are generated from Rust; core/ alone imports them. Views do not import each other, except
// within a folder of views; figures_link.ts loads views/figures/.
import { existsSync, readFileSync } from 'node:fs'
import { dirname, resolve } from 'node:path'
import { expect, test } from 'vitest'
import { parseSync } from 'vite'
import { sources, within } from './sources'

/** From the top; what stands in one line may not import each other. */
const LAYERS = [['main.ts', 'page.ts'], ['views'], ['app', 'charts'], ['ui'], ['text'], ['core'], ['../pkg', '../pkg-figures']]
/** The two files of the first line: the script of page and worker starts the page. */
const ALLOWED = [['main.ts', 'page.ts']]

/** Every module that a source names: imports of values and types, exports from elsewhere, and `import()`. */
function imports(name: string, source: string): string[] {
  const { module } = parseSync(name, source)
  const statics = module.staticImports.map(found => found.moduleRequest.value)
  const exported = module.staticExports.flatMap(found => found.entries.flatMap(entry => entry.moduleRequest?.value ?? []))
  const dynamic = module.dynamicImports.map(({ moduleRequest: { start, end } }) => source.slice(start, end).replace(/^['"`]|['"`]$/g, ''))
  return [...statics, ...exported, ...dynamic]
}

/** The file that an import means, as seen from src/. */
function target(from: string, name: string): string {
  const path = resolve(dirname(from), name.replace(/\?.*$/, ''))
  const file = [path, `${path}.ts`, `${path}/index.ts`].find(candidate => /\.\w+$/.test(candidate) && existsSync(candidate))
  return file ? relative(file) : relative(path)
}
const SRC = resolve(__dirname, '../src')
const relative = (path: string): string => (path.startsWith(SRC) ? within(path) : `../${path.slice(dirname(SRC).length + 1)}`)

/** The number of the layer that a file belongs to; −1 for none. */
const layer = (file: string): number => LAYERS.findIndex(line => line.some(part => file === part || file.startsWith(`${part}/`)))
/** The part of the layer's line. */
const part = (file: string): string => LAYERS[layer(file)]!.find(p => file === p || file.startsWith(`${p}/`))!

/** Why a file may not import another; null if it may. */
function fault(from: string, to: string): string | null {
  const arrow = `${from} → ${to}`
  if (layer(to) < 0) return `${arrow}: belongs to no layer`
  if (layer(to) < layer(from)) return `${arrow}: goes up`
  const sideways = layer(to) === layer(from) && part(to) !== part(from)
  return sideways && !ALLOWED.some(([a, b]) => a === from && b === to) ? `${arrow}: goes sideways` : null
}

/** A circle of imports; null if there is none. */
function circle(graph: ReadonlyMap<string, readonly string[]>): string[] | null {
  const done = new Set<string>()
  const visit = (file: string, path: readonly string[]): string[] | null => {
    if (path.includes(file)) return [...path.slice(path.indexOf(file)), file]
    if (done.has(file)) return null
    for (const next of graph.get(file) ?? []) {
      const found = visit(next, [...path, file])
      if (found) return found
    }
    done.add(file)
    return null
  }
  for (const file of graph.keys()) {
    const found = visit(file, [])
    if (found) return found
  }
  return null
}

const graph = new Map(
  sources().map(path => [
    within(path),
    imports(path, readFileSync(path, 'utf8'))
      .filter(name => name.startsWith('.'))
      .map(name => target(path, name)),
  ]),
)

test('every kind of import is read, and faults are found', () => {
  const source = "import { a } from './a'\nimport type { B } from './b'\nimport './c.css'\nexport { d } from './d'\nconst e = () => import('./e')\nimport f from './f?url'\n"
  expect(imports('x.ts', source).sort()).toEqual(['./a', './b', './c.css', './d', './e', './f?url'])
  expect(fault('ui/dom.ts', 'views/map.ts')).toContain('goes up')
  expect(fault('charts/axes.ts', 'app/session.ts')).toContain('goes sideways')
  expect(fault('views/map.ts', 'ui/dom.ts')).toBeNull()
  expect(fault('views/map.ts', 'elsewhere.ts')).toContain('no layer')
  expect(circle(new Map([['a', ['b']], ['b', ['c']], ['c', ['a']]]))).toEqual(['a', 'b', 'c', 'a'])
})

test('no import goes up or sideways', () => {
  expect([...graph].flatMap(([from, all]) => [fault(from, from), ...all.map(to => fault(from, to))]).filter(found => found !== null)).toEqual([])
  expect([...graph.values()].flat().length).toBeGreaterThan(150)
})

test('no files import each other in a circle', () => expect(circle(graph)).toBeNull())

test('only core/ imports the modules generated from Rust', () => {
  const others = [...graph].filter(([from, all]) => !from.startsWith('core/') && all.some(to => to.startsWith('../pkg')))
  expect(others.map(([from]) => from)).toEqual([])
})
