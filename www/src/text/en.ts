// Every text of the page, in English; a second language is a second object of this type. The core's refusals are shown in the
// core's own words.
import { exactly, fixed, span, spans, unit } from './format'
import type { Growth, StabilitySummary, WindowEnd } from '../core/protocol'

const seconds = (s: number) => unit(fixed(s, 3), 's')
/** A critical reaction time (s); null: every reaction time is stable. */
const tau = (s: number | null) => (s === null ? '–' : s >= 1000 ? unit('over 1000', 's') : unit(exactly(s, s < 10 ? 3 : s < 100 ? 1 : 0), 's'))
/** Two significant digits. */
const short = (x: number) => String(Number(x.toPrecision(2)))
const jams = (n: number) => (n === 1 ? '1 jam' : `${n} jams`)
const growth = (rate: number) => `${rate > 0 ? 'doubles' : 'halves'} every ${span(Math.LN2 / Math.abs(rate))}`
/** The same as a range, unless the error is below a twentieth of the rate: the error is the bound on what is not linear and two
 * standard errors. */
function within({ rate, nonlinear_bound, standard_error }: Growth): string {
  const error = nonlinear_bound + 2 * standard_error
  if (error < 0.05 * Math.abs(rate)) return growth(rate)
  if (nonlinear_bound >= Math.abs(rate)) return 'waves too large to tell'
  if (error >= Math.abs(rate)) return 'not clear yet'
  const [fast, slow] = [error, -error].map(e => Math.LN2 / (Math.abs(rate) + e))
  return `${rate > 0 ? 'doubles' : 'halves'} every ${spans(fast!, slow!)}`
}

export const en = {
  title: 'Ringroad',
  subtitle: 'traffic jams out of nothing',

  boot: {
    failed: (why: string) => `Ringroad cannot start here: ${why}`,
    advice:
      'It needs WebAssembly. A page opened from disk, or shown under a strict security policy, may not load it: open the one-file version, ringroad.html, or ask whoever runs the site to allow ‘wasm-unsafe-eval’.',
    oneFile: 'Open ringroad.html',
  },

  header: {
    presets: 'Experiments',
    choose: 'Experiments …',
    share: 'Share',
    files: 'Data',
    figures: 'Figures',
    lab: 'Laboratory',
    help: 'Help',
    fullscreen: 'Full screen',
    next: 'Try next:',
    close: 'Close',
  },

  problem: {
    title: 'That did not work',
    over: 'The run ended in a collision: go back first.',
    dismiss: 'Dismiss',
  },

  summary: {
    stable: 'Stable',
    unstable: 'Unstable',
    open: 'No wave',
    critical: (v: StabilitySummary): string => {
      if (v.stable === null) return 'No wave can run on this ring: its vehicles stand, or there is only one.'
      if (!v.homogeneous && v.scale !== null) {
        return v.stable
          ? `With these drivers every small wave fades, up to reaction times ${fixed(v.scale, 2)} times as long.`
          : `With these drivers a small wave grows; it would fade with ${fixed(v.scale, 2)} times their reaction times.`
      }
      if (!v.homogeneous || v.critical_discrete === null) {
        return v.stable
          ? 'With these drivers every small wave fades.'
          : 'With these drivers a small wave grows.'
      }
      if (v.critical_discrete <= 0) return `Drivers react after ${seconds(v.reaction_time)}; no delay at all would be small enough.`
      return `Drivers react after ${seconds(v.reaction_time)}; this ring tolerates ${tau(v.critical_discrete)}${v.critical === null || v.critical >= 1000 ? '' : ` (τ = ${tau(v.critical)})`}.`
    },
    wave: (v: StabilitySummary): string => {
      if (v.stable === null || v.rate === null || v.mode === null || v.rate === 0) return ''
      return v.stable
        ? `Its slowest wave, ${jams(v.mode)}, ${growth(v.rate)}.`
        : `Its fastest wave, ${jams(v.mode)}, ${growth(v.rate)}.`
    },
    lane: (lane: number): string => `Lane ${lane}:`,
    measured: (g: Growth, large: boolean): string => {
      const over = g.window < 59 ? `measured, ${span(g.window)}: ` : 'measured: '
      const now = large ? '; now large waves' : ''
      if (Math.abs(g.rate) < 2 * g.standard_error || Math.abs(g.rate) < 1e-6) return `${over}neither grows nor fades${now}`
      return over + within(g) + now
    },
    measuring: 'measuring …',
    large: 'large waves, beyond linear theory',
    crash: (t: number, a: number, b: number): string => `Crash at t = ${unit(exactly(t, 2), 's')}: vehicle ${a} ran into vehicle ${b}.`,
    crashAdvice: 'Go back with the time line, lower the reaction time, or restart.',
    end: (t: number): string => `the run ends here, at t = ${unit(fixed(t, 2), 's')}`,
    goOn: 'Go on',
  },

  ring: {
    title: 'The ring',
    size: (n: number, km: string, lanes: number): string =>
      `${n} ${n === 1 ? 'car' : 'cars'} on ${lanes > 1 ? `${lanes} × ` : ''}${unit(km, 'km')}`,
    mean: 'mean speed',
    speed: (v: number): string => unit(exactly(v, 1), 'm/s'),
    kmh: (v: number): string => unit(fixed(v * 3.6, 0), 'km/h'),
    flow: (q: number): string => unit(fixed(q * 3600, 0), 'veh/h'),
    density: (rho: number): string => unit(fixed(rho * 1000, 1), 'veh/km'),
    canvas: 'The ring seen from above. Arrow keys choose a car, B brakes it.',
    travel: 'travel →',
    car: (n: number): string => `car ${n}`,
    colour: 'Colour',
    colours: { difference: 'against v∞', speed: 'speed', frustration: 'frustration' },
    hint: (s: number): string => `Click a car to watch it; press it longer to brake it for ${unit(String(s), 's')}.`,
  },

  legend: {
    difference: { low: 'slower', high: 'faster', unit: 'm/s', name: 'difference from the equilibrium speed' },
    speed: { low: '', high: '', unit: 'm/s', name: 'speed' },
    frustration: { low: 'calm', high: 'frustrated', unit: '', name: 'frustration φ' },
  },

  map: {
    title: 'Space and time',
    note: { difference: 'speed against v∞, log scale', speed: 'speed' },
    canvas: 'Space-time map: position upwards, time to the right.',
    position: 'position (m)',
    coMovingPosition: 'position, co-moving (m)',
    time: 'time (s)',
    lane: 'Lane',
    coMoving: 'Co-moving',
    coMovingHint: 'Move with the equilibrium speed v∞',
    reading: (t: number, x: number, v: number, d: number): string =>
      `t = ${unit(exactly(t, 1), 's')}, x = ${unit(fixed(x, 0), 'm')}: ${unit(exactly(v, 2), 'm/s')} (${d >= 0 ? '+' : ''}${exactly(d, Math.abs(d) < 0.1 ? 3 : 2)})`,
  },

  speeds: {
    title: 'Speeds',
    note: (v: number): string => `dashed: v∞ = ${unit(exactly(v, 2), 'm/s')}`,
    unit: 'm/s',
    car: (n: number): string => `car ${n}`,
    equilibrium: 'v∞',
    chart: 'Speeds of some cars over time.',
  },

  chart: {
    kind: 'chart',
    hint: 'Arrow keys read values.',
    time: (t: string): string => `t = ${t}`,
  },

  transport: {
    title: 'Playback',
    play: 'Play',
    pause: 'Pause',
    step: 'Step',
    restart: 'Restart',
    playback: 'Playback speed',
    times: (x: number): string => `× ${x}`,
    time: (t: number, decimals: number): string => `t = ${unit(exactly(t, decimals), 's')}`,
    line: 'Time line',
    lineValue: (t: number): string => `${fixed(t, 1)} seconds`,
    behind: (x: number): string => `This machine manages about × ${x >= 10 ? fixed(x, 0) : fixed(x, 1)}.`,
    replaying: 'Replaying …',
  },

  controls: {
    title: 'Drivers and road',
    more: 'More',
    less: 'Fewer',
    reset: (name: string): string => `Put ${name} back to what was opened`,
    drivers: 'Every driver',
    road: 'Road and run',
    names: {
      vehicles: 'Vehicles',
      length: 'Ring length',
      lanes: 'Lanes',
      time_step: 'Time step',
      until: 'End of the run',
      seed: 'Seed',
      max_speed: 'Top speed',
      sensitivity: 'Sensitivity',
      min_headway: 'Minimum headway',
      vehicle_length: 'Vehicle length',
      reaction_time: 'Reaction time',
      frustration_rate: 'Frustration rate',
      pass_frustration: 'Frustration by a pass',
    } as Record<string, string>,
    units: { '': '', s: 'seconds', m: 'metres', 'm/s': 'metres per second', '1/s': 'per second' } as Record<string, string>,
    number: (name: string): string => `${name}, as a number`,
    allowed: (name: string, whole: boolean, min: number, max: number, unit: string): string =>
      `${name}: ${whole ? 'a whole number' : 'a number'} from ${min} to ${max} ${unit}`.trim(),
    start: 'Start',
    starts: {
      uniform: 'uniform',
      'one-lane': 'all in lane 1',
      staggered: 'staggered',
      random: 'random',
    } as Record<string, string>,
    nudge: (n: number): string => `Nudge car ${n}`,
    nudgeHint: 'Push it 1 m ahead',
    brake: (n: number): string => `Brake car ${n}`,
    brakeHint: 'Stand still for 3 s (key B)',
  },

  tabs: { label: 'More views', lanes: 'Lanes', car: 'Car', actions: 'Actions', stability: 'Stability' },

  lanes: {
    imbalance: 'ΔN, fullest minus emptiest lane',
    flow: (window: number): string => `flow at L/2 over ${unit(fixed(window, 2), 's')} (veh/h)`,
    symbol: 'ΔN',
    flowName: 'flow',
    one: 'One lane: ΔN is 0.',
    counts: (counts: readonly number[]): string => counts.map((n, k) => `lane ${k + 1}: ${n}`).join(' · '),
    changes: (n: number): string => (n === 1 ? '1 lane change so far' : `${n} lane changes so far`),
    imbalanceChart: 'Difference between the fullest and the emptiest lane over time.',
    flowChart: 'Flow over time, vehicles per hour.',
  },

  car: {
    which: 'Vehicle',
    speed: 'speed',
    headway: 'headway',
    perceived: 'headway as seen',
    frustration: 'frustration φ',
    attempt: 'P(φ), attempt within 1 s',
    changes: 'lane changes',
    distance: 'distance driven',
    lane: 'lane',
    own: 'Its own parameters, from now on',
    set: 'Set',
  },

  actions: {
    none: 'Nothing has been done yet. Press a car, move a slider, or nudge.',
    remove: (text: string): string => `Remove ${text} and replay`,
    clear: 'Restart without them',
    clearHint: 'Keeps what belongs to t = 0',
    at: (t: string): string => `${t} s`,
    vehicles: (selector: string): string =>
      selector === 'all' ? 'all cars' : /^\d+$/.test(selector) ? `car ${selector}` : selector.endsWith('%') ? `${selector} of the cars` : `cars ${selector}`,
    brake: (s: string): string => `brake for ${s} s`,
    nudge: (m: string): string => `nudge by ${m} m`,
    add: 'Add',
    addLabel: 'Do now, such as 7:brake=3',
  },

  live: {
    state: (t: number, mean: number, slowest: number, fastest: number): string =>
      `${fixed(t, 0)} seconds. Mean speed ${exactly(mean, 1)} metres per second, from ${exactly(slowest, 1)} to ${exactly(fastest, 1)}.`,
    standing: (count: number): string =>
      count === 0 ? 'Nobody stands.' : count === 1 ? 'One car stands.' : `${count} cars stand.`,
    playing: 'Playing.',
    paused: 'Paused.',
  },

  diagram: {
    title: 'Where waves grow',
    stable: 'stable',
    unstable: 'unstable',
    jam: 'jam',
    /** `lane`: its number where there are several, else null. */
    vehicles: (lane: number | null): string => (lane === null ? 'vehicles N' : `vehicles in lane ${lane}`),
    /** Shorter, for beside the colour bar. */
    vehiclesShort: (lane: number | null): string => (lane === null ? 'vehicles N' : `N in lane ${lane}`),
    reaction: 'reaction time Δ (s)',
    handle: 'Vehicles and reaction time',
    kind: 'two-way slider',
    hint: 'Drag the point, or use its arrow keys: ← → vehicles, ↑ ↓ reaction time. A new N starts again.',
    hintLanes: (lane: number, each: boolean): string =>
      `The diagram is of lane ${lane}, like the summary. Drag the point, or use its arrow keys: ← → vehicles, ↑ ↓ reaction time. A new number starts again, with as many ${each ? 'in every lane' : 'in the one lane of the start'}.`,
    value: (n: number, lane: number | null, delta: number, state: string): string =>
      `${n} vehicles${lane === null ? '' : ` in lane ${lane}`}, reaction time ${fixed(delta, 2)} seconds${state === '' ? '' : `: ${state}`}`,
    drag: 'drag the point',
    /** The curves, each with its value at the point's N (s). */
    discrete: (s: number | null): string => `τ in steps: ${tau(s)}`,
    continuous: (s: number | null): string => `τ continuous: ${tau(s)}`,
    newell: (s: number | null): string => `Newell’s limit: ${tau(s)}`,
    describe: (n: number, lane: number | null, discrete: number | null, continuous: number | null, newell: number | null): string =>
      `The diagram of vehicles${lane === null ? '' : ` in lane ${lane}`} and reaction time. ${discrete === null && continuous === null ? `With ${n} vehicles nothing moves: a jam.` : `With ${n} vehicles the curve stands at ${tau(discrete)} in the run’s steps, in continuous time at ${tau(continuous)}, Newell’s limit at ${tau(newell)}; above the curve waves grow.`}`,
    /** For heterogeneous drivers. */
    titleAlike: 'If all drivers were equal',
    alike: 'The drivers of this ring differ. The diagram is for equal drivers: those without values of their own.',
    shading: 'What the diagram shows',
    shadings: { regions: 'regions', steps: 'in steps', continuous: 'continuous' },
    rates: 'growth rate',
    every: 'modes',
    everyHint: 'The critical reaction time of every single mode: of the run’s steps, or of continuous time with its growth rate',
    map: (part: number): string =>
      part < 1 ? `Growth rates: ${fixed(100 * part, 0)} % computed.` : 'Colours show the largest growth rate, from blue, fading, to orange, growing.',
    rate: (rate: number): string => (rate > 0 ? `+${rate}` : fixed(rate, 2)),
    rateUnit: '1/s',
  },

  roots: {
    title: 'Characteristic roots',
    real: 'growth Re s (1/s)',
    imaginary: 'Im s (1/s)',
    dominant: 'leading roots',
    next: 'next roots',
    fades: 'fades',
    grows: 'grows',
    describe: (right: readonly number[], count: number, fastest: string): string =>
      `${right.length === 0 ? `All ${count} modes lie left of the imaginary axis: they fade.` : `Right of the imaginary axis, growing: ${right.length === 1 ? 'mode' : 'modes'} ${right.join(', ')} of ${count}.`} ${fastest}`,
    largest: (mode: number, rate: number): string => `Mode ${mode} has the largest growth rate, ${unit(exactly(rate, 4), '1/s')}.`,
    none: 'Nothing moves here: no roots.',
  },

  modes: {
    title: 'Growth, measured',
    axis: 'mode q',
    rate: 'growth (1/s)',
    predicted: 'theory',
    measured: 'measured',
    waiting: (t: number): string => `Measuring from t = ${unit(fixed(t, 1), 's')} on …`,
    changing: 'Lane changes go on: nothing measured.',
    nothing: 'Nothing is measured yet.',
    quiet: 'No wave to measure: nudge a car.',
    /** What ended the time, from `from` to `to` (s), in which the mode was linear; its rate is known to ±`bound` (1/s). */
    ended: {
      end_of_run: (from, _to, bound) => `Linear since t = ${unit(fixed(from, 1), 's')}${bound === null ? '' : `, within ±${unit(short(bound), '1/s')}`}.`,
      left_linear_regime: (_from, to, bound) =>
        `Left the linear regime at t = ${unit(fixed(to, 1), 's')}${bound === null ? '' : `; until then within ±${unit(short(bound), '1/s')}`}.`,
      disturbed: (_from, to) => `Disturbed at t = ${unit(fixed(to, 1), 's')}.`,
      sank_into_rounding: (_from, to) => `Faded into rounding at t = ${unit(fixed(to, 1), 's')}.`,
      never_linear: () => '',
    } as Record<WindowEnd, (from: number, to: number, bound: number | null) => string>,
    large: 'Waves are too large now for linear theory.',
    differ: 'Drivers differ: modes mix.',
    differHint: 'Theory: the ring’s roots, each followed from the mode of equal drivers.',
    none: 'Nothing moves here: no waves.',
    bound: 'The waves’ size may have moved the rate by so much at most.',
    one: (mode: number, rate: number, predicted: number | null): string =>
      `mode ${mode}: ${exactly(rate, 4)}${predicted === null ? '' : ` against ${exactly(predicted, 4)}`}`,
    describe: (list: string): string => (list === '' ? 'Growth of each mode: nothing measured yet.' : `Growth per second, measured against theory: ${list}.`),
  },
}

export type Dictionary = typeof en