//! Delays in force: how many steps ago each driver sees the scene.
//!
//! A reaction time Δ is m = round(Δ/dt) steps, the *target*. The delay in force is 0 at t = 0, grows by at most one
//! step per step towards the target and falls to it at once: so it never looks further back than what
//! was seen.

use crate::history::padded;

/// Delays of all drivers, in steps.
#[derive(Clone, Debug)]
pub struct Delays {
    target: Vec<u32>,
    /// What the delay may be at most now: one more than it was in the step before.
    cap: Vec<u32>,
    /// Padded, with delays of 0.
    delay: Vec<u32>,
    /// Every delay has been at its target for a step: nothing changes by itself.
    settled: bool,
    /// The delay that all drivers have, if they have one.
    common: Option<u32>,
}

impl Delays {
    /// At t = 0, with these targets.
    pub fn new(target: Vec<u32>) -> Self {
        let delay = vec![0; padded(target.len())];
        let cap = vec![0; target.len()];
        let mut delays = Self { target, cap, delay, settled: false, common: None };
        delays.find_common();
        delays
    }

    /// Gives a driver another target, from the present step on. To be followed by [`Self::find_common`].
    pub fn set_target(&mut self, j: usize, target: u32) {
        self.target[j] = target;
        self.delay[j] = target.min(self.cap[j]);
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
        self.find_common();
    }

    /// Finds out whether all drivers have one delay.
    pub fn find_common(&mut self) {
        let delays = &self.delay[..self.target.len()];
        self.common = delays.iter().all(|d| *d == delays[0]).then_some(delays[0]);
    }

    /// The delay that all drivers have, if they have one.
    #[inline]
    pub fn common(&self) -> Option<usize> {
        self.common.map(|d| d as usize)
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
            delays.find_common();
            seen.push(delays.of(0));
        }
        assert_eq!(seen, [0, 1, 2, 3, 3, 4, 5, 6, 1, 1, 2, 2]);
    }
}
