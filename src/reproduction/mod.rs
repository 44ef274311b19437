//! The paper's figures, and some that it points at: each is scenarios and probes that give tables, a picture and
//! claims, and nothing else.
//!
//! # Pieces
//!
//! A figure is a list of independent *pieces* of work, most of them one run each. Natively they run in parallel; a
//! page spreads them over workers, shows how many are done, and cancels by not asking for more. What a piece gives is
//! columns of numbers, a [`TaskResult`], which crosses from a worker as one array. [`Figure::assemble`] turns
//! all pieces into an [`Outcome`]; the result does not depend on who ran which piece in which order.
//!
//! Run k of a Monte Carlo figure has seed k, counted from 1.

mod aggressive_driver;
mod aggressive_gain;
pub mod claim;
mod cyclic;
mod frustration_flow;
mod fundamental_diagram;
mod load_balance;
mod stability;
mod waves;

use crate::error::{Error, quoted};
use crate::format::table::{Column, Table, Values};
use crate::measurement::Measurement;
use crate::measurement::probe::{Probe, measure};
use crate::measurement::provenance::{figure_to_csv, run_to_csv};
use crate::plot::Plot;
use crate::reproduction::claim::{Claim, Estimate, deviation, mean, student_95};
use crate::scenario::Scenario;
use crate::simulation::Simulation;
use serde::Serialize;

/// How much work to spend.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// As in the paper.
    Full,
    /// Fewer and shorter runs: for a first look, and for tests.
    Small,
}

impl Size {
    /// One of two.
    fn choose<T>(self, full: T, small: T) -> T {
        if self == Self::Full { full } else { small }
    }
}

/// What a piece of work gives: columns of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct TaskResult {
    /// The columns.
    pub columns: Vec<Vec<f64>>,
}

impl TaskResult {
    /// As one array: the number of columns, their lengths, then their numbers.
    pub fn flat(&self) -> Vec<f64> {
        let lengths = self.columns.iter().map(|c| c.len() as f64);
        std::iter::once(self.columns.len() as f64)
            .chain(lengths)
            .chain(self.columns.iter().flatten().copied())
            .collect()
    }

    /// Reads such an array.
    pub fn from_flat(flat: &[f64]) -> Result<Self, Error> {
        let wrong =
            || Error::new("piece", "an array of another form", "an array that a piece of a figure gave");
        let (&count, rest) = flat.split_first().ok_or_else(wrong)?;
        let count = count as usize;
        if rest.len() < count {
            return Err(wrong());
        }
        let (lengths, mut rest) = rest.split_at(count);
        let mut columns = Vec::with_capacity(count);
        for &length in lengths {
            let length = length as usize;
            if rest.len() < length {
                return Err(wrong());
            }
            let (column, after) = rest.split_at(length);
            columns.push(column.to_vec());
            rest = after;
        }
        if rest.is_empty() { Ok(Self { columns }) } else { Err(wrong()) }
    }
}

/// A piece of work that has begun. Where nothing else can stop it, it is done in slices, with a look at the person's
/// wishes in between.
pub trait Task {
    /// Goes on for about so many updates of a vehicle, or to its end where it is short; gives the piece when it is
    /// done.
    fn advance(&mut self, updates: u64) -> Option<TaskResult>;
}

/// Work that is short enough to be done at once.
impl<F: FnMut() -> TaskResult> Task for F {
    fn advance(&mut self, _: u64) -> Option<TaskResult> {
        Some(self())
    }
}

/// A table of a figure, with what made it.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureTable {
    /// Name, which becomes that of the file.
    pub name: String,
    /// The table.
    pub table: Table,
    source: Source,
}

/// What made a table.
#[derive(Clone, Debug, PartialEq)]
enum Source {
    /// One run.
    Run(Box<Scenario>, Measurement),
    /// Many runs, or theory: a scenario, and what was varied and how often it was run.
    Summary(Box<Scenario>, String),
}

impl FigureTable {
    /// The table of one run.
    fn run(name: impl Into<String>, table: Table, scenario: &Scenario, measurement: &Measurement) -> Self {
        let source = Source::Run(Box::new(scenario.clone()), measurement.clone());
        Self { name: name.into(), table, source }
    }

    /// A table over many runs of variants of one scenario.
    fn summary(name: impl Into<String>, table: Table, scenario: &Scenario, how: impl Into<String>) -> Self {
        Self { name: name.into(), table, source: Source::Summary(Box::new(scenario.clone()), how.into()) }
    }

    /// As CSV. The table of one run can be replayed from its header.
    pub fn to_csv(&self) -> String {
        match &self.source {
            Source::Run(scenario, measurement) => run_to_csv(&self.table, scenario, measurement),
            Source::Summary(scenario, how) => figure_to_csv(&self.table, &self.name, scenario, how),
        }
    }
}

/// What a figure gives.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Its tables.
    pub tables: Vec<FigureTable>,
    /// The picture.
    pub plot: Plot,
    /// The claims of the paper that it checks.
    pub claims: Vec<Claim>,
}

/// A figure.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Figure {
    /// Identifier, as the command writes it.
    pub id: &'static str,
    /// Title.
    pub title: &'static str,
    /// What it shows and how it is made, in a few sentences.
    pub caption: &'static str,
    /// Whether it goes beyond the paper.
    pub beyond: bool,
    #[serde(skip)]
    pieces: fn(Size) -> Vec<String>,
    #[serde(skip)]
    start: fn(Size, usize) -> Box<dyn Task>,
    #[serde(skip)]
    assemble: fn(Size, &[TaskResult]) -> Outcome,
}

/// Every figure, in the order of the paper, then those beyond it.
pub static FIGURES: [Figure; 7] = [
    fundamental_diagram::FIGURE,
    waves::FIGURE,
    stability::FIGURE,
    load_balance::FIGURE,
    aggressive_driver::FIGURE,
    aggressive_gain::FIGURE,
    frustration_flow::FIGURE,
];

impl Figure {
    /// The figure of that name.
    pub fn named(id: &str) -> Result<&'static Self, Error> {
        FIGURES.iter().find(|f| f.id == id).ok_or_else(|| {
            let ids: Vec<_> = FIGURES.iter().map(|f| f.id).collect();
            Error::new("figure", quoted(id), format!("{} or all", ids.join(", ")))
        })
    }

    /// What its pieces of work are, in a few words each.
    pub fn pieces(&self, size: Size) -> Vec<String> {
        (self.pieces)(size)
    }

    /// Begins a piece of work: a run or a few.
    ///
    /// # Panics
    /// If there is no such piece.
    pub fn start(&self, size: Size, piece: usize) -> Box<dyn Task> {
        (self.start)(size, piece)
    }

    /// Does a piece of work.
    ///
    /// # Panics
    /// If there is no such piece.
    pub fn run(&self, size: Size, piece: usize) -> TaskResult {
        let mut work = self.start(size, piece);
        loop {
            if let Some(piece) = work.advance(u64::MAX) {
                return piece;
            }
        }
    }

    /// Tables, picture and claims from all pieces, in their order.
    pub fn assemble(&self, size: Size, pieces: &[TaskResult]) -> Result<Outcome, Error> {
        let needed = self.pieces(size).len();
        if pieces.len() == needed {
            Ok((self.assemble)(size, pieces))
        } else {
            Err(Error::new("pieces", pieces.len(), format!("{needed} for {}", self.id)))
        }
    }

    /// All of it, on as many cores as there are. `done` is told of every finished piece.
    pub fn outcome(&self, size: Size, done: &(dyn Fn() + Sync)) -> Outcome {
        let work = |k: usize| {
            let piece = self.run(size, k);
            done();
            piece
        };
        let count = self.pieces(size).len();
        #[cfg(feature = "parallel")]
        let pieces: Vec<_> = {
            use rayon::prelude::*;
            (0..count).into_par_iter().map(work).collect()
        };
        #[cfg(not(feature = "parallel"))]
        let pieces: Vec<_> = (0..count).map(work).collect();
        (self.assemble)(size, &pieces)
    }
}

// ---- What the figures share ------------------------------------------------------------------------------------

/// The scenario of the paper's single-lane figures: vehicle 1 displaced by 1 m downstream.
fn nudged(reaction_time: f64, metres: f64, until: f64) -> Scenario {
    let mut scenario = Scenario { until, ..Scenario::default() };
    scenario.driver.reaction_time = reaction_time;
    scenario.actions.push(format!("at=0:1:nudge={metres}").parse().expect("the grammar of actions"));
    scenario
}

/// A run of a valid scenario to its end, with measurements: their tables, and the state at the end.
fn measured(scenario: &Scenario, measurements: &[Measurement]) -> (Vec<Table>, Simulation) {
    let probe = |m: &Measurement| m.probe(scenario).expect("measurements of figures are valid");
    let mut probes: Vec<_> = measurements.iter().map(probe).collect();
    let mut simulation = Simulation::new(scenario).expect("scenarios of figures are valid");
    measure(&mut simulation, &mut probes, &mut |_| true);
    (probes.iter().map(|p| p.table()).collect(), simulation)
}

/// A run with one probe of the figure's own.
fn observed(scenario: &Scenario, probe: &mut dyn Probe) -> Simulation {
    let mut simulation = Simulation::new(scenario).expect("scenarios of figures are valid");
    probe.observe(&simulation);
    while !simulation.is_finished() {
        simulation.step();
        probe.observe(&simulation);
    }
    simulation
}

/// The numbers of a table, column by column; text columns are left out.
fn numbers(table: &Table) -> Vec<Vec<f64>> {
    let one = |column: &Column| match &column.values {
        Values::Float(values) => Some(values.clone()),
        Values::Whole(values) => Some(values.iter().map(|&v| v as f64).collect()),
        Values::Text(_) => None,
    };
    table.columns().iter().filter_map(one).collect()
}

/// The table of a measurement of numbers alone, from the [`numbers`] that crossed as a piece.
fn refilled(scenario: &Scenario, measurement: &Measurement, columns: &[Vec<f64>]) -> Table {
    let empty = measurement.probe(scenario).expect("measurements of figures are valid").table();
    let fill = |(column, values): (&Column, &Vec<f64>)| match &column.values {
        Values::Whole(_) => Column::whole(
            column.name.clone(),
            column.unit,
            column.meaning.clone(),
            values.iter().map(|&v| v as u64).collect(),
        ),
        _ => Column::float(column.name.clone(), column.unit, column.meaning.clone(), values.clone()),
    };
    Table::new(empty.columns().iter().zip(columns).map(fill).collect())
}

/// The one column of that name, as numbers.
fn column(table: &Table, name: &str) -> Vec<f64> {
    table.floats(name).map_or_else(
        || table.wholes(name).expect("a column of numbers of that name").iter().map(|&v| v as f64).collect(),
        <[f64]>::to_vec,
    )
}

/// Mean, standard deviation and half-width of the 95 % interval of the mean over runs, row by row.
struct Spread {
    mean: Vec<f64>,
    deviation: Vec<f64>,
    half: Vec<f64>,
}

impl Spread {
    fn of(runs: &[&[f64]]) -> Self {
        let rows = runs.iter().map(|r| r.len()).min().unwrap_or(0);
        let mut spread = Self { mean: Vec::new(), deviation: Vec::new(), half: Vec::new() };
        for row in 0..rows {
            let values: Vec<_> = runs.iter().map(|r| r[row]).collect();
            let n = values.len() as f64;
            spread.mean.push(mean(&values));
            spread.deviation.push(deviation(&values));
            spread.half.push(student_95(n - 1.0) * deviation(&values) / n.sqrt());
        }
        spread
    }

    fn low(&self) -> Vec<f64> {
        self.mean.iter().zip(&self.half).map(|(m, h)| m - h).collect()
    }

    fn high(&self) -> Vec<f64> {
        self.mean.iter().zip(&self.half).map(|(m, h)| m + h).collect()
    }

    /// Columns `NAME_mean`, `NAME_deviation` and `NAME_half_interval`, the unit at the end of each name.
    fn columns(&self, name: &str, unit: &'static str, meaning: &str) -> Vec<Column> {
        let suffix = match unit {
            "" => "",
            "m" => "_m",
            "m/s" => "_m_per_s",
            "veh/s" => "_veh_per_s",
            "%" => "_percent",
            other => unreachable!("no suffix for {other}"),
        };
        [
            ("mean", "mean over the runs", &self.mean),
            ("deviation", "standard deviation over the runs", &self.deviation),
            ("half_interval", "half-width of the 95 % confidence interval of the mean", &self.half),
        ]
        .map(|(which, words, values)| {
            Column::float(
                format!("{name}_{which}{suffix}"),
                unit,
                format!("{meaning}: {words}"),
                values.clone(),
            )
        })
        .into()
    }
}

/// `true` as 1, for claims about what happens.
fn indicator(holds: bool) -> Estimate {
    Estimate::exact(f64::from(u8::from(holds)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_cross_as_one_array() {
        let piece = TaskResult { columns: vec![vec![1.0, 2.5], vec![], vec![-3.0]] };
        assert_eq!(TaskResult::from_flat(&piece.flat()).unwrap(), piece);
        for broken in [&[][..], &[2.0, 1.0], &[1.0, 2.0, 5.0], &[1.0, 1.0, 5.0, 6.0]] {
            assert!(TaskResult::from_flat(broken).is_err(), "{broken:?}");
        }
    }

    #[test]
    fn an_unknown_figure_and_a_missing_piece_are_refused_by_name() {
        let message = Figure::named("figure-9").unwrap_err().to_string();
        assert!(message.contains("figure-9") && message.contains("load-balance"), "{message}");
        let message = FIGURES[0].assemble(Size::Small, &[]).unwrap_err().to_string();
        assert!(message.contains("pieces") && message.contains("fundamental-diagram"), "{message}");
    }
}
