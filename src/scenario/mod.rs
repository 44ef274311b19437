//! A scenario: everything that determines a run, as plain data that validates itself.
//!
//! | file | subject |
//! |---|---|
//! | [`parameters`] | the one table of parameters |
//! | [`value`] | the values of a parameter, and the kinds of parameters |
//! | [`parameter_values`] | a parameter with the values that a batch or a sweep gives it |
//! | [`driver`] | a driver: speed against headway, and the equilibrium of a lane |
//! | [`action`] | timed actions, driver overrides, vehicle selectors |
//! | [`start`] | where the vehicles are at t = 0 |
//! | [`link`] | a scenario as the readable part of a link |
//! | [`presets`] | scenarios with names |
//! | `json` | the JSON form |
//! | `validation` | whether a scenario can be run |
//!
//! ```
//! use ringroad::Scenario;
//!
//! let scenario = Scenario::from_json(r#"{"vehicles": 20, "driver": {"reaction_time": 0.5}}"#).unwrap();
//! assert_eq!((scenario.vehicles, scenario.length), (20, 1000.0));
//!
//! let refusal = Scenario { vehicles: 200, ..Scenario::default() }.validate().unwrap_err();
//! assert!(refusal.to_string().starts_with("vehicles: 200 is not allowed"));
//! ```

pub mod action;
pub mod driver;
mod json;
pub mod link;
pub mod parameter_values;
pub mod parameters;
pub mod presets;
pub mod start;
mod validation;
pub mod value;

pub use start::Start;

use crate::error::Error;
use crate::numerics::random;
use crate::scenario::action::{Action, DriverOverride, VehicleSelector};
use crate::scenario::driver::Driver;
use crate::scenario::parameters::{Field, Law, PARAMETERS, Parameter, RoadField};
use crate::scenario::value::Value;

/// Everything that determines a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// N, all lanes together.
    pub vehicles: usize,
    /// L, m.
    pub length: f64,
    /// Number of lanes; lane 1 is the outermost.
    pub lanes: usize,
    /// dt, s.
    pub time_step: f64,
    /// End of the run, s.
    pub until: f64,
    /// Seed of every random draw.
    pub seed: u64,
    /// Where the vehicles are at t = 0.
    pub start: Start,
    /// The default driver.
    pub driver: Driver,
    /// Drivers that differ from the default driver; a later override goes over an earlier one. `exceptions` in JSON.
    pub overrides: Vec<DriverOverride>,
    /// What happens during the run. Order matters only among actions of the same step.
    pub actions: Vec<Action>,
}

impl Default for Scenario {
    fn default() -> Self {
        let mut scenario = Self {
            vehicles: 0,
            length: f64::NAN,
            lanes: 0,
            time_step: f64::NAN,
            until: f64::NAN,
            seed: 0,
            start: Start::Uniform,
            driver: Driver::default(),
            overrides: Vec::new(),
            actions: Vec::new(),
        };
        for parameter in &PARAMETERS {
            if let Field::Road(field) = parameter.field {
                scenario.assign(field, parameter.default);
            }
        }
        scenario
    }
}

impl Scenario {
    /// The law of car following of all vehicles.
    pub fn law(&self) -> Law {
        Law::Newell
    }

    /// The value of a parameter; a driver's parameter is that of the default driver.
    pub fn value(&self, parameter: &Parameter) -> Value {
        match parameter.field {
            Field::Road(field) => self.road_value(field),
            Field::Driver(field) => self.driver.value(field),
        }
    }

    /// Checks a value and gives it to a parameter (a driver's parameter: of the default driver). Combinations of
    /// values are for [`Self::validate`] to check.
    pub fn set(&mut self, parameter: &Parameter, value: impl Into<Value>) -> Result<(), Error> {
        let value = value.into();
        parameter.check(value)?;
        match parameter.field {
            Field::Road(field) => self.assign(field, value),
            Field::Driver(field) => self.driver.set(field, value),
        }
        Ok(())
    }

    fn road_value(&self, field: RoadField) -> Value {
        // Every field is named, so that one that is neither a parameter nor one of these four does not compile.
        let &Self {
            vehicles,
            length,
            lanes,
            time_step,
            until,
            seed,
            start: _,
            driver: _,
            overrides: _,
            actions: _,
        } = self;
        Value::Number(match field {
            RoadField::Vehicles => vehicles as f64,
            RoadField::Length => length,
            RoadField::Lanes => lanes as f64,
            RoadField::TimeStep => time_step,
            RoadField::Until => until,
            RoadField::Seed => seed as f64,
        })
    }

    /// Gives a field a value that its parameter allows; a value of another kind changes nothing.
    fn assign(&mut self, field: RoadField, value: Value) {
        let Some(number) = value.number() else { return };
        match field {
            // Ranges of the table keep these conversions exact.
            RoadField::Vehicles => self.vehicles = number as usize,
            RoadField::Lanes => self.lanes = number as usize,
            RoadField::Seed => self.seed = number as u64,
            RoadField::Length => self.length = number,
            RoadField::TimeStep => self.time_step = number,
            RoadField::Until => self.until = number,
        }
    }

    /// The number of steps in a time (s), rounded.
    pub fn steps(&self, seconds: f64) -> u64 {
        (seconds / self.time_step).round() as u64
    }

    /// The time of a step in s, with as few decimals as bring it within a thousandth of a step of i·dt, which itself is
    /// often a number such as 18.330000000000002. [`Self::steps`] gives the step back.
    pub(crate) fn time_of(&self, step: u64) -> f64 {
        let time = step as f64 * self.time_step;
        let mut scale = 1.0;
        // The smallest step, 0.001 s, needs six decimals.
        for _ in 0..=6 {
            let short = (time * scale).round() / scale;
            if (short - time).abs() <= 1e-3 * self.time_step {
                return short;
            }
            scale *= 10.0;
        }
        time
    }

    /// Number of steps of the whole run.
    pub fn last_step(&self) -> u64 {
        self.steps(self.until)
    }

    /// How many vehicles start in each lane, outermost first.
    pub fn vehicles_per_lane(&self) -> Vec<usize> {
        if let Start::OneLane(lane) = self.start {
            (1..=self.lanes).map(|l| if l == lane { self.vehicles } else { 0 }).collect()
        } else {
            let (each, rest) = (self.vehicles / self.lanes, self.vehicles % self.lanes);
            (0..self.lanes).map(|l| if l == 0 { each + rest } else { each }).collect()
        }
    }

    /// The driver of every vehicle at t = 0: the default driver with the overrides.
    pub fn drivers(&self) -> Vec<Driver> {
        let mut drivers = vec![self.driver; self.vehicles];
        for (k, differing) in self.overrides.iter().enumerate() {
            for vehicle in self.selected(differing.vehicles, random::Stream::DriverOverride(k)) {
                for &(field, value) in &differing.values {
                    drivers[vehicle].set(field, value);
                }
            }
        }
        drivers
    }

    /// The selected vehicles as indices from 0, ascending; a share is drawn from `stream`.
    pub(crate) fn selected(&self, vehicles: VehicleSelector, stream: random::Stream) -> Vec<usize> {
        match vehicles {
            VehicleSelector::All => (0..self.vehicles).collect(),
            VehicleSelector::Vehicle(n) => vec![n - 1],
            VehicleSelector::Range(first, last) => (first - 1..last).collect(),
            VehicleSelector::Share(percent) => {
                let count = (percent / 100.0 * self.vehicles as f64).round() as usize;
                random::Generator::new(self.seed, stream).choose(count.min(self.vehicles), self.vehicles)
            }
        }
    }

    /// Actions with their places in the list, in the order in which they happen.
    pub(crate) fn actions_in_time(&self) -> Vec<(u64, usize)> {
        let mut order: Vec<(u64, usize)> = Vec::with_capacity(self.actions.len());
        for (k, action) in self.actions.iter().enumerate() {
            let step = self.steps(action.at);
            order.insert(order.partition_point(|&(s, _)| s <= step), (step, k));
        }
        order
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scenario_holds_what_the_table_says() {
        let mut scenario = Scenario::default();
        for parameter in &PARAMETERS {
            assert_eq!(scenario.value(parameter), parameter.default, "{}", parameter.name);
            let range = parameter.kind.range().unwrap();
            let edge = if parameter.default == Value::Number(range.max) { range.min } else { range.max };
            scenario.set(parameter, edge).unwrap();
            assert_eq!(scenario.value(parameter), Value::Number(edge), "{}", parameter.name);
        }
    }

    #[test]
    fn the_time_of_a_step_is_short_and_gives_the_step_back() {
        for time_step in [0.001, 0.005, 0.01, 0.015, 0.025, 0.1, 0.3, 1.0 / 3.0, 0.5] {
            let scenario = Scenario { time_step, ..Scenario::default() };
            for step in (0..5000).chain([123_456, 999_999, 9_999_999]) {
                let time = scenario.time_of(step);
                assert_eq!(scenario.steps(time), step, "{time}");
                assert!((time - step as f64 * time_step).abs() <= 1e-3 * time_step, "{time}");
                assert!(time.to_string().split_once('.').is_none_or(|(_, d)| d.len() <= 6), "{time}");
            }
        }
        let at = |time_step, step| Scenario { time_step, ..Scenario::default() }.time_of(step);
        assert_eq!([at(0.01, 1833), at(0.015, 1), at(0.3, 3), at(0.1, 30)], [18.33, 0.015, 0.9, 3.0]);
    }

    #[test]
    fn lanes_are_dealt_in_blocks_with_the_remainder_in_the_first() {
        let scenario = Scenario { vehicles: 11, lanes: 3, ..Scenario::default() };
        assert_eq!(scenario.vehicles_per_lane(), [5, 3, 3]);
        let scenario = Scenario { start: Start::OneLane(2), ..scenario };
        assert_eq!(scenario.vehicles_per_lane(), [0, 11, 0]);
    }

    #[test]
    fn a_share_of_drivers_is_drawn_by_the_seed() {
        let with_seed = |seed| {
            let scenario = Scenario {
                seed,
                overrides: vec!["10%:sensitivity=2".parse().unwrap()],
                ..Scenario::default()
            };
            scenario.drivers().iter().map(|d| d.sensitivity == 2.0).collect::<Vec<_>>()
        };
        assert_eq!(with_seed(1).iter().filter(|&&aggressive| aggressive).count(), 5);
        assert_eq!(with_seed(1), with_seed(1));
        assert_ne!(with_seed(1), with_seed(2));
    }
}
