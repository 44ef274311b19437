// A field for a number, and what is said of one that cannot be.
import { el } from './dom'

/** A decimal comma typed or pasted into a number field becomes a point: browsers drop it without a word where the
 * language writes a point, and 0,4 would be 4. */
function comma(event: InputEvent): void {
  // Two commas, or a comma and a point, part thousands.
  if (!/^[^.,]*,[^.,]*$/.test(event.data ?? '')) return
  event.preventDefault()
  document.execCommand('insertText', false, event.data!.replace(',', '.'))
}

/** `wrong` stands where the page wants the sentence; `complain` puts it there, and an empty one takes it away. */
export function numberField(props: Parameters<typeof el>[1] & { id: string }) {
  const wrong = el('div', { class: 'wrong', id: `${props.id.replace(/-number$/, '')}-wrong`, role: 'alert', hidden: true })
  const number = el('input', { type: 'number', step: 'any', inputmode: 'decimal', 'aria-describedby': wrong.id, onbeforeinput: comma, ...props })
  const complain = (message: string) => {
    wrong.textContent = message
    wrong.hidden = message === ''
    number.setAttribute('aria-invalid', String(message !== ''))
  }
  return { number, wrong, complain }
}
