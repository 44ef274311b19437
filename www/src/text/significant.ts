// Numbers with a fixed count of significant digits.
import { fixed } from './format'

/** So many significant digits, without trailing zeros; very large and very small ones with a power of ten. */
export function significant(value: number, digits: number): string {
  const text = value.toPrecision(digits)
  if (!text.includes('e')) return fixed(Number(text), Math.max(0, digits - 1 - Math.floor(Math.log10(Math.abs(value) || 1))))
  const [mantissa, power] = text.split('e')
  return `${fixed(Number(mantissa), digits)}e${Number(power)}`.replace('e-', 'e\u2212')
}
