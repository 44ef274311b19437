//! What linear theory says of the ring as it runs, in the few numbers of the page's sentence.

use crate::scenario::driver::{Driver, Equilibrium, equilibrium};
use crate::stability::report::{Lane, Report};

/// The sentence's numbers, of the least stable lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StabilitySummary {
    /// Whether every wave fades, in the run's steps; none where no wave can exist.
    pub stable: Option<bool>,
    /// Whether all drivers of the lane are alike.
    pub alike: bool,
    /// Reaction time in whole steps, s; the mean where drivers differ.
    pub reaction_time: f64,
    /// Critical reaction time in continuous time, s, none if every one is stable; the mean where drivers differ.
    pub critical: Option<f64>,
    /// The same for the run's time step.
    pub critical_discrete: Option<f64>,
    /// By what factor all reaction times may grow before waves do (below 1: must shrink); none of equal drivers.
    pub scale: Option<f64>,
    /// The largest growth rate in the run, 1/s.
    pub rate: Option<f64>,
    /// Number of jams of the fastest wave.
    pub mode: Option<usize>,
    /// The lane's equilibrium.
    pub equilibrium: Equilibrium,
    /// Lane, from 1.
    pub lane: usize,
    /// Vehicles in it.
    pub vehicles: usize,
}

impl Default for StabilitySummary {
    /// Of a ring about which nothing is known.
    fn default() -> Self {
        Self {
            stable: None,
            alike: true,
            reaction_time: 0.0,
            critical: None,
            critical_discrete: None,
            scale: None,
            rate: None,
            mode: None,
            equilibrium: Equilibrium { speed: 0.0, density: 0.0, flow: 0.0 },
            lane: 1,
            vehicles: 0,
        }
    }
}

/// The verdict on lanes of drivers on a ring of `length` metres, in steps of `time_step` seconds. Delays are what
/// they will be once all of them are in force.
pub fn verdict(lanes: &[Vec<Driver>], length: f64, time_step: f64) -> StabilitySummary {
    if lanes.iter().all(Vec::is_empty) {
        return StabilitySummary::default();
    }
    let lanes: Vec<_> = lanes.iter().map(|drivers| lane(drivers.clone(), time_step)).collect();
    let report = Report::of_lanes(&lanes, length, time_step);
    let moves = !report.jammed && report.vehicles > 1;
    StabilitySummary {
        stable: moves.then_some(report.stable),
        alike: report.equal_drivers,
        reaction_time: report.delay_in_force_s,
        critical: report.critical_reaction_time_s,
        critical_discrete: report.critical_reaction_time_discrete_s,
        scale: report.critical_scale_discrete.filter(|_| !report.equal_drivers),
        rate: report.max_growth_rate_discrete_per_s.filter(|_| moves),
        mode: report.fastest_mode_discrete.filter(|_| moves),
        equilibrium: equilibrium(&lanes[report.lane - 1].drivers, length)
            .unwrap_or(StabilitySummary::default().equilibrium),
        lane: report.lane,
        vehicles: report.vehicles,
    }
}

/// Drivers of one lane as theory sees them, with the delays that they will have in steps of `time_step` seconds.
pub fn lane(drivers: Vec<Driver>, time_step: f64) -> Lane {
    let delay_steps = drivers.iter().map(|d| (d.reaction_time / time_step).round() as u64).collect();
    Lane { drivers, delay_steps }
}
