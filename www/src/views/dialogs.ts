// Share, data, help.
import { Cancelled } from '../core/client'
import { el } from '../ui/dom'
import { fixed } from '../text/format'
import { save } from '../ui/download'
import type { Session } from '../app/session'
import { text } from '../text'
import { numberField } from '../ui/number_field'
import { BRAKE } from './ring'

function dialog(id: string, title: string, ...children: (Node | null)[]): HTMLDialogElement {
  const close = el('button', { type: 'button', 'aria-label': text.header.close, onclick: () => element.close() }, '✕')
  const element = el('dialog', { id, 'aria-labelledby': `${id}-title` }, el('header', {}, el('h2', { id: `${id}-title` }, title), close), ...children)
  element.addEventListener('click', event => {
    if (event.target === element) element.close()
  })
  return element
}

/** The clipboard is closed to sandboxed frames; copying what is selected still works on a click. */
async function copy(field: HTMLTextAreaElement, button: HTMLButtonElement): Promise<void> {
  field.select()
  let done = false
  try {
    await navigator.clipboard.writeText(field.value)
    done = true
  } catch {
    field.focus()
    field.select()
    done = document.execCommand('copy')
  }
  button.textContent = done ? text.share.copied : text.share.select
  setTimeout(() => {
    button.textContent = text.share.copy
  }, 2000)
}

export function shareDialog(session: Session, address: () => string): HTMLDialogElement {
  const t = text.share
  const part = (id: string, label: string, rows: number) => {
    const field = el('textarea', { id, rows, readonly: true, spellcheck: 'false', onfocus: () => field.select() })
    const button = el('button', { type: 'button', onclick: () => void copy(field, button) }, t.copy)
    return { field, nodes: [el('label', { for: id }, label), field, el('div', { class: 'buttons' }, button)] }
  }
  const link = part('share-link', t.link, 3)
  const embed = part('share-embed', t.embed, 4)
  const disk = el('p', { id: 'share-disk', hidden: true }, t.disk)
  const element = dialog('share', t.title, ...link.nodes, ...embed.nodes, disk, el('p', {}, t.shortcut))
  const fill = () => {
    const hash = session.snapshot.link
    const base = address()
    link.field.value = hash === '' ? base : `${base}#${hash}`
    const file = base.split('/').pop() ?? ''
    const one = file === 'ringroad.html'
    // An address on this disk means nothing in a course page.
    disk.hidden = !base.startsWith('file:')
    const folder = disk.hidden ? base.slice(0, base.length - file.length) : ''
    const frame = one ? `${folder}${file}#view=embed${hash === '' ? '' : `&${hash}`}` : `${folder}embed.html${hash === '' ? '' : `#${hash}`}`
    embed.field.value = `<iframe src="${frame.replaceAll('&', '&amp;')}" width="100%" height="520" style="border:0" allowfullscreen title="Ringroad"></iframe>`
  }
  element.addEventListener('toggle', fill)
  session.on('snapshot', fill)
  return element
}

/** Tables that are offered, with what each is measured with. */
const TABLES = ['trajectories', 'speed-map', 'speeds', 'flow-map', 'flow', 'lanes', 'events', 'growth'] as const

export function filesDialog(session: Session): HTMLDialogElement {
  const t = text.files
  const table = el('select', { id: 'table' }, ...TABLES.map(name => el('option', { value: name }, t.tables[name] ?? name)))
  const { number: every, wrong, complain } = numberField({ id: 'every', value: 1, min: 0.001, max: 1e7, style: 'width:6rem' })
  const bar = el('progress', { max: 1, value: 0, hidden: true, 'aria-label': t.export })
  const status = el('p', { role: 'status', id: 'export-status' })
  const shown = el('textarea', { rows: 8, readonly: true, hidden: true, 'aria-label': t.show, id: 'export-text' })
  const cancel = el('button', { type: 'button', hidden: true, onclick: () => void session.client.ask('cancel', {}) }, t.cancel)
  const measurement = () => {
    const plain: Record<string, unknown> = { table: table.value }
    if (table.value !== 'events') plain.every = every.valueAsNumber
    if (table.value === 'speeds') plain.vehicles = session.snapshot.watched
    if (table.value === 'speed-map') plain.lane = session.view.lane + 1
    return JSON.stringify(plain)
  }
  every.addEventListener('input', () => complain(''))
  const csv = async (use: (content: string) => void) => {
    if (table.value !== 'events' && !(every.valueAsNumber >= Number(every.min) && every.valueAsNumber <= Number(every.max))) {
      complain(text.controls.allowed(t.every, false, Number(every.min), Number(every.max), 's'))
      every.focus()
      return
    }
    bar.hidden = cancel.hidden = false
    session.pause()
    try {
      const content = await session.client.ask('csv', { measurement: measurement() }, part => {
        bar.value = part
        status.textContent = t.running(part)
      })
      use(content)
      status.textContent = t.made(`${table.value}.csv`, fixed(content.length / 1000, 1))
    } catch (e) {
      status.textContent = e instanceof Cancelled ? t.cancelled : e instanceof Error ? e.message : String(e)
    } finally {
      bar.hidden = cancel.hidden = true
    }
  }
  const saveCsv = el('button', { type: 'button', class: 'main', id: 'save-csv', onclick: () => void csv(content => save(`${table.value}.csv`, 'text/csv', content)) }, t.save)
  const showCsv = el(
    'button',
    {
      type: 'button',
      id: 'show-csv',
      onclick: () =>
        void csv(content => {
          shown.hidden = false
          shown.value = content
          shown.select()
        }),
    },
    t.show,
  )
  const saveScenario = el(
    'button',
    { type: 'button', onclick: () => save('scenario.json', 'application/json', `${JSON.stringify(session.snapshot.scenario, null, 2)}\n`) },
    t.scenario,
  )
  const file = el('input', { type: 'file', id: 'file', accept: '.json,.csv,application/json,text/csv' })
  const opened = el('p', { role: 'status', id: 'file-status' })
  file.addEventListener('change', async () => {
    const chosen = file.files?.[0]
    if (!chosen) return
    session.pause()
    let refusal = ''
    const before = session.onTrouble
    session.onTrouble = messages => {
      refusal = messages.join(' ')
    }
    const done = await session.open('file', await chosen.text())
    session.onTrouble = before
    opened.textContent = [done ? t.opened(chosen.name) : `${chosen.name}: `, refusal].join(done ? ' ' : '').trim()
    opened.style.color = done ? '' : 'var(--bad)'
    file.value = ''
  })
  const everyRow = el('div', {}, el('label', { for: 'every' }, t.every), el('div', { class: 'row' }, every, 's'), wrong)
  table.addEventListener('change', () => {
    everyRow.hidden = table.value === 'events'
  })
  return dialog(
    'files',
    t.title,
    el('h3', {}, t.export),
    el('label', { for: 'table' }, t.table),
    table,
    everyRow,
    el('div', { class: 'buttons' }, saveCsv, showCsv, cancel),
    bar,
    status,
    shown,
    el('p', {}, t.note),
    el('div', { class: 'buttons' }, saveScenario),
    el('label', { for: 'file' }, t.open),
    file,
    opened,
  )
}

export function helpDialog(session: Session): HTMLDialogElement {
  const t = text.help
  return dialog(
    'help',
    t.title,
    el('p', {}, t.what),
    el('p', {}, t.threshold),
    el('p', {}, t.reading),
    el('p', {}, text.ring.hint(BRAKE)),
    el('table', {}, el('tbody', {}, ...t.keys.map(([key, what]) => el('tr', {}, el('td', {}, el('kbd', {}, key)), el('td', {}, what))))),
    el('p', { class: 'note' }, t.version(session.start.version, session.client.place)),
  )
}
