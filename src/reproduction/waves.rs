//! A small disturbance at three reaction times: speeds of five vehicles, and maps of flow and speed over space and time.

use super::claim::{Claim, Estimate, Expected, short};
use super::cyclic::{Choice, Depths, TAKEN, equilibrium_speed, round_trip};
use super::figure::{Figure, FigureTable, Outcome};
use super::shared::{column, indicator, measured, nudged, numbers, refilled};
use super::task::{Size, TaskResult};
use super::wave_analysis::{SETTLING, WaveAnalysis};
use crate::format::table::{Column, Table};
use crate::measurement::Measurement;
use crate::measurement::probe::Probe;
use crate::numerics::exp::exp;
use crate::plot::{Axis, Layer, Panel, Plot};
use crate::scenario::Scenario;
use crate::scenario::driver::Driver;
use crate::simulation::Simulation;

const ID: &str = "waves";

pub(super) const FIGURE: Figure = Figure {
    id: ID,
    title: "A small disturbance at three reaction times",
    caption: "Fifty vehicles in one lane, vehicle 1 displaced by 1 m at t = 0, steps of 0.01 s. Above: speeds of \
              vehicles 1, 11, 21, 31 and 41 less the equilibrium speed, on a scale that is logarithmic beyond 0.01 m/s, with \
              the exponential fitted to the smallest speeds of vehicle 21 in three round trips of the disturbance (dashed). \
              Middle: flow over a window of 18.63 s, in which ten vehicles pass in equilibrium, as in the paper. Below: speed \
              less the equilibrium speed, which shows also what is too small to change a count of vehicles; blue is \
              slower. The run at 0.75 s ends in a collision.",
    beyond: false,
    tasks,
    start: |size, task| Box::new(move || run(size, task)),
    assemble,
};

/// Δ of the columns of panels, s, and the cyclic growth rates that the paper gives.
const CASES: [(f64, f64); 3] = [(0.0, -1.073), (0.5, -0.790), (0.75, 0.443)];
/// Further delays for which the time of the collision is measured, s: one step shorter and one longer than 0.75 s.
const NEIGHBOURS: [f64; 2] = [0.74, 0.76];
/// Cells of the map of speed along the road.
const CELLS: usize = 100;
/// δ, the window of the flow, s.
const WINDOW: f64 = 18.63;

fn tasks(_: Size) -> Vec<String> {
    let panels = CASES.iter().map(|c| format!("reaction time {} s", c.0));
    panels.chain(NEIGHBOURS.iter().map(|d| format!("collision at {d} s"))).collect()
}

fn scenario(size: Size, reaction_time: f64) -> Scenario {
    nudged(reaction_time, 1.0, size.choose(300.0, 300.0))
}

fn measurements(size: Size) -> [Measurement; 3] {
    let bins = size.choose(100, 50);
    [
        Measurement::Speeds { every: 0.5, vehicles: None },
        Measurement::FlowMap { every: size.choose(1.0, 5.0), bins, window: WINDOW },
        Measurement::SpeedMap { every: 1.0, bins: CELLS, lane: 1 },
    ]
}

/// Of a reaction time of the figure: the columns of the three tables; then velocity, its uncertainty, mode and congested
/// stretches; the deviation of speeds; the time of the collision; and all [`Depths`]. Of a further delay: the time of
/// the collision.
fn run(size: Size, task: usize) -> TaskResult {
    let Some(&(reaction_time, _)) = CASES.get(task) else {
        let scenario = scenario(size, NEIGHBOURS[task - CASES.len()]);
        let (_, simulation) = measured(&scenario, &[]);
        return TaskResult { columns: vec![vec![collision_time(&simulation)]] };
    };
    let scenario = scenario(size, reaction_time);
    let probe = |m: &Measurement| m.probe(&scenario).expect("measurements of figures are valid");
    let probes: Vec<Box<dyn Probe>> = measurements(size).iter().map(probe).collect();
    let (depths, tables, simulation) = Depths::measure(&scenario, probes);
    let [speeds, flow, map] = &tables[..] else { unreachable!("three measurements") };
    let mut columns: Vec<_> = [speeds, flow, map].into_iter().flat_map(numbers).collect();
    let waves = WaveAnalysis::of(&column(map, "speed_m_per_s"), CELLS, scenario.length);
    columns.push(vec![
        waves.velocity.value,
        waves.velocity.uncertainty,
        waves.mode as f64,
        waves.congested as f64,
    ]);
    columns.push(waves.deviation);
    columns.push(vec![collision_time(&simulation)]);
    columns.extend(depths.into_columns());
    TaskResult { columns }
}

/// Time of the collision, s; NaN without one.
fn collision_time(simulation: &Simulation) -> f64 {
    simulation.collision().map_or(f64::NAN, |c| c.time)
}

/// The task result of a reaction time, taken apart.
struct Case<'a> {
    reaction_time: f64,
    tables: [Table; 3],
    /// Velocity, its uncertainty, mode, congested stretches.
    wave: &'a [f64],
    deviation: &'a [f64],
    collision: f64,
    depths: Depths,
}

impl<'a> Case<'a> {
    fn of(size: Size, case: usize, result: &'a TaskResult) -> Self {
        let scenario = scenario(size, CASES[case].0);
        let [speeds, flow, map] = measurements(size);
        let (speed_columns, rest) = result.columns.split_at(6);
        let (flow_columns, rest) = rest.split_at(3);
        let (map_columns, rest) = rest.split_at(3);
        Self {
            reaction_time: CASES[case].0,
            tables: [
                refilled(&scenario, &speeds, speed_columns),
                refilled(&scenario, &flow, flow_columns),
                refilled(&scenario, &map, map_columns),
            ],
            wave: &rest[0],
            deviation: &rest[1],
            collision: rest[2][0],
            depths: Depths::new(&rest[3..]),
        }
    }

    /// Logarithm of the ratio of the deviation of speeds at the end to that at 20 s.
    fn change(&self) -> f64 {
        match (self.deviation.get(SETTLING), self.deviation.last()) {
            (Some(&early), Some(&late)) => libm::log(late / early),
            _ => f64::NAN,
        }
    }

    fn panels(&self) -> [Panel; 3] {
        let [speeds, flow, map] = &self.tables;
        let delta = format!("Δ = {} s", self.reaction_time);
        let time = column(speeds, "time_s");
        let v = equilibrium_speed();
        let mut layers = vec![Layer::Rule { name: String::new(), vertical: false, at: 0.0, left: false }];
        for (style, c) in speeds.columns().iter().skip(1).enumerate() {
            let name = format!("{}", 1 + 10 * style);
            let y = column(speeds, &c.name).iter().map(|speed| speed - v).collect();
            layers.push(Layer::Curve { name, style, x: time.clone(), y });
        }
        if let Some(fitted) = self.depths.growth(TAKEN) {
            let middles: Vec<f64> = (0..TAKEN.periods).map(|n| n as f64 + 0.5).collect();
            let x = middles.iter().map(|n| n * round_trip()).collect();
            let y = middles.iter().map(|n| -fitted.amplitude * exp(fitted.rate * (n + 0.5))).collect();
            layers.push(Layer::Curve { name: "fit".into(), style: 5, x, y });
        }
        let x = Axis::from_to("time (s)", 0.0, 300.0);
        let speeds_panel = Panel {
            title: format!("{delta}: speeds of five vehicles"),
            x: x.clone(),
            y: Axis::signed_log("speed − v∞ (m/s)"),
            layers,
        };
        let y = Axis::from_to("position (m)", 0.0, 1000.0);
        let q = equilibrium_flow();
        let flow_map = map_of(flow, "flow_veh_per_s", "flow (veh/s)", |flow| flow);
        let flow_range = (q - 3.5 / WINDOW, q + 3.5 / WINDOW);
        let flow_panel = Panel {
            title: format!("{delta}: flow"),
            x: x.clone(),
            y: y.clone(),
            layers: vec![coloured(flow_map, flow_range, Some(q), false)],
        };
        let speed_map = map_of(map, "speed_m_per_s", "m/s", |speed| speed - v);
        let map_panel = Panel {
            title: format!("{delta}: speed − v∞"),
            x,
            y,
            layers: vec![coloured(speed_map, (-10.0, 10.0), Some(0.0), true)],
        };
        [speeds_panel, flow_panel, map_panel]
    }
}

/// The data of a map with time along x, from a table with a row for each time and place: name, number of times, ends of
/// the cells in time, values place by place.
fn map_of(
    table: &Table,
    name: &str,
    words: &str,
    of: impl Fn(f64) -> f64,
) -> (String, usize, (f64, f64), Vec<f64>) {
    let times = column(table, "time_s");
    let values = column(table, name);
    let bins = times.iter().take_while(|&&t| t == times[0]).count();
    let rows = values.len() / bins;
    let every = if rows > 1 { times[bins] - times[0] } else { 1.0 };
    // The table has a row of places for each time; the map needs a row of times for each place.
    let transposed =
        (0..bins).flat_map(|b| (0..rows).map(move |r| r * bins + b)).map(|i| of(values[i])).collect();
    (words.into(), rows, (times[0] - 0.5 * every, times[times.len() - 1] + 0.5 * every), transposed)
}

fn coloured(
    (name, width, x, values): (String, usize, (f64, f64), Vec<f64>),
    range: (f64, f64),
    middle: Option<f64>,
    signed_log: bool,
) -> Layer {
    Layer::Map { name, width, x, y: (0.0, 1000.0), values, range, middle, signed_log }
}

fn equilibrium_flow() -> f64 {
    Driver::default().flow(0.05)
}

fn assemble(size: Size, results: &[TaskResult]) -> Outcome {
    let cases: Vec<Case> =
        results[..CASES.len()].iter().enumerate().map(|(k, result)| Case::of(size, k, result)).collect();
    let neighbours: Vec<f64> = results[CASES.len()..].iter().map(|p| p.columns[0][0]).collect();
    let mut tables = Vec::new();
    for case in &cases {
        let scenario = scenario(size, case.reaction_time);
        for ((what, table), measurement) in
            ["speeds", "flow", "map"].iter().zip(&case.tables).zip(&measurements(size))
        {
            let name = format!("waves-{what}-{}", case.reaction_time);
            tables.push(FigureTable::run(name, table.clone(), &scenario, measurement));
        }
    }
    let base = scenario(size, 0.0);
    let how = "runs at reaction times of 0, 0.5 and 0.75 s; every vehicle, every number of periods, two kinds of period, two fits";
    tables.push(FigureTable::summary("waves-growth", growth_table(&cases), &base, how));
    let mut rows: [Vec<Panel>; 3] = Default::default();
    for case in &cases {
        for (row, panel) in rows.iter_mut().zip(case.panels()) {
            row.push(panel);
        }
    }
    let plot = Plot {
        id: ID.into(),
        title: FIGURE.title.into(),
        description: "Nine panels. Above, speeds of five vehicles: at reaction times of 0 and 0.5 s the oscillation \
                      that the nudge makes dies away, at 0.75 s it grows until two vehicles collide. Middle, flow over \
                      time and place: only at 0.75 s does it change by whole vehicles. Below, speed over time and place: \
                      slow stripes run upstream in all three and fade in the first two; in the third they multiply."
            .into(),
        columns: 3,
        panels: rows.into_iter().flatten().collect(),
    };
    Outcome { tables, plot, claims: claims(&cases, &neighbours) }
}

fn growth_table(cases: &[Case]) -> Table {
    let rows: Vec<_> = cases
        .iter()
        .flat_map(|case| {
            Choice::all()
                .into_iter()
                .filter_map(|c| Some((case.reaction_time, c, case.depths.growth(c)?.rate)))
        })
        .collect();
    let text = |f: fn(Choice) -> &'static str| rows.iter().map(|r| f(r.1).to_owned()).collect();
    Table::new(vec![
        Column::float("reaction_time_s", "s", "Δ", rows.iter().map(|r| r.0).collect()),
        Column::whole("vehicle", "", "whose speed", rows.iter().map(|r| r.1.vehicle as u64 + 1).collect()),
        Column::text(
            "period",
            "from one upward crossing of v∞ to the next, or a round trip of the disturbance",
            text(Choice::period_word),
        ),
        Column::whole(
            "periods",
            "",
            "number of periods fitted, from the first",
            rows.iter().map(|r| r.1.periods as u64).collect(),
        ),
        Column::text(
            "fit",
            "of a·exp(k·n): non-linear least squares, or a line through the logarithms",
            text(Choice::fit_word),
        ),
        Column::float("growth_rate_per_period", "", "k", rows.iter().map(|r| r.2).collect()),
    ])
}

/// Allowed distance of k from the paper's, for details of cutting periods and of fitting.
const GROWTH_TOLERANCE: f64 = 0.02;

fn claims(cases: &[Case], neighbours: &[f64]) -> Vec<Claim> {
    let mut claims = Vec::new();
    for (case, &(reaction_time, paper)) in cases.iter().zip(&CASES) {
        let rate = |choice| case.depths.growth(choice).map_or(f64::NAN, |f| f.rate);
        let mut claim = Claim::new(
            ID,
            format!("cyclic growth rate k at Δ = {reaction_time} s"),
            "",
            Expected::About(paper, GROWTH_TOLERANCE),
            Estimate::exact(rate(TAKEN)),
            format!(
                "Here: {}, which is {:.1} s. The paper names neither vehicle nor period nor their number nor the fit; tolerance 0.02, a \
                 choice of ours, for details of cutting and fitting.",
                TAKEN.words(),
                round_trip()
            ),
        );
        for choice in Choice::all() {
            if choice != TAKEN && !rate(choice).is_nan() {
                claim = claim.or(choice.words(), Estimate::exact(rate(choice)));
            }
        }
        claims.push(claim);
    }
    claims.push(one_choice(cases));
    let last = &cases[2];
    claims.push(
        Claim::new(
            ID,
            "time of the collision at Δ = 0.75 s",
            "s",
            Expected::About(217.0, 1.0),
            Estimate::exact(last.collision),
            "Vehicle 1 displaced by 1 m, 75 steps of delay, the scene before t = 0 frozen; tolerance 1 s, since the paper says “about”.",
        )
        .or("74 steps of delay", Estimate::exact(neighbours[0]))
        .or("76 steps of delay", Estimate::exact(neighbours[1])),
    );
    for case in cases {
        let at = format!("Δ = {} s", case.reaction_time);
        let deviation = |row: Option<&f64>| row.map_or_else(|| "none".into(), |&d| short(d));
        let spread = format!(
            "Standard deviation of speed round the ring: {} m/s at 20 s, {} m/s at the end of the run ({} s).",
            deviation(case.deviation.get(SETTLING)),
            deviation(case.deviation.last()),
            short(case.deviation.len() as f64 - 1.0),
        );
        claims.push(Claim::new(
            ID,
            format!("congestion travels upstream at {at}: speed of the wave against the traffic"),
            "m/s",
            Expected::MoreThan(0.0),
            Estimate::new(-case.wave[0], case.wave[1]),
            format!(
                "Phase of Fourier mode {} of speed along the road, the strongest from 20 s on; uncertainty: 1.96 \
                 standard errors of the slope.",
                case.wave[2]
            ),
        ));
        let fades = case.reaction_time < 0.6;
        claims.push(Claim::new(
            ID,
            format!(
                "congestion {} at {at}: logarithm of the change of the deviation of speeds",
                if fades { "dissipates" } else { "grows" }
            ),
            "",
            if fades { Expected::AtMost(0.0) } else { Expected::MoreThan(0.0) },
            Estimate::exact(case.change()),
            spread,
        ));
    }
    claims.push(Claim::new(
        ID,
        "the wave dissipates more slowly at 0.5 s than at 0 s: difference of the logarithms of the change",
        "",
        Expected::MoreThan(0.0),
        Estimate::exact(cases[1].change() - cases[0].change()),
        "Change of the standard deviation of speed from 20 s to 300 s.",
    ));
    claims.push(Claim::new(
        ID,
        "at Δ = 0.75 s the congestion splits into several: congested stretches of road at the end",
        "",
        Expected::MoreThan(1.0),
        Estimate::exact(last.wave[3]),
        "Stretches slower than the mean by more than a tenth of the largest deviation, in the last second before the \
         collision.",
    ));
    claims.push(Claim::new(
        ID,
        "a displacement downstream slows vehicle 1 and speeds up vehicle N at first",
        "",
        Expected::About(1.0, 0.0),
        first_speeds(),
        "Speeds at t = 0 against the equilibrium speed; 1 means that both hold.",
    ));
    claims
}

/// Whether vehicle 1 starts slower than in equilibrium and vehicle N faster.
fn first_speeds() -> Estimate {
    let simulation = Simulation::new(&nudged(0.0, 1.0, 1.0)).expect("scenarios of figures are valid");
    let v = equilibrium_speed();
    indicator(simulation.speed(0) < v && simulation.speed(simulation.vehicles() - 1) > v)
}

/// Whether a single choice of vehicle, period and fit gives all three rates of the paper.
fn one_choice(cases: &[Case]) -> Claim {
    let mut best = (f64::INFINITY, TAKEN);
    let mut single = [0; 3];
    let all = Choice::all();
    for &choice in &all {
        let distances: Vec<f64> = cases
            .iter()
            .zip(&CASES)
            .map(|(case, c)| case.depths.growth(choice).map_or(f64::INFINITY, |k| (k.rate - c.1).abs()))
            .collect();
        for (count, distance) in single.iter_mut().zip(&distances) {
            *count += usize::from(*distance <= GROWTH_TOLERANCE);
        }
        let largest = distances.iter().copied().fold(0.0, f64::max);
        if largest < best.0 {
            best = (largest, choice);
        }
    }
    Claim::new(
        ID,
        "one choice of vehicle, period and fit gives all three growth rates: largest distance from the three, for the best choice",
        "",
        Expected::AtMost(GROWTH_TOLERANCE),
        Estimate::exact(best.0),
        format!(
            "{} choices: 50 vehicles, 2 to 12 upward crossings or 2 to 4 round trips, two fits. The best is {}; the \
             single rates are met within 0.02 by {}, {} and {} of them.",
            all.len(),
            best.1.words(),
            single[0],
            single[1],
            single[2]
        ),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduction::claim::ClaimVerdict;

    #[test]
    fn a_verdict_flips_with_its_value() {
        let results: Vec<TaskResult> = (0..5).map(|k| run(Size::Small, k)).collect();
        let verdicts = |results: &[TaskResult]| {
            assemble(Size::Small, results).claims.iter().map(Claim::verdict).collect::<Vec<_>>()
        };
        // The sign of the speed of the waves at Δ = 0.75 s, of which one claim speaks.
        let mut perturbed = results.clone();
        perturbed[2].columns[12][0] *= -1.0;
        let (before, after) = (verdicts(&results), verdicts(&perturbed));
        let changed: Vec<_> = before.into_iter().zip(after).filter(|(a, b)| a != b).collect();
        assert_eq!(changed, [(ClaimVerdict::Agrees, ClaimVerdict::Differs)]);
    }
}
