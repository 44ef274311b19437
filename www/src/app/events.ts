// Events with names and typed values, and the listeners to them.
type Listener<V> = (value: V) => void

/** `Events` maps the name of each event to the type of its value. */
export class Emitter<Events> {
  #listeners = new Map<keyof Events, Set<Listener<never>>>()

  on<K extends keyof Events>(event: K, listener: Listener<Events[K]>): void {
    const set = this.#listeners.get(event) ?? new Set()
    this.#listeners.set(event, set.add(listener as Listener<never>))
  }

  emit<K extends keyof Events>(event: K, value: Events[K]): void {
    for (const listener of this.#listeners.get(event) ?? []) (listener as Listener<Events[K]>)(value)
  }
}
