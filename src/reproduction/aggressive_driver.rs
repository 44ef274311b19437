//! One aggressive driver among fifty: what it gains, and what it does to the others.

use super::{Figure, FigureTable, Outcome, Size, Spread, TaskResult, indicator, observed};
use crate::format::table::{Column, Table};
use crate::measurement::probe::Probe;
use crate::plot::{Axis, Layer, Panel, Plot};
use crate::reproduction::claim::{Claim, Estimate, Expected, mean};
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
    pieces,
    start: |size, piece| Box::new(move || run(size, piece)),
    assemble,
};

/// Vehicle 1 and its nearest neighbours in lane 2, ahead and behind; indices from 0.
const FOLLOWED: [usize; 3] = [0, 26, 25];
const EVERY: f64 = 5.0;

fn runs(size: Size) -> usize {
    size.choose(20, 5)
}

fn until(size: Size) -> f64 {
    size.choose(500.0, 200.0)
}

fn pieces(size: Size) -> Vec<String> {
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
        scenario.overrides.push("1:sensitivity=2".parse().expect("the grammar of exceptions"));
    }
    scenario
}

/// Everything that the figure and its claims need of a run.
#[derive(Clone, Debug, Default)]
struct Log {
    times: Vec<f64>,
    /// Lane changes and distances of the vehicles followed.
    changes: [Vec<f64>; 3],
    distances: [Vec<f64>; 3],
    /// Mean speeds of the control drivers by lane, up to the first lane change: sums over states.
    lane_speed: [f64; 2],
    states: f64,
    /// Lane changes after which the headway is larger, and all.
    enlarged: f64,
    changed: f64,
    /// When the frustration of vehicle 1 first rose; whether it passed another in the same step; by how much the
    /// frustration of the passed rose.
    first_rise: Option<(f64, bool, f64)>,
    headways: Vec<f64>,
    frustration: Vec<f64>,
    last_changes: Vec<f64>,
    last_distances: Vec<f64>,
}

/// The probe that keeps it.
struct Follow {
    log: Log,
    every: u64,
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
                    // Between two states lies one step of driving as well, 5 cm at a difference of 1 m/s.
                    log.enlarged += f64::from(u8::from(simulation.headway(vehicle) > log.headways[vehicle]));
                }
                Event::Pass { passer: 0, passed } if log.first_rise.is_none() => {
                    let jump = simulation.frustration(passed) - log.frustration[passed];
                    log.first_rise = Some((simulation.events_time(), false, jump));
                }
                _ => {}
            }
        }
        // The first rise is that of a pass if the frustration of vehicle 1 was 0 until then and is not after it.
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
        if simulation.step_index().is_multiple_of(self.every) {
            log.times.push(simulation.time());
            for (k, &j) in FOLLOWED.iter().enumerate() {
                log.changes[k].push(f64::from(simulation.lane_changes(j)));
                log.distances[k].push(simulation.distance(j));
            }
        }
        if simulation.is_finished() {
            log.last_changes = (0..n).map(|j| f64::from(simulation.lane_changes(j))).collect();
            log.last_distances = (0..n).map(|j| simulation.distance(j)).collect();
        }
    }

    fn table(&self) -> Table {
        let log = &self.log;
        let mut columns = vec![Column::float("time_s", "s", "time", log.times.clone())];
        for (k, j) in FOLLOWED.iter().map(|j| j + 1).enumerate() {
            let (changes, distance) = (log.changes[k].clone(), log.distances[k].clone());
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

fn run(size: Size, piece: usize) -> TaskResult {
    let aggressive = piece < runs(size);
    let scenario = scenario(size, aggressive, if aggressive { piece as u64 + 1 } else { 1 });
    let mut follow = Follow { log: Log::default(), every: scenario.steps(EVERY), lane_changes: 0 };
    let simulation = observed(&scenario, &mut follow);
    let log = follow.log;
    let rise = log.first_rise.unwrap_or((f64::NAN, false, f64::NAN));
    let mut columns = vec![log.times.clone()];
    columns.extend(log.changes.iter().cloned());
    columns.extend(log.distances.iter().cloned());
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

/// Places of the columns of a piece.
const CHANGES: usize = 1;
const DISTANCES: usize = 4;
const FACTS: usize = 7;
const LAST_CHANGES: usize = 8;
const LAST_DISTANCES: usize = 9;

fn assemble(size: Size, pieces: &[TaskResult]) -> Outcome {
    let (runs, alone) = pieces.split_at(runs(size));
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

fn claims(size: Size, runs: &[TaskResult], alone: &TaskResult) -> Vec<Claim> {
    let until = until(size);
    let last = |piece: &TaskResult, k: usize| *piece.columns[k].last().expect("a row at the end");
    let over = |f: &dyn Fn(&TaskResult) -> f64| Estimate::mean(&runs.iter().map(f).collect::<Vec<_>>());
    let fact = |k: usize| over(&|p: &TaskResult| p.columns[FACTS][k]);
    let seeds = format!("{} runs, seeds 1 to {0}, 95 % interval.", runs.len());
    let claim = |text: &str, unit, expected, ours, how: &str| {
        Claim::new(ID, text, unit, expected, ours, format!("{how} {seeds}").trim().to_owned())
    };
    let changes = |k: usize| over(&|p: &TaskResult| last(p, CHANGES + k));
    // Of a control driver: the mean of the two neighbours, which halves the noise; both are told.
    let control = |p: &TaskResult, first: usize| 0.5 * (last(p, first + 1) + last(p, first + 2));
    let both = |of: &dyn Fn(usize) -> Estimate| {
        format!("Mean of both neighbours in lane 2: ahead {}, behind {}.", of(1), of(2))
    };
    let control_changes = over(&|p: &TaskResult| control(p, CHANGES));
    let ratio = {
        // Of the means; its interval by linear propagation over the paired runs.
        let (a, c) = (changes(0).value, control_changes.value);
        let spread = over(&|p: &TaskResult| last(p, CHANGES) - a / c * control(p, CHANGES));
        Estimate::new(a / c, spread.uncertainty / c)
    };
    let gain_on =
        |k: usize| over(&|p: &TaskResult| 100.0 * (last(p, DISTANCES) / last(p, DISTANCES + k) - 1.0));
    let gain = over(&|p: &TaskResult| 100.0 * (last(p, DISTANCES) / control(p, DISTANCES) - 1.0));
    let everyone = over(&|p: &TaskResult| {
        let all = &p.columns[LAST_DISTANCES];
        100.0 * (all[0] / mean(&all[1..]) - 1.0)
    });
    let more = over(&|p: &TaskResult| control(p, CHANGES) - control(alone, CHANGES));
    let (enlarged, changed) =
        runs.iter().fold((0.0, 0.0), |(e, c), p| (e + p.columns[FACTS][1], c + p.columns[FACTS][2]));
    let not_enlarged = {
        // Of the sums; changes of one run depend on each other, runs do not.
        let share = (changed - enlarged) / changed;
        let spread = over(&|p: &TaskResult| (1.0 - share) * p.columns[FACTS][2] - p.columns[FACTS][1]);
        Estimate::new(share, spread.uncertainty / (changed / runs.len() as f64))
    };
    let per_change =
        over(&|p: &TaskResult| slope_percent(&p.columns[LAST_CHANGES], &p.columns[LAST_DISTANCES]));
    let paper_end = until == 500.0;
    let scaled = if paper_end { String::new() } else { format!(" Only {until} s here.") };
    vec![
        claim(
            "lane changes of the aggressive driver in 500 s",
            "",
            Expected::About(12.0, 0.5),
            changes(0),
            &format!("Tolerance: half a unit of the number printed.{scaled}"),
        ),
        claim(
            "lane changes of a control driver in 500 s",
            "",
            Expected::About(3.0, 0.5),
            control_changes,
            &format!("{} Tolerance: half a unit of the number printed.{scaled}", both(&changes)),
        ),
        claim(
            "the aggressive driver changes lanes about 4 times as often",
            "",
            Expected::About(4.0, 0.5),
            ratio,
            "Ratio of the two means; tolerance: half a unit of the number printed.",
        ),
        claim(
            "the aggressive driver is less than 2 % faster",
            "%",
            Expected::AtMost(2.0),
            gain,
            &format!("Distance against that of a control driver in the same run. {}", both(&gain_on)),
        )
        .or("against the mean of all other drivers", everyone),
        claim(
            "an aggressive driver raises the lane changes of its neighbours",
            "",
            Expected::MoreThan(0.0),
            more,
            "Lane changes of both neighbours in lane 2 less those without an aggressive driver, mean.",
        ),
        Claim::new(
            ID,
            "without an aggressive driver nobody ever changes lane: lane changes of all",
            "",
            Expected::AtMost(0.0),
            Estimate::exact(alone.columns[LAST_CHANGES].iter().sum()),
            format!("One run of {until} s, seed 1."),
        ),
        claim(
            "lane 1 is faster than lane 2 before the first lane change: mean difference",
            "m/s",
            Expected::MoreThan(0.0),
            fact(0),
            "Mean speed of the control drivers of lane 1 less that of lane 2, over all steps before the first change.",
        ),
        Claim::new(
            ID,
            "the aggressive driver's frustration first rises when it passes a vehicle in lane 2: share of the runs",
            "",
            Expected::About(1.0, 0.0),
            indicator(runs.iter().all(|p| p.columns[FACTS][4] == 1.0)),
            format!(
                "Whether, in every one of {0} runs, seeds 1 to {0}, φ of vehicle 1 leaves 0 in the very step in which it passes (1 means so); at {1:.2} s in the mean.",
                runs.len(),
                fact(3).value
            ),
        ),
        claim(
            "the driver who is passed then has a jump of frustration",
            "",
            Expected::About(0.1, 0.011),
            fact(5),
            "Rise of φ of the one passed in that step: p = 0.1, more or less one step of r.",
        ),
        claim(
            "not every lane change enlarges the changer's headway: share of those that do not",
            "",
            Expected::MoreThan(0.0),
            not_enlarged,
            &format!("Of all {changed} lane changes, headway before the step against after it."),
        ),
        claim(
            "more lane changes only marginally raise the speed: gain for each lane change more",
            "%",
            Expected::AtMost(2.0 / 9.0),
            per_change,
            "Slope of distance against lane changes over all 50 drivers of a run; marginal: 2 % for the 9 changes more that the paper counts.",
        ),
    ]
}

/// Slope of distance, in per cent of its mean, against lane changes.
fn slope_percent(changes: &[f64], distances: &[f64]) -> f64 {
    let points: Vec<_> = changes.iter().copied().zip(distances.iter().copied()).collect();
    crate::numerics::least_squares::line(&points)
        .map_or(f64::NAN, |line| 100.0 * line.slope / mean(distances))
}
