// No function of the page is long: what it does fits on two screens.
import { readFileSync } from 'node:fs'
import { parseSync } from 'vite'
import { expect, test } from 'vitest'
import { sources } from './sources'

/** Lines of the longest function that is allowed. */
const MOST = 120

interface Node {
  readonly type: string
  readonly start: number
  readonly end: number
}

/** Calls `visit` for a node and all nodes in it. */
function walk(node: unknown, visit: (node: Node) => void): void {
  if (Array.isArray(node)) node.forEach(child => walk(child, visit))
  else if (node && typeof node === 'object') {
    if ('type' in node) visit(node as Node)
    Object.values(node).forEach(child => walk(child, visit))
  }
}

/** The functions of a source file: where each begins, and how many lines it has. */
function functions(name: string, source: string): { place: string; lines: number }[] {
  const { program, errors } = parseSync(name, source)
  expect(errors, name).toEqual([])
  const found: { place: string; lines: number }[] = []
  const line = (offset: number) => source.slice(0, offset).split('\n').length
  walk(program, ({ type, start, end }) => {
    if (!['FunctionDeclaration', 'FunctionExpression', 'ArrowFunctionExpression'].includes(type)) return
    found.push({ place: `${name}:${line(start)}`, lines: line(end) - line(start) + 1 })
  })
  return found
}

test('the length of every kind of function is measured', () => {
  const source = 'function a() {\n}\nconst b = () => {\n\n}\nclass C {\n  d() {\n\n\n  }\n}\n'
  expect(functions('x.ts', source).map(f => f.lines)).toEqual([2, 3, 4])
})

test(`no function is longer than ${MOST} lines`, () => {
  const all = sources().flatMap(name => functions(name, readFileSync(name, 'utf8')))
  expect(all.length).toBeGreaterThan(300)
  expect(all.filter(f => f.lines > MOST)).toEqual([])
})
