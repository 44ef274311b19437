//! The stability summary: what linear theory says of the ring as it runs, in the few numbers of the page's sentence.
//!
//! ```
//! use ringroad::scenario::driver::Driver;
//! use ringroad::stability::summary::StabilitySummary;
//!
//! let driver = Driver { reaction_time: 0.75, ..Driver::default() };
//! let summary = StabilitySummary::of(&[vec![driver; 50]], 1000.0, 0.01);
//! assert_eq!((summary.stable, summary.mode), (Some(false), Some(8)));
//! assert!((summary.critical_discrete.unwrap() - 0.678_869).abs() < 1e-6);
//! ```

use super::lane::Lane;
use super::report::Report;
use crate::scenario::driver::{Driver, Equilibrium, equilibrium};

/// The numbers of the sentence, of the least stable lane.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct StabilitySummary {
    /// Whether every wave fades, in the run's steps; `None` where no wave can exist.
    pub stable: Option<bool>,
    /// Whether all drivers of the lane are the same to the theory.
    pub homogeneous: bool,
    /// Reaction time in whole steps, s; the mean where drivers differ.
    pub reaction_time: f64,
    /// Critical reaction time in continuous time, s, `None` if every one is stable; the mean where drivers differ.
    pub critical: Option<f64>,
    /// The same for the run's time step.
    pub critical_discrete: Option<f64>,
    /// By what factor all reaction times may grow before waves do (below 1: must shrink); `None` for homogeneous drivers.
    pub scale: Option<f64>,
    /// The largest growth rate in the run, 1/s.
    pub rate: Option<f64>,
    /// The mode q that grows fastest: its number of waves on the ring.
    pub mode: Option<usize>,
    /// The lane's equilibrium.
    pub equilibrium: Equilibrium,
    /// Lane, from 1.
    pub lane: usize,
    /// Vehicles in it.
    pub vehicles: usize,
}

impl Default for StabilitySummary {
    /// The summary of a ring without vehicles.
    fn default() -> Self {
        Self {
            stable: None,
            homogeneous: true,
            reaction_time: 0.0,
            critical: None,
            critical_discrete: None,
            scale: None,
            rate: None,
            mode: None,
            equilibrium: Equilibrium::default(),
            lane: 1,
            vehicles: 0,
        }
    }
}

impl StabilitySummary {
    /// The summary of lanes of drivers on a ring of `length` metres, in steps of `time_step` seconds. Delays are what
    /// they will be once all of them are in force.
    pub fn of(lanes: &[Vec<Driver>], length: f64, time_step: f64) -> Self {
        if lanes.iter().all(Vec::is_empty) {
            return Self::default();
        }
        let lanes: Vec<_> = lanes.iter().map(|drivers| Lane::new(drivers.clone(), time_step)).collect();
        let report = Report::of_lanes(&lanes, length, time_step);
        let moves = !report.jammed && report.vehicles > 1;
        Self {
            stable: moves.then_some(report.stable),
            homogeneous: report.homogeneous,
            reaction_time: report.delay_in_force_s,
            critical: report.critical_reaction_time_s,
            critical_discrete: report.critical_reaction_time_discrete_s,
            scale: report.critical_scale_discrete.filter(|_| !report.homogeneous),
            rate: report.max_growth_rate_discrete_per_s.filter(|_| moves),
            mode: report.fastest_mode_discrete.filter(|_| moves),
            equilibrium: equilibrium(&lanes[report.lane - 1].drivers, length).unwrap_or_default(),
            lane: report.lane,
            vehicles: report.vehicles,
        }
    }
}
