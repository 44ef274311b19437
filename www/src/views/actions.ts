// The list of actions in words, each with a button that takes it back, and a field for another one.
import { button, el } from '../ui/dom'
import { unit } from '../text/format'
import type { Session } from '../app/session'
import type { Parameter } from '../core/protocol'
import { text } from '../text'

const t = text.actions

/** An action such as `at=40:7:brake=3` in words; the units come from the core's table of parameters. */
export function inWords(action: string, parameters: readonly Pick<Parameter, 'name' | 'unit'>[]): { when: string; what: string } {
  const [, at = '', selector = '', effects = ''] = /^at=([^:]*):([^:]*):(.*)$/.exec(action) ?? []
  const one = (effect: string): string => {
    const [name = '', value = ''] = effect.split('=')
    if (name === 'brake') return t.brake(value)
    if (name === 'nudge') return t.nudge(value)
    const own = name.replaceAll('-', '_')
    return `${(text.controls.names[own] ?? name).toLowerCase()} ${unit(value, parameters.find(p => p.name === own)?.unit ?? '')}`
  }
  return { when: t.at(at), what: `${t.vehicles(selector)}: ${effects.split(',').map(one).join(', ')}` }
}

export function actionsView(session: Session): HTMLElement {
  const list = el('ul', { class: 'actions' })
  const none = el('p', {}, t.none)
  const clear = button({ id: 'clear', title: t.clearHint, onclick: () => void session.restart(false) }, t.clear)
  const input = el('input', { type: 'text', id: 'do', placeholder: '7:brake=3', 'aria-label': t.addLabel, style: 'flex:1;width:auto' })
  const form = el(
    'form',
    {
      class: 'row',
      onsubmit: async (event: SubmitEvent) => {
        event.preventDefault()
        if (input.value.trim() !== '' && (await session.act(input.value.trim()))) input.value = ''
      },
    },
    input,
    el('button', { type: 'submit' }, t.add),
  )
  let shown = ''
  session.on('snapshot', ({ scenario: { actions } }) => {
    if (shown === actions.join()) return
    shown = actions.join()
    none.hidden = actions.length > 0
    clear.hidden = actions.length === 0
    list.replaceChildren(
      ...actions.map((action, index) => {
        const { when, what } = inWords(action, session.start.parameters)
        return el(
          'li',
          {},
          el('span', { class: 'when' }, when),
          el('span', {}, what),
          button({ 'aria-label': t.remove(`${when}, ${what}`), onclick: () => void session.remove(index) }, '✕'),
        )
      }),
    )
  })
  return el('div', {}, none, list, form, el('div', { class: 'row' }, clear))
}
