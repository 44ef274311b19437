//! How many drivers of another kind calm a ring?

use super::driver_classes::DriverClasses;
use super::homogeneous::Time;
use super::report::{Report, lanes_of};
use crate::error::Error;
use crate::scenario::Scenario;
use crate::scenario::action::driver_values;
use crate::scenario::driver::Driver;
use crate::scenario::parameters::DriverField;
use crate::scenario::value::Value;
use serde::Serialize;

/// The answer, for the least stable lane of a scenario, in the steps of its simulation. Its JSON is part of a report's, where
/// lane and vehicles are said already.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StabilizingDrivers {
    /// The lane, from 1.
    #[serde(skip)]
    pub lane: usize,
    /// Vehicles in it.
    #[serde(skip)]
    pub vehicles: usize,
    /// The smallest number of changed drivers with whom the lane is stable; `None` where no number calms it.
    pub smallest_calming_number: Option<usize>,
    /// Numbers of changed drivers, 0 first: all up to the lane's vehicles, of a large lane a choice.
    #[serde(rename = "calming_numbers")]
    pub numbers: Vec<usize>,
    /// The largest growth rate of each, 1/s.
    #[serde(rename = "calming_growth_rates_discrete_per_s")]
    pub max_growth_rates_discrete_per_s: Vec<f64>,
}

/// Every number is tried on rings up to this size; between those tried on larger ones the growth rate is taken to
/// fall as the number rises.
const TRIED: usize = 200;

/// Changes one driver after another of the least stable lane, those of the lowest numbers first; where the others
/// are equal, and that is the usual question, it does not matter which.
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
    let calm: Vec<_> = lane.drivers.iter().map(changed).collect();
    calm.iter().try_for_each(Driver::check)?;
    let n = calm.len();
    let ring = |number: usize| {
        let drivers = [&calm[..number], &lane.drivers[number..]].concat();
        let delays = drivers.iter().map(|d| scenario.steps(d.reaction_time) as f64 * scenario.time_step);
        DriverClasses::of(&drivers, delays.collect::<Vec<_>>(), scenario.length)
    };
    let time = Time::Steps(scenario.time_step);
    let rate = |number: usize| ring(number).fastest(time).map_or(0.0, |mode| mode.root.re);
    // The verdict is the report's: by the closed form of equal drivers, by the count of others.
    let stable = |number: usize| super::report::is_stable(&ring(number), time);

    let tried = n.min(TRIED);
    let numbers: Vec<_> = (0..=tried).map(|k| k * n / tried).collect();
    let rates = numbers.iter().map(|&number| rate(number)).collect();
    let smallest = numbers.iter().position(|&number| stable(number)).map(|k| {
        let (mut low, mut high) = (if k == 0 { numbers[0] } else { numbers[k - 1] + 1 }, numbers[k]);
        while low < high {
            let middle = usize::midpoint(low, high);
            if stable(middle) {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        high
    });
    Ok(StabilizingDrivers {
        lane: place + 1,
        vehicles: n,
        smallest_calming_number: smallest,
        numbers,
        max_growth_rates_discrete_per_s: rates,
    })
}

/// Reads `reaction-time=0` or `reaction-time=0,sensitivity=2`.
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
    fn five_drivers_without_delay_calm_fifty() {
        let calming =
            stabilizing_drivers(&scenario(0.75), &parse_changes("reaction-time=0").unwrap()).unwrap();
        assert_eq!(calming.smallest_calming_number, Some(5));
        assert_eq!(calming.numbers, (0..=50).collect::<Vec<_>>());
        assert!(calming.max_growth_rates_discrete_per_s.windows(2).all(|w| w[1] <= w[0] + 1e-12));
        let stable = stabilizing_drivers(&scenario(0.5), &parse_changes("reaction-time=0").unwrap()).unwrap();
        assert_eq!(stable.smallest_calming_number, Some(0));
        let useless =
            stabilizing_drivers(&scenario(0.75), &parse_changes("reaction-time=0.74").unwrap()).unwrap();
        assert_eq!(useless.smallest_calming_number, None);
    }

    #[test]
    fn a_large_ring_has_its_number_too() {
        let scenario = Scenario { vehicles: 2000, length: 40_000.0, ..scenario(0.75) };
        let calming = stabilizing_drivers(&scenario, &parse_changes("reaction-time=0").unwrap()).unwrap();
        let number = calming.smallest_calming_number.unwrap();
        assert!(calming.numbers.len() == 201 && (100..400).contains(&number), "{number}");
    }

    #[test]
    fn nonsense_is_refused_by_name() {
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
