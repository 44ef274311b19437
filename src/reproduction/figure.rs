//! A figure: its tasks, and the tables, the picture and the claims that come from their results.
//!
//! ```
//! use ringroad::reproduction::{Figure, Size};
//!
//! // The tasks of a figure can be done in any order and place; their results make the figure.
//! let figure = Figure::named("fundamental-diagram")?;
//! let results: Vec<_> = (0..figure.tasks(Size::Small).len()).map(|k| figure.run(Size::Small, k)).collect();
//! assert!(!figure.assemble(Size::Small, &results)?.claims.is_empty());
//! # Ok::<(), ringroad::Error>(())
//! ```

use super::claim::Claim;
use super::task::{Size, Task, TaskResult, run_all};
use crate::error::Error;
use crate::format::table::Table;
use crate::measurement::Measurement;
use crate::measurement::provenance::{figure_to_csv, run_to_csv};
use crate::plot::Plot;
use crate::scenario::Scenario;
use serde::Serialize;

/// A figure of the paper, or one beyond it.
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
    /// A few words on each task.
    #[serde(skip)]
    pub(super) tasks: fn(Size) -> Vec<String>,
    /// Begins the task of that index.
    #[serde(skip)]
    pub(super) start: fn(Size, usize) -> Box<dyn Task>,
    /// The outcome from the results of all tasks, in their order.
    #[serde(skip)]
    pub(super) assemble: fn(Size, &[TaskResult]) -> Outcome,
}

impl Figure {
    /// A few words on each of its tasks. Their number is the number of tasks.
    pub fn tasks(&self, size: Size) -> Vec<String> {
        (self.tasks)(size)
    }

    /// Begins a task, counted from 0.
    ///
    /// # Panics
    /// If there is no such task.
    pub fn start(&self, size: Size, task: usize) -> Box<dyn Task> {
        (self.start)(size, task)
    }

    /// Runs a task, counted from 0, to its end.
    ///
    /// # Panics
    /// If there is no such task.
    pub fn run(&self, size: Size, task: usize) -> TaskResult {
        let mut task = self.start(size, task);
        loop {
            if let Some(result) = task.advance(u64::MAX) {
                return result;
            }
        }
    }

    /// Tables, picture and claims from the results of all tasks, in the order of the tasks.
    ///
    /// # Errors
    /// If the number of results is not the number of tasks.
    pub fn assemble(&self, size: Size, results: &[TaskResult]) -> Result<Outcome, Error> {
        let needed = self.tasks(size).len();
        if results.len() == needed {
            Ok((self.assemble)(size, results))
        } else {
            Err(Error::out_of_range("task results", results.len(), format!("{needed} for {}", self.id)))
        }
    }

    /// Runs all tasks, on as many cores as there are, and assembles their results. `done` is called after every
    /// finished task. The outcome does not depend on the number of cores nor on the order in which tasks end.
    pub fn outcome(&self, size: Size, done: &(dyn Fn() + Sync)) -> Outcome {
        let results = run_all(self.tasks(size).len(), |task| {
            let result = self.run(size, task);
            done();
            result
        });
        (self.assemble)(size, &results)
    }
}

/// Everything that a figure gives.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Outcome {
    /// Its tables.
    pub tables: Vec<FigureTable>,
    /// The picture.
    pub plot: Plot,
    /// The claims of the paper that it checks.
    pub claims: Vec<Claim>,
}

/// A table of a figure, and how it was made.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureTable {
    /// Name of the table and of its file.
    pub name: String,
    /// The table.
    pub table: Table,
    source: Source,
}

/// How a table was made.
#[derive(Clone, Debug, PartialEq)]
enum Source {
    /// From one run.
    Run(Box<Scenario>, Measurement),
    /// From many runs of variants of a scenario, or from theory; the text says what was varied and how many runs
    /// there were.
    Summary(Box<Scenario>, String),
}

impl FigureTable {
    /// The table of one run.
    pub(super) fn run(
        name: impl Into<String>,
        table: Table,
        scenario: &Scenario,
        measurement: &Measurement,
    ) -> Self {
        let source = Source::Run(Box::new(scenario.clone()), measurement.clone());
        Self { name: name.into(), table, source }
    }

    /// A table of many runs of variants of a scenario, or of theory.
    pub(super) fn summary(
        name: impl Into<String>,
        table: Table,
        scenario: &Scenario,
        made_from: impl Into<String>,
    ) -> Self {
        let source = Source::Summary(Box::new(scenario.clone()), made_from.into());
        Self { name: name.into(), table, source }
    }

    /// The table as CSV. That of one run can be replayed from its header.
    pub fn to_csv(&self) -> String {
        match &self.source {
            Source::Run(scenario, measurement) => run_to_csv(&self.table, scenario, measurement),
            Source::Summary(scenario, made_from) => {
                figure_to_csv(&self.table, &self.name, scenario, made_from)
            }
        }
    }
}
