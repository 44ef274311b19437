// The series that the charts draw: values over time since the start of the run, at most as many as the map has columns.

/** A run that has just begun fills this much of the map's width, s. */
const SHORTEST_WINDOW = 60

/** Columns, one value for each time. */
export interface Series {
  /** s. */
  readonly time: number[]
  /** Mean speed, m/s. */
  readonly mean: number[]
  /** Vehicles per second; null until the window of the flow has passed for the first time. */
  readonly flow: (number | null)[]
  /** Vehicles in the fullest lane minus vehicles in the emptiest lane. */
  readonly imbalance: number[]
  /** Speed of each watched vehicle, m/s. */
  readonly speeds: number[][]
}

/** Without values, for so many watched vehicles. */
export function empty(watched: number): Series {
  return { time: [], mean: [], flow: [], imbalance: [], speeds: Array.from({ length: watched }, () => []) }
}

/** Appends the core's rows (time, mean, flow, imbalance, speeds) and drops the oldest values above `most`. */
export function append(series: Series, rows: Float64Array, most: number): void {
  const width = 4 + series.speeds.length
  for (let at = 0; at + width <= rows.length; at += width) {
    series.time.push(rows[at]!)
    series.mean.push(rows[at + 1]!)
    series.flow.push(Number.isNaN(rows[at + 2]) ? null : rows[at + 2]!)
    series.imbalance.push(rows[at + 3]!)
    series.speeds.forEach((speeds, k) => speeds.push(rows[at + 4 + k]!))
  }
  const excess = series.time.length - most
  if (excess > 0) {
    for (const column of [series.time, series.mean, series.flow, series.imbalance, ...series.speeds]) {
      column.splice(0, excess)
    }
  }
}

/** The times (s) that map and charts begin and end at: the whole run until the map is full, then its latest part.
 * `interval`: seconds between two values; `columns`: columns of the map. */
export function timeWindow(series: Series, interval: number, columns: number): [number, number] {
  const most = columns * interval
  const now = (series.time.at(-1) ?? 0) + interval
  return now > most ? [now - most, now] : [0, Math.max(now, SHORTEST_WINDOW)]
}
