//! Load balance: all vehicles start in one of two lanes and spread over both.

use super::claim::{Claim, Estimate, Expected};
use super::figure::{Figure, FigureTable, Outcome};
use super::shared::{Spread, column, measured};
use super::task::{Size, TaskResult};
use crate::format::table::{Column, Table};
use crate::measurement::Measurement;
use crate::numerics::statistics::mean;
use crate::plot::{Axis, Layer, Panel, Plot};
use crate::scenario::driver::Driver;
use crate::scenario::{Scenario, Start};
use crate::simulation::frustration::attempt_probability;

const ID: &str = "load-balance";

pub(super) const FIGURE: Figure = Figure {
    id: ID,
    title: "Two lanes share the load",
    caption: "Fifty vehicles start in lane 1 of two, steps of 0.05 s, no reaction time, r = 0.1 /s, p = 0.2; 10 runs with \
              seeds 1 to 10. The difference ΔN between the lanes and the flow at L/2 over a window of 5 s: mean and \
              95 % confidence interval of the mean. Beside them, in orange, the same with r = 0.01 /s, p = 0.02. The \
              difference at late times is smaller than the noise of 10 runs, so claims about it use 100 runs, seeds 1 to 100.",
    beyond: false,
    tasks,
    start: |size, task| Box::new(move || run(size, task)),
    assemble,
};

/// (r, p): those of the paper, and a tenth of both.
const FRUSTRATION: [(f64, f64); 2] = [(0.1, 0.2), (0.01, 0.02)];
const N: usize = 50;

/// Number of runs of the figure: that of the paper.
fn runs(size: Size) -> usize {
    size.choose(10, 4)
}

/// Number of runs for the claims about late times; those of the figure are the first of them.
fn long_runs(size: Size) -> usize {
    size.choose(100, 4)
}

/// End of a run, s. The paper's plot ends at 100 s, but the paper says that balance is not reached "even after a time
/// much longer".
fn until(size: Size) -> f64 {
    size.choose(300.0, 100.0)
}

fn tasks(size: Size) -> Vec<String> {
    let each = |&(r, p): &(f64, f64)| {
        (1..=long_runs(size)).map(move |seed| format!("run {seed} with r = {r}, p = {p}")).collect::<Vec<_>>()
    };
    FRUSTRATION.iter().flat_map(each).collect()
}

fn scenario(size: Size, (r, p): (f64, f64), seed: u64) -> Scenario {
    let mut scenario = Scenario {
        vehicles: N,
        lanes: 2,
        start: Start::OneLane(1),
        time_step: 0.05,
        until: until(size),
        seed,
        ..Scenario::default()
    };
    scenario.driver.frustration_rate = r;
    scenario.driver.pass_frustration = p;
    scenario
}

/// Mean ΔN from 60 s on and over the last 50 s; then, for a run of the figure, time, ΔN and flow with a row each half
/// second.
fn run(size: Size, task: usize) -> TaskResult {
    let (which, seed) = (task / long_runs(size), task % long_runs(size) + 1);
    let scenario = scenario(size, FRUSTRATION[which], seed as u64);
    let flow = Measurement::Flow { every: 0.5, window: 5.0, at: None };
    let (tables, _) = measured(&scenario, &[Measurement::Lanes { every: 0.5 }, flow]);
    let (time, imbalance) = (column(&tables[0], "time_s"), column(&tables[0], "imbalance"));
    let late = |from: f64| {
        let rows = time.iter().zip(&imbalance).filter(|row| *row.0 >= from);
        mean(&rows.map(|row| *row.1).collect::<Vec<_>>())
    };
    let mut columns = vec![vec![late(60.0), late(until(size) - 50.0)]];
    if seed <= runs(size) {
        columns.extend([time, imbalance, column(&tables[1], "flow_veh_per_s")]);
    }
    TaskResult { columns }
}

/// The mean ΔN if every vehicle chose its lane by tossing a coin: E|2B − N| of a binomial B with N trials of probability
/// 1/2.
pub(crate) fn random_imbalance(n: usize) -> f64 {
    // Weights relative to the middle one, from the middle outwards; so they neither overflow nor underflow.
    let mut weight = 1.0;
    let (mut total, mut sum) = (0.0, 0.0);
    for k in n.div_ceil(2)..=n {
        let difference = (2 * k - n) as f64;
        let copies = if difference == 0.0 { 1.0 } else { 2.0 };
        total += copies * weight;
        sum += copies * weight * difference;
        weight *= (n - k) as f64 / (k + 1) as f64;
    }
    sum / total
}

/// The runs of one (r, p).
struct Group<'a> {
    /// Mean ΔN from 60 s on and over the last 50 s, from all runs.
    late: Estimate,
    last: Estimate,
    /// Times, ΔN and flow of the runs of the figure.
    time: &'a [f64],
    imbalance: Vec<&'a [f64]>,
    flow: Vec<&'a [f64]>,
}

impl<'a> Group<'a> {
    fn of(size: Size, results: &'a [TaskResult]) -> Self {
        let long = |k: usize| Estimate::mean(&results.iter().map(|p| p.columns[0][k]).collect::<Vec<_>>());
        let column = |k: usize| results[..runs(size)].iter().map(|p| p.columns[k].as_slice()).collect();
        Self {
            late: long(0),
            last: long(1),
            time: &results[0].columns[1],
            imbalance: column(2),
            flow: column(3),
        }
    }

    /// Mean over the times from `from` to `to` (s) and over the runs, with the interval over runs.
    fn average(&self, runs: &[&[f64]], from: f64, to: f64) -> Estimate {
        let rows: Vec<usize> =
            (0..self.time.len()).filter(|&k| self.time[k] >= from && self.time[k] <= to).collect();
        let each = |run: &&[f64]| mean(&rows.iter().map(|&k| run[k]).collect::<Vec<_>>());
        Estimate::mean(&runs.iter().map(each).collect::<Vec<_>>())
    }

    /// The first time at which ΔN is at most `most`, mean over the runs; NaN where a run never reaches it.
    fn reaches(&self, most: f64) -> Estimate {
        let first = |run: &&[f64]| run.iter().position(|&d| d <= most).map_or(f64::NAN, |k| self.time[k]);
        Estimate::mean(&self.imbalance.iter().map(first).collect::<Vec<_>>())
    }

    fn table(&self) -> Table {
        let mut columns = vec![Column::float("time_s", "s", "time", self.time.to_vec())];
        columns.extend(Spread::of(&self.imbalance).columns("imbalance", "", "ΔN"));
        columns.extend(Spread::of(&self.flow).columns("flow", "veh/s", "flow at L/2 over 5 s, both lanes"));
        Table::new(columns)
    }
}

fn assemble(size: Size, results: &[TaskResult]) -> Outcome {
    let (paper, tenth) = results.split_at(long_runs(size));
    let (paper, tenth) = (Group::of(size, paper), Group::of(size, tenth));
    let how = |(r, p): (f64, f64)| format!("{} runs, seeds 1 to {0}, r = {r} /s, p = {p}", runs(size));
    let tables = vec![
        FigureTable::summary(
            "load-balance",
            paper.table(),
            &scenario(size, FRUSTRATION[0], 1),
            how(FRUSTRATION[0]),
        ),
        FigureTable::summary(
            "load-balance-tenth",
            tenth.table(),
            &scenario(size, FRUSTRATION[1], 1),
            how(FRUSTRATION[1]),
        ),
    ];
    let plot = Plot {
        id: ID.into(),
        title: FIGURE.title.into(),
        description: format!(
            "Left: the difference between the lanes falls from 50 to a few vehicles, within seconds at the paper's r \
             and p, more slowly at a tenth of both; chance alone would leave {:.1}. Right: the flow through both \
             lanes rises as the difference falls, to about one vehicle a second.",
            random_imbalance(N)
        ),
        columns: 2,
        panels: vec![
            panel(
                "Difference between the lanes",
                "ΔN (vehicles)",
                [&paper, &tenth],
                true,
                random_imbalance(N),
            ),
            panel(
                "Flow at L/2, both lanes",
                "flow (veh/s)",
                [&paper, &tenth],
                false,
                2.0 * Driver::default().flow(0.025),
            ),
        ],
    };
    Outcome { tables, plot, claims: claims(size, &paper, &tenth) }
}

/// ΔN or flow of the groups over time, and beside them a constant for comparison.
fn panel(title: &str, label: &str, groups: [&Group; 2], imbalance: bool, rule: f64) -> Panel {
    let name = if imbalance { "chance" } else { "equilibrium" };
    let x: Vec<f64> = (0..=100).map(f64::from).collect();
    let y = vec![rule; x.len()];
    let mut layers = vec![Layer::Curve { name: name.into(), style: 5, x, y }];
    for (style, group) in groups.into_iter().enumerate() {
        let spread = Spread::of(if imbalance { &group.imbalance } else { &group.flow });
        let x = group.time.to_vec();
        layers.push(Layer::Band {
            name: String::new(),
            style,
            x: x.clone(),
            low: spread.low(),
            high: spread.high(),
        });
        let (r, p) = FRUSTRATION[style];
        layers.push(Layer::Curve { name: format!("r = {r}, p = {p}"), style, x, y: spread.mean });
    }
    let y = if imbalance { Axis::from_to(label, 0.0, 52.0) } else { Axis::from_to(label, 0.0, 1.4) };
    Panel { title: title.into(), x: Axis::from_to("time (s)", 0.0, 100.0), y, layers }
}

fn claims(size: Size, paper: &Group, tenth: &Group) -> Vec<Claim> {
    let runs = paper.imbalance.len();
    let seeds = format!("{runs} runs, seeds 1 to {runs}, 95 % interval");
    let at_30 = paper.average(&paper.imbalance, 30.0, 30.0);
    let late = paper.average(&paper.imbalance, 30.0, 100.0);
    let flow = paper.average(&paper.flow, 30.0, 100.0);
    let per_lane = Estimate::new(flow.value * 1800.0, flow.uncertainty * 1800.0);
    let slower = |a: Estimate, b: Estimate| {
        Estimate::new(a.value - b.value, libm::hypot(a.uncertainty, b.uncertainty))
    };
    let speeds = (paper.reaches(7.0), tenth.reaches(7.0));
    let correlation: Vec<f64> =
        paper.imbalance.iter().zip(&paper.flow).map(|(d, q)| correlation(&d[10..200], &q[10..200])).collect();
    let claim = |text: &str, unit, expected, ours, how: &str| {
        Claim::new(ID, text, unit, expected, ours, format!("{how} {seeds}."))
    };
    let long = |text: &str, expected, ours, how: String| {
        let seeds = format!("{0} runs, seeds 1 to {0}, 95 % interval", long_runs(size));
        Claim::new(ID, text, "", expected, ours, format!("{how} {seeds}."))
    };
    vec![
        claim(
            "the lanes become balanced: ΔN at 30 s",
            "",
            Expected::AtMost(12.5),
            at_30,
            "Balanced: at most a quarter of the 50 at the start.",
        ),
        claim(
            "ΔN is about 5 at 30 s",
            "",
            Expected::About(5.0, 1.0),
            at_30,
            "Tolerance 1, read from “about”.",
        ),
        claim(
            "ΔN falls to about 5 within about 30 s: time to 7 or fewer",
            "s",
            Expected::About(30.0, 10.0),
            speeds.0,
            "Mean over the runs of the first time at which ΔN ≤ 7; tolerance 10 s.",
        ),
        claim(
            "ΔN keeps oscillating around 5: mean from 30 to 100 s",
            "",
            Expected::About(5.0, 1.0),
            late,
            "Mean over time, then over the runs; tolerance 1.",
        ),
        long(
            "balance is not reached after a longer time either: ΔN over the last 50 s",
            Expected::MoreThan(0.0),
            paper.last,
            format!("Runs of {} s.", until(size)),
        ),
        claim(
            "flow at L/2 settles at about 1.0 veh/s: mean from 30 to 100 s",
            "veh/s",
            Expected::About(1.0, 0.05),
            flow,
            "Window 5 s; tolerance 0.05: half a unit of the last digit printed.",
        ),
        claim(
            "flow of each lane, about 1800 veh/h",
            "veh/h",
            Expected::About(1800.0, 90.0),
            per_lane,
            "Half of the above, times 3600; tolerance 90, which is 0.05 veh/s.",
        ),
        claim(
            "flow rises as ΔN falls: correlation of the two from 5 to 100 s, with the opposite sign",
            "",
            Expected::MoreThan(0.0),
            Estimate::mean(&correlation.iter().map(|c| -c).collect::<Vec<_>>()),
            "Pearson's correlation in each run.",
        ),
        claim(
            "smaller r and p lower the rate of balancing: later arrival at ΔN ≤ 7 with a tenth of both",
            "s",
            Expected::MoreThan(0.0),
            slower(speeds.1, speeds.0),
            "r = 0.01 /s, p = 0.02 against r = 0.1 /s, p = 0.2.",
        ),
        long(
            "smaller r and p lower the late ΔN: how much lower with a tenth of both",
            Expected::MoreThan(0.0),
            slower(paper.late, tenth.late),
            format!(
                "Mean from 60 to {} s: {} and {}; 10 runs as in the figure leave the sign open.",
                until(size),
                paper.late,
                tenth.late
            ),
        ),
        Claim::new(
            ID,
            "P(φ = 0.5) is about 30 %",
            "%",
            Expected::About(30.0, 1.0),
            Estimate::exact(100.0 * attempt_probability(0.5)),
            "The formula; tolerance 1 %, read from “about”.",
        ),
    ]
}

/// Pearson's correlation.
fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let (mean_a, mean_b) = (mean(a), mean(b));
    let sum =
        |f: &dyn Fn(f64, f64) -> f64| a.iter().zip(b).map(|(&a, &b)| f(a - mean_a, b - mean_b)).sum::<f64>();
    sum(&|a, b| a * b) / (sum(&|a, _| a * a) * sum(&|_, b| b * b)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coin_tosses_leave_a_mean_difference_of_five_or_six() {
        assert_eq!(random_imbalance(1), 1.0);
        assert_eq!(random_imbalance(2), 1.0);
        assert_eq!(random_imbalance(3), 1.5);
        assert!((random_imbalance(50) - 5.6137).abs() < 1e-3, "{}", random_imbalance(50));
    }
}
