//! Actions: those of the scenario at their time, and those made while running.
//!
//! An action made while running is added to the scenario with the present time, so that a replay of the scenario gives
//! the same bits.

use super::attempt_sampler::Sampler;
use super::state::{Simulation, UNKNOWN};
use crate::error::{Error, quoted};
use crate::numerics::random::Stream;
use crate::numerics::simd::Width;
use crate::scenario::action::{Action, Effect, VehicleSelector};
use crate::scenario::driver::Driver;
use crate::scenario::parameters::RoadField;

impl<S: Sampler> Simulation<S> {
    /// Makes an action now: its `at` becomes the present time, and it is added to the scenario, so that a replay gives
    /// the same bits. A refused action changes nothing. After a collision every action is refused, since a replay would
    /// make it before the collision.
    ///
    /// ```
    /// use ringroad::scenario::Scenario;
    /// use ringroad::simulation::Simulation;
    ///
    /// let mut simulation = Simulation::new(&Scenario::default())?;
    /// simulation.run_to(100);
    /// simulation.act("at=0:7:brake=3".parse()?)?;
    /// assert_eq!(simulation.speed(6), 0.0);
    /// assert_eq!(simulation.scenario().actions[0].at, 1.0);
    /// # Ok::<(), ringroad::error::Error>(())
    /// ```
    pub fn act(&mut self, mut action: Action) -> Result<(), Error> {
        action.at = self.scenario.time_of(self.step);
        if self.collision.is_some() {
            return Err(Error::conflict("action", quoted(&action.to_string()), "none after a collision"));
        }
        self.scenario.check_action(&action)?;
        let index = self.scenario.actions.len();
        let members = self.scenario.selected(action.vehicles, Stream::Action(index));
        let mut longest = 0.0_f64;
        for &j in &members {
            let mut driver = self.drivers[j];
            for effect in &action.effects {
                if let Effect::Set(field, value) = *effect {
                    driver.set(field, value);
                }
            }
            driver.check()?;
            longest = longest.max(driver.reaction_time);
        }
        self.scenario.check_history(longest)?;
        self.scenario.actions.push(action);
        self.apply(index);
        self.perceive(false);
        Ok(())
    }

    /// Removes from the scenario the actions of this step that the last [`Self::act`] replaces: a replay gives the same
    /// bits with fewer actions.
    pub fn forget_replaced(&mut self) {
        let Some((last, before)) = self.scenario.actions.split_last() else { return };
        // The vehicles of a share are drawn by the action's place in the list, which must therefore stay.
        let first =
            before.iter().rposition(|a| matches!(a.vehicles, VehicleSelector::Share(_))).map_or(0, |k| k + 1);
        let replaced = |&k: &usize| {
            self.scenario.steps(before[k].at) == self.step
                && self.scenario.steps(last.at) == self.step
                && last.replaces(&before[k])
        };
        let places: Vec<usize> = (first..before.len()).rev().filter(replaced).collect();
        for k in places {
            let mut fewer = self.scenario.clone();
            fewer.actions.remove(k);
            // An action in between may be valid only because of it: a headway that fits a shorter vehicle.
            if fewer.validate().is_ok() {
                self.scenario = fewer;
                for (_, index) in &mut self.agenda {
                    *index -= usize::from(*index > k);
                }
            }
        }
    }

    /// Computes with vectors of another width; results stay the same to the last bit.
    pub fn set_width(&mut self, width: Width) {
        self.width = width;
        self.car_following.set_width(width);
        self.lane_order.set_width(width);
    }

    /// Moves the end of the run, s.
    pub fn set_until(&mut self, until: f64) -> Result<(), Error> {
        self.scenario.set(RoadField::Until.parameter(), until)?;
        self.last_step = self.scenario.last_step();
        Ok(())
    }

    /// Whether actions are due in the present step.
    #[inline]
    pub(super) fn actions_are_due(&self) -> bool {
        self.agenda.last().is_some_and(|&(due, _)| due <= self.step)
    }

    /// Applies the actions that are due, in the order of the list.
    pub(super) fn apply_due_actions(&mut self) {
        while let Some(&(due, index)) = self.agenda.last() {
            if due > self.step {
                return;
            }
            self.agenda.pop();
            self.apply(index);
        }
    }

    fn apply(&mut self, index: usize) {
        let Action { vehicles, effects, .. } = self.scenario.actions[index].clone();
        let vehicles = self.scenario.selected(vehicles, Stream::Action(index));
        let mut any_set = false;
        for &j in &vehicles {
            for &effect in &effects {
                match effect {
                    Effect::Set(field, value) => {
                        any_set = true;
                        self.drivers[j].set(field, value);
                    }
                    Effect::Brake(seconds) => {
                        self.braked.push((j, self.step + self.scenario.steps(seconds)));
                    }
                    Effect::Nudge(metres) => self.nudge(j, metres),
                }
            }
        }
        if any_set {
            self.adopt_drivers(&vehicles);
        }
    }

    /// Displaces a vehicle: at t = 0 its position at the start, later its displacement.
    fn nudge(&mut self, j: usize, metres: f64) {
        if self.step == 0 {
            self.lane_order.nudge_start(j, metres);
        } else {
            self.history.displace(j, metres);
            self.nudged[j] += metres;
        }
        self.car_following.invalidate(j);
        self.car_following.invalidate(self.lane_order.behind(j));
        self.contact_free_until = UNKNOWN;
        self.lane_order.require_checks();
    }

    /// Brings everything that is derived from the drivers up to date after some of them have `changed`.
    pub(super) fn adopt_drivers(&mut self, changed: &[usize]) {
        self.car_following.set_drivers(&self.drivers, changed);
        let target = |&j: &usize| (j, self.scenario.steps(self.drivers[j].reaction_time) as u32);
        self.delays.set_targets(changed.iter().map(target));
        self.history.require(self.delays.longest_target());
        let dt = self.scenario.time_step;
        for (step, driver) in self.frustration_step.iter_mut().zip(&self.drivers) {
            *step = driver.frustration_rate * dt;
        }
        let largest = |of: fn(&Driver) -> f64| self.drivers.iter().map(of).fold(0.0, f64::max);
        (self.max_speed, self.max_vehicle_length) = (largest(|d| d.max_speed), largest(|d| d.vehicle_length));
        self.contact_free_until = UNKNOWN;
    }
}
