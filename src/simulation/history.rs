//! What was Δ ago: the displacements of all vehicles, one row a step, for as many steps as the longest reaction
//! time in use looks back.
//!
//! A displacement is the distance driven since t = 0 plus the nudges since then. Rows lie in a ring buffer, vehicles
//! side by side in a row, so that one step reads and writes memory in order.

use crate::numerics::simd::{Aligned, CHUNK};

/// Displacements (m) by step and vehicle.
#[derive(Clone, Debug)]
pub struct History {
    data: Aligned,
    vehicles: usize,
    /// The vehicle whose image comes after the last whole chunk.
    closing: usize,
    /// Numbers in a row, padding included.
    width: usize,
    /// Rows kept.
    rows: usize,
    /// The row of the present step.
    head: usize,
}

impl History {
    /// All displacements 0, with room to look back `steps` steps, and one more for the step in which delays grow.
    pub fn new(vehicles: usize, steps: usize) -> Self {
        // One more than a whole number of chunks: see `close`.
        let width = padded(vehicles) + CHUNK;
        let rows = rows_for(steps);
        let closing = padded(vehicles) % vehicles;
        Self { data: Aligned::filled(0.0, width * rows), vehicles, closing, width, rows, head: 0 }
    }

    /// The row of `delay` steps ago.
    #[inline]
    pub fn seen(&self, delay: usize) -> &[f64] {
        let start = self.row_start(delay);
        &self.data[start..start + self.width]
    }

    /// The displacement of one vehicle `delay` steps ago.
    #[inline]
    pub fn at(&self, delay: usize, vehicle: usize) -> f64 {
        self.data[self.row_start(delay) + vehicle]
    }

    /// The present row.
    #[inline]
    pub fn now(&self) -> &[f64] {
        self.seen(0)
    }

    /// Displaces a vehicle by so many metres, now.
    pub fn displace(&mut self, vehicle: usize, metres: f64) {
        let start = self.row_start(0);
        for image in images(vehicle, self.vehicles) {
            self.data[start + image] += metres;
        }
        self.close();
    }

    /// Repeats one more vehicle behind the last whole chunk, so that a row reads as closed: on one lane the
    /// leader of every vehicle is then the next number. To be called when the present row has been written.
    #[inline]
    pub fn close(&mut self) {
        let start = self.row_start(0);
        self.data[start + self.width - CHUNK] = self.data[start + self.closing];
    }

    /// Makes the next row the present one: gives it, to be written, and the others, to be read.
    #[inline]
    pub fn advance(&mut self) -> (&mut [f64], Past<'_>) {
        self.head = self.after(1);
        self.ahead(0)
    }

    /// The row that will be the present one so many steps on, to be written, and those that will be its past.
    #[inline]
    pub(crate) fn ahead(&mut self, steps: usize) -> (&mut [f64], Past<'_>) {
        let start = self.after(steps) * self.width;
        let (before, rest) = self.data.split_at_mut(start);
        let (row, after) = rest.split_at_mut(self.width);
        (row, Past { before, after, width: self.width })
    }

    /// Makes rows that have been written ahead the present and the past.
    pub(crate) fn catch_up(&mut self, steps: usize) {
        for _ in 0..steps {
            self.head = self.after(1);
            self.close();
        }
    }

    #[inline]
    fn after(&self, steps: usize) -> usize {
        let row = self.head + steps;
        if row < self.rows { row } else { row - self.rows }
    }

    /// How far back it can look, in steps.
    pub fn looks_back(&self) -> usize {
        self.rows - rows_for(0)
    }

    /// Changes how far back it can look. Rows that were not kept before are not to be asked for: the delay in
    /// force grows by at most one step per step.
    pub fn look_back(&mut self, steps: usize) {
        let rows = rows_for(steps);
        if rows == self.rows {
            return;
        }
        let mut data = Aligned::filled(0.0, self.width * rows);
        let kept = rows.min(self.rows);
        for delay in 0..kept {
            let target = (kept - 1 - delay) * self.width;
            data[target..target + self.width].copy_from_slice(self.seen(delay));
        }
        (self.data, self.rows, self.head) = (data, rows, kept - 1);
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.data.bytes()
    }

    #[inline]
    fn row_start(&self, delay: usize) -> usize {
        debug_assert!(delay < self.rows, "delay {delay} of {} rows", self.rows);
        let row = if delay <= self.head { self.head - delay } else { self.head + self.rows - delay };
        row * self.width
    }
}

/// The rows of a [`History`] but the present one.
#[derive(Clone, Copy, Debug)]
pub struct Past<'a> {
    before: &'a [f64],
    after: &'a [f64],
    width: usize,
}

impl<'a> Past<'a> {
    /// The row of `delay` ≥ 1 steps ago.
    #[inline]
    pub fn seen(self, delay: usize) -> &'a [f64] {
        let back = delay * self.width;
        match self.before.len().checked_sub(back) {
            Some(start) => &self.before[start..][..self.width],
            None => &self.after[self.after.len() - (back - self.before.len())..][..self.width],
        }
    }
}

/// Where a vehicle stands in padded arrays: the padding repeats the first vehicles, so that whatever is done to all
/// vehicles, chunk by chunk, is done to the images as to their originals and nothing that is computed from them differs.
pub(crate) fn images(vehicle: usize, vehicles: usize) -> impl Iterator<Item = usize> {
    (vehicle..padded(vehicles)).step_by(vehicles)
}

/// Vehicles padded to whole chunks.
pub(crate) fn padded(vehicles: usize) -> usize {
    vehicles.next_multiple_of(CHUNK)
}

/// The present row, those looked back at, and one more: the step in which a reaction time grows looks back a step
/// farther at once. So the row before the present one is always there too, by which passes are told.
fn rows_for(steps: usize) -> usize {
    steps + 2
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Row i holds the value i throughout.
    fn advanced(history: &mut History, value: f64) {
        history.advance().0.fill(value);
    }

    #[test]
    fn it_looks_back_as_far_as_asked_through_changes_of_length() {
        let mut history = History::new(3, 4);
        let mut step = 0.0;
        for look_back in [4, 2, 7, 7, 1, 5] {
            history.look_back(look_back);
            for _ in 0..11 {
                step += 1.0;
                advanced(&mut history, step);
            }
            for delay in 0..=look_back + 1 {
                assert_eq!(history.at(delay, 2), step - delay as f64);
            }
        }
        // Growing keeps what was known.
        history.look_back(9);
        for delay in 0..=6 {
            assert_eq!(history.at(delay, 0), step - delay as f64);
        }
    }

    #[test]
    fn it_holds_the_rows_in_use_and_no_more() {
        assert_eq!(History::new(16, 75).bytes(), (16 + 8) * 8 * 77);
        let mut history = History::new(16, 75);
        history.look_back(10);
        assert_eq!(history.bytes(), (16 + 8) * 8 * 12);
    }
}
