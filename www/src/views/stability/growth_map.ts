// The map of the largest growth rate in the stability diagram. The core computes it column by column in slices between the
// steps of the traffic, and what is there is painted after each slice; a map that is not wanted any more costs one slice at most.
import type { Client } from '../../core/client'

/** Reaction times in a column. */
const DELAYS = 200
/** Time for which one request computes, ms; then what is there is painted. */
const PART = 120
/** The colours are logarithmic from this rate … */
const FROM = 1e-3
/** … to this one, 1/s, on either side of 0. */
export const TO = 1

type Colour = readonly [number, number, number]

/** Decay, no growth, growth: blue and orange, which colour-blind eyes tell apart. */
const COLOURS = {
  light: [[24, 78, 160], [248, 248, 246], [190, 84, 0]],
  dark: [[110, 176, 245], [20, 23, 28], [250, 160, 50]],
} as const

/** The colour of a growth rate (1/s): red, green, blue. */
export function colour(rate: number, dark: boolean): Colour {
  const [decay, zero, growth] = COLOURS[dark ? 'dark' : 'light']
  const end = rate < 0 ? decay : growth
  const part = Math.min(1, Math.log1p(Math.abs(rate) / FROM) / Math.log1p(TO / FROM))
  const mix = (k: 0 | 1 | 2) => Math.round(zero[k] + part * (end[k] - zero[k]))
  return [mix(0), mix(1), mix(2)]
}

/** The growth rate at a place of the colour bar, −1 … 1. */
export const rateAt = (place: number): number => Math.sign(place) * FROM * Math.expm1(Math.abs(place) * Math.log1p(TO / FROM))

/** What a map is of. */
interface Subject {
  /** Differs from map to map. */
  readonly key: string
  readonly vehicles: readonly number[]
  /** The longest reaction time, s. */
  readonly highest: number
  /** Whether in the run's time steps, or in continuous time. */
  readonly steps: boolean
}
export type GrowthMap = ReturnType<typeof growthMap>

/** `going` tells whether to compute more; `progress` is called when there is more of the map. */
export function growthMap(client: Client, going: () => boolean, progress: () => void) {
  const picture = document.createElement('canvas')
  picture.height = DELAYS
  let subject: Subject | null = null
  let rates = new Float64Array()
  let done = 0
  let running = false
  let dark = false

  /** Paints the columns from `from` to what is done. */
  const paint = (from: number) => {
    if (done === from) return
    const image = new ImageData(done - from, DELAYS)
    for (let k = from; k < done; k++) {
      for (let i = 0; i < DELAYS; i++) {
        const rate = rates[k * DELAYS + i]!
        if (Number.isNaN(rate)) continue
        image.data.set([...colour(rate, dark), 255], 4 * ((DELAYS - 1 - i) * (done - from) + k - from))
      }
    }
    picture.getContext('2d', { willReadFrequently: true })!.putImageData(image, from, 0)
  }
  const run = async () => {
    if (running) return
    running = true
    while (subject && done < subject.vehicles.length && going()) {
      const { vehicles, highest, steps } = subject
      const asked = subject
      const more = await client.ask('growthRates', { vehicles: vehicles.slice(done), highest, count: DELAYS, steps, budget: PART })
      if (asked !== subject) continue
      const from = done
      rates.set(more, from * DELAYS)
      done += more.length / DELAYS
      paint(from)
      progress()
    }
    running = false
  }
  return {
    /** Computes this map from now on; null: none. */
    show(next: Subject | null) {
      if (next?.key !== subject?.key) {
        this.halt()
        subject = next
        done = 0
        rates = new Float64Array((next?.vehicles.length ?? 0) * DELAYS)
        picture.width = Math.max(1, next?.vehicles.length ?? 0)
      }
      void run()
    },
    /** Stops after the present slice; `show` goes on. */
    halt() {
      if (running) void client.ask('haltGrowthRates', {})
    },
    /** How much of it is there, 0 … 1. */
    part: (): number => (subject ? done / subject.vehicles.length : 0),
    /** Draws it. `left` and `right`: places of the first and the last number of vehicles; `top` and `bottom`: places of the
     * longest reaction time and of 0, px. */
    draw(c: CanvasRenderingContext2D, left: number, right: number, top: number, bottom: number, isDark: boolean) {
      if (dark !== isDark) {
        dark = isDark
        paint(0)
      }
      const w = (right - left) / Math.max(1, picture.width - 1)
      const h = (bottom - top) / (DELAYS - 1)
      c.drawImage(picture, left - w / 2, top - h / 2, right - left + w, bottom - top + h)
    },
  }
}
