// The share dialog: the link to the session as it is now, and the HTML that shows it in a course page.
import type { Session } from '../../app/session'
import { base } from '../../app/url'
import { dialogsText } from '../../text/dialogs'
import { dialog } from '../../ui/dialog'
import { button, el } from '../../ui/dom'

const t = dialogsText.share

/** Copies a field's text. Sandboxed frames may not write to the clipboard; there the older command may still copy what is
 * selected, and if it does not, the text stays selected. */
async function copy(field: HTMLTextAreaElement, copier: HTMLButtonElement): Promise<void> {
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
  copier.textContent = done ? t.copied : t.select
  setTimeout(() => {
    copier.textContent = t.copy
  }, 2000)
}

/** A text to copy, with its label and button. */
function copied(id: string, label: string, rows: number) {
  const field = el('textarea', { id, rows, readonly: true, spellcheck: 'false', onfocus: () => field.select() })
  const copier = button({ onclick: () => void copy(field, copier) }, t.copy)
  return { field, nodes: [el('label', { for: id }, label), field, el('div', { class: 'buttons' }, copier)] }
}

export function shareDialog(session: Session): HTMLDialogElement {
  const link = copied('share-link', t.link, 3)
  const embed = copied('share-embed', t.embed, 4)
  const disk = el('p', { id: 'share-disk', hidden: true }, t.disk)
  const element = dialog('share', t.title, ...link.nodes, ...embed.nodes, disk, el('p', {}, t.shortcut))
  const fill = () => {
    const { link: scenario } = session.snapshot
    const address = base()
    link.field.value = scenario === '' ? address : `${address}#${scenario}`
    const file = address.split('/').pop() ?? ''
    // A course page cannot reach an address on this disk: the frame then names the file alone.
    disk.hidden = !address.startsWith('file:')
    const folder = disk.hidden ? address.slice(0, address.length - file.length) : ''
    const frame =
      file === 'ringroad.html'
        ? `${folder}${file}#view=embed${scenario === '' ? '' : `&${scenario}`}`
        : `${folder}embed.html${scenario === '' ? '' : `#${scenario}`}`
    embed.field.value = `<iframe src="${frame.replaceAll('&', '&amp;')}" width="100%" height="520" style="border:0" allowfullscreen title="Ringroad"></iframe>`
  }
  fill()
  session.on('snapshot', fill)
  return element
}
