//! Whether a scenario can be run: every value in its range, every combination with a meaning, a start that fits.

use crate::error::{Error, quoted};
use crate::numerics::random;
use crate::scenario::action::{Action, Effect};
use crate::scenario::driver::Driver;
use crate::scenario::parameters::PARAMETERS;
use crate::scenario::{Scenario, Start};

/// The largest memory that the history of positions may take, bytes: 2 GiB.
const HISTORY_LIMIT: f64 = 2.0 * 1024.0 * 1024.0 * 1024.0;

impl Scenario {
    /// Whether the scenario can be run. Checks every value by itself, then combinations of values (at every time of the
    /// run), then whether the vehicles fit on the road. The refusal is of the first one that fails.
    pub fn validate(&self) -> Result<(), Error> {
        for parameter in &PARAMETERS {
            let value = self.value(parameter);
            parameter.check(value)?;
            parameter.check_use(self.law(), value)?;
        }
        for (k, differing) in self.overrides.iter().enumerate() {
            let place = |e: Error| e.within(format!("exceptions[{}] “{differing}”", k + 1));
            differing.vehicles.check(self.vehicles).map_err(place)?;
            for &(field, value) in &differing.values {
                field.parameter().check(value).map_err(place)?;
            }
        }
        for (k, action) in self.actions.iter().enumerate() {
            self.check_action(action).map_err(|e| e.within(format!("actions[{}] “{action}”", k + 1)))?;
        }
        self.check_drivers_through_time()?;
        self.check_start()
    }

    /// Whether an action is allowed by itself, without regard to other actions.
    pub(crate) fn check_action(&self, action: &Action) -> Result<(), Error> {
        if !(0.0..=1e7).contains(&action.at) {
            return Err(Error::out_of_range("at", action.at, "a number from 0 to 10000000 s"));
        }
        action.vehicles.check(self.vehicles)?;
        action.effects.iter().try_for_each(|effect| effect.check(self.length))
    }

    /// Checks d > C for every driver at every time, and that the history of positions fits into memory.
    fn check_drivers_through_time(&self) -> Result<(), Error> {
        self.driver.check()?;
        let mut drivers = self.drivers();
        drivers.iter().try_for_each(Driver::check)?;
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
            for vehicle in self.selected(action.vehicles, random::Stream::Action(k)) {
                for &(field, value) in &sets {
                    drivers[vehicle].set(field, value);
                }
                drivers[vehicle].check().map_err(place)?;
                longest = longest.max(drivers[vehicle].reaction_time);
            }
        }
        self.check_history(longest)
    }

    /// Whether the history of positions fits into memory where `longest` is the longest reaction time, s.
    pub(crate) fn check_history(&self, longest: f64) -> Result<(), Error> {
        let bytes = 8.0 * self.vehicles as f64 * (longest / self.time_step).round();
        if bytes > HISTORY_LIMIT {
            let steps = HISTORY_LIMIT / (8.0 * self.vehicles as f64);
            let most = (steps * self.time_step * 1e3).floor() / 1e3;
            let allowed = format!(
                "at most {most} s for {} vehicles in steps of {} s: the history must fit 2 GiB",
                self.vehicles, self.time_step
            );
            return Err(Error::too_large("reaction-time", longest, allowed));
        }
        Ok(())
    }

    fn check_start(&self) -> Result<(), Error> {
        let n = self.vehicles;
        match self.start {
            Start::OneLane(lane) if lane == 0 || lane > self.lanes => {
                return Err(Error::conflict(
                    "start",
                    quoted(&self.start.to_string()),
                    format!("a lane from 1 to {}", self.lanes),
                ));
            }
            Start::OneLane(_) => {}
            _ if self.lanes > n => {
                return Err(Error::conflict(
                    "lanes",
                    self.lanes,
                    format!("at most {n}: more lanes than vehicles can fill"),
                ));
            }
            Start::Staggered if !n.is_multiple_of(self.lanes) => {
                let allowed = format!("a number that {} lanes divide, for a staggered start", self.lanes);
                return Err(Error::conflict("vehicles", n, allowed));
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
                    return Err(Error::conflict("vehicles", n, allowed));
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
                        return Err(Error::conflict("vehicles", n, allowed));
                    }
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(json: &str) -> String {
        Scenario::from_json(json).unwrap_err().to_string()
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
}
