//! A lane as the theory takes it: its drivers, and the delay of each that is in force.
//!
//! ```
//! use ringroad::scenario::Scenario;
//! use ringroad::stability::lane::lanes_of;
//!
//! let mut scenario = Scenario { vehicles: 5, lanes: 2, ..Scenario::default() };
//! scenario.driver.reaction_time = 0.75;
//! let lanes = lanes_of(&scenario);
//! assert_eq!(lanes[0].delay_steps, [75, 75, 75]); // in steps of 0.01 s
//! assert_eq!(lanes[1].drivers.len(), 2);
//! ```

use super::driver_classes::DriverClasses;
use crate::scenario::Scenario;
use crate::scenario::driver::{Driver, Equilibrium, equilibrium};

/// The drivers of a lane and the delay of each that is in force, in steps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lane {
    /// Drivers, in any order: it does not matter to the theory.
    pub drivers: Vec<Driver>,
    /// Delay of each, steps.
    pub delay_steps: Vec<u64>,
}

/// A lane in equilibrium, by driver classes, in both times.
#[derive(Clone, Debug)]
pub(super) struct LaneClasses {
    /// The equilibrium; 0 everywhere in an empty lane.
    pub equilibrium: Equilibrium,
    /// With the drivers' reaction times.
    pub continuous: DriverClasses,
    /// With the delays in force.
    pub in_steps: DriverClasses,
}

impl Lane {
    /// A lane of drivers with the delays that they have in steps of `time_step` seconds once all are in force.
    pub fn new(drivers: Vec<Driver>, time_step: f64) -> Self {
        let delay_steps = drivers.iter().map(|d| (d.reaction_time / time_step).round() as u64).collect();
        Self { drivers, delay_steps }
    }

    /// Its driver classes on a ring of `length` metres, in continuous time and in steps of `time_step` seconds.
    pub(super) fn classes(&self, length: f64, time_step: f64) -> LaneClasses {
        let equilibrium = equilibrium(&self.drivers, length).unwrap_or_default();
        let reaction_times = self.drivers.iter().map(|d| d.reaction_time);
        let delays = self.delay_steps.iter().map(|&m| m as f64 * time_step);
        LaneClasses {
            continuous: DriverClasses::in_equilibrium(&self.drivers, reaction_times, &equilibrium),
            in_steps: DriverClasses::in_equilibrium(&self.drivers, delays, &equilibrium),
            equilibrium,
        }
    }
}

/// The lanes of a scenario at the start, with the delays that their drivers will have in force.
pub fn lanes_of(scenario: &Scenario) -> Vec<Lane> {
    let drivers = scenario.drivers();
    let mut rest = drivers.as_slice();
    let mut lane = |count: usize| {
        let (own, others) = rest.split_at(count);
        rest = others;
        Lane::new(own.to_vec(), scenario.time_step)
    };
    scenario.vehicles_per_lane().into_iter().map(&mut lane).collect()
}
