//! Tasks: the units of work of a figure, and their results.
//!
//! A figure is a list of independent tasks, most of them one run each. Natively they run on all cores. A page spreads
//! them over workers, counts the finished ones, and cancels by starting no further task. A [`TaskResult`] is columns
//! of numbers, which cross from a worker to the page as one array.
//!
//! ```
//! use ringroad::reproduction::task::TaskResult;
//!
//! let result = TaskResult { columns: vec![vec![1.0, 2.5], vec![], vec![-3.0]] };
//! assert_eq!(result.flat(), [3.0, 2.0, 0.0, 1.0, 1.0, 2.5, -3.0]);
//! assert_eq!(TaskResult::from_flat(&result.flat())?, result);
//! # Ok::<(), ringroad::error::Error>(())
//! ```

use crate::error::Error;
use crate::numerics::parallel;
use std::convert::Infallible;

/// How much work to spend on a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// As many and as long runs as in the paper.
    Full,
    /// Fewer and shorter runs: for a first look, and for tests.
    Small,
}

impl Size {
    /// The first value at full size, the second at small size.
    pub(super) fn choose<T>(self, full: T, small: T) -> T {
        if self == Self::Full { full } else { small }
    }
}

/// The result of a task: columns of numbers, which may differ in length. Their meaning is known to the figure.
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

    /// Reads an array that [`TaskResult::flat`] made.
    ///
    /// # Errors
    /// If the lengths in the array do not fit its own length.
    pub fn from_flat(flat: &[f64]) -> Result<Self, Error> {
        let wrong =
            || Error::malformed("task result", "an array of another form", "an array that a task gave");
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

/// A task that has begun. Where nothing else can interrupt it (a page without workers), it runs in slices, and the
/// page handles its events between two of them.
pub trait Task {
    /// Continues for about `updates` updates of a single vehicle, or to the end where the task is short. Gives the
    /// result when the task is finished, `None` before.
    fn advance(&mut self, updates: u64) -> Option<TaskResult>;
}

/// A task that is short enough to run in one slice.
impl<F: FnMut() -> TaskResult> Task for F {
    fn advance(&mut self, _: u64) -> Option<TaskResult> {
        Some(self())
    }
}

/// The results of the tasks 0 … `count` − 1, in this order, computed on as many cores as there are.
pub(super) fn run_all(count: usize, task: impl Fn(usize) -> TaskResult + Sync + Send) -> Vec<TaskResult> {
    let Ok(results) = parallel::try_map(count, None, |k| Ok::<_, Infallible>(task(k)));
    results
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_cross_as_one_array() {
        let result = TaskResult { columns: vec![vec![1.0, 2.5], vec![], vec![-3.0]] };
        assert_eq!(TaskResult::from_flat(&result.flat()).unwrap(), result);
        for broken in [&[][..], &[2.0, 1.0], &[1.0, 2.0, 5.0], &[1.0, 1.0, 5.0, 6.0]] {
            assert!(TaskResult::from_flat(broken).is_err(), "{broken:?}");
        }
    }
}
