//! One aggressive driver among fifty: its gain, and its effect on the others.

use super::claim::{Claim, Estimate, Expected};
use super::figure::{Figure, FigureTable, Outcome};
use super::shared::{Spread, indicator, observed};
use super::task::{Size, TaskResult};
use crate::format::table::{Column, Table};
use crate::measurement::due_rows::DueRows;
use crate::measurement::probe::Probe;
use crate::numerics::statistics::mean;
use crate::plot::{Axis, Layer, Panel, Plot};
use crate::scenario::{Scenario, Start};
use crate::simulation::{Event, Simulation};

const ID: &str = "aggressive-driver";

pub(super) const FIGURE: Figure = Figure {
    id: ID,
    title: "One aggressive driver",
    caption: "Two lanes of 25 vehicles, staggered, steps of 0.05 s, no reaction time, r = 0.1 /s, p = 0.1. Vehicle 1, in \
              lane 1, has λ = 2, all others λ = 1. The control drivers are its nearest neighbours in lane 2 at the start: \
              vehicle 27 ahead and vehicle 26 behind. 20 runs with seeds 1 to 20; mean, and standard deviation as a \
              band.",
    beyond: false,
    tasks,
    start: |size, task| Box::new(move || run(size, task)),
    assemble,
};

/// Vehicle 1 and its nearest neighbours in lane 2, ahead and behind; indices from 0.
const FOLLOWED: [usize; 3] = [0, 26, 25];
/// Time between two rows of the table, s.
const EVERY: f64 = 5.0;

fn runs(size: Size) -> usize {
    size.choose(20, 5)
}

fn until(size: Size) -> f64 {
    size.choose(500.0, 200.0)
}

fn tasks(size: Size) -> Vec<String> {
    let each = (1..=runs(size)).map(|seed| format!("run {seed}"));
    each.chain(["without the aggressive driver".to_owned()]).collect()
}

fn scenario(size: Size, aggressive: bool, seed: u64) -> Scenario {
    let mut scenario = Scenario {
        vehicles: 50,
        lanes: 2,
        start: Start::Staggered,
        time_step: 0.05,
        until: until(size),
        seed,
        ..Scenario::default()
    };
    if aggressive {
        scenario.overrides.push("1:sensitivity=2".parse().expect("the grammar of driver overrides"));
    }
    scenario
}

/// What the figure and its claims need of a run.
#[derive(Clone, Debug, Default)]
struct Log {
    /// Mean speed of the drivers with λ = 1 in each lane, summed over the states before the first lane change, m/s.
    lane_speed: [f64; 2],
    /// Number of these states.
    states: f64,
    /// Number of lane changes after which the headway is larger, and of all lane changes.
    enlarged: f64,
    changed: f64,
    /// Time at which the frustration of vehicle 1 first rose or vehicle 1 first passed another, s; whether both happened
    /// in the same step; rise of the frustration of the passed vehicle.
    first_rise: Option<(f64, bool, f64)>,
    /// Headway (m) and frustration of every vehicle in the state before.
    headways: Vec<f64>,
    frustration: Vec<f64>,
    /// Lane changes and distance (m) of every vehicle at the end.
    last_changes: Vec<f64>,
    last_distances: Vec<f64>,
}

/// The probe that fills the log.
struct Follow {
    log: Log,
    /// Lane changes and distances (m) of the vehicles [`FOLLOWED`].
    rows: DueRows<[(f64, f64); 3]>,
    lane_changes: u64,
}

impl Probe for Follow {
    fn observe(&mut self, simulation: &Simulation) {
        let log = &mut self.log;
        let n = simulation.vehicles();
        for event in simulation.events() {
            match *event {
                Event::LaneChange { vehicle, .. } => {
                    self.lane_changes += 1;
                    log.changed += 1.0;
                    // The vehicles also moved for one step between the two states: 5 cm at a difference of 1 m/s.
                    log.enlarged += f64::from(u8::from(simulation.headway(vehicle) > log.headways[vehicle]));
                }
                Event::Pass { passer: 0, passed } if log.first_rise.is_none() => {
                    let jump = simulation.frustration(passed) - log.frustration[passed];
                    log.first_rise = Some((simulation.events_time(), false, jump));
                }
                _ => {}
            }
        }
        // The first rise comes from a pass if the frustration of vehicle 1 leaves 0 in the step of that pass.
        let before = log.frustration.first().copied().unwrap_or(0.0);
        let now = simulation.frustration(0);
        if before == 0.0 && now > 0.0 && !log.headways.is_empty() {
            let time = simulation.events_time();
            match &mut log.first_rise {
                Some(rise) if rise.0 == time => rise.1 = true,
                Some(_) => {}
                None => log.first_rise = Some((time, false, f64::NAN)),
            }
        }
        if self.lane_changes == 0 {
            for lane in 0..2 {
                let control = (1..n).filter(|&j| simulation.lane(j) == lane);
                let (sum, count) = control.fold((0.0, 0.0), |(s, c), j| (s + simulation.speed(j), c + 1.0));
                log.lane_speed[lane] += sum / count;
            }
            log.states += 1.0;
        }
        log.headways = (0..n).map(|j| simulation.headway(j)).collect();
        log.frustration = (0..n).map(|j| simulation.frustration(j)).collect();
        self.rows.record(simulation, || {
            FOLLOWED.map(|j| (f64::from(simulation.lane_changes(j)), simulation.distance(j)))
        });
        if simulation.is_finished() {
            log.last_changes = (0..n).map(|j| f64::from(simulation.lane_changes(j))).collect();
            log.last_distances = (0..n).map(|j| simulation.distance(j)).collect();
        }
    }

    fn table(&self) -> Table {
        let mut columns = vec![self.rows.time_column()];
        for (k, j) in FOLLOWED.iter().map(|j| j + 1).enumerate() {
            let (changes, distance) = self.rows.rows().iter().map(|row| row[k]).unzip();
            columns.push(Column::float(
                format!("lane_changes_{j}"),
                "",
                format!("lane changes of vehicle {j}"),
                changes,
            ));
            columns.push(Column::float(
                format!("distance_{j}_m"),
                "m",
                format!("distance driven by vehicle {j}"),
                distance,
            ));
        }
        Table::new(columns)
    }
}

/// Columns: times; lane changes of the three vehicles; their distances; and those that the constants below name.
fn run(size: Size, task: usize) -> TaskResult {
    let aggressive = task < runs(size);
    let scenario = scenario(size, aggressive, if aggressive { task as u64 + 1 } else { 1 });
    let mut follow =
        Follow { log: Log::default(), rows: DueRows::every(scenario.steps(EVERY)), lane_changes: 0 };
    let simulation = observed(&scenario, &mut follow);
    let (log, rows) = (follow.log, follow.rows);
    let rise = log.first_rise.unwrap_or((f64::NAN, false, f64::NAN));
    let of_each = |value: fn((f64, f64)) -> f64| {
        [0, 1, 2].map(|k| rows.rows().iter().map(|row| value(row[k])).collect::<Vec<f64>>())
    };
    let mut columns = vec![rows.times().to_vec()];
    columns.extend(of_each(|(changes, _)| changes));
    columns.extend(of_each(|(_, distance)| distance));
    columns.push(vec![
        (log.lane_speed[0] - log.lane_speed[1]) / log.states,
        log.enlarged,
        log.changed,
        rise.0,
        f64::from(u8::from(rise.1)),
        rise.2,
        f64::from(u8::from(simulation.collision().is_some())),
    ]);
    columns.push(log.last_changes.clone());
    columns.push(log.last_distances.clone());
    TaskResult { columns }
}

/// Indices of columns in a task result. The column FACTS holds: difference of the lanes' speeds, lane changes that enlarge
/// the headway, all lane changes, the three parts of the first rise, whether there was a collision.
const CHANGES: usize = 1;
const DISTANCES: usize = 4;
const FACTS: usize = 7;
const LAST_CHANGES: usize = 8;
const LAST_DISTANCES: usize = 9;

fn assemble(size: Size, results: &[TaskResult]) -> Outcome {
    let (runs, alone) = results.split_at(runs(size));
    let time = runs[0].columns[0].clone();
    let spread = |k: usize| Spread::of(&runs.iter().map(|p| p.columns[k].as_slice()).collect::<Vec<_>>());
    let names = ["aggressive", "control_ahead", "control_behind"];
    let words =
        ["vehicle 1, λ = 2", "vehicle 27, λ = 1, ahead in lane 2", "vehicle 26, λ = 1, behind in lane 2"];
    let mut columns = vec![Column::float("time_s", "s", "time", time.clone())];
    for k in 0..3 {
        let meaning = format!("lane changes of {}", words[k]);
        columns.extend(spread(CHANGES + k).columns(&format!("lane_changes_{}", names[k]), "", &meaning));
    }
    for k in 0..3 {
        let meaning = format!("distance driven by {}", words[k]);
        columns.extend(spread(DISTANCES + k).columns(&format!("distance_{}", names[k]), "m", &meaning));
    }
    let how = format!("{} runs, seeds 1 to {0}", runs.len());
    let tables =
        vec![FigureTable::summary("aggressive-driver", Table::new(columns), &scenario(size, true, 1), how)];
    let panel = |title: &str, label: &str, first: usize, scale: f64| {
        let mut layers = Vec::new();
        for (k, name) in ["aggressive, λ = 2", "control ahead", "control behind"].iter().enumerate() {
            let s = spread(first + k);
            let edge = |sign: f64| {
                s.mean.iter().zip(&s.deviation).map(|(m, d)| (m + sign * d) * scale).collect::<Vec<f64>>()
            };
            if k < 2 {
                let (low, high) = (edge(-1.0), edge(1.0));
                layers.push(Layer::Band { name: String::new(), style: k, x: time.clone(), low, high });
            }
            layers.push(Layer::Curve { name: (*name).into(), style: k, x: time.clone(), y: edge(0.0) });
        }
        Panel {
            title: title.into(),
            x: Axis::from_to("time (s)", 0.0, until(size)),
            y: Axis::new(label),
            layers,
        }
    };
    let plot = Plot {
        id: ID.into(),
        title: FIGURE.title.into(),
        description:
            "Left: the aggressive driver changes lanes several times as often as its neighbours. Right: the \
                      distances driven can hardly be told apart."
                .into(),
        columns: 2,
        panels: vec![
            panel("Lane changes", "lane changes Δl", CHANGES, 1.0),
            panel("Distance driven", "distance (km)", DISTANCES, 1e-3),
        ],
    };
    Outcome { tables, plot, claims: claims(size, runs, &alone[0]) }
}

/// The results that the claims are about.
struct Results<'a> {
    /// One for each seed.
    runs: &'a [TaskResult],
    /// The run without the aggressive driver.
    alone: &'a TaskResult,
    /// End of the runs, s.
    until: f64,
}

/// The last number of a column.
fn last(result: &TaskResult, column: usize) -> f64 {
    *result.columns[column].last().expect("a row at the end")
}

/// The last number of a control driver: the mean of the two, which halves the noise.
fn control(result: &TaskResult, first: usize) -> f64 {
    0.5 * (last(result, first + 1) + last(result, first + 2))
}

impl Results<'_> {
    /// Mean over the runs.
    fn over(&self, of: impl Fn(&TaskResult) -> f64) -> Estimate {
        Estimate::mean(&self.runs.iter().map(of).collect::<Vec<_>>())
    }

    /// Mean over the runs of a number of the column [`FACTS`].
    fn fact(&self, k: usize) -> Estimate {
        self.over(|run| run.columns[FACTS][k])
    }

    /// A claim about a mean over the runs.
    fn claim(
        &self,
        text: &str,
        unit: &'static str,
        expected: Expected,
        ours: Estimate,
        method: &str,
    ) -> Claim {
        let method = format!("{method} {} runs, seeds 1 to {0}, 95 % interval.", self.runs.len());
        Claim::new(ID, text, unit, expected, ours, method)
    }

    /// How often the aggressive driver and the control drivers change lanes.
    fn lane_change_claims(&self) -> Vec<Claim> {
        let changes = |k: usize| self.over(|run| last(run, CHANGES + k));
        let control_changes = self.over(|run| control(run, CHANGES));
        let ratio = {
            // Of the means; its interval by linear propagation over the paired runs.
            let (a, c) = (changes(0).value, control_changes.value);
            let spread = self.over(|run| last(run, CHANGES) - a / c * control(run, CHANGES));
            Estimate::new(a / c, spread.uncertainty / c)
        };
        let shorter =
            if self.until == 500.0 { String::new() } else { format!(" Only {} s here.", self.until) };
        vec![
            self.claim(
                "lane changes of the aggressive driver in 500 s",
                "",
                Expected::About(12.0, 0.5),
                changes(0),
                &format!("Tolerance: half a unit of the number printed.{shorter}"),
            ),
            self.claim(
                "lane changes of a control driver in 500 s",
                "",
                Expected::About(3.0, 0.5),
                control_changes,
                &format!(
                    "{} Tolerance: half a unit of the number printed.{shorter}",
                    mean_of_both(changes(1), changes(2))
                ),
            ),
            self.claim(
                "the aggressive driver changes lanes about 4 times as often",
                "",
                Expected::About(4.0, 0.5),
                ratio,
                "Ratio of the two means; tolerance: half a unit of the number printed.",
            ),
        ]
    }

    /// How much farther the aggressive driver comes.
    fn gain_claim(&self) -> Claim {
        let percent = |a: f64, b: f64| 100.0 * (a / b - 1.0);
        let gain_on = |k: usize| self.over(|run| percent(last(run, DISTANCES), last(run, DISTANCES + k)));
        let gain = self.over(|run| percent(last(run, DISTANCES), control(run, DISTANCES)));
        let on_all_others = self.over(|run| {
            let all = &run.columns[LAST_DISTANCES];
            percent(all[0], mean(&all[1..]))
        });
        self.claim(
            "the aggressive driver is less than 2 % faster",
            "%",
            Expected::AtMost(2.0),
            gain,
            &format!(
                "Distance against that of a control driver in the same run. {}",
                mean_of_both(gain_on(1), gain_on(2))
            ),
        )
        .or("against the mean of all other drivers", on_all_others)
    }

    /// What the aggressive driver does to its neighbours.
    fn neighbour_claims(&self) -> Vec<Claim> {
        let more = self.over(|run| control(run, CHANGES) - control(self.alone, CHANGES));
        vec![
            self.claim(
                "an aggressive driver raises the lane changes of its neighbours",
                "",
                Expected::MoreThan(0.0),
                more,
                "Lane changes of both neighbours in lane 2 less those without an aggressive driver, mean.",
            ),
            Claim::new(
                ID,
                "without an aggressive driver there are no lane changes: lane changes of all vehicles",
                "",
                Expected::AtMost(0.0),
                Estimate::exact(self.alone.columns[LAST_CHANGES].iter().sum()),
                format!("One run of {} s, seed 1.", self.until),
            ),
        ]
    }

    /// How it begins: the faster lane and the first pass.
    fn first_pass_claims(&self) -> Vec<Claim> {
        vec![
            self.claim(
                "lane 1 is faster than lane 2 before the first lane change: mean difference",
                "m/s",
                Expected::MoreThan(0.0),
                self.fact(0),
                "Mean speed of the drivers with λ = 1 in lane 1 less that of lane 2, over all steps before the first change.",
            ),
            Claim::new(
                ID,
                "the aggressive driver's frustration first rises when it passes a vehicle in lane 2: 1 if so in every run",
                "",
                Expected::About(1.0, 0.0),
                indicator(self.runs.iter().all(|run| run.columns[FACTS][4] == 1.0)),
                format!(
                    "Whether φ of vehicle 1 leaves 0 in the very step in which it first passes a vehicle, in every one of {0} runs, seeds 1 to {0}; at {1:.2} s on average.",
                    self.runs.len(),
                    self.fact(3).value
                ),
            ),
            self.claim(
                "the frustration of the driver that is passed jumps then",
                "",
                Expected::About(0.1, 0.011),
                self.fact(5),
                "Rise of φ of the passed driver in that step: p = 0.1, plus or minus one step of r.",
            ),
        ]
    }

    /// What a lane change brings.
    fn benefit_claims(&self) -> Vec<Claim> {
        let total = |k: usize| self.runs.iter().map(|run| run.columns[FACTS][k]).sum::<f64>();
        let (enlarged, changed) = (total(1), total(2));
        let not_enlarged = {
            // Of the sums; changes of one run depend on each other, runs do not.
            let share = (changed - enlarged) / changed;
            let spread = self.over(|run| (1.0 - share) * run.columns[FACTS][2] - run.columns[FACTS][1]);
            Estimate::new(share, spread.uncertainty / (changed / self.runs.len() as f64))
        };
        let per_change =
            self.over(|run| slope_percent(&run.columns[LAST_CHANGES], &run.columns[LAST_DISTANCES]));
        vec![
            self.claim(
                "not every lane change enlarges the changer's headway: share of those that do not",
                "",
                Expected::MoreThan(0.0),
                not_enlarged,
                &format!("Of all {changed} lane changes, headway before the step against after it."),
            ),
            self.claim(
                "more lane changes only marginally raise the speed: gain for each further lane change",
                "%",
                Expected::AtMost(2.0 / 9.0),
                per_change,
                "Slope of distance against lane changes over all 50 drivers of a run; marginal: 2 % for the 9 further lane changes that the paper counts.",
            ),
        ]
    }
}

/// The words for a mean of the two control drivers, and the value of each.
fn mean_of_both(ahead: Estimate, behind: Estimate) -> String {
    format!("Mean of both neighbours in lane 2: ahead {ahead}, behind {behind}.")
}

fn claims(size: Size, runs: &[TaskResult], alone: &TaskResult) -> Vec<Claim> {
    let results = Results { runs, alone, until: until(size) };
    let mut claims = results.lane_change_claims();
    claims.push(results.gain_claim());
    claims.extend(results.neighbour_claims());
    claims.extend(results.first_pass_claims());
    claims.extend(results.benefit_claims());
    claims
}

/// Slope of distance, in per cent of its mean, against lane changes.
fn slope_percent(changes: &[f64], distances: &[f64]) -> f64 {
    let points: Vec<_> = changes.iter().copied().zip(distances.iter().copied()).collect();
    crate::numerics::least_squares::line(&points)
        .map_or(f64::NAN, |line| 100.0 * line.slope / mean(distances))
}
