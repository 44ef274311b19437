// A colour bar with its numbers.
import { el } from '../dom'
import { fixed } from '../format'
import type { Legend, Quantity } from '../shared/protocol'
import { text } from '../text'

/** `compact`: fewer numbers, for a short bar. */
export function legendView(compact = false): { element: HTMLElement; show: (legend: Legend, quantity: Quantity) => void } {
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
        ...legend.ticks.filter(tick => !compact || quantity !== 'difference' || Math.abs(tick.value) !== 0.1).map(({ value, place }) => {
          const sign = quantity === 'difference' && value > 0 ? '+' : ''
          return el('span', { style: `left:${100 * place}%` }, `${sign}${fixed(value, 2)}`)
        }),
      )
    },
  }
}
