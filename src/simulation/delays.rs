//! Delays in force: how many steps old the positions are that each driver responds to.
//!
//! A reaction time Δ is m = round(Δ/dt) steps, the *target*. The delay in force is 0 at t = 0, grows by at most one
//! step per step towards the target, and falls to it at once. So a driver never responds to positions from before t = 0,
//! nor to older ones than those it has responded to already.

use super::padding::{images, padded};
use crate::numerics::simd::Aligned;

/// Delays of all drivers, in steps.
#[derive(Clone, Debug)]
pub(crate) struct Delays {
    target: Vec<u32>,
    /// The largest delay that is allowed now: one more than the delay in the step before.
    cap: Vec<u32>,
    /// Padded.
    delay: Vec<u32>,
    /// All delays have been at their targets for a step, so that none changes by itself.
    settled: bool,
    /// The different delays in force where there are at most [`MAX_DISTINCT`], else none.
    distinct: Vec<usize>,
    /// See [`Delays::masks`].
    masks: Vec<Aligned>,
}

/// Steps are taken in one go where there are at most so many different delays.
pub(crate) const MAX_DISTINCT: usize = 4;

/// A number of which every bit is set.
const EVERY_BIT: f64 = f64::from_bits(u64::MAX);

impl Delays {
    /// At t = 0, with these targets.
    pub(crate) fn new(target: Vec<u32>) -> Self {
        let delay = vec![0; padded(target.len())];
        let cap = vec![0; target.len()];
        let masks = vec![Aligned::filled(0.0, padded(target.len())); MAX_DISTINCT - 1];
        let distinct = Vec::with_capacity(MAX_DISTINCT);
        let mut delays = Self { target, cap, delay, settled: false, distinct, masks };
        delays.find_distinct();
        delays
    }

    /// Gives drivers other targets (vehicle, steps), from the present step on.
    pub(crate) fn set_targets(&mut self, targets: impl IntoIterator<Item = (usize, u32)>) {
        for (j, target) in targets {
            self.target[j] = target;
            for image in images(j, self.target.len()) {
                self.delay[image] = target.min(self.cap[j]);
            }
        }
        self.settled = false;
        self.find_distinct();
    }

    /// Goes to the next step.
    pub(crate) fn advance(&mut self) {
        if self.settled {
            return;
        }
        self.settled = true;
        for ((delay, cap), &target) in self.delay.iter_mut().zip(&mut self.cap).zip(&self.target) {
            *cap = *delay + 1;
            *delay = target.min(*cap);
            self.settled &= *cap > target;
        }
        let (vehicles, padded) = (self.target.len(), padded(self.target.len()));
        for image in vehicles..padded {
            self.delay[image] = self.delay[image - vehicles];
        }
        self.find_distinct();
    }

    fn find_distinct(&mut self) {
        self.distinct.clear();
        for &delay in &self.delay[..self.target.len()] {
            if self.distinct.contains(&(delay as usize)) {
                continue;
            }
            if self.distinct.len() == MAX_DISTINCT {
                self.distinct.clear();
                return;
            }
            self.distinct.push(delay as usize);
        }
        for (mask, &distinct) in self.masks.iter_mut().zip(&self.distinct[1..]) {
            for (mask, &delay) in mask.iter_mut().zip(&self.delay) {
                *mask = if delay as usize == distinct { EVERY_BIT } else { 0.0 };
            }
        }
    }

    /// The delay that all drivers have, if they have one.
    #[inline]
    pub(crate) fn common(&self) -> Option<usize> {
        if let [delay] = self.distinct[..] { Some(delay) } else { None }
    }

    /// The different delays in force, where there are at most [`MAX_DISTINCT`]; else none.
    #[inline]
    pub(crate) fn distinct(&self) -> &[usize] {
        &self.distinct
    }

    /// For each of [`Self::distinct`] but the first a mask over all drivers (padded): all bits set for the drivers that
    /// have this delay, none for the others.
    #[inline]
    pub(crate) fn masks(&self) -> &[Aligned] {
        &self.masks
    }

    /// Whether no delay changes by itself.
    #[inline]
    pub(crate) fn are_settled(&self) -> bool {
        self.settled
    }

    /// The delay in force of a driver.
    #[inline]
    pub(crate) fn of(&self, j: usize) -> usize {
        self.delay[j] as usize
    }

    /// The delays in force of all drivers (padded).
    #[inline]
    pub(crate) fn all(&self) -> &[u32] {
        &self.delay
    }

    /// The longest target: no delay in force becomes longer.
    pub(crate) fn longest_target(&self) -> usize {
        self.target.iter().copied().max().unwrap_or(0) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_grows_by_a_step_and_falls_at_once() {
        let mut delays = Delays::new(vec![3]);
        let mut in_force = vec![delays.of(0)];
        for step in 1..12 {
            delays.advance();
            match step {
                5 => delays.set_targets([(0, 6)]),
                8 => delays.set_targets([(0, 1)]),
                10 => delays.set_targets([(0, 2)]),
                _ => {}
            }
            assert_eq!(delays.common(), Some(delays.of(0)));
            in_force.push(delays.of(0));
        }
        assert_eq!(in_force, [0, 1, 2, 3, 3, 4, 5, 6, 1, 1, 2, 2]);
    }

    #[test]
    fn different_delays_are_counted_after_every_change() {
        let mut delays = Delays::new(vec![2; 6]);
        (0..5).for_each(|_| delays.advance());
        assert_eq!(delays.distinct(), [2]);
        delays.set_targets([(1, 0), (2, 1)]);
        assert_eq!(delays.distinct(), [2, 0, 1]);
        assert!(
            delays.masks()[0][1].is_nan() && delays.masks()[0][2] == 0.0 && delays.masks()[1][2].is_nan()
        );
        delays.set_targets((0..6).map(|j| (j, j as u32)));
        (0..5).for_each(|_| delays.advance());
        assert_eq!((delays.distinct(), delays.common()), (&[][..], None), "too many");
    }
}
