//! The characteristic roots of a lane: the leading ones of every mode, in continuous time and in the steps of a simulation,
//! and a choice of them for a picture.
//!
//! ```
//! use ringroad::scenario::Scenario;
//! use ringroad::stability::roots::{leading_factors, leading_roots};
//!
//! let mut scenario = Scenario::default(); // 50 vehicles, so modes 1 … 25
//! scenario.driver.reaction_time = 0.75;
//! let roots = leading_roots(&scenario, 0, 2);
//! assert_eq!(roots.len(), 2 * 25);
//! assert!(roots.iter().any(|root| root.real_per_s > 0.0)); // some mode grows
//! let factors = leading_factors(&scenario, 0, 2);
//! assert!(factors.iter().all(|factor| factor.residual < 1e-10));
//! ```

use super::discrete_roots::DiscreteRoot;
use super::driver_classes::DriverClasses;
use super::homogeneous::Time;
use super::lane::{Lane, LaneClasses, lanes_of};
use crate::numerics::complex::{Complex64, norm};
use crate::scenario::Scenario;
use serde::Serialize;
use std::f64::consts::PI;

/// A characteristic root in continuous time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[non_exhaustive]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ModeRoot {
    /// q.
    pub mode: usize,
    /// The branch of Lambert's W; of heterogeneous drivers, the branch of homogeneous drivers from which it was followed.
    pub branch: i32,
    /// Re s, 1/s.
    pub real_per_s: f64,
    /// Im s, 1/s.
    pub imaginary_per_s: f64,
    /// What rounding has left of the equation, as a change of the root, relative to max(1, |s|).
    pub residual: f64,
}

/// The `count` leading characteristic roots of every mode of a lane (from 0), mode by mode, by falling real part.
///
/// # Panics
/// If the scenario has no such lane.
pub fn leading_roots(scenario: &Scenario, lane: usize, count: usize) -> Vec<ModeRoot> {
    let lane = lanes_of(scenario).swap_remove(lane);
    let classes = lane.classes(scenario.length, scenario.time_step).continuous;
    roots_of_modes(&classes, 1..=classes.vehicles() / 2, count)
}

/// The same of the simulation: its `count` leading growth factors for every mode, by falling modulus.
///
/// # Panics
/// If the scenario has no such lane.
pub fn leading_factors(scenario: &Scenario, lane: usize, count: usize) -> Vec<DiscreteRoot> {
    let lane = lanes_of(scenario).swap_remove(lane);
    let dt = scenario.time_step;
    let classes = lane.classes(scenario.length, dt).in_steps;
    let modes = 1..=classes.vehicles() / 2;
    if let Some((ring, _)) = classes.homogeneous() {
        let steps = lane.delay_steps[0];
        return modes.flat_map(|q| ring.leading_factors(q, steps, dt, count)).collect();
    }
    let time = Time::Steps(dt);
    let of_mode = |q: usize| {
        let reach = count as i32;
        let mut roots: Vec<DiscreteRoot> = Vec::new();
        // Branch 0 first, then −1, 1, −2, 2 …: z has an argument within half a turn, so a branch that leads to a known z
        // gives no new root.
        for k in (0..=reach).flat_map(|k| if k == 0 { vec![0] } else { vec![-k, k] }) {
            let Some(s) = classes.follow(q, k, time).filter(|s| (s.im * dt).abs() < PI + 1e-9) else {
                continue;
            };
            let root = DiscreteRoot::new(q, k, s, dt, classes.residual(s, time) / norm(s).max(1.0));
            let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
            let known = |r: &DiscreteRoot| {
                near(r.factor_real, root.factor_real) && near(r.factor_imaginary, root.factor_imaginary)
            };
            if !roots.iter().any(known) {
                roots.push(root);
            }
        }
        roots.sort_by(|a, b| b.real_per_s.total_cmp(&a.real_per_s));
        roots.truncate(count);
        roots
    };
    modes.flat_map(of_mode).collect()
}

fn roots_of_modes(
    classes: &DriverClasses,
    modes: impl Iterator<Item = usize>,
    count: usize,
) -> Vec<ModeRoot> {
    let root = |mode: usize, branch: i32, s: Complex64, residual: f64| ModeRoot {
        mode,
        branch,
        real_per_s: s.re,
        imaginary_per_s: s.im,
        residual,
    };
    if let Some((ring, delay)) = classes.homogeneous() {
        let of_mode = |q: usize| {
            let roots = ring.leading_roots(q, delay, count).into_iter();
            roots.map(move |r| root(q, r.branch, r.value, r.residual))
        };
        return modes.flat_map(of_mode).collect();
    }
    let of_mode = |q: usize| {
        let reach = count as i32;
        let mut roots: Vec<ModeRoot> = Vec::new();
        for k in -reach..=reach {
            let Some(s) = classes.follow(q, k, Time::Continuous) else { continue };
            let residual = classes.residual(s, Time::Continuous) / norm(s).max(1.0);
            roots.insert(roots.partition_point(|r| r.real_per_s >= s.re), root(q, k, s, residual));
        }
        roots.truncate(count);
        roots
    };
    modes.flat_map(of_mode).collect()
}

/// The roots of a lane as a picture shows them.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[non_exhaustive]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct LaneRoots {
    /// Vehicles in the lane.
    pub vehicles: usize,
    /// Whether all its drivers are the same to the theory, so that its modes are Fourier's.
    #[serde(rename = "equal_drivers")]
    pub homogeneous: bool,
    /// The modes shown.
    pub modes: Vec<usize>,
    /// Growth rate (1/s) of each in the simulation's steps; `None` where the root could not be followed.
    pub growth_per_s: Vec<Option<f64>>,
    /// Angular frequency (1/s) of each in steps.
    pub frequency_per_s: Vec<Option<f64>>,
    /// The next roots of the modes, in continuous time.
    pub next: Vec<ModeRoot>,
}

impl LaneRoots {
    /// The dominant root of every mode in the steps of the simulation (`time_step` in seconds, ring of `length` metres), and
    /// the next `others` of each in continuous time; of about `most` modes, evenly spread, where there are more.
    pub fn of(lane: &Lane, length: f64, time_step: f64, others: usize, most: usize) -> Self {
        let LaneClasses { continuous, in_steps, .. } = lane.classes(length, time_step);
        let last = continuous.vehicles() / 2;
        if continuous.is_jammed() || last == 0 {
            return Self { vehicles: continuous.vehicles(), ..Self::default() };
        }
        let modes: Vec<usize> = (1..=last).step_by(last.div_ceil(most.max(1))).collect();
        let time = Time::Steps(time_step);
        let dominant: Vec<_> = match in_steps.homogeneous() {
            Some((ring, delay)) => modes.iter().map(|&q| Some(ring.root(q, delay, time))).collect(),
            None => modes.iter().map(|&q| in_steps.follow(q, 0, time)).collect(),
        };
        let mut next = roots_of_modes(&continuous, modes.iter().copied(), others + 1);
        next.retain(|root| root.branch != 0);
        Self {
            vehicles: continuous.vehicles(),
            homogeneous: in_steps.homogeneous().is_some(),
            growth_per_s: dominant.iter().map(|s| s.map(|s| s.re)).collect(),
            frequency_per_s: dominant.iter().map(|s| s.map(|s| s.im)).collect(),
            modes,
            next,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stability::report::Report;

    /// The largest growth rate among the roots of a picture is the report's; all next roots lie to the left.
    #[test]
    fn roots_of_a_picture_and_the_report_agree() {
        let scenario = |reaction_time| {
            let mut scenario = Scenario::default();
            scenario.driver.reaction_time = reaction_time;
            scenario
        };
        let mut heterogeneous = scenario(0.75);
        heterogeneous.overrides = vec!["1-4:reaction-time=0.3".parse().unwrap()];
        for scenario in [scenario(0.5), scenario(0.75), heterogeneous] {
            let lane = lanes_of(&scenario).remove(0);
            let roots = LaneRoots::of(&lane, 1000.0, 0.01, 1, 200);
            let largest = roots.growth_per_s.iter().flatten().copied().fold(f64::NEG_INFINITY, f64::max);
            let report = Report::of(&scenario);
            assert_eq!((roots.modes.len(), roots.homogeneous), (25, report.homogeneous));
            assert!((largest - report.max_growth_rate_discrete_per_s.unwrap()).abs() < 1e-12);
            let dominant = report.max_growth_rate_per_s.unwrap();
            assert_eq!(roots.next.len(), 25);
            assert!(roots.next.iter().all(|root| root.branch != 0 && root.real_per_s < dominant));
        }
        let jam = Scenario { vehicles: 150, ..scenario(1.0) };
        assert!(LaneRoots::of(&lanes_of(&jam)[0], 1000.0, 0.01, 1, 200).modes.is_empty());
    }
}
