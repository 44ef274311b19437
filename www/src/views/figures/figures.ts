// The paper's figures: each with its button, its picture, the paper's claims and files to save. The core computes all of them.
import { Cancelled } from '../../core/client'
import { Pool } from '../../core/pool'
import { button, el } from '../../ui/dom'
import { wasmBytes } from '../../core/assets'
import { save } from '../../ui/download'
import { png } from '../../ui/png'
import type { Session } from '../../app/session'
import type { Claim, FigureInfo, FigureOutcome } from '../../core/protocol'
import { figuresText as t } from '../../text/figures'
import { readable } from '../../charts/readout'

/** One figure on the page. */
interface Entry {
  readonly info: FigureInfo
  readonly element: HTMLElement
  state: 'idle' | 'waiting' | 'running'
  outcome: FigureOutcome | null
  show(): void
  say(words: string, part?: number): void
}

export async function figuresView(session: Session): Promise<HTMLElement[]> {
  const infos = await session.client.ask('figures', { wasm: await wasmBytes('figures') })
  const pool = new Pool(session.client)
  const queue: Entry[] = []
  let current: Entry | null = null

  const all = button({ class: 'main', id: 'figures-all', onclick: () => entries.forEach(queueUp) }, t.all)
  const none = button({ id: 'figures-cancel', disabled: true, onclick: () => [...queue, current].forEach(e => e && cancel(e)) }, t.cancelAll)
  const summary = el('p', { role: 'status', id: 'figures-summary' })

  function queueUp(entry: Entry): void {
    if (entry.state !== 'idle') return
    entry.state = 'waiting'
    entry.say(current ? t.waiting : t.starting)
    queue.push(entry)
    entry.show()
    void runQueue()
  }

  function cancel(entry: Entry): void {
    if (entry.state === 'running') pool.cancel()
    else if (entry.state === 'waiting') {
      queue.splice(queue.indexOf(entry), 1)
      entry.state = 'idle'
      entry.say(t.cancelled)
      entry.show()
    }
  }

  async function runQueue(): Promise<void> {
    if (current) return
    for (let entry = queue.shift(); entry; entry = queue.shift()) {
      current = entry
      none.disabled = false
      entry.state = 'running'
      entry.say(t.starting, 0)
      entry.show()
      entry.say(await run(entry))
      entry.state = 'idle'
      entry.show()
      current = null
      const claims = entries.flatMap(e => e.outcome?.claims ?? [])
      summary.textContent = claims.length === 0 ? '' : tally(claims)
    }
    none.disabled = true
  }

  /** Runs a figure; how it ended, in words. */
  async function run(entry: Entry): Promise<string> {
    const { id: figure, tasks: count } = entry.info
    const before = performance.now()
    try {
      const { result, workers } = await pool.run<Float64Array, FigureOutcome>(
        count,
        (core, task) => core.ask('task', { figure, task }),
        (core, results) => core.ask('assemble', { figure, results }),
        done => entry.say(done < count ? t.running(done, count) : t.assembling, done / count),
      )
      entry.outcome = result
      return t.done((performance.now() - before) / 1000, workers)
    } catch (e) {
      return e instanceof Cancelled ? t.cancelled : t.failed(e instanceof Error ? e.message : String(e))
    }
  }

  const entries = infos.map(info => figureEntry(info, queueUp, cancel))
  return [
    el('div', { class: 'figures-head' }, el('h2', {}, t.title), el('p', {}, t.intro), el('div', { class: 'row' }, all, none), summary),
    ...entries.map(e => e.element),
  ]
}

function figureEntry(info: FigureInfo, queueUp: (entry: Entry) => void, cancel: (entry: Entry) => void): Entry {
  const run = button({ class: 'run', 'aria-label': t.runLabel(info.title), onclick: () => queueUp(entry) }, t.run)
  const stop = button({ class: 'stop', 'aria-label': t.cancelLabel(info.title), hidden: true, onclick: () => cancel(entry) }, t.cancel)
  const bar = el('progress', { max: 1, value: 0, hidden: true, 'aria-label': t.progress(info.title) })
  const status = el('span', { class: 'status', role: 'status' })
  const result = el('div', { class: 'result' })
  let shown: FigureOutcome | null = null
  const entry: Entry = {
    info,
    state: 'idle',
    outcome: null,
    element: el(
      'section',
      { class: 'card figure', id: `figure-${info.id}`, 'aria-labelledby': `figure-${info.id}-title` },
      el('header', {}, el('h3', { id: `figure-${info.id}-title` }, info.title), info.beyond ? el('span', { class: 'note' }, t.beyond) : null),
      el('p', { class: 'caption' }, info.caption),
      el('div', { class: 'row' }, run, stop, bar, status),
      result,
    ),
    say(words, part) {
      status.textContent = words
      if (part !== undefined) bar.value = part
    },
    show() {
      const idle = entry.state === 'idle'
      // When the focused button disappears, the focus goes to the one in its place.
      const focused = document.activeElement === run || document.activeElement === stop
      run.hidden = !idle
      stop.hidden = idle
      bar.hidden = entry.state !== 'running'
      if (focused) (idle ? run : stop).focus({ preventScroll: true })
      entry.element.dataset.state = entry.state
      if (entry.outcome && entry.outcome !== shown) {
        shown = entry.outcome
        run.replaceChildren(t.again)
        result.replaceChildren(...outcomeParts(info, entry.outcome))
        entry.element.dataset.done = ''
      }
    },
  }
  return entry
}

function tally(claims: readonly Claim[]): string {
  const count = (v: Claim['verdict']) => claims.filter(c => c.verdict === v).length
  return t.summary(count('agrees'), count('differs'), count('open'))
}

function outcomeParts(info: FigureInfo, outcome: FigureOutcome): HTMLElement[] {
  const parsed = new DOMParser().parseFromString(outcome.svg, 'image/svg+xml').documentElement
  const picture = document.importNode(parsed, true) as unknown as SVGSVGElement
  const file = (name: string, make: () => void) => button({ onclick: make }, name)
  const files = el(
    'div',
    { class: 'row files' },
    el('span', {}, t.save),
    file(`${info.id}.svg`, () => save(`${info.id}.svg`, 'image/svg+xml', outcome.svg)),
    file(`${info.id}.png`, async () => save(`${info.id}.png`, 'image/png', await png(outcome.svg))),
    ...outcome.tables.map(({ name, csv }) => file(`${name}.csv`, () => save(`${name}.csv`, 'text/csv', csv))),
  )
  return [
    ...readable(info.title, picture, outcome.fields),
    files,
    outcome.claims.length === 0 ? el('p', { class: 'note' }, t.noClaims) : claimsTable(info, outcome.claims),
  ]
}

function claimsTable(info: FigureInfo, claims: readonly Claim[]): HTMLElement {
  const c = t.columns
  const head = [c.claim, c.paper, c.ours, c.verdict, c.method].map(name => el('th', { scope: 'col' }, name))
  const row = (claim: Claim) =>
    el(
      'tr',
      { 'data-verdict': claim.verdict },
      el('th', { scope: 'row' }, claim.claim),
      el('td', { 'data-name': c.paper }, claim.paper),
      el('td', { 'data-name': c.ours }, claim.ours),
      el('td', { class: 'verdict', 'data-name': c.verdict }, el('span', { 'aria-hidden': 'true' }, t.symbols[claim.verdict]), ` ${t.verdicts[claim.verdict]}`),
      el('td', { class: 'method', 'data-name': c.method }, claim.method),
    )
  return el(
    'table',
    { class: 'claims' },
    el('caption', {}, el('span', { class: 'hidden' }, `${info.title}: `), tally(claims)),
    el('thead', {}, el('tr', {}, ...head)),
    el('tbody', {}, ...claims.map(row)),
  )
}
