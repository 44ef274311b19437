// The value of a parameter in the session, and how it is written.
import type { Parameter } from '../core/protocol'
import { decimals } from '../text/format'
import type { Session } from './session'

/** The value in force now: of every driver without an override, or of the road. */
export const valueOf = (session: Session, parameter: Parameter): number =>
  parameter.of === 'driver'
    ? session.snapshot.driver[parameter.name]!
    : (session.snapshot.scenario as unknown as Record<string, number>)[parameter.name]!

/** With as many decimals as the slider's step has, and more only if the value needs them. */
export function written({ slider }: Pick<Parameter, 'slider'>, value: number): string {
  const short = value.toFixed(decimals(slider?.step ?? 1))
  return Number(short) === value ? String(Number(short)) : String(value)
}
