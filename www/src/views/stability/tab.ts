// The stability tab: the stability diagram, the characteristic roots, and the growth of each mode by theory and in the run.
import type { Session } from '../../app/session'
import type { ModalGrowth, LaneRoots, StabilitySummary } from '../../core/protocol'
import { el } from '../../ui/dom'
import { diagramView } from './diagram'
import { modesView } from './modes'
import { rootsView } from './roots'
import './stability.css'

/** Time between two requests for the measured growth, ms. */
const MEASURE = 400

/** `preview` shows the stability summary for another place, or with null that of the run. */
export function stabilityView(session: Session, preview: (summary: StabilitySummary | null) => void): HTMLElement {
  const diagram = diagramView(session, preview)
  const roots = rootsView()
  const modes = modesView()
  const element = el('div', { class: 'stability' }, el('div', { class: 'figures' }, diagram.element, roots.element, modes.element))
  const visible = () => element.clientWidth > 0

  let curvesOf = ''
  let rootsOf = ''
  let theory: LaneRoots | null = null
  let measured: ModalGrowth | null = null
  const showModes = () => {
    if (theory && measured && session.frame) modes.show(theory, measured, session.snapshot.stability.mode, session.frame.time, session.snapshot.scenario.lanes)
  }
  // The core computes theory only while the tab is visible, and only when something has changed on which it depends.
  const update = async () => {
    if (!session.snapshot || !visible()) return
    const { scenario, driver, stability, changes } = session.snapshot
    const { length, lanes, time_step, start, vehicles, exceptions } = scenario
    const road = [length, lanes, time_step, start, vehicles, driver]
    const curves = JSON.stringify([road, exceptions, stability.lane, stability.vehicles, stability.homogeneous])
    if (curves !== curvesOf) {
      curvesOf = curves
      diagram.of(await session.client.ask('diagram', {}))
    }
    const lane = JSON.stringify([road, exceptions, stability, changes])
    if (lane !== rootsOf) {
      rootsOf = lane
      theory = await session.client.ask('roots', {})
      roots.show(theory)
      showModes()
    }
    diagram.show()
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
  session.on('snapshot', () => void update())
  session.on('frame', measure)
  session.on('legends', () => {
    // The page may have changed between light and dark.
    diagram.draw()
    roots.redraw()
    modes.redraw()
  })
  new ResizeObserver(() => {
    void update()
    measure()
  }).observe(element)
  return element
}
