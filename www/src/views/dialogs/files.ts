// The data dialog: saves the run so far as CSV and the scenario as JSON, and opens such files.
import type { Session } from '../../app/session'
import { Cancelled } from '../../core/client'
import { text } from '../../text'
import { dialogsText } from '../../text/dialogs'
import { fixed } from '../../text/format'
import { dialog } from '../../ui/dialog'
import { button, el } from '../../ui/dom'
import { save } from '../../ui/download'
import { numberField } from '../../ui/number_field'

const t = dialogsText.files
const TABLES = ['trajectories', 'speed-map', 'speeds', 'flow-map', 'flow', 'lanes', 'events', 'growth'] as const

/** Which table, and how often it has a row: the fields, and the measurement that they describe. */
function measurementFields(session: Session) {
  const table = el('select', { id: 'table' }, ...TABLES.map(name => el('option', { value: name }, t.tables[name] ?? name)))
  const { number: every, wrong, complain } = numberField({ id: 'every', value: 1, min: 0.001, max: 1e7, style: 'width:6rem' })
  const everyRow = el('div', {}, el('label', { for: 'every' }, t.every), el('div', { class: 'row' }, every, 's'), wrong)
  const hasRows = () => table.value !== 'events'
  every.addEventListener('input', () => complain(''))
  table.addEventListener('change', () => {
    everyRow.hidden = !hasRows()
  })
  return {
    elements: [el('label', { for: 'table' }, t.table), table, everyRow],
    file: () => `${table.value}.csv`,
    /** As JSON for the core; null where the number is not allowed, which the field then says. */
    measurement(): string | null {
      const plain: Record<string, unknown> = { table: table.value }
      if (hasRows()) {
        const { valueAsNumber: value, min, max } = every
        if (!(value >= Number(min) && value <= Number(max))) {
          complain(text.controls.allowed(t.every, false, Number(min), Number(max), 's'))
          every.focus()
          return null
        }
        plain.every = value
      }
      if (table.value === 'speeds') plain.vehicles = session.snapshot.watched
      if (table.value === 'speed-map') plain.lane = session.view.lane + 1
      return JSON.stringify(plain)
    },
  }
}

/** The part that saves the run as CSV or shows it as text. */
function exportPart(session: Session): Node[] {
  const fields = measurementFields(session)
  const bar = el('progress', { max: 1, value: 0, hidden: true, 'aria-label': t.export })
  const status = el('p', { role: 'status', id: 'export-status' })
  const shown = el('textarea', { rows: 8, readonly: true, hidden: true, 'aria-label': t.show, id: 'export-text' })
  const cancel = button({ hidden: true, onclick: () => void session.client.ask('cancel', {}) }, t.cancel)
  const csv = async (use: (content: string) => void) => {
    const measurement = fields.measurement()
    if (measurement === null) return
    bar.hidden = cancel.hidden = false
    session.playback.pause()
    try {
      const content = await session.client.ask('csv', { measurement }, part => {
        bar.value = part
        status.textContent = t.running(part)
      })
      use(content)
      status.textContent = t.made(fields.file(), fixed(content.length / 1000, 1))
    } catch (e) {
      status.textContent = e instanceof Cancelled ? t.cancelled : e instanceof Error ? e.message : String(e)
    } finally {
      bar.hidden = cancel.hidden = true
    }
  }
  const show = (content: string) => {
    shown.hidden = false
    shown.value = content
    shown.select()
  }
  const saveCsv = button({ class: 'main', id: 'save-csv', onclick: () => void csv(content => save(fields.file(), 'text/csv', content)) }, t.save)
  const showCsv = button({ id: 'show-csv', onclick: () => void csv(show) }, t.show)
  return [el('h3', {}, t.export), ...fields.elements, el('div', { class: 'buttons' }, saveCsv, showCsv, cancel), bar, status, shown, el('p', {}, t.note)]
}

/** The part that opens a file. */
function openPart(session: Session): Node[] {
  const file = el('input', { type: 'file', id: 'file', accept: '.json,.csv,application/json,text/csv' })
  const opened = el('p', { role: 'status', id: 'file-status' })
  file.addEventListener('change', async () => {
    const chosen = file.files?.[0]
    if (!chosen) return
    session.playback.pause()
    let refusal = ''
    // The dialog covers the page: what is wrong with a file is shown here.
    const before = session.onProblem
    session.onProblem = messages => {
      refusal = messages.join(' ')
    }
    const done = await session.open('file', await chosen.text())
    session.onProblem = before
    opened.textContent = [done ? t.opened(chosen.name) : `${chosen.name}: `, refusal].join(done ? ' ' : '').trim()
    opened.style.color = done ? '' : 'var(--bad)'
    file.value = ''
  })
  return [el('label', { for: 'file' }, t.open), file, opened]
}

export function filesDialog(session: Session): HTMLDialogElement {
  const saveScenario = button(
    { onclick: () => save('scenario.json', 'application/json', `${JSON.stringify(session.snapshot.scenario, null, 2)}\n`) },
    t.scenario,
  )
  return dialog('files', t.title, ...exportPart(session), el('div', { class: 'buttons' }, saveScenario), ...openPart(session))
}
