// A colour bar: the colours of a quantity from low to high, with numbers and the unit.
import { el } from '../ui/dom'
import { fixed } from '../text/format'
import type { ColourBar, Quantity } from '../core/protocol'
import { text } from '../text'

export function legendView(): { element: HTMLElement; show: (legend: ColourBar, quantity: Quantity) => void } {
  const low = el('span')
  const high = el('span')
  const bar = el('canvas', { class: 'bar', width: 64, height: 1, role: 'img' })
  const ticks = el('div', { class: 'ticks', 'aria-hidden': 'true' })
  const element = el('div', { class: 'legend' }, low, bar, high, ticks)
  return {
    element,
    show(legend, quantity) {
      const words = text.legend[quantity]
      const count = legend.colours.length / 3
      bar.width = count
      const context = bar.getContext('2d')!
      for (let i = 0; i < count; i++) {
        context.fillStyle = `rgb(${legend.colours.slice(3 * i, 3 * i + 3).join(' ')})`
        context.fillRect(i, 0, 1, 1)
      }
      bar.setAttribute('aria-label', `${words.name}${words.unit ? `, ${words.unit}` : ''}`)
      low.textContent = words.low
      high.textContent = [words.high, words.unit].filter(w => w !== '').join(' ')
      ticks.replaceChildren(
        ...legend.ticks.map(({ value, place }) => {
          const sign = quantity === 'difference' && value > 0 ? '+' : ''
          // The style sheet leaves the minor numbers out on a short bar.
          const minor = quantity === 'difference' && Math.abs(value) === 0.1
          return el('span', { class: minor ? 'minor' : undefined, style: `left:${100 * place}%` }, `${sign}${fixed(value, 2)}`)
        }),
      )
    },
  }
}
