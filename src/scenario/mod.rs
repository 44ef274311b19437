//! A scenario: everything that determines a run, as plain data that validates itself.
//!
//! In JSON it is one flat object: `version`, the road's parameters, `start`, the default `driver`, `exceptions`
//! and `actions` (texts in the grammar of [`crate::scenario::action`]). What is left out has its default; what is unknown is
//! refused by name.

pub mod action;
pub mod driver;
pub mod link;
pub mod parameters;
pub mod presets;

use crate::error::{Error, quoted};
use crate::format::json::{Json, Object};
use crate::numerics::random;
use crate::scenario::action::{Action, DriverOverride, Effect, VehicleSelector};
use crate::scenario::driver::Driver;
use crate::scenario::parameters::{PARAMETERS, Parameter, Scope};
use serde::Serialize;
use std::fmt;
use std::str::FromStr;

/// Version of the JSON form.
pub const FORMAT: u64 = 1;

/// Where the vehicles are at t = 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// Numbers dealt in blocks, lane 1 first and with the remainder; equal headways in each lane.
    Uniform,
    /// All in the given lane, equal headways.
    OneLane(usize),
    /// N divisible by n lanes; as uniform, lane l shifted downstream by (n − l)·L/N.
    Staggered,
    /// Seeded positions, no headway under the driver's minimum headway d.
    Random,
}

impl fmt::Display for Start {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Uniform => write!(f, "uniform"),
            Self::OneLane(1) => write!(f, "one-lane"),
            Self::OneLane(lane) => write!(f, "one-lane={lane}"),
            Self::Staggered => write!(f, "staggered"),
            Self::Random => write!(f, "random"),
        }
    }
}

impl FromStr for Start {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self, Error> {
        let wrong =
            || Error::new("start", quoted(text), "uniform, one-lane, one-lane=LANE, staggered or random");
        match text.trim().split_once('=') {
            None => match text.trim() {
                "uniform" => Ok(Self::Uniform),
                "one-lane" => Ok(Self::OneLane(1)),
                "staggered" => Ok(Self::Staggered),
                "random" => Ok(Self::Random),
                _ => Err(wrong()),
            },
            Some(("one-lane", lane)) => lane.trim().parse().map(Self::OneLane).map_err(|_| wrong()),
            Some(_) => Err(wrong()),
        }
    }
}

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
    /// Drivers who differ, applied in order.
    pub exceptions: Vec<DriverOverride>,
    /// What happens on the way. Order matters among actions of the same step only.
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
            exceptions: Vec::new(),
            actions: Vec::new(),
        };
        for parameter in &PARAMETERS {
            if let Scope::Road { set, .. } = parameter.scope {
                set(&mut scenario, parameter.default);
            }
        }
        scenario
    }
}

/// The largest history of positions that a run may need: 2 GiB.
const HISTORY_LIMIT: f64 = 2.0 * 1024.0 * 1024.0 * 1024.0;

impl Scenario {
    /// A time in whole steps.
    pub fn steps(&self, seconds: f64) -> u64 {
        (seconds / self.time_step).round() as u64
    }

    /// The time of a step, s, with no more decimals than bring it to a thousandth of a step: i·dt itself is often
    /// 18.330000000000002. It is the same number of [`Self::steps`].
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

    /// Every vehicle's driver at the start: the default one and the exceptions.
    pub fn drivers(&self) -> Vec<Driver> {
        let mut drivers = vec![self.driver; self.vehicles];
        for (k, exception) in self.exceptions.iter().enumerate() {
            for vehicle in self.members(exception.who, random::Stream::DriverOverride(k)) {
                for &(parameter, value) in &exception.values {
                    assign(&mut drivers[vehicle], parameter, value);
                }
            }
        }
        drivers
    }

    /// The vehicles (indices from 0, ascending) that `who` means; a share is drawn from `stream`.
    pub(crate) fn members(&self, who: VehicleSelector, stream: random::Stream) -> Vec<usize> {
        match who {
            VehicleSelector::All => (0..self.vehicles).collect(),
            VehicleSelector::Vehicle(n) => vec![n - 1],
            VehicleSelector::Range(first, last) => (first - 1..last).collect(),
            VehicleSelector::Share(percent) => {
                let count = (percent / 100.0 * self.vehicles as f64).round() as usize;
                random::Generator::new(self.seed, stream).choose(count.min(self.vehicles), self.vehicles)
            }
        }
    }

    /// Whether it can be run: every value in its range, every combination with a meaning, a start that fits.
    pub fn validate(&self) -> Result<(), Error> {
        for parameter in &PARAMETERS {
            parameter.check(parameter.get(self))?;
        }
        for (k, exception) in self.exceptions.iter().enumerate() {
            let place = |e: Error| e.within(format!("exceptions[{}] “{exception}”", k + 1));
            exception.who.check(self.vehicles).map_err(place)?;
            for &(parameter, value) in &exception.values {
                parameter.check(value).map_err(place)?;
            }
        }
        for (k, action) in self.actions.iter().enumerate() {
            self.check_action(action).map_err(|e| e.within(format!("actions[{}] “{action}”", k + 1)))?;
        }
        self.check_drivers_through_time()?;
        self.check_start()
    }

    /// Whether an action by itself makes sense here.
    pub(crate) fn check_action(&self, action: &Action) -> Result<(), Error> {
        if !(0.0..=1e7).contains(&action.at) {
            return Err(Error::new("at", action.at, "a number from 0 to 10000000 s"));
        }
        action.who.check(self.vehicles)?;
        action.effects.iter().try_for_each(|effect| effect.check(self.length))
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

    /// d > C for every driver at every time, and a history that fits into memory.
    fn check_drivers_through_time(&self) -> Result<(), Error> {
        check_min_headway(&self.driver)?;
        let mut drivers = self.drivers();
        drivers.iter().try_for_each(check_min_headway)?;
        let mut longest = drivers.iter().map(|d| d.reaction_time).fold(0.0, f64::max);
        for (_, k) in self.actions_in_time() {
            let action = &self.actions[k];
            let place = |e: Error| e.within(format!("actions[{}] “{action}”", k + 1));
            let sets: Vec<_> = action
                .effects
                .iter()
                .filter_map(|e| if let Effect::Set(p, v) = e { Some((*p, *v)) } else { None })
                .collect();
            if sets.is_empty() {
                continue;
            }
            for vehicle in self.members(action.who, random::Stream::Action(k)) {
                for &(parameter, value) in &sets {
                    assign(&mut drivers[vehicle], parameter, value);
                }
                check_min_headway(&drivers[vehicle]).map_err(place)?;
                longest = longest.max(drivers[vehicle].reaction_time);
            }
        }
        self.check_history(longest)
    }

    /// Whether the positions seen over the reaction time fit into memory.
    pub(crate) fn check_history(&self, longest: f64) -> Result<(), Error> {
        let bytes = 8.0 * self.vehicles as f64 * (longest / self.time_step).round();
        if bytes > HISTORY_LIMIT {
            let steps = HISTORY_LIMIT / (8.0 * self.vehicles as f64);
            let most = (steps * self.time_step * 1e3).floor() / 1e3;
            let allowed = format!(
                "at most {most} s for {} vehicles in steps of {} s: the history must fit 2 GiB",
                self.vehicles, self.time_step
            );
            return Err(Error::new("reaction-time", longest, allowed));
        }
        Ok(())
    }

    fn check_start(&self) -> Result<(), Error> {
        let n = self.vehicles;
        match self.start {
            Start::OneLane(lane) if lane == 0 || lane > self.lanes => {
                return Err(Error::new(
                    "start",
                    quoted(&self.start.to_string()),
                    format!("a lane from 1 to {}", self.lanes),
                ));
            }
            Start::OneLane(_) => {}
            _ if self.lanes > n => {
                return Err(Error::new(
                    "lanes",
                    self.lanes,
                    format!("at most {n}: more lanes than vehicles can fill"),
                ));
            }
            Start::Staggered if !n.is_multiple_of(self.lanes) => {
                let allowed = format!("a number that {} lanes divide, for a staggered start", self.lanes);
                return Err(Error::new("vehicles", n, allowed));
            }
            _ => {}
        }
        let drivers = self.drivers();
        let mut first = 0;
        for (lane, &count) in self.vehicles_per_lane().iter().enumerate() {
            let lane_drivers = &drivers[first..first + count];
            first += count;
            let most = |each: f64| (self.length / each).floor();
            if self.start == Start::Random {
                let needed: f64 = lane_drivers.iter().map(|d| d.min_headway).sum();
                if needed > self.length {
                    let allowed = format!(
                        "fewer in lane {}: {count} with their minimum headways need {needed} m of {} m (about {} fit)",
                        lane + 1,
                        self.length,
                        most(needed / count as f64)
                    );
                    return Err(Error::new("vehicles", n, allowed));
                }
            } else if count > 0 {
                let headway = self.length / count as f64;
                for (i, driver) in lane_drivers.iter().enumerate() {
                    let ahead = lane_drivers[(i + 1) % count];
                    let contact = 0.5 * (driver.vehicle_length + ahead.vehicle_length);
                    if headway <= contact {
                        let allowed = format!(
                            "fewer in lane {}: {count} have a headway of {headway} m, and vehicles touch at {contact} m (at most {} fit)",
                            lane + 1,
                            (self.length / contact).ceil() - 1.0
                        );
                        return Err(Error::new("vehicles", n, allowed));
                    }
                }
            }
        }
        Ok(())
    }

    /// One line of JSON with every field, as headers carry it.
    pub fn to_json(&self) -> String {
        self.tree().to_string()
    }

    /// Reads JSON and validates.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        Object::read("scenario", text).and_then(|object| Self::from_object(&object))
    }

    /// The scenario as an object of JSON, with every field.
    pub fn tree(&self) -> Json {
        let (mut object, mut driver) = (Object::default(), Object::default());
        for parameter in &PARAMETERS {
            let holder = if parameter.is_of_driver() { &mut driver } else { &mut object };
            holder.insert(parameter.name, parameter.get(self));
        }
        object.insert("version", FORMAT);
        object.insert("start", self.start.to_string());
        object.insert("driver", driver);
        object.insert("exceptions", self.exceptions.iter().map(DriverOverride::to_string).collect::<Json>());
        object.insert("actions", self.actions.iter().map(Action::to_string).collect::<Json>());
        object.into()
    }

    fn from_object(object: &Object) -> Result<Self, Error> {
        let mut scenario = Self::default();
        for (name, value) in object.iter() {
            match name {
                "version" if value.as_number() == Some(FORMAT as f64) => {}
                "version" => return Err(Error::new("version", value, FORMAT.to_string())),
                "start" => {
                    let text = value.as_text().ok_or_else(|| Error::new("start", value, "a text"))?;
                    scenario.start = text.parse()?;
                }
                "driver" => {
                    let Json::Object(driver) = value else {
                        return Err(Error::new("driver", value, "a JSON object"));
                    };
                    for (name, value) in driver.iter() {
                        let parameter = PARAMETERS
                            .iter()
                            .find(|p| p.is_of_driver() && p.name == name)
                            .ok_or_else(|| unknown(name, true, "").within("driver"))?;
                        parameter.set(&mut scenario, read_number(parameter, value)?)?;
                    }
                }
                "exceptions" => scenario.exceptions = read_texts("exceptions", value)?,
                "actions" => scenario.actions = read_texts("actions", value)?,
                name => {
                    let parameter =
                        PARAMETERS.iter().find(|p| !p.is_of_driver() && p.name == name).ok_or_else(|| {
                            unknown(name, false, ", version, start, driver, exceptions, actions")
                        })?;
                    parameter.set(&mut scenario, read_number(parameter, value)?)?;
                }
            }
        }
        scenario.validate()?;
        Ok(scenario)
    }
}

pub(crate) fn assign(driver: &mut Driver, parameter: &Parameter, value: f64) {
    if let Scope::Driver { set, .. } = parameter.scope {
        set(driver, value);
    }
}

pub(crate) fn check_min_headway(driver: &Driver) -> Result<(), Error> {
    if driver.min_headway > driver.vehicle_length {
        Ok(())
    } else {
        let allowed = format!("more than the vehicle length, {} m", driver.vehicle_length);
        Err(Error::new("min-headway", format!("{} m", driver.min_headway), allowed))
    }
}

impl Serialize for Scenario {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.tree().serialize(serializer)
    }
}

fn read_number(parameter: &Parameter, value: &Json) -> Result<f64, Error> {
    value.as_number().ok_or_else(|| Error::new(parameter.name, value, parameter.allowed()))
}

fn read_texts<T: FromStr<Err = Error>>(field: &'static str, value: &Json) -> Result<Vec<T>, Error> {
    let list = value.as_list().ok_or_else(|| Error::new(field, value, "a list of texts"))?;
    let one = |(k, item): (usize, &Json)| {
        let text = item.as_text().ok_or_else(|| Error::new(format!("{field}[{}]", k + 1), item, "a text"))?;
        text.parse().map_err(|e: Error| e.within(format!("{field}[{}]", k + 1)))
    };
    list.iter().enumerate().map(one).collect()
}

fn unknown(name: &str, of_driver: bool, more: &str) -> Error {
    let names: Vec<_> = PARAMETERS.iter().filter(|p| p.is_of_driver() == of_driver).map(|p| p.name).collect();
    Error::new("field", quoted(name), format!("{}{more}", names.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(json: &str) -> String {
        Scenario::from_json(json).unwrap_err().to_string()
    }

    #[test]
    fn json_reads_back_and_defaults_fill_the_rest() {
        let json = r#"{"version":1,"vehicles":20,"time_step":0.05,"driver":{"reaction_time":0.1},
            "exceptions":["3:sensitivity=2"],"actions":["at=0:1:nudge=1"]}"#;
        let scenario = Scenario::from_json(json).unwrap();
        assert_eq!((scenario.vehicles, scenario.length), (20, 1000.0));
        assert_eq!(Scenario::from_json(&scenario.to_json()).unwrap(), scenario);
        assert_eq!(serde_json::to_string(&scenario).unwrap(), scenario.to_json());
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
    fn every_refusal_names_field_value_and_what_is_allowed() {
        for (json, words) in [
            ("{", &["scenario", "JSON"][..]),
            ("[1]", &["scenario", "[1]", "JSON object"]),
            (r#"{"version":2}"#, &["version", "2", "1"]),
            (r#"{"cars":5}"#, &["cars", "vehicles"]),
            (r#"{"driver":{"lambda":5}}"#, &["driver", "lambda", "sensitivity"]),
            (r#"{"driver":{"vehicles":5}}"#, &["driver", "vehicles", "sensitivity"]),
            (r#"{"vehicles":0}"#, &["vehicles", "0", "from 1 to 1000000"]),
            (r#"{"vehicles":2.5}"#, &["vehicles", "2.5", "whole"]),
            (r#"{"vehicles":"many"}"#, &["vehicles", "many"]),
            (r#"{"length":1e999}"#, &["scenario", "number out of range"]),
            (r#"{"time_step":0.6}"#, &["time-step", "0.6", "0.5 s"]),
            (r#"{"driver":{"min_headway":4}}"#, &["min-headway", "4 m", "vehicle length", "5 m"]),
            (r#"{"exceptions":["51:sensitivity=2"]}"#, &["exceptions[1]", "51", "1 to 50"]),
            (r#"{"exceptions":["7:sensitivity=200"]}"#, &["sensitivity", "200", "0.01 to 20"]),
            (r#"{"exceptions":["7:vehicle-length=8"]}"#, &["min-headway", "7.5", "8 m"]),
            (r#"{"actions":["at=-1:all:brake=1"]}"#, &["actions[1]", "at", "-1"]),
            (r#"{"actions":["at=1:60:brake=1"]}"#, &["actions[1]", "60", "1 to 50"]),
            (r#"{"actions":["at=1:6:brake=-1"]}"#, &["brake", "-1"]),
            (r#"{"actions":["at=1:6:nudge=1001"]}"#, &["nudge", "1001", "1000 m"]),
            (r#"{"actions":["at=1:6:min-headway=5"]}"#, &["actions[1]", "min-headway", "5 m"]),
            (r#"{"actions":[7]}"#, &["actions[1]", "7", "text"]),
            (r#"{"start":"spiral"}"#, &["start", "spiral", "staggered"]),
            (r#"{"start":"one-lane=2"}"#, &["start", "one-lane=2", "1 to 1"]),
            (r#"{"vehicles":3,"lanes":4}"#, &["lanes", "4", "more lanes than vehicles"]),
            (r#"{"vehicles":5,"lanes":2,"start":"staggered"}"#, &["vehicles", "5", "staggered"]),
            (r#"{"vehicles":200}"#, &["vehicles", "200", "5 m", "199"]),
            (r#"{"vehicles":134,"start":"random"}"#, &["vehicles", "134", "minimum headways"]),
            (
                r#"{"vehicles":1000000,"length":1e8,"driver":{"reaction_time":10}}"#,
                &["reaction-time", "10", "2 GiB"],
            ),
        ] {
            let message = refused(json);
            for word in words {
                assert!(message.contains(word), "{json}: {message} lacks {word}");
            }
        }
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
                exceptions: vec!["10%:sensitivity=2".parse().unwrap()],
                ..Scenario::default()
            };
            scenario.drivers().iter().map(|d| d.sensitivity == 2.0).collect::<Vec<_>>()
        };
        assert_eq!(with_seed(1).iter().filter(|&&aggressive| aggressive).count(), 5);
        assert_eq!(with_seed(1), with_seed(1));
        assert_ne!(with_seed(1), with_seed(2));
    }
}
