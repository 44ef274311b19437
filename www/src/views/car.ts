// The watched car: what it does, and what can be changed about its driver.
import { el } from '../dom'
import { exactly, fixed, unit } from '../format'
import type { Session } from '../session'
import { text } from '../text'

const t = text.car
/** Parameters that are offered for one driver. */
const OWN = ['reaction_time', 'sensitivity', 'max_speed']

export function carView(session: Session): HTMLElement {
  const which = el('input', { type: 'number', id: 'car-number', min: 1, step: 1, style: 'width:6rem' })
  which.addEventListener('change', () => {
    const n = which.valueAsNumber
    if (Number.isInteger(n) && n >= 1 && n <= session.snapshot.scenario.vehicles) session.watch(n - 1)
    else which.value = String(session.watched + 1)
  })
  const names = ['speed', 'headway', 'perceived', 'lane', 'frustration', 'attempt', 'changes', 'distance'] as const
  const values = Object.fromEntries(names.map(name => [name, el('dd')])) as Record<(typeof names)[number], HTMLElement>
  const facts = el('dl', { class: 'facts' }, ...names.flatMap(name => [el('dt', {}, t[name]), values[name]]))
  const own = OWN.map(name => session.start.parameters.find(p => p.name === name)!).map(p => {
    const input = el('input', { type: 'number', id: `own-${p.name}`, step: 'any', min: p.min, max: p.max, style: 'width:6rem' })
    const set = () => {
      if (input.value !== '') void session.act(`${session.watched + 1}:${p.name.replaceAll('_', '-')}=${input.value}`)
      input.value = ''
    }
    return el(
      'form',
      { class: 'row', onsubmit: (event: SubmitEvent) => (event.preventDefault(), set()) },
      el('label', { for: `own-${p.name}`, style: 'flex:1' }, text.controls.names[p.name] ?? p.name, ' ', el('i', {}, p.symbol)),
      input,
      el('span', { style: 'width:2.2rem' }, p.unit),
      el('button', { type: 'submit' }, t.set),
    )
  })
  const element = el('div', {}, el('div', { class: 'row' }, el('label', { for: 'car-number' }, t.which), which), facts, el('h3', {}, t.own), ...own)
  const show = () => {
    const { frame, watched: j } = session
    if (!frame || element.hidden) return
    if (document.activeElement !== which) which.value = String(j + 1)
    const phi = frame.frustration[j]!
    const put = (name: (typeof names)[number], value: string) => {
      values[name].textContent = value
    }
    put('speed', `${unit(exactly(frame.speeds[j]!, 2), 'm/s')} · ${unit(fixed(frame.speeds[j]! * 3.6, 0), 'km/h')}`)
    put('headway', unit(exactly(frame.headways[j]!, 2), 'm'))
    put('perceived', unit(exactly(frame.perceived[j]!, 2), 'm'))
    put('lane', String(frame.lanes[j]! + 1))
    put('frustration', exactly(phi, 2))
    put('attempt', unit(fixed((200 / Math.PI) * Math.atan(phi), 1), '%'))
    put('changes', String(frame.laneChanges[j]!))
    put('distance', unit(fixed(frame.distances[j]! / 1000, 2), 'km'))
  }
  session.on('frame', show)
  session.on('watch', () => {
    which.value = String(session.watched + 1)
    show()
  })
  session.on('snapshot', ({ scenario }) => {
    which.max = String(scenario.vehicles)
  })
  new MutationObserver(show).observe(element, { attributeFilter: ['hidden'] })
  return element
}
