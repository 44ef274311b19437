// How the lines of charts look, and the list that names them.
import { el } from '../ui/dom'

export interface Line {
  readonly label: string
  readonly colour: string
  readonly dash?: readonly number[]
  readonly width?: number
}

/** Line colours that colour-blind eyes tell apart (after Okabe and Ito), on a dark or a light ground. */
export const palette = (dark: boolean): readonly string[] =>
  dark ? ['#7cc4f5', '#f0a941', '#4fd0a5', '#f08bc1', '#e6e04e'] : ['#0064a6', '#b45f00', '#007a57', '#b13a80', '#5a4fb0']

/** The names of the lines, each beside a sample of the line. */
export const keys = (lines: readonly Line[]): HTMLElement =>
  el('div', { class: 'keys' }, ...lines.map(line => el('span', { style: `--piece:${sample(line)}` }, line.label)))

/** A sample of a line as a CSS background. */
function sample({ colour, dash = [] }: Line): string {
  let at = 0
  const stops = dash.map((length, k) => `${k % 2 === 0 ? colour : '#0000'} ${at}px ${(at += length)}px`)
  return stops.length === 0 ? `linear-gradient(${colour} 0 0)` : `repeating-linear-gradient(90deg,${stops.join()})`
}
