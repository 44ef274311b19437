// What a person does with one key or one button.
import type { Session } from './session'

/** Seconds that a braked vehicle stands. */
export const BRAKE = 3
/** Metres that a nudge moves a vehicle ahead. */
const NUDGE = 1

/** Brakes a vehicle, given by its index from 0. */
export const brake = (session: Session, vehicle: number) => session.act(`${vehicle + 1}:brake=${BRAKE}`)
export const brakeWatched = (session: Session) => brake(session, session.watched)
export const nudgeWatched = (session: Session) => session.act(`${session.watched + 1}:nudge=${NUDGE}`)

/** Does what a key pressed anywhere on the page stands for. `help` opens the help. */
export function pressed(session: Session, help: () => void, event: KeyboardEvent): void {
  if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector('dialog[open]') || document.body.dataset.view === 'figures') return
  const at = event.target as HTMLElement
  // A field of text takes every key itself; a focused button takes the space bar.
  const typing = at.matches('textarea, select, input:not([type=range]):not([type=checkbox])')
  if (typing || (event.key === ' ' && at.matches('button, summary, input, [role=tab]') && !at.matches('[type=range]'))) return
  const commands: Record<string, () => void> = {
    ' ': () => session.playback.toggle(),
    '.': () => void session.playback.step(),
    r: () => void session.restart(true),
    n: () => void nudgeWatched(session),
    b: () => void brakeWatched(session),
    '?': help,
  }
  const command = commands[event.key.length === 1 ? event.key.toLowerCase() : event.key]
  if (!command) return
  event.preventDefault()
  command()
}
