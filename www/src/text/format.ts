// Numbers as people read them, with the digits that are known or needed.

/** At most so many decimals, without trailing zeros; a true minus sign. */
export function fixed(value: number, decimals: number): string {
  const text = value.toFixed(decimals)
  const short = text.includes('.') ? text.replace(/\.?0+$/, '') : text
  return (short === '-0' ? '0' : short).replace('-', '\u2212')
}

/** How many decimals a slider with this step needs. */
export const decimals = (step: number): number => Math.max(0, Math.min(6, Math.ceil(-Math.log10(step) - 1e-9)))

/** Always so many decimals. */
export const exactly = (value: number, decimals: number): string => value.toFixed(decimals).replace('-', '\u2212')

/** A number and its unit, with a narrow no-break space between them. */
export const unit = (value: string, of: string): string => (of === '' ? value : `${value}\u202f${of}`)

/** A span of time (s) in seconds, minutes, hours or days: the number and its unit. */
function spanParts(seconds: number): readonly [string, string] {
  if (seconds < 9.95) return [fixed(seconds, 1), 's']
  if (seconds < 180) return [fixed(seconds, 0), 's']
  if (seconds < 7200) return [fixed(seconds / 60, 0), 'min']
  if (seconds < 2 * 86400) return [fixed(seconds / 3600, 0), 'h']
  return [fixed(seconds / 86400, 0), 'd']
}

/** A span of time (s) in seconds, minutes, hours or days. */
export const span = (seconds: number): string => unit(...spanParts(seconds))

/** A range of spans of time (s), with the unit once where both have the same. */
export function spans(from: number, to: number): string {
  const [low, high] = [spanParts(from), spanParts(to)]
  return `${low[1] === high[1] ? low[0] : unit(...low)}–${unit(...high)}`
}
