//! The displacements of the past: a row of all vehicles for every step, as many rows as the longest reaction time in use
//! looks back.
//!
//! A displacement is the distance moved since t = 0, nudges after t = 0 included. The rows lie in a ring buffer, vehicles
//! side by side in a row, so that a step reads and writes memory in order. A row is padded to whole chunks and then
//! *closed*: one more chunk begins with the image of the next vehicle. On one lane, where the leader of vehicle j is
//! j + 1, the displacements of all leaders are then the same row read from its second number on. Rows are written only
//! through functions that close them.

use super::padding::{images, padded};
use crate::numerics::simd::{Aligned, CHUNK};

/// Displacements (m) by step and vehicle.
#[derive(Clone, Debug)]
pub(crate) struct History {
    data: Aligned,
    vehicles: usize,
    /// The vehicle whose image closes a row.
    closing: usize,
    /// Numbers in a row, padding included.
    width: usize,
    /// Rows kept, and rows needed from the next step on.
    rows: usize,
    needed: usize,
    /// The row of the present step.
    head: usize,
}

impl History {
    /// At t = 0, all displacements 0, for delays of up to `steps` steps.
    pub(crate) fn new(vehicles: usize, steps: usize) -> Self {
        let width = padded(vehicles) + CHUNK;
        let rows = rows_for(steps);
        let data = Aligned::filled(0.0, width * rows);
        Self { data, vehicles, closing: padded(vehicles) % vehicles, width, rows, needed: rows, head: 0 }
    }

    /// The row of `delay` steps ago.
    #[inline]
    pub(crate) fn row(&self, delay: usize) -> &[f64] {
        let start = self.row_start(delay);
        &self.data[start..start + self.width]
    }

    /// The present row.
    #[inline]
    pub(crate) fn now(&self) -> &[f64] {
        self.row(0)
    }

    /// Displaces a vehicle by so many metres, now.
    pub(crate) fn displace(&mut self, vehicle: usize, metres: f64) {
        let start = self.row_start(0);
        for image in images(vehicle, self.vehicles) {
            self.data[start + image] += metres;
        }
        self.close();
    }

    /// Goes to the next step: `write` gets its row, to be filled up to the padding's end, and the rows before it.
    #[inline]
    pub(crate) fn advance<R>(&mut self, write: impl FnOnce(&mut [f64], Past<'_>) -> R) -> R {
        if self.needed != self.rows {
            self.resize(self.needed);
        }
        self.head = self.after(1);
        let (row, past) = self.row_ahead(0);
        let result = write(row, past);
        self.close();
        result
    }

    /// Goes so many steps on: `write` gets access to their rows and fills each up to the padding's end. They are closed
    /// only then; so while they are written none of them may be read as a row of leaders.
    #[inline]
    pub(crate) fn advance_many(&mut self, steps: usize, write: impl FnOnce(&mut RowsAhead<'_>)) {
        write(&mut RowsAhead(self));
        for _ in 0..steps {
            self.head = self.after(1);
            self.close();
        }
    }

    /// Whether more rows are kept than are needed; the next [`Self::advance`] drops them.
    pub(crate) fn is_longer_than_needed(&self) -> bool {
        self.needed < self.rows
    }

    /// From now on delays are up to `steps` steps. Rows are added at once and dropped with the next step only, since
    /// another action of this step may need them again. Added rows hold nothing: the delay in force, which grows by at
    /// most one step per step, does not reach them before they are written.
    pub(crate) fn require(&mut self, steps: usize) {
        self.needed = rows_for(steps);
        if self.needed > self.rows {
            self.resize(self.needed);
        }
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> usize {
        self.data.bytes()
    }

    #[cold]
    fn resize(&mut self, rows: usize) {
        let mut data = Aligned::filled(0.0, self.width * rows);
        let kept = rows.min(self.rows);
        for delay in 0..kept {
            let target = (kept - 1 - delay) * self.width;
            data[target..target + self.width].copy_from_slice(self.row(delay));
        }
        (self.data, self.rows, self.head) = (data, rows, kept - 1);
    }

    /// Repeats one more vehicle behind the padding of the present row.
    #[inline]
    fn close(&mut self) {
        let start = self.row_start(0);
        self.data[start + self.width - CHUNK] = self.data[start + self.closing];
    }

    /// The row that will be the present one so many steps on, and those that will be its past.
    #[inline]
    fn row_ahead(&mut self, steps: usize) -> (&mut [f64], Past<'_>) {
        let start = self.after(steps) * self.width;
        let (before, rest) = self.data.split_at_mut(start);
        let (row, after) = rest.split_at_mut(self.width);
        (row, Past { before, after, width: self.width })
    }

    #[inline]
    fn after(&self, steps: usize) -> usize {
        let row = self.head + steps;
        if row < self.rows { row } else { row - self.rows }
    }

    #[inline]
    fn row_start(&self, delay: usize) -> usize {
        debug_assert!(delay < self.rows, "delay {delay} of {} rows", self.rows);
        let row = if delay <= self.head { self.head - delay } else { self.head + self.rows - delay };
        row * self.width
    }
}

/// The rows of steps that are being taken; see [`History::advance_many`].
pub(crate) struct RowsAhead<'a>(&'a mut History);

impl RowsAhead<'_> {
    /// The row of the step that is so many steps on, to be written, and the rows before it.
    #[inline]
    pub(crate) fn row(&mut self, steps: usize) -> (&mut [f64], Past<'_>) {
        self.0.row_ahead(steps)
    }
}

/// The rows of a [`History`] but the one that is being written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Past<'a> {
    before: &'a [f64],
    after: &'a [f64],
    width: usize,
}

impl<'a> Past<'a> {
    /// The row of `delay` ≥ 1 steps before.
    #[inline]
    pub(crate) fn row(self, delay: usize) -> &'a [f64] {
        let back = delay * self.width;
        match self.before.len().checked_sub(back) {
            Some(start) => &self.before[start..][..self.width],
            None => &self.after[self.after.len() - (back - self.before.len())..][..self.width],
        }
    }
}

/// Rows for delays of up to `steps` steps: the present one, those before it, and one more for the step in which a
/// longer reaction time comes into force. So the row before the present one, which is needed to find passes, is always there.
fn rows_for(steps: usize) -> usize {
    steps + 2
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Row i holds the value i throughout.
    fn advanced(history: &mut History, value: f64) {
        history.advance(|row, _| row.fill(value));
    }

    #[test]
    fn it_looks_back_as_far_as_required_through_changes_of_length() {
        let mut history = History::new(3, 4);
        let mut step = 0.0;
        for steps in [4, 2, 7, 7, 1, 5] {
            history.require(steps);
            for _ in 0..11 {
                step += 1.0;
                advanced(&mut history, step);
            }
            for delay in 0..=steps + 1 {
                assert_eq!(history.row(delay)[2], step - delay as f64);
            }
        }
        // What was known is kept when rows are added.
        history.require(9);
        for delay in 0..=6 {
            assert_eq!(history.row(delay)[0], step - delay as f64);
        }
    }

    #[test]
    fn it_holds_the_rows_in_use_and_no_more() {
        assert_eq!(History::new(16, 75).bytes(), (16 + 8) * 8 * 77);
        let mut history = History::new(16, 75);
        history.require(10);
        assert!(history.is_longer_than_needed());
        history.require(75);
        assert!(!history.is_longer_than_needed(), "nothing is dropped before the next step");
        history.require(10);
        advanced(&mut history, 1.0);
        assert_eq!(history.bytes(), (16 + 8) * 8 * 12);
    }

    #[test]
    fn every_way_to_write_a_row_closes_it() {
        let n = CHUNK;
        let mut history = History::new(n, 3);
        let fill = |row: &mut [f64], value: f64| row[..n].iter_mut().for_each(|x| *x = value);
        history.advance(|row, _| fill(row, 1.0));
        assert_eq!(history.now()[n], 1.0);
        history.displace(0, 0.5);
        assert_eq!(history.now()[n], 1.5);
        history.advance_many(2, |rows| {
            for step in 1..=2 {
                fill(rows.row(step).0, 1.0 + step as f64);
            }
        });
        assert_eq!([0, 1, 2].map(|delay| history.row(delay)[n]), [3.0, 2.0, 1.5]);
    }
}
