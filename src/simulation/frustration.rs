//! The rules of frustration, and the probability of an attempt to change lanes.
//!
//! P(φ) = (2/π)·arctan φ is the probability of an attempt within the next second; in a step of dt seconds it is
//! P* = 1 − (1 − P)^dt. [`super::attempt_sampler`] draws attempts with this probability.
//!
//! ```
//! use ringroad::simulation::frustration::{attempt_probability, attempt_probability_in_step};
//!
//! assert_eq!(attempt_probability(1.0), 0.5);
//! // Two steps of half a second without an attempt are a second without an attempt.
//! let none = 1.0 - attempt_probability_in_step(1.0, 0.5);
//! assert!((none * none - 0.5).abs() < 1e-15);
//! ```

use super::lane_order::AdjacentLeaders;
use crate::numerics::simd::{CHUNK, Chunk, Real, chunks, chunks_mut, kernel};
use std::f64::consts::FRAC_2_PI;

/// P(φ), the probability of an attempt within one second.
pub fn attempt_probability(frustration: f64) -> f64 {
    FRAC_2_PI * libm::atan(frustration)
}

/// The hazard of an attempt, −ln(1 − P(φ)), 1/s; precise for large φ too, where 1 − P = (2/π)·arctan(1/φ).
pub fn hazard(frustration: f64) -> f64 {
    if frustration <= 1.0 {
        -libm::log1p(-attempt_probability(frustration))
    } else {
        -libm::log(FRAC_2_PI * libm::atan(1.0 / frustration))
    }
}

/// P*, the probability of an attempt within a step of `time_step` seconds.
pub fn attempt_probability_in_step(frustration: f64, time_step: f64) -> f64 {
    -libm::expm1(-hazard(frustration) * time_step)
}

/// Headways (m) that differ by no more than this count as equal. The own headway is computed from that at the start, the
/// adjacent one from positions; without the tolerance, rounding errors would raise φ of vehicles side by side in equal lanes.
pub const EQUAL: f64 = 1e-6;

/// φ after rules 1 and 2: up by `change` where the adjacent headway is larger than the own one, down where it is
/// smaller, never below 0, unchanged where they are equal to within [`EQUAL`].
#[inline(always)]
pub(crate) fn compared(frustration: f64, own: f64, adjacent: f64, change: f64) -> f64 {
    let up = if own + EQUAL < adjacent { change } else { 0.0 };
    let down = if own > adjacent + EQUAL { change } else { 0.0 };
    let next = frustration + up - down;
    if next > 0.0 { next } else { 0.0 }
}

/// What drivers with one delay compare; all slices padded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Comparison<'a> {
    /// Displacements as perceived, m.
    pub(crate) perceived: &'a [f64],
    /// The adjacent leaders, on the outer side and on the inner side.
    pub(crate) adjacent: [&'a AdjacentLeaders; 2],
    /// Offsets of the own leaders, m.
    pub(crate) offsets: &'a [f64],
    /// Their displacements relative to the vehicles, as perceived, m.
    pub(crate) relative: &'a [f64],
    /// r·dt of every driver.
    pub(crate) change: &'a [f64],
}

kernel! {
    /// Rules 1 and 2 for vehicles that were not passed, chunk by chunk from chunk `next` on. It stops before chunk `end`, or
    /// before the first chunk in which the clock of a vehicle runs out, which stays unchanged; `next` is then that chunk.
    pub(crate) fn compare_chunks(
        comparison: Comparison<'_>, frustration: &mut [f64], clocks: &mut [f64], per_step: f64, next: &mut usize, end: usize,
    ) {
        let Comparison { perceived, adjacent: [outer, inner], offsets, relative, change } = comparison;
        let (own, offsets) = (&chunks(perceived)[..end], &chunks(offsets)[..end]);
        let (relative, change) = (&chunks(relative)[..end], &chunks(change)[..end]);
        let (outer_offsets, inner_offsets) = (&chunks(&outer.offsets)[..end], &chunks(&inner.offsets)[..end]);
        let outer_vehicles = &outer.vehicles.as_chunks::<CHUNK>().0[..end];
        let inner_vehicles = &inner.vehicles.as_chunks::<CHUNK>().0[..end];
        let frustration = &mut chunks_mut(frustration)[..end];
        let clocks = &mut chunks_mut(clocks)[..end];
        let (per_step, equal, none) = (Chunk::splat(per_step), Chunk::splat(EQUAL), Chunk::splat(0.0));
        for k in *next..end {
            let own = Chunk::load(&own[k]);
            let outer = Chunk::load(&outer_offsets[k]) + (Chunk::gather(perceived, &outer_vehicles[k]) - own);
            let inner = Chunk::load(&inner_offsets[k]) + (Chunk::gather(perceived, &inner_vehicles[k]) - own);
            let adjacent = inner.most(outer);
            let own = Chunk::load(&offsets[k]) + Chunk::load(&relative[k]);
            let change = Chunk::load(&change[k]);
            let up = (own + equal).where_below(adjacent, change);
            let down = (adjacent + equal).where_below(own, change);
            let updated = none.most((Chunk::load(&frustration[k]) + up) - down);
            let left = Chunk::load(&clocks[k]) - updated * per_step;
            if left.reaches(none) != u8::MAX >> (8 - CHUNK) {
                *next = k;
                return;
            }
            updated.store(&mut frustration[k]);
            left.store(&mut clocks[k]);
        }
        *next = end.max(*next);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::exp::exp;

    #[test]
    fn the_probability_of_the_paper() {
        assert!((attempt_probability(0.5) - 0.295).abs() < 1e-3, "“about 30 %”");
        assert_eq!(attempt_probability(0.0), 0.0);
        assert!(attempt_probability(1e12) <= 1.0);
        for phi in [0.0, 1e-6, 0.3, 0.999, 1.001, 7.0, 1e6] {
            let one_minus = 1.0 - attempt_probability(phi);
            assert!((exp(-hazard(phi)) - one_minus).abs() < 1e-15, "φ = {phi}");
        }
    }

    #[test]
    fn steps_compose_to_a_second() {
        for phi in [0.01, 0.5, 1.0, 3.0, 1e4] {
            for steps in [2, 20, 100, 1000] {
                let per_step = attempt_probability_in_step(phi, 1.0 / f64::from(steps));
                let none = (0..steps).fold(1.0, |none, _| none * (1.0 - per_step));
                assert!((1.0 - none - attempt_probability(phi)).abs() < 1e-12, "φ = {phi}, {steps} steps");
            }
        }
    }

    #[test]
    fn larger_smaller_equal_and_infinite_headways() {
        assert_eq!(compared(0.2, 10.0, 20.0, 0.1), 0.2 + 0.1);
        assert_eq!(compared(0.2, 20.0, 10.0, 0.1), 0.1);
        assert_eq!(compared(0.05, 20.0, 10.0, 0.1), 0.0);
        assert_eq!(compared(0.2, 10.0, 10.0, 0.1), 0.2);
        assert_eq!(compared(0.2, 10.0, f64::INFINITY, 0.1), 0.2 + 0.1);
    }
}
