//! How many drivers must change, say to a shorter reaction time, to stabilize a ring?
//!
//! ```
//! use ringroad::scenario::Scenario;
//! use ringroad::stability::stabilizing_drivers::{parse_changes, stabilizing_drivers};
//!
//! let mut scenario = Scenario::default();
//! scenario.driver.reaction_time = 0.75; // 50 vehicles, unstable
//! let changes = parse_changes("reaction-time=0").unwrap();
//! let answer = stabilizing_drivers(&scenario, &changes).unwrap();
//! assert_eq!(answer.smallest_number, Some(5));
//! ```

use super::homogeneous::Time;
use super::lane::{Lane, lanes_of};
use super::report::{Report, is_stable};
use crate::error::Error;
use crate::numerics::bisection::Whole;
use crate::scenario::Scenario;
use crate::scenario::action::driver_values;
use crate::scenario::driver::Driver;
use crate::scenario::parameters::DriverField;
use crate::scenario::value::Value;
use serde::Serialize;

/// The answer, for the least stable lane of a scenario, in the steps of its simulation. Its JSON is part of a report's, which
/// states lane and vehicles already.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct StabilizingDrivers {
    /// The lane, from 1.
    #[serde(skip)]
    pub lane: usize,
    /// Vehicles in it.
    #[serde(skip)]
    pub vehicles: usize,
    /// The smallest number of changed drivers with which the lane is stable; `None` where no number stabilizes it.
    #[serde(rename = "smallest_calming_number")]
    pub smallest_number: Option<usize>,
    /// Numbers of changed drivers, 0 first: all up to the lane's vehicles; in a large lane evenly spread ones.
    #[serde(rename = "calming_numbers")]
    pub numbers: Vec<usize>,
    /// The largest growth rate with each number, 1/s.
    #[serde(rename = "calming_growth_rates_discrete_per_s")]
    pub max_growth_rates_discrete_per_s: Vec<f64>,
}

/// In lanes of up to so many vehicles every number is tried. In larger lanes, between the numbers tried, the growth rate is
/// taken to fall as the number rises.
const TRIED: usize = 200;

/// Changes one driver after another of the least stable lane, those of the lowest vehicle numbers first. Where the others are
/// homogeneous, which is the usual question, it does not matter which drivers are changed.
///
/// Fails where a changed value is not allowed for a driver.
pub fn stabilizing_drivers(
    scenario: &Scenario,
    changes: &[(DriverField, Value)],
) -> Result<StabilizingDrivers, Error> {
    let place = Report::of(scenario).lane - 1;
    let lane = lanes_of(scenario).swap_remove(place);
    let changed = |driver: &Driver| {
        let mut driver = *driver;
        for &(field, value) in changes {
            driver.set(field, value);
        }
        driver
    };
    for &(field, value) in changes {
        field.parameter().check(value)?;
    }
    let changed: Vec<_> = lane.drivers.iter().map(changed).collect();
    changed.iter().try_for_each(Driver::check)?;
    let n = changed.len();
    let with = |number: usize| {
        let drivers = [&changed[..number], &lane.drivers[number..]].concat();
        Lane::new(drivers, scenario.time_step).classes(scenario.length, scenario.time_step).in_steps
    };
    let time = Time::Steps(scenario.time_step);
    let rate = |number: usize| with(number).fastest(time).map_or(0.0, |mode| mode.root.re);
    let unstable = |number: usize| !is_stable(&with(number), time);

    let tried = n.min(TRIED);
    let numbers: Vec<_> = (0..=tried).map(|k| k * n / tried).collect();
    let rates = numbers.iter().map(|&number| rate(number)).collect();
    let smallest = numbers.iter().position(|&number| !unstable(number)).map(|k| match k {
        0 => 0,
        k => Whole::new(numbers[k - 1], numbers[k]).until(unstable).fails,
    });
    Ok(StabilizingDrivers {
        lane: place + 1,
        vehicles: n,
        smallest_number: smallest,
        numbers,
        max_growth_rates_discrete_per_s: rates,
    })
}

/// Reads changes such as `reaction-time=0` or `reaction-time=0,sensitivity=2`; refuses what a driver may not have.
pub fn parse_changes(text: &str) -> Result<Vec<(DriverField, Value)>, Error> {
    let changes = driver_values(text).map_err(|e| e.within("calm-with"))?;
    for &(field, value) in &changes {
        field.parameter().check(value).map_err(|e| e.within("calm-with"))?;
    }
    Ok(changes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scenario(reaction_time: f64) -> Scenario {
        let mut scenario = Scenario::default();
        scenario.driver.reaction_time = reaction_time;
        scenario
    }

    #[test]
    fn five_drivers_without_delay_stabilize_fifty() {
        let answer =
            stabilizing_drivers(&scenario(0.75), &parse_changes("reaction-time=0").unwrap()).unwrap();
        assert_eq!(answer.smallest_number, Some(5));
        assert_eq!(answer.numbers, (0..=50).collect::<Vec<_>>());
        assert!(answer.max_growth_rates_discrete_per_s.windows(2).all(|w| w[1] <= w[0] + 1e-12));
        let stable = stabilizing_drivers(&scenario(0.5), &parse_changes("reaction-time=0").unwrap()).unwrap();
        assert_eq!(stable.smallest_number, Some(0));
        let useless =
            stabilizing_drivers(&scenario(0.75), &parse_changes("reaction-time=0.74").unwrap()).unwrap();
        assert_eq!(useless.smallest_number, None);
    }

    #[test]
    fn the_number_of_a_large_ring_is_found_too() {
        let scenario = Scenario { vehicles: 2000, length: 40_000.0, ..scenario(0.75) };
        let answer = stabilizing_drivers(&scenario, &parse_changes("reaction-time=0").unwrap()).unwrap();
        let number = answer.smallest_number.unwrap();
        assert!(answer.numbers.len() == 201 && (100..400).contains(&number), "{number}");
    }

    #[test]
    fn changes_that_are_not_allowed_are_refused_by_name() {
        for (text, words) in
            [("reaction-time=-1", "reaction-time"), ("vehicles=3", "vehicles"), ("calm", "calm")]
        {
            let message = parse_changes(text).unwrap_err().to_string();
            assert!(message.contains("calm-with") && message.contains(words), "{message}");
        }
        let changes = parse_changes("min-headway=4").unwrap();
        assert!(
            stabilizing_drivers(&scenario(0.75), &changes)
                .unwrap_err()
                .to_string()
                .contains("vehicle length")
        );
    }
}
