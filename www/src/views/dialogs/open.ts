// Opens the dialogs by name, and makes each when it is first opened.
import type { Session } from '../../app/session'
import { loadDialogs } from './load'

export type DialogName = keyof Awaited<ReturnType<typeof loadDialogs>>['dialogs']

/** `place`: the element that gets the dialogs. */
export function dialogOpener(session: Session, place: HTMLElement): (name: DialogName) => Promise<void> {
  const made: Partial<Record<DialogName, HTMLDialogElement>> = {}
  return async name => {
    try {
      const { dialogs } = await loadDialogs()
      const dialog = (made[name] ??= place.appendChild(dialogs[name](session)))
      if (!dialog.open) dialog.showModal()
    } catch (e) {
      session.emit('problem', [e instanceof Error ? e.message : String(e)])
    }
  }
}
