// The texts of the dialogs, in English. They are loaded with the dialogs.
import { fixed } from './format'

export const enDialogs = {
  share: {
    title: 'Share',
    link: 'Link to this experiment, with everything done so far',
    embed: 'HTML for a course page',
    copy: 'Copy',
    copied: 'Copied',
    select: 'Selected: press Ctrl+C',
    disk: 'This page was opened from disk: put its file on a web server first, beside the course page.',
    shortcut: 'The link holds only what differs from the default.',
  },

  files: {
    title: 'Data',
    export: 'Save the run so far as CSV',
    table: 'Table',
    tables: {
      trajectories: 'Trajectories of all vehicles',
      'speed-map': 'Space-time map of speed',
      speeds: 'Speeds of the watched cars',
      'flow-map': 'Space-time map of flow',
      flow: 'Flow at L/2',
      events: 'Lane changes, passes, collision',
      lanes: 'Vehicles per lane',
      growth: 'Growth of each mode',
    } as Record<string, string>,
    every: 'A row every',
    save: 'Save CSV',
    show: 'Show as text',
    cancel: 'Cancel',
    scenario: 'Save the scenario (JSON)',
    open: 'Open a scenario (JSON) or a saved table (CSV)',
    made: (name: string, kb: string): string => `${name}, ${kb} kB`,
    running: (part: number): string => `Repeating the run: ${fixed(100 * part, 0)} %`,
    cancelled: 'Cancelled.',
    opened: (name: string): string => `${name} is open.`,
    note: 'The file names the scenario and the program’s version; the command gives the same bytes.',
  },

  help: {
    title: 'Help',
    what: 'Cars on a ring road follow each other, and every driver reacts a little late. Below a critical reaction time every disturbance fades; above it the smallest one grows into jams that travel backwards. The page says where the threshold lies before the traffic shows it.',
    keys: [
      ['Space', 'play or pause'],
      ['.', 'one step'],
      ['R', 'restart, keeping the actions'],
      ['N', 'nudge the watched car'],
      ['B', 'brake the watched car'],
      ['← →', 'move a slider; on the ring: choose a car'],
      ['?', 'this help'],
    ] as readonly (readonly [string, string])[],
    threshold:
      'The tolerated reaction time holds for the run, which goes in time steps; τ beside it is that of continuous time.',
    reading:
      'In the map every row of the road is a line of time: blue where cars are slower than the equilibrium speed v∞, amber where they are faster, on a logarithmic scale from 1 cm/s to 10 m/s. Stripes that fall to the right are jams that move against the traffic.',
    version: (v: string, place: 'worker' | 'page'): string =>
      `Version ${v}; the core runs in ${place === 'worker' ? 'a worker' : 'the page itself'}.`,
  },
}

export type DialogsDictionary = typeof enDialogs
