//! Delays in force: how many steps ago each driver sees the scene.
//!
//! A reaction time Δ is m = round(Δ/dt) steps, the *target*. The delay in force is 0 at t = 0, grows by at most one
//! step per step towards the target and falls to it at once: so it never looks further back than what
//! was seen.

use crate::numerics::simd::Aligned;
use crate::simulation::history::{images, padded};

/// Delays of all drivers, in steps.
#[derive(Clone, Debug)]
pub struct Delays {
    target: Vec<u32>,
    /// What the delay may be at most now: one more than it was in the step before.
    cap: Vec<u32>,
    /// Padded.
    delay: Vec<u32>,
    /// Every delay has been at its target for a step: nothing changes by itself.
    settled: bool,
    /// The different delays in force, where they are few; else none.
    few: Vec<usize>,
    /// For each of them but the first: who has it; see [`Delays::chosen`].
    chosen: Vec<Aligned>,
}

/// So many different delays are few.
pub(crate) const FEW: usize = 4;

/// A number of which every bit is set: a mask.
const EVERY_BIT: f64 = f64::from_bits(u64::MAX);

impl Delays {
    /// At t = 0, with these targets.
    pub fn new(target: Vec<u32>) -> Self {
        let delay = vec![0; padded(target.len())];
        let cap = vec![0; target.len()];
        let chosen = vec![Aligned::filled(0.0, padded(target.len())); FEW - 1];
        let mut delays = Self { target, cap, delay, settled: false, few: Vec::with_capacity(FEW), chosen };
        delays.find_few();
        delays
    }

    /// Gives a driver another target, from the present step on. To be followed by [`Self::find_few`].
    pub fn set_target(&mut self, j: usize, target: u32) {
        self.target[j] = target;
        for image in images(j, self.target.len()) {
            self.delay[image] = target.min(self.cap[j]);
        }
        self.settled = false;
    }

    /// To the next step.
    pub fn advance(&mut self) {
        if self.settled {
            return;
        }
        self.settled = true;
        for ((delay, cap), &target) in self.delay.iter_mut().zip(&mut self.cap).zip(&self.target) {
            *cap = *delay + 1;
            *delay = target.min(*cap);
            self.settled &= *cap > target;
        }
        let (vehicles, originals) = (self.target.len(), padded(self.target.len()));
        for image in vehicles..originals {
            self.delay[image] = self.delay[image - vehicles];
        }
        self.find_few();
    }

    /// Finds out which delays there are.
    pub fn find_few(&mut self) {
        self.few.clear();
        for &delay in &self.delay[..self.target.len()] {
            if self.few.contains(&(delay as usize)) {
                continue;
            }
            if self.few.len() == FEW {
                self.few.clear();
                return;
            }
            self.few.push(delay as usize);
        }
        for (chosen, &which) in self.chosen.iter_mut().zip(&self.few[1..]) {
            for (chosen, &delay) in chosen.iter_mut().zip(&self.delay) {
                *chosen = if delay as usize == which { EVERY_BIT } else { 0.0 };
            }
        }
    }

    /// The delay that all drivers have, if they have one.
    #[inline]
    pub fn common(&self) -> Option<usize> {
        if let [delay] = self.few[..] { Some(delay) } else { None }
    }

    /// The different delays, where there are only a few; else none.
    #[inline]
    pub fn few(&self) -> &[usize] {
        &self.few
    }

    /// For each of [`Self::few`] but the first a mask over all drivers (padded): all bits set for those who have it.
    #[inline]
    pub(crate) fn chosen(&self) -> &[Aligned] {
        &self.chosen
    }

    /// Whether no delay changes by itself.
    #[inline]
    pub fn are_settled(&self) -> bool {
        self.settled
    }

    /// The delay in force of a driver.
    #[inline]
    pub fn of(&self, j: usize) -> usize {
        self.delay[j] as usize
    }

    /// The delays in force of all drivers (padded).
    #[inline]
    pub fn all(&self) -> &[u32] {
        &self.delay
    }

    /// The longest target: how far back anyone may come to look.
    pub fn longest_target(&self) -> usize {
        self.target.iter().copied().max().unwrap_or(0) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_grows_by_a_step_and_falls_at_once() {
        let mut delays = Delays::new(vec![3]);
        let mut seen = vec![delays.of(0)];
        for step in 1..12 {
            delays.advance();
            match step {
                5 => delays.set_target(0, 6),
                8 => delays.set_target(0, 1),
                10 => delays.set_target(0, 2),
                _ => {}
            }
            delays.find_few();
            seen.push(delays.of(0));
        }
        assert_eq!(seen, [0, 1, 2, 3, 3, 4, 5, 6, 1, 1, 2, 2]);
    }
}
