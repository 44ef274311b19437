// The page's address: after the # stand the scenario, for the core, and entries that the page reads itself.

/** A link, split into what the page reads and what the core reads. */
export interface PageOptions {
  /** `view=embed`: ring, map, playback and stability summary only. `view=figures`: the paper's figures. */
  readonly view: 'lab' | 'embed' | 'figures' | null
  /** All other entries, for the core. */
  readonly scenario: string
}

export function readHash(hash: string): PageOptions {
  let view: PageOptions['view'] = null
  const rest = hash
    .replace(/^#/, '')
    .split('&')
    .filter(entry => {
      if (entry === 'view=embed') view = 'embed'
      else if (entry === 'view=lab') view = 'lab'
      else if (entry === 'view=figures') view = 'figures'
      else return entry !== ''
      return false
    })
  return { view, scenario: rest.join('&') }
}

/** The part of the address from the # on. */
export const hashOf = (scenario: string, view: PageOptions['view']): string =>
  `#${[view ? `view=${view}` : '', scenario].filter(part => part !== '').join('&')}`

/** Writes the scenario into the address without a new entry in the history, where the frame allows it. */
export function writeHash(scenario: string, view: PageOptions['view']): void {
  try {
    history.replaceState(null, '', hashOf(scenario, view))
  } catch {
    // A srcdoc frame has no address of its own; the share dialog shows the link there, too.
  }
}

/** The address without the part after #. */
export const base = (): string => location.href.split('#')[0]!
