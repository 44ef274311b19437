// Pointer and keys on the canvas of the ring: hovering, choosing and braking a vehicle.
import { brake } from '../../app/commands'
import type { Session } from '../../app/session'
import { geometry, nearestVehicle } from './geometry'

/** Time after which a vehicle that is pressed brakes, ms. */
const HOLD = 350

/** `hover` gets the index of the vehicle under the pointer when it becomes another one, −1 for none. */
export function listen(canvas: HTMLCanvasElement, session: Session, hover: (vehicle: number) => void): void {
  const at = (event: PointerEvent): number => {
    const { left, top, width, height } = canvas.getBoundingClientRect()
    return nearestVehicle(geometry(width, height, session.snapshot.scenario), session.frame, event.clientX - left, event.clientY - top)
  }
  let timer = 0
  let hovered = -1
  canvas.addEventListener('pointerdown', event => {
    const vehicle = at(event)
    if (vehicle < 0) return
    session.watch(vehicle)
    timer = window.setTimeout(() => void brake(session, vehicle), HOLD)
  })
  for (const end of ['pointerup', 'pointercancel', 'pointerleave'] as const) {
    canvas.addEventListener(end, () => clearTimeout(timer))
  }
  // A long touch opens no menu.
  canvas.addEventListener('contextmenu', event => event.preventDefault())
  canvas.addEventListener('pointermove', event => {
    const vehicle = at(event)
    if (vehicle !== hovered) hover((hovered = vehicle))
  })
  canvas.addEventListener('pointerleave', () => hover((hovered = -1)))
  canvas.addEventListener('keydown', event => {
    const by = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key]
    if (by === undefined) return
    event.preventDefault()
    const { vehicles } = session.snapshot.scenario
    session.watch((session.watched + by + vehicles) % vehicles)
  })
}
