// A field for a number, and the sentence that refuses a number that is not allowed.
import { el } from './dom'

/** A decimal comma that is typed or pasted becomes a point. Where the language of the page writes a point, browsers drop the comma
 * silently: 0,4 would become 4. */
function comma(event: InputEvent): void {
  // Two commas, or a comma and a point, separate thousands: left to the browser.
  if (!/^[^.,]*,[^.,]*$/.test(event.data ?? '')) return
  event.preventDefault()
  document.execCommand('insertText', false, event.data!.replace(',', '.'))
}

/** `wrong` is the element of the sentence, which the caller places; `complain` shows a sentence there, an empty one hides it. */
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
