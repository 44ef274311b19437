// The texts of the paper's figures, in English. They are loaded with the figures, not with the laboratory.
import { span } from './format'

export const enFigures = {
  title: 'The paper, figure by figure',
  intro:
    'Every figure is computed here, in this browser, and what the paper claims is held against what comes out. A verdict is computed, too: from the value, its uncertainty and the tolerance of the row.',
  all: 'Run all',
  run: 'Run',
  again: 'Run again',
  runLabel: (title: string): string => `Run: ${title}`,
  cancel: 'Cancel',
  cancelAll: 'Cancel all',
  cancelLabel: (title: string): string => `Cancel: ${title}`,
  beyond: 'beyond the paper',
  starting: 'Starting …',
  waiting: 'Waiting for the figure before it.',
  running: (done: number, of: number): string => `${done} of ${of} pieces of work`,
  assembling: 'Putting it together …',
  done: (seconds: number, workers: number): string =>
    `Done in ${span(seconds)}${workers === 0 ? '' : workers === 1 ? ', one worker' : `, ${workers} workers`}.`,
  cancelled: 'Cancelled.',
  failed: (why: string): string => `That did not work: ${why}`,
  progress: (title: string): string => `Progress: ${title}`,
  plot: (title: string): string => `Picture: ${title}`,
  save: 'Save',
  noClaims: 'The paper claims nothing here.',
  columns: { claim: 'Claim', paper: 'Paper', ours: 'Ours', verdict: 'Verdict', method: 'How it was measured' },
  verdicts: { agrees: 'agrees', differs: 'differs', open: 'not determined by the paper' },
  symbols: { agrees: '✓', differs: '✗', open: '?' },
  summary: (agree: number, differ: number, open: number): string => {
    const words = (n: number, one: string, many: string) => `${n} ${n === 1 ? one : many}`
    const all = words(agree + differ + open, 'claim', 'claims')
    return `${all}: ${words(agree, 'agrees', 'agree')}, ${words(differ, 'differs', 'differ')}, ${open} not determined by the paper.`
  },
  point: (panel: string, name: string, x: string, atX: string, y: string, atY: string): string =>
    `${panel}${name === '' ? '' : `, ${name}`} · ${x}: ${atX} · ${y}: ${atY}`,
  interval: (low: string, high: string): string => ` (${low} to ${high})`,
  cell: (panel: string, x: string, atX: string, y: string, atY: string, name: string, value: string): string =>
    `${panel} · ${x}: ${atX} · ${y}: ${atY} · ${name}: ${value}`,
  noValue: 'none',
  kind: 'picture with values to read',
  keys: 'Left and right go along a curve, up and down to another curve; in a map they go from cell to cell. Page up and page down go to another panel, Escape leaves.',
  hint: 'Point at the picture, or tap it, to read values; or go to it with Tab and press the arrow keys.',
}

export type FiguresDictionary = typeof enFigures
