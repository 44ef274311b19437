// The series that the charts draw: values over time since the start of the run, at most as many as the map has columns.
import type { Rows } from '../core/protocol'

/** A run that has just begun fills this much of the map's width, s. */
const SHORTEST_WINDOW = 60

/** Columns, one value for each time, as the core records them. */
export type Series = Readonly<Rows>

/** Without values, for so many watched vehicles. */
export function empty(watched: number): Series {
  return { time: [], mean: [], flow: [], imbalance: [], speeds: Array.from({ length: watched }, () => []) }
}

const columns = (rows: Series) => [rows.time, rows.mean, rows.flow, rows.imbalance, ...rows.speeds]

/** Appends what the core has recorded and drops the oldest values above `most`. */
export function append(series: Series, rows: Series, most: number): void {
  const added = columns(rows)
  columns(series).forEach((column, k) => {
    column.push(...(added[k] as number[]))
    column.splice(0, column.length - most)
  })
}

/** The times (s) that map and charts begin and end at: the whole run until the map is full, then its latest part.
 * `interval`: seconds between two values; `most`: seconds that the full map shows. */
export function timeWindow(series: Series, interval: number, most: number): [number, number] {
  const now = (series.time.at(-1) ?? 0) + interval
  return now > most ? [now - most, now] : [0, Math.max(now, SHORTEST_WINDOW)]
}
