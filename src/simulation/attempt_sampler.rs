//! When a driver attempts a lane change.
//!
//! A [`Sampler`] draws attempts with the probability P* per step of [`attempt_probability_in_step`]. [`Literal`] draws
//! a number for every vehicle and step; [`ExponentialClock`] has the same distribution and draws only when an attempt is
//! possible. A simulation takes the sampler as a type parameter:
//!
//! ```
//! use ringroad::scenario::Scenario;
//! use ringroad::simulation::Simulation;
//! use ringroad::simulation::attempt_sampler::Literal;
//!
//! let scenario = Scenario { lanes: 2, ..Scenario::default() };
//! let mut simulation = Simulation::<Literal>::with_sampler(&scenario)?;
//! simulation.run_to(100);
//! assert_eq!(simulation.step_index(), 100);
//! # Ok::<(), ringroad::error::Error>(())
//! ```

use super::frustration::attempt_probability_in_step;
use super::padding::padded;
use crate::numerics::random::Generator;
use crate::numerics::simd::Aligned;

/// Decides when a driver attempts a lane change.
pub trait Sampler: Clone {
    /// For so many vehicles and a step of `time_step` seconds; all draws are made from `generator`.
    fn new(vehicles: usize, time_step: f64, generator: Generator) -> Self;
    /// Whether this vehicle attempts a lane change in this step.
    fn attempts(&mut self, vehicle: usize, frustration: f64) -> bool;
    /// Which of two equally good lanes: true for the outer one.
    fn coin(&mut self) -> bool;
    /// For each vehicle (padded) what is left of its exponential clock, and by how much this falls in a step for each unit
    /// of φ: a vehicle can attempt a change only when it has fallen below 0. None if this sampler has no clocks.
    fn clocks(&mut self) -> Option<(&mut [f64], f64)> {
        None
    }
}

/// The rule as it is written: a uniform number for every vehicle and step, compared with P*.
#[derive(Clone, Debug)]
pub struct Literal {
    time_step: f64,
    generator: Generator,
}

impl Sampler for Literal {
    fn new(_vehicles: usize, time_step: f64, generator: Generator) -> Self {
        Self { time_step, generator }
    }
    fn attempts(&mut self, _vehicle: usize, frustration: f64) -> bool {
        self.generator.uniform() < attempt_probability_in_step(frustration, self.time_step)
    }
    fn coin(&mut self) -> bool {
        self.generator.coin()
    }
}

/// An upper bound of the hazard is [`BOUND`]·φ: the largest value of −ln(1 − P(φ))/φ is 0.703413 at φ = 0.6732.
const BOUND: f64 = 0.703_42;

/// An exponential clock for every vehicle, run by an upper bound of the hazard and thinned to the true one.
///
/// The clock of a vehicle holds an exponentially distributed amount E of hazard; each step takes away
/// ĝ(φ)·dt with ĝ(φ) = 0.70342·φ ≥ −ln(1 − P(φ)). Since E has no memory, the step in which it runs out is
/// that of the first success of independent draws with probability P̂ = 1 − exp(−ĝ·dt) each. A success
/// counts as an attempt with probability P*/P̂, so that the probability of an attempt is P*. Then E is drawn anew. So the distribution is the
/// literal one, and a step costs a multiplication and a comparison.
#[derive(Clone, Debug)]
pub struct ExponentialClock {
    left: Aligned,
    bound_per_step: f64,
    time_step: f64,
    generator: Generator,
    bounds: ProbabilityBounds,
}

impl Sampler for ExponentialClock {
    fn new(vehicles: usize, time_step: f64, mut generator: Generator) -> Self {
        let mut left = Aligned::filled(f64::INFINITY, padded(vehicles));
        left[..vehicles].fill_with(|| generator.exponential());
        Self {
            left,
            bound_per_step: BOUND * time_step,
            time_step,
            generator,
            bounds: ProbabilityBounds::new(),
        }
    }

    #[inline(always)]
    fn attempts(&mut self, vehicle: usize, frustration: f64) -> bool {
        let hazard_bound = frustration * self.bound_per_step;
        let left = self.left[vehicle] - hazard_bound;
        self.left[vehicle] = left;
        // Strictly less: a clock that was set to exactly 0 must not run out at φ = 0.
        left < 0.0 && self.runs_out(vehicle, frustration, hazard_bound)
    }

    fn coin(&mut self) -> bool {
        self.generator.coin()
    }

    fn clocks(&mut self) -> Option<(&mut [f64], f64)> {
        Some((&mut self.left, self.bound_per_step))
    }
}

impl ExponentialClock {
    /// Sets the clock that has run out anew, and draws whether this is an attempt.
    #[cold]
    fn runs_out(&mut self, vehicle: usize, frustration: f64, hazard_bound: f64) -> bool {
        self.left[vehicle] = self.generator.exponential();
        let uniform = self.generator.uniform();
        self.bounds.decide(uniform, hazard_bound, frustration, self.time_step).unwrap_or_else(|| {
            let bound = -libm::expm1(-hazard_bound);
            uniform * bound < attempt_probability_in_step(frustration, self.time_step)
        })
    }
}

/// Bounds of P* and P̂ that decide most draws as the exact comparison would, without a transcendental function: P* grows
/// with φ, so that it lies between its values at two nodes, and P̂ = 1 − e^−x lies between x/(1 + x) and the smaller of x
/// and 1.
#[derive(Clone, Debug)]
struct ProbabilityBounds {
    /// P* at the nodes from [`Self::FIRST`] on; NaN where it has not been computed yet.
    known: Vec<f64>,
}

impl ProbabilityBounds {
    /// Nodes are the numbers with at most one bit after the leading one, 1, 1.5, 2, 3, 4 …; so many bits below are 0.
    const BITS: u32 = 51;
    /// The node 2⁻¹⁰.
    const FIRST: u64 = (1023 - 10) << 1;
    /// So many nodes, up to 2⁴⁰.
    const COUNT: usize = 101;

    fn new() -> Self {
        Self { known: vec![f64::NAN; Self::COUNT] }
    }

    /// P* at a node.
    fn at(&mut self, node: usize, time_step: f64) -> Option<f64> {
        let known = self.known.get_mut(node)?;
        if known.is_nan() {
            let frustration = f64::from_bits((Self::FIRST + node as u64) << Self::BITS);
            *known = attempt_probability_in_step(frustration, time_step);
        }
        Some(*known)
    }

    /// Whether u·P̂ < P*, where the bounds tell; none where they do not.
    fn decide(&mut self, uniform: f64, hazard_bound: f64, frustration: f64, time_step: f64) -> Option<bool> {
        const ROUNDING: f64 = 1e-9;
        let node = (frustration.to_bits() >> Self::BITS).checked_sub(Self::FIRST)? as usize;
        let ceiling = self.at(node + 1, time_step)?;
        if uniform * (hazard_bound / (1.0 + hazard_bound)) > ceiling * (1.0 + ROUNDING) {
            return Some(false);
        }
        let floor = self.at(node, time_step)?;
        (uniform * hazard_bound.min(1.0) < floor * (1.0 - ROUNDING)).then_some(true)
    }
}

#[cfg(test)]
mod tests {
    use super::super::frustration::hazard;
    use super::*;
    use crate::numerics::exp::exp;
    use crate::numerics::random::Stream;

    #[test]
    fn bounds_decide_as_the_exact_comparison_does() {
        let mut generator = Generator::new(3, Stream::LaneChanging);
        let (mut bounds, time_step) = (ProbabilityBounds::new(), 0.01);
        let mut decided = [0, 0];
        let draws = 400_000;
        for k in 0..draws {
            let frustration =
                if k % 20 == 0 { f64::from(1 << (k % 31)) } else { exp(30.0 * generator.uniform() - 8.0) };
            let (uniform, hazard_bound) = (generator.uniform(), BOUND * frustration * time_step);
            let exact =
                uniform * -libm::expm1(-hazard_bound) < attempt_probability_in_step(frustration, time_step);
            if let Some(decision) = bounds.decide(uniform, hazard_bound, frustration, time_step) {
                assert_eq!(decision, exact, "φ = {frustration}, u = {uniform}");
                decided[usize::from(decision)] += 1;
            }
        }
        let share = f64::from(decided[0] + decided[1]) / f64::from(draws);
        assert!(share > 0.8 && decided[1] > 1000, "{decided:?} of {draws} are decided");
    }

    #[test]
    fn the_clock_runs_on_an_upper_bound() {
        for k in 1..200_000 {
            let phi = f64::from(k) * 1e-4;
            assert!(hazard(phi) <= BOUND * phi, "φ = {phi}");
        }
        for k in 0..60 {
            let phi = 20.0 * exp(f64::from(k));
            assert!(hazard(phi) <= BOUND * phi, "φ = {phi}");
        }
    }

    /// Two-sample Kolmogorov–Smirnov test of the step of the first attempt under a rising and falling φ: with
    /// 10⁵ samples each, sup|F₁ − F₂| exceeds 1.95·√(2/10⁵) = 0.00872 with probability 0.001 under equality.
    #[test]
    fn the_exponential_clock_and_the_literal_sampler_have_one_distribution() {
        fn first_attempts<S: Sampler>(seed: u64, path: fn(u32) -> f64) -> Vec<u32> {
            let n = 100_000;
            let mut sampler = S::new(n, 0.05, Generator::new(seed, Stream::LaneChanging));
            let first = |j| (0..4000).find(|&step| sampler.attempts(j, path(step))).unwrap_or(4000);
            (0..n).map(first).collect()
        }
        let paths: [fn(u32) -> f64; 3] = [
            |step| 0.005 * f64::from(step),
            |step| 0.4 + 0.3 * f64::from(step % 50) / 50.0,
            |step| if step % 40 < 20 { 0.0 } else { 30.0 * f64::from(step) / 4000.0 },
        ];
        for path in paths {
            let mut a = first_attempts::<Literal>(1, path);
            let mut b = first_attempts::<ExponentialClock>(2, path);
            a.sort_unstable();
            b.sort_unstable();
            let below =
                |sorted: &[u32], step| sorted.partition_point(|&x| x <= step) as f64 / sorted.len() as f64;
            let largest = (0..4000).map(|s| (below(&a, s) - below(&b, s)).abs()).fold(0.0, f64::max);
            assert!(largest < 0.00872, "Kolmogorov–Smirnov distance {largest}");
        }
    }
}
