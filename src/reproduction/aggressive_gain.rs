//! Beyond the paper: the gain of aggressive drivers against their λ, their share and the density of traffic.

use super::claim::{Claim, Estimate, Expected};
use super::figure::{Figure, FigureTable, Outcome};
use super::shared::measured;
use super::task::{Size, TaskResult};
use crate::format::table::{Column, Table};
use crate::numerics::statistics::mean;
use crate::plot::{Axis, Layer, Panel, Plot};
use crate::scenario::{Scenario, Start};

const ID: &str = "aggressive-gain";

pub(super) const FIGURE: Figure = Figure {
    id: ID,
    title: "What aggressive drivers gain",
    caption: "Two lanes of 1 km, staggered, steps of 0.05 s, no reaction time, r = 0.1 /s, p = 0.1, 500 s. One aggressive \
              driver among 50 of λ from 1 to 4; a share of 50 with λ = 2; one with λ = 2 among 20 to 200 \
              vehicles. 20 runs each, seeds 1 to 20. Gain: mean distance of the aggressive over that of all \
              others; mean and 95 % confidence interval.",
    beyond: true,
    tasks: |size| {
        let each = |point: &Point| {
            let name = point.name();
            (1..=runs(size)).map(move |seed| format!("{name}, run {seed}")).collect::<Vec<_>>()
        };
        points(size).iter().flat_map(each).collect()
    },
    start: |size, task| Box::new(move || run(size, task)),
    assemble,
};

/// What is varied, and its value; the rest is as in the paper.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Point {
    /// λ of the one aggressive driver, 1/s.
    Sensitivity(f64),
    /// Share of aggressive drivers, %.
    Share(f64),
    /// Number of vehicles, one of them aggressive.
    Vehicles(usize),
}

impl Point {
    fn name(&self) -> String {
        match self {
            Self::Sensitivity(lambda) => format!("λ = {lambda}"),
            Self::Share(share) => format!("{share} % aggressive"),
            Self::Vehicles(n) => format!("{n} vehicles"),
        }
    }

    fn scenario(self, size: Size, seed: u64) -> Scenario {
        let driver_override = match self {
            Self::Sensitivity(lambda) => format!("1:sensitivity={lambda}"),
            Self::Share(share) => format!("{share}%:sensitivity=2"),
            Self::Vehicles(_) => "1:sensitivity=2".to_owned(),
        };
        Scenario {
            vehicles: if let Self::Vehicles(n) = self { n } else { 50 },
            lanes: 2,
            start: Start::Staggered,
            time_step: 0.05,
            until: size.choose(500.0, 100.0),
            seed,
            overrides: vec![driver_override.parse().expect("the grammar of driver overrides")],
            ..Scenario::default()
        }
    }
}

fn points(size: Size) -> Vec<Point> {
    let lambdas: &[f64] = size.choose(&[1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 3.5, 4.0], &[2.0, 4.0]);
    let shares: &[f64] =
        size.choose(&[2.0, 4.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0], &[10.0]);
    // From 140 vehicles on there are no lane changes.
    let counts: &[usize] = size.choose(&[20, 40, 60, 80, 100, 120, 140, 200], &[50, 100]);
    let lambdas = lambdas.iter().map(|&l| Point::Sensitivity(l));
    let shares = shares.iter().map(|&s| Point::Share(s));
    lambdas.chain(shares).chain(counts.iter().map(|&n| Point::Vehicles(n))).collect()
}

fn runs(size: Size) -> usize {
    size.choose(20, 3)
}

/// Gain in per cent, mean lane changes of the aggressive and of the other drivers, mean speed of all in m/s.
fn run(size: Size, task: usize) -> TaskResult {
    let (point, seed) = (task / runs(size), task % runs(size) + 1);
    let scenario = points(size)[point].scenario(size, seed as u64);
    let (_, simulation) = measured(&scenario, &[]);
    let mean_of = |f: &dyn Fn(usize) -> f64, aggressive: bool| {
        let each =
            (0..simulation.vehicles()).filter(|&j| (simulation.driver(j).sensitivity > 1.0) == aggressive);
        mean(&each.map(f).collect::<Vec<_>>())
    };
    let distance = |j: usize| simulation.distance(j);
    let changes = |j: usize| f64::from(simulation.lane_changes(j));
    let all: Vec<f64> = (0..simulation.vehicles()).map(distance).collect();
    TaskResult {
        columns: vec![vec![
            100.0 * (mean_of(&distance, true) / mean_of(&distance, false) - 1.0),
            mean_of(&changes, true),
            mean_of(&changes, false),
            mean(&all) / simulation.time(),
        ]],
    }
}

/// The results of all points at which the same thing is varied.
struct Series {
    x: Vec<f64>,
    /// Gain, lane changes of the aggressive drivers, of the others, mean speed; one value for each point.
    values: [Vec<Estimate>; 4],
}

impl Series {
    fn of(size: Size, results: &[TaskResult], x: impl Fn(Point) -> Option<f64>) -> Self {
        let mut series = Self { x: Vec::new(), values: Default::default() };
        for (point, of_point) in points(size).into_iter().zip(results.chunks(runs(size))) {
            if let Some(at) = x(point) {
                series.x.push(at);
                for (k, values) in series.values.iter_mut().enumerate() {
                    let each: Vec<f64> = of_point.iter().map(|p| p.columns[0][k]).collect();
                    values.push(Estimate::mean(&each));
                }
            }
        }
        series
    }

    fn table(&self, first: Column) -> Table {
        let mut columns = vec![first];
        let names = [
            ("gain", "_percent", "%", "distance of the aggressive over that of the others, less one"),
            ("lane_changes_aggressive", "", "", "lane changes of an aggressive driver"),
            ("lane_changes_others", "", "", "lane changes of another driver"),
            ("mean_speed", "_m_per_s", "m/s", "mean speed of all"),
        ];
        for ((name, suffix, unit, words), values) in names.into_iter().zip(&self.values) {
            let value = values.iter().map(|e| e.value).collect();
            let half = values.iter().map(|e| e.uncertainty).collect();
            columns.push(Column::float(
                format!("{name}_mean{suffix}"),
                unit,
                format!("{words}, mean of the runs"),
                value,
            ));
            let meaning = format!("{words}, half-width of the 95 % interval of the mean");
            columns.push(Column::float(format!("{name}_half_interval{suffix}"), unit, meaning, half));
        }
        Table::new(columns)
    }

    fn points(&self, which: usize, name: &str, style: usize) -> Layer {
        Layer::Points {
            name: name.into(),
            style,
            x: self.x.clone(),
            y: self.values[which].iter().map(|e| e.value).collect(),
            error: self.values[which].iter().map(|e| e.uncertainty).collect(),
        }
    }

    fn panels(&self, x: &Axis) -> [Panel; 2] {
        let gain = Panel {
            title: "Gain in distance".into(),
            x: x.clone(),
            y: Axis::new("gain (%)"),
            layers: vec![
                Layer::Rule { name: "2 %".into(), vertical: false, at: 2.0, left: false },
                Layer::Rule { name: String::new(), vertical: false, at: 0.0, left: false },
                self.points(0, "", 0),
            ],
        };
        let changes = Panel {
            title: "Lane changes".into(),
            x: x.clone(),
            y: Axis::new("lane changes of a driver"),
            layers: vec![self.points(1, "aggressive", 0), self.points(2, "others", 1)],
        };
        [gain, changes]
    }
}

fn assemble(size: Size, results: &[TaskResult]) -> Outcome {
    let lambda = Series::of(size, results, |p| if let Point::Sensitivity(l) = p { Some(l) } else { None });
    let share = Series::of(size, results, |p| if let Point::Share(s) = p { Some(s) } else { None });
    let density =
        Series::of(size, results, |p| if let Point::Vehicles(n) = p { Some(n as f64) } else { None });
    let base = Point::Sensitivity(2.0).scenario(size, 1);
    let how = |what: &str| format!("{} runs for each {what}, seeds 1 to {0}", runs(size));
    let lambda_column =
        Column::float("sensitivity_per_s", "1/s", "λ of the aggressive driver", lambda.x.clone());
    let share_column = Column::float("share_percent", "%", "share of aggressive drivers", share.x.clone());
    let count_column = Column::whole(
        "vehicles",
        "",
        "N on two lanes of 1 km",
        density.x.iter().map(|&n| n as u64).collect(),
    );
    let tables = vec![
        FigureTable::summary("aggressive-gain-sensitivity", lambda.table(lambda_column), &base, how("λ")),
        FigureTable::summary("aggressive-gain-share", share.table(share_column), &base, how("share")),
        FigureTable::summary("aggressive-gain-density", density.table(count_column), &base, how("N")),
    ];
    let upper = [
        lambda.panels(&Axis::from_to("λ of the aggressive driver (1/s)", 1.0, 4.2)),
        share.panels(&Axis::from_to("share of aggressive drivers (%)", 0.0, 100.0)),
        density.panels(&Axis::from_to("vehicles on two lanes of 1 km", 0.0, 210.0)),
    ];
    let (gains, changes): (Vec<_>, Vec<_>) = upper.into_iter().map(|[gain, changes]| (gain, changes)).unzip();
    let plot = Plot {
        id: ID.into(),
        title: FIGURE.title.into(),
        description: "Above, the gain in distance of aggressive drivers; below, lane changes of aggressive and other \
                      drivers: against λ, against the share of aggressive drivers, and against the number of vehicles."
            .into(),
        columns: 3,
        panels: gains.into_iter().chain(changes).collect(),
    };
    let most = |series: &Series, what: &str| {
        let upper = |e: &Estimate| e.value + e.uncertainty;
        let (k, largest) = series.values[0]
            .iter()
            .enumerate()
            .max_by(|a, b| upper(a.1).total_cmp(&upper(b.1)))
            .expect("a point");
        Claim::new(
            ID,
            format!("beyond the paper: the gain stays under 2 % for every {what}; the largest"),
            "%",
            Expected::AtMost(2.0),
            *largest,
            format!(
                "{} runs of {} s at each of {} values, seeds 1 to {}, 95 % interval; the largest is at {}.",
                runs(size),
                base.until,
                series.x.len(),
                runs(size),
                series.x[k]
            ),
        )
    };
    let claims = vec![most(&lambda, "λ"), most(&share, "share"), most(&density, "number of vehicles")];
    Outcome { tables, plot, claims }
}
