// The tab of the watched vehicle: its state now, and parameters that can be set for its driver alone.
import { el } from '../ui/dom'
import { exactly, fixed, unit } from '../text/format'
import type { Session } from '../app/session'
import { text } from '../text'
import { numberField } from '../ui/number_field'

const t = text.car
/** Parameters that can be set for one driver. */
const OWN = ['reaction_time', 'sensitivity', 'max_speed']

export function carView(session: Session): HTMLElement {
  const { number: which, wrong, complain } = numberField({ id: 'car-number', min: 1, step: 1, style: 'width:6rem' })
  which.addEventListener('change', () => {
    const n = which.valueAsNumber
    const { vehicles } = session.snapshot.scenario
    if (Number.isInteger(n) && n >= 1 && n <= vehicles) session.watch(n - 1)
    else complain(text.controls.allowed(t.which, true, 1, vehicles, ''))
  })
  which.addEventListener('input', () => complain(''))
  const names = ['speed', 'headway', 'perceived', 'lane', 'frustration', 'attempt', 'changes', 'distance'] as const
  const values = Object.fromEntries(names.map(name => [name, el('dd')])) as Record<(typeof names)[number], HTMLElement>
  const facts = el('dl', { class: 'facts' }, ...names.flatMap(name => [el('dt', {}, t[name]), values[name]]))
  const own = OWN.map(name => session.start.parameters.find(p => p.name === name)!).map(p => {
    const { number: input, wrong: ownWrong, complain: ownComplain } = numberField({ id: `own-${p.name}`, min: p.min, max: p.max, style: 'width:6rem' })
    const set = () => {
      const name = text.controls.names[p.name] ?? p.name
      const value = input.valueAsNumber
      if (!(value >= p.min && value <= p.max)) {
        ownComplain(text.controls.allowed(name, p.whole, p.min, p.max, p.unit))
        return
      }
      void session.act(`${session.watched + 1}:${p.name.replaceAll('_', '-')}=${value}`)
      input.value = ''
    }
    input.addEventListener('input', () => ownComplain(''))
    return el(
      'form',
      { class: 'row', novalidate: true, onsubmit: (event: SubmitEvent) => (event.preventDefault(), set()) },
      el('label', { for: `own-${p.name}`, style: 'flex:1' }, text.controls.names[p.name] ?? p.name, ' ', el('i', {}, p.symbol)),
      input,
      el('span', { style: 'width:2.2rem' }, p.unit),
      el('button', { type: 'submit' }, t.set),
      ownWrong,
    )
  })
  const element = el('div', {}, el('div', { class: 'row' }, el('label', { for: 'car-number' }, t.which), which, wrong), facts, el('h3', {}, t.own), ...own)
  const show = () => {
    const { frame, watched: j } = session
    if (!frame || element.hidden) return
    if (document.activeElement !== which && wrong.hidden) which.value = String(j + 1)
    const phi = frame.frustration[j]!
    const put = (name: (typeof names)[number], value: string) => {
      values[name].textContent = value
    }
    put('speed', `${unit(exactly(frame.speeds[j]!, 2), 'm/s')} · ${unit(fixed(frame.speeds[j]! * 3.6, 0), 'km/h')}`)
    put('headway', unit(exactly(frame.headways[j]!, 2), 'm'))
    put('perceived', unit(exactly(frame.perceived[j]!, 2), 'm'))
    put('lane', String(frame.lanes[j]! + 1))
    put('frustration', exactly(phi, 2))
    put('attempt', unit(fixed(100 * frame.attempt[j]!, 1), '%'))
    put('changes', String(frame.laneChanges[j]!))
    put('distance', unit(fixed(frame.distances[j]! / 1000, 2), 'km'))
  }
  session.on('frame', show)
  session.on('watch', () => {
    complain('')
    which.value = String(session.watched + 1)
    show()
  })
  session.on('snapshot', ({ scenario }) => {
    if (which.max === String(scenario.vehicles)) return
    which.max = String(scenario.vehicles)
    complain('')
  })
  new MutationObserver(show).observe(element, { attributeFilter: ['hidden'] })
  return element
}
