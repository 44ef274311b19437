// What crosses from the core to the page. Generated from the structs in src/web/types.rs; do not edit.
// `WRITE_TYPES=1 cargo test --lib web::types` writes this file anew.

/**
 * What the page gets once, when the core has started.
 */
export type Start = { 
/**
 * The core's table of parameters.
 */
parameters: Array<Parameter>, 
/**
 * Scenarios with names.
 */
presets: Array<Preset>, 
/**
 * Size of the space-time map.
 */
map: MapShape, 
/**
 * Version of the program.
 */
version: string, };

/**
 * Size of the space-time map.
 */
export type MapShape = { 
/**
 * Columns, one an interval of time.
 */
columns: number, 
/**
 * Cells of a column, from x = 0 to x = L.
 */
bins: number, };

/**
 * One row of the core's table of parameters.
 */
export type Parameter = { 
/**
 * Name, with underscores.
 */
name: string, 
/**
 * Symbol in formulas; empty where there is none.
 */
symbol: string, 
/**
 * Unit; empty for a pure number.
 */
unit: string, 
/**
 * Default value.
 */
default: number, 
/**
 * Smallest allowed value.
 */
min: number, 
/**
 * Largest allowed value.
 */
max: number, 
/**
 * Range of the slider, if it has one.
 */
slider: Slider | null, 
/**
 * Whether only whole numbers are allowed.
 */
whole: boolean, 
/**
 * What it means, in one line.
 */
meaning: string, 
/**
 * What it belongs to.
 */
of: Owner, };

/**
 * Range of a slider.
 */
export type Slider = { 
/**
 * Smallest value.
 */
min: number, 
/**
 * Largest value.
 */
max: number, 
/**
 * Distance between neighbouring values.
 */
step: number, };

/**
 * What a parameter belongs to.
 */
export type Owner = "road" | "driver";

/**
 * A scenario with a name.
 */
export type Preset = { 
/**
 * Name, as a link writes it.
 */
name: string, 
/**
 * Title.
 */
title: string, 
/**
 * What to notice.
 */
notice: string, 
/**
 * What to try next.
 */
next: string, 
/**
 * The scenario.
 */
scenario: Scenario, };

/**
 * A scenario in the core's JSON form.
 */
export type Scenario = { 
/**
 * Version of the form.
 */
version: number, 
/**
 * Vehicles, all lanes together.
 */
vehicles: number, 
/**
 * Length of the ring, m.
 */
length: number, 
/**
 * Number of lanes.
 */
lanes: number, 
/**
 * Time step, s.
 */
time_step: number, 
/**
 * End of the run, s.
 */
until: number, 
/**
 * Seed of every random draw.
 */
seed: number, 
/**
 * How the vehicles are placed at t = 0.
 */
start: string, 
/**
 * Parameters of the default driver, by name.
 */
driver: Record<string, number>, 
/**
 * Driver overrides: `7:sensitivity=2`.
 */
exceptions: Array<string>, 
/**
 * Timed actions: `at=40:7:brake=3`.
 */
actions: Array<string>, };

/**
 * What changes by actions and settings only.
 */
export type Snapshot = { 
/**
 * The scenario with all actions made so far.
 */
scenario: Scenario, 
/**
 * The part of a link after the #.
 */
link: string, 
/**
 * Parameters, by name, that now hold for every driver without an override.
 */
driver: Record<string, number>, 
/**
 * What theory says of the ring as it is now.
 */
stability: StabilitySummary, 
/**
 * Numbers (from 1) of the vehicles whose speeds are in the rows.
 */
watched: Array<number>, 
/**
 * Seconds between two rows, and between two columns of the map.
 */
interval: number, 
/**
 * Seconds that the whole map holds.
 */
map_window: number, 
/**
 * Window of the flow in the rows, s.
 */
flow_window: number, 
/**
 * Equilibrium speed with the vehicles spread evenly over all lanes, m/s.
 */
mean_equilibrium_speed: number, 
/**
 * Counts what changed the stability summary or the drivers; differs from a frame's when this snapshot is out of date.
 */
changes: number, };

/**
 * What linear theory says of the least stable lane.
 */
export type StabilitySummary = { 
/**
 * Whether every wave fades in the run's time steps; `null` where no wave can exist.
 */
stable: boolean | null, 
/**
 * Whether all drivers are the same.
 */
homogeneous: boolean, 
/**
 * Delay in force, s; the mean where drivers differ.
 */
reaction_time: number, 
/**
 * Critical reaction time in continuous time, s; `null` where every reaction time is stable.
 */
critical: number | null, 
/**
 * The same for the run's time step.
 */
critical_discrete: number | null, 
/**
 * Where drivers differ: the factor by which all reaction times may grow before waves do.
 */
scale: number | null, 
/**
 * Largest growth rate of the run, 1/s; `null` where nothing can grow or decay.
 */
rate: number | null, 
/**
 * Mode of the fastest wave: its number of jams.
 */
mode: number | null, 
/**
 * Equilibrium speed of the lane, m/s.
 */
equilibrium_speed: number, 
/**
 * Equilibrium flow of the lane, vehicles per second.
 */
flow: number, 
/**
 * Density of the lane, vehicles per metre.
 */
density: number, 
/**
 * The lane, from 1.
 */
lane: number, 
/**
 * Vehicles in it.
 */
vehicles: number, };

/**
 * The state of a frame, apart from its values for every vehicle.
 */
export type FrameState = { 
/**
 * Time, s.
 */
time: number, 
/**
 * Steps taken since t = 0.
 */
step: number, 
/**
 * Whether the run is over.
 */
finished: boolean, 
/**
 * The collision that ended the run.
 */
collision: Collision | null, 
/**
 * What the traffic does now.
 */
traffic: Traffic, 
/**
 * What was recorded since the frame before.
 */
rows: Rows, 
/**
 * Which run this is; it grows when one begins anew.
 */
epoch: number, 
/**
 * Differs from the snapshot's when that is out of date.
 */
changes: number, 
/**
 * Growth measured in the run; `null` while there is not enough of it.
 */
growth: Growth | null, 
/**
 * Whether waves are now too large for linear theory; `growth` is from before then.
 */
large: boolean, };

/**
 * The traffic of all lanes together at one instant.
 *
 * ```
 * use ringroad::live::traffic::Traffic;
 * use ringroad::scenario::Scenario;
 * use ringroad::simulation::Simulation;
 *
 * let simulation = Simulation::new(&Scenario::default())?;
 * let traffic = Traffic::of(&simulation);
 * assert_eq!(traffic.density, 0.05); // 50 vehicles on 1000 m
 * assert_eq!(traffic.vehicles_per_lane, [50]);
 * # Ok::<(), ringroad::error::Error>(())
 * ```
 */
export type Traffic = { 
/**
 * Mean speed of all vehicles, m/s.
 */
mean_speed: number, 
/**
 * Speed of the slowest vehicle, m/s.
 */
lowest_speed: number, 
/**
 * Speed of the fastest vehicle, m/s.
 */
highest_speed: number, 
/**
 * Number of vehicles slower than 0.1 m/s.
 */
standing: number, 
/**
 * Vehicles per metre of road, all lanes together.
 */
density: number, 
/**
 * Density times mean speed, vehicles per second, all lanes together.
 */
flow: number, 
/**
 * Lane changes of all vehicles since t = 0.
 */
lane_changes: number, 
/**
 * Number of vehicles in each lane, lane 1 first.
 */
vehicles_per_lane: Array<number>, };

/**
 * A collision.
 */
export type Collision = { 
/**
 * Time, s.
 */
time: number, 
/**
 * The vehicle behind, from 0.
 */
behind: number, 
/**
 * The vehicle ahead, from 0.
 */
ahead: number, 
/**
 * The lane, from 0.
 */
lane: number, };

/**
 * What is recorded at every interval, column by column.
 */
export type Rows = { 
/**
 * Time, s.
 */
time: Array<number>, 
/**
 * Mean speed, m/s.
 */
mean: Array<number>, 
/**
 * Flow through L/2, vehicles per second; `null` until its window has passed.
 */
flow: Array<number | null>, 
/**
 * ΔN: vehicles in the fullest lane minus those in the emptiest.
 */
imbalance: Array<number>, 
/**
 * Speed (m/s) of each watched vehicle.
 */
speeds: Array<Array<number>>, };

/**
 * Growth of the fastest wave, measured in the run.
 */
export type Growth = { 
/**
 * Growth rate, 1/s.
 */
rate: number, 
/**
 * Its standard error, 1/s.
 */
standard_error: number, 
/**
 * How far the size of the waves may have moved the rate, 1/s.
 */
nonlinear_bound: number, 
/**
 * Length of the time over which it was measured, s.
 */
window: number, 
/**
 * Fourier mode of the wave.
 */
mode: number, };

/**
 * What a colour stands for.
 */
export type Quantity = "difference" | "speed" | "frustration";

/**
 * The colour bars of ring and map.
 */
export type ColourBars = { 
/**
 * Of the vehicles on the ring.
 */
ring: ColourBar, 
/**
 * Of the map.
 */
map: ColourBar, };

/**
 * A colour bar.
 */
export type ColourBar = { 
/**
 * Red, green, blue of its colours, from the lowest value to the highest.
 */
colours: Array<number>, 
/**
 * Values to write beside it.
 */
ticks: Array<Tick>, };

/**
 * A value beside a colour bar.
 */
export type Tick = { 
/**
 * The value.
 */
value: number, 
/**
 * Its place, from 0 to 1.
 */
place: number, };

/**
 * What the map shows at a place.
 */
export type MapReading = { 
/**
 * Time, s.
 */
time: number, 
/**
 * Position on the road, m.
 */
position: number, 
/**
 * Speed, m/s; `null` in an empty lane.
 */
speed: number | null, 
/**
 * Speed minus the equilibrium speed at that time, m/s; `null` in an empty lane.
 */
difference: number | null, };

/**
 * The stability diagram of the lane that the stability summary speaks of.
 */
export type StabilityDiagram = { 
/**
 * Critical reaction times.
 */
curves: Curves, 
/**
 * The number of vehicles beyond which the lane is a jam.
 */
jam: number, 
/**
 * Reaction time of its drivers, s; where drivers differ, of those without an override.
 */
reaction_time: number, };

/**
 * Critical reaction times over the number of vehicles in the lane; `null` where every reaction time is stable.
 */
export type Curves = { 
/**
 * Numbers of vehicles, ascending.
 */
vehicles: Array<number>, 
/**
 * In continuous time, s.
 */
continuous_s: Array<number | null>, 
/**
 * In the run's time steps, s.
 */
discrete_s: Array<number | null>, 
/**
 * Newell's limit 1/(2c), s.
 */
newell_s: Array<number | null>, };

/**
 * The roots of a lane as a picture shows them.
 */
export type LaneRoots = { 
/**
 * Vehicles in the lane.
 */
vehicles: number, 
/**
 * Whether all its drivers are the same to the theory, so that its modes are Fourier's.
 */
equal_drivers: boolean, 
/**
 * The modes shown.
 */
modes: Array<number>, 
/**
 * Growth rate (1/s) of each in the simulation's steps; `None` where the root could not be followed.
 */
growth_per_s: Array<number | null>, 
/**
 * Angular frequency (1/s) of each in steps.
 */
frequency_per_s: Array<number | null>, 
/**
 * The next roots of the modes, in continuous time.
 */
next: Array<ModeRoot>, };

/**
 * A characteristic root in continuous time.
 */
export type ModeRoot = { 
/**
 * q.
 */
mode: number, 
/**
 * The branch of Lambert's W; of heterogeneous drivers, the branch of homogeneous drivers from which it was followed.
 */
branch: number, 
/**
 * Re s, 1/s.
 */
real_per_s: number, 
/**
 * Im s, 1/s.
 */
imaginary_per_s: number, 
/**
 * What rounding has left of the equation, as a change of the root, relative to max(1, |s|).
 */
residual: number, };

/**
 * Growth of the modes of a lane since the last change.
 */
export type ModalGrowth = { 
/**
 * The time from which growth is measured, s.
 */
starts: number, 
/**
 * Number of modes that are or will be measured, from mode 1 on.
 */
followed: number, 
/**
 * The modes measured; none until there is something to measure.
 */
modes: Array<ModeGrowth>, };

/**
 * Growth of one mode since the last change.
 */
export type ModeGrowth = { 
/**
 * The mode, from 1.
 */
mode: number, 
/**
 * Growth rate measured, 1/s; `null` while there is none.
 */
rate: number | null, 
/**
 * Its standard error, 1/s.
 */
standard_error: number | null, 
/**
 * Growth rate by theory, 1/s; where drivers differ, of the root followed from this mode of equal drivers.
 */
predicted: number | null, 
/**
 * How far the size of the waves may have moved the rate, 1/s.
 */
nonlinear_bound: number | null, 
/**
 * Start of the time in which the mode was linear, s.
 */
from: number | null, 
/**
 * Its end, s.
 */
to: number | null, 
/**
 * What ended it.
 */
ended_by: WindowEnd, };

/**
 * What ended the linear window of a mode.
 */
export type WindowEnd = "end_of_run" | "left_linear_regime" | "sank_into_rounding" | "disturbed" | "never_linear";

/**
 * A figure of the paper, or beyond it.
 */
export type FigureInfo = { 
/**
 * Identifier.
 */
id: string, 
/**
 * Title.
 */
title: string, 
/**
 * Caption.
 */
caption: string, 
/**
 * Whether it goes beyond the paper.
 */
beyond: boolean, 
/**
 * Number of its tasks.
 */
tasks: number, };

/**
 * A claim of the paper beside what is measured here; numbers are written with their units.
 */
export type Claim = { 
/**
 * What is claimed.
 */
claim: string, 
/**
 * The paper's value.
 */
paper: string, 
/**
 * The value measured here.
 */
ours: string, 
/**
 * Whether they agree.
 */
verdict: ClaimVerdict, 
/**
 * How it was measured.
 */
method: string, };

/**
 * Whether the paper and the measurement agree.
 */
export type ClaimVerdict = "agrees" | "differs" | "open";

/**
 * The rectangle between the axes of a panel, in units of the picture, and the values that can be read in it.
 */
export type Field = { 
/**
 * The panel's title.
 */
title: string, 
/**
 * Left edge.
 */
left: number, 
/**
 * Upper edge.
 */
top: number, 
/**
 * Width.
 */
width: number, 
/**
 * Height.
 */
height: number, 
/**
 * What the horizontal axis measures, with the unit.
 */
x: string, 
/**
 * What the vertical axis measures, with the unit.
 */
y: string, 
/**
 * Its curves, points and maps, as far as they lie between the axes.
 */
marks: Array<Mark>, };

/**
 * Values that can be read off a picture (seven digits of them), and where they are drawn, in units of the picture.
 */
export type Mark = { "kind": "curve", 
/**
 * Its name; empty where it is alone.
 */
name: string, 
/**
 * Abscissae.
 */
x: Array<number>, 
/**
 * Ordinates.
 */
y: Array<number>, 
/**
 * Lower ends of the band about the curve, or of the error bars; empty where there are none.
 */
low: Array<number | null>, 
/**
 * Upper ends; empty where there are none.
 */
high: Array<number | null>, 
/**
 * Distance of the points from the left edge of the picture.
 */
right: Array<number>, 
/**
 * Distance of the points from the upper edge of the picture.
 */
down: Array<number>, } | { "kind": "map", 
/**
 * What its values mean, or their unit.
 */
name: string, 
/**
 * Number of cells along x, which is the length of a row of `values`.
 */
width: number, 
/**
 * Centres of the first and the last cell along x.
 */
x: [number, number], 
/**
 * Centres of the first and the last cell along y.
 */
y: [number, number], 
/**
 * Values, row by row, from the lowest y; `null` where there is none.
 */
values: Array<number | null>, 
/**
 * Left and right edge in the picture.
 */
across: [number, number], 
/**
 * Lower and upper edge in the picture.
 */
up: [number, number], };
