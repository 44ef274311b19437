// The page's address: the experiment after the #, and what concerns the page alone.

/** Entries of a link that the page reads itself. */
export interface PageOptions {
  /** `view=embed`: ring, map, play and verdict only. `view=figures`: the paper's figures. */
  readonly view: 'lab' | 'embed' | 'figures' | null
  /** The rest, for the core. */
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

/** What stands after the #. */
export const hashOf = (scenario: string, view: PageOptions['view']): string =>
  `#${[view ? `view=${view}` : '', scenario].filter(part => part !== '').join('&')}`

/** Puts the experiment into the address without a new entry in the history, where the frame allows it. */
export function writeHash(scenario: string, view: PageOptions['view']): void {
  try {
    history.replaceState(null, '', hashOf(scenario, view))
  } catch {
    // A srcdoc frame has no address of its own; the share dialog still has the link.
  }
}

/** The address without the part after #. */
export const base = (): string => location.href.split('#')[0]!
