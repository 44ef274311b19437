//! The rows of a probe that looks at regular times: which states give rows, and where the rows are kept.
//!
//! A state is *due* every so many steps, for some tables also at a collision. A due state gives one row, one row for
//! each vehicle, or one number for each column: the probe decides. When the same time is shown twice, because an action
//! was made by hand, the rows of the second look replace those of the first.

use crate::format::table::Column;
use crate::simulation::Simulation;

/// The rows of all due states so far.
#[derive(Clone, Debug)]
pub(crate) struct DueRows<R> {
    every: u64,
    at_collision: bool,
    /// Step of the last due state.
    last: Option<u64>,
    /// Where its rows begin.
    start: usize,
    /// Times of the due states, s.
    times: Vec<f64>,
    rows: Vec<R>,
}

impl<R> DueRows<R> {
    /// A state is due every so many steps.
    pub(crate) fn every(every: u64) -> Self {
        Self { every, at_collision: false, last: None, start: 0, times: Vec::new(), rows: Vec::new() }
    }

    /// A state is due every so many steps, and at a collision.
    pub(crate) fn with_collision(every: u64) -> Self {
        Self { at_collision: true, ..Self::every(every) }
    }

    /// Whether the state is due: `None` if not. If it is, the rows that come now ([`Self::push`], [`Self::extend`])
    /// are those of its time, and the rows that an earlier look at the same time gave are taken out and returned.
    pub(crate) fn begin(&mut self, simulation: &Simulation) -> Option<Vec<R>> {
        let step = simulation.step_index();
        if step % self.every != 0 && !(self.at_collision && simulation.collision().is_some()) {
            return None;
        }
        if self.last.replace(step) == Some(step) {
            return Some(self.rows.drain(self.start..).collect());
        }
        self.start = self.rows.len();
        self.times.push(simulation.time());
        Some(Vec::new())
    }

    /// Adds a row of the state that has begun.
    pub(crate) fn push(&mut self, row: R) {
        self.rows.push(row);
    }

    /// Adds rows of the state that has begun.
    pub(crate) fn extend(&mut self, rows: impl IntoIterator<Item = R>) {
        self.rows.extend(rows);
    }

    /// If the state is due, adds its only row.
    pub(crate) fn record(&mut self, simulation: &Simulation, row: impl FnOnce() -> R) {
        if self.begin(simulation).is_some() {
            self.push(row());
        }
    }

    /// Times of the due states, s.
    pub(crate) fn times(&self) -> &[f64] {
        &self.times
    }

    /// All rows, in order of time.
    pub(crate) fn rows(&self) -> &[R] {
        &self.rows
    }

    /// How many rows each due state has, where all have the same number; 0 before the first.
    pub(crate) fn per_time(&self) -> usize {
        self.rows.len().checked_div(self.times.len()).unwrap_or(0)
    }

    /// Time of every row, s, where all due states have the same number of rows.
    pub(crate) fn time_of_rows(&self) -> Vec<f64> {
        self.times.iter().flat_map(|&time| std::iter::repeat_n(time, self.per_time())).collect()
    }

    /// The column `time_s`, a value for each row.
    pub(crate) fn time_column(&self) -> Column {
        Column::float("time_s", "s", "time", self.time_of_rows())
    }

    /// A value from each row.
    pub(crate) fn each<T>(&self, value: fn(&R) -> T) -> Vec<T> {
        self.rows.iter().map(value).collect()
    }
}

impl<T: Copy> DueRows<T> {
    /// The k-th of the `width` values that each due state gave.
    pub(crate) fn nth_of_each(&self, k: usize, width: usize) -> Vec<T> {
        self.rows.iter().skip(k).step_by(width).copied().collect()
    }
}
