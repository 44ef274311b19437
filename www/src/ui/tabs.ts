// Tabs: several views in one place, of which one is visible; the arrow keys go from tab to tab.
import { button, el } from './dom'
import { text } from '../text'

export function tabs(views: readonly { id: string; name: string; panel: HTMLElement }[]): HTMLElement {
  const buttons = views.map(({ id, name, panel }) => {
    panel.id = `panel-${id}`
    panel.setAttribute('role', 'tabpanel')
    panel.setAttribute('aria-labelledby', `tab-${id}`)
    panel.tabIndex = 0
    return button({ role: 'tab', id: `tab-${id}`, 'aria-controls': `panel-${id}`, onclick: () => choose(id) }, name)
  })
  const choose = (id: string) => {
    views.forEach((view, k) => {
      const chosen = view.id === id
      view.panel.hidden = !chosen
      buttons[k]!.setAttribute('aria-selected', String(chosen))
      buttons[k]!.tabIndex = chosen ? 0 : -1
    })
  }
  const list = el('div', { role: 'tablist', 'aria-label': text.tabs.label }, ...buttons)
  list.addEventListener('keydown', event => {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key]
    if (by === undefined) return
    const now = buttons.findIndex(b => b.tabIndex === 0)
    const next = (now + by + views.length) % views.length
    choose(views[next]!.id)
    buttons[next]!.focus()
  })
  choose(views[0]!.id)
  return el('section', { id: 'more', class: 'card', 'aria-label': text.tabs.label }, list, ...views.map(v => v.panel))
}
