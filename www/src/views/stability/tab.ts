// The stability tab: where waves grow, why, and whether the run agrees.
import { el } from '../../ui/dom'
import type { Session } from '../../app/session'
import type { ModalGrowth, Roots, StabilitySummary } from '../../core/protocol'
import { modesView } from './modes'
import { planeView } from './diagram'
import { rootsView } from './roots'
import './stability.css'

/** Between two looks at the measured growth, ms. */
const MEASURE = 400

export function stabilityView(session: Session, preview: (v: StabilitySummary | null) => void): HTMLElement {
  const plane = planeView(session, preview)
  const roots = rootsView()
  const modes = modesView()
  const element = el('div', { class: 'stability' }, el('div', { class: 'figures' }, plane.element, roots.element, modes.element))
  const visible = () => element.clientWidth > 0

  let curvesOf = ''
  let rootsOf = ''
  let theory: Roots | null = null
  let measured: ModalGrowth | null = null
  const showModes = () => {
    if (theory && measured && session.frame) modes.show(theory, measured, session.snapshot.verdict.mode, session.frame.time, session.snapshot.scenario.lanes)
  }
  // Theory is asked when what it depends on has changed, and only for eyes that see it.
  const consider = async () => {
    if (!session.snapshot || !visible()) return
    const { scenario, driver, verdict, changes } = session.snapshot
    const { length, lanes, time_step, start, vehicles, exceptions } = scenario
    const road = [length, lanes, time_step, start, vehicles, driver]
    const curves = JSON.stringify([road, exceptions, verdict.lane, verdict.vehicles, verdict.alike])
    if (curves !== curvesOf) {
      curvesOf = curves
      plane.of(await session.client.ask('diagram', {}))
    }
    const lane = JSON.stringify([road, exceptions, verdict, changes])
    if (lane !== rootsOf) {
      rootsOf = lane
      theory = await session.client.ask('roots', {})
      roots.show(theory)
      showModes()
    }
    plane.show()
  }
  let timer = 0
  const measure = () => {
    if (timer !== 0 || !visible()) return
    timer = window.setTimeout(async () => {
      timer = 0
      if (!visible()) return
      measured = await session.client.ask('modes', {})
      showModes()
    }, MEASURE)
  }
  session.on('snapshot', () => void consider())
  session.on('frame', measure)
  session.on('legends', () => {
    // Light has become dark, or the other way round.
    plane.redraw()
    roots.redraw()
    modes.redraw()
  })
  new ResizeObserver(() => {
    void consider()
    measure()
  }).observe(element)
  return element
}
