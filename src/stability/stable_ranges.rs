//! The inverse questions, for one lane of homogeneous drivers: at a given reaction time, which numbers of vehicles are stable,
//! and which sensitivities?
//!
//! ```
//! use ringroad::scenario::driver::Driver;
//! use ringroad::stability::homogeneous::Time;
//! use ringroad::stability::stable_ranges::{most_vehicles, stable_vehicles};
//!
//! let driver = Driver::default();
//! let most = most_vehicles(&driver, 1000.0);
//! // On one kilometre, at 0.75 s: 41 vehicles are stable, 42 are not; from 134 vehicles on, all stand.
//! let stable = stable_vehicles(&driver, 1000.0, 0.75, Time::Steps(0.01), most);
//! assert_eq!(stable, [(1, 41), (134, 199)]);
//! ```

use super::homogeneous::{HomogeneousRing, Time};
use crate::numerics::bisection::Whole;
use crate::numerics::complex::Complex64;
use crate::numerics::lambert_w::lambert_w;
use crate::scenario::driver::Driver;
use crate::scenario::parameters::{DriverField, RoadField};

/// The largest number of vehicles of such drivers that a lane of `length` metres holds without contact.
pub fn most_vehicles(driver: &Driver, length: f64) -> usize {
    let most = RoadField::Vehicles.parameter().kind.range().map_or(f64::INFINITY, |range| range.max);
    ((length / driver.vehicle_length).ceil() - 1.0).clamp(1.0, most) as usize
}

/// The numbers of vehicles from 1 to `most` with which a lane of `length` metres is stable at the delay `delay`
/// (s), as intervals with both ends included.
///
/// The critical reaction time falls as the lane fills, up to the jam (h ≤ d), where nothing moves and
/// everything is stable again; so there are two intervals at most.
pub fn stable_vehicles(
    driver: &Driver,
    length: f64,
    delay: f64,
    time: Time,
    most: usize,
) -> Vec<(usize, usize)> {
    let stable = |n: usize| {
        delay < HomogeneousRing { vehicles: n, slope: driver.slope(length / n as f64) }.critical(time)
    };
    // Stable numbers come first, then unstable ones up to the jam. One vehicle is always stable.
    let jammed = first_jammed(driver, length, most);
    let first_unstable = Whole::new(0, jammed).until(stable).fails;
    let mut intervals = Vec::new();
    if first_unstable > 1 {
        intervals.push((1, first_unstable - 1));
    }
    if jammed <= most {
        match intervals.last_mut() {
            Some((_, last)) if *last + 1 == jammed => *last = most,
            _ => intervals.push((jammed, most)),
        }
    }
    intervals
}

/// The smallest number of vehicles of such drivers that all stand in equilibrium on a lane of `length` metres; `most` + 1
/// where that number is larger than `most`.
pub fn first_jammed(driver: &Driver, length: f64, most: usize) -> usize {
    Whole::new(0, most + 1).until(|n| length / n as f64 > driver.min_headway).fails
}

/// The sensitivities λ (1/s), within the allowed range, with which N homogeneous drivers are stable at the delay `delay`
/// (s), as intervals. An end of an interval is critical, unless it is an end of the range.
///
/// The slope c = λ·e^{−(λ/V)(h − d)} must stay below the critical one, a/(2Δ·sin a) or
/// sin(a/(2m + 1))/(dt·sin a). It is largest at λ = V/(h − d), so unstable sensitivities are one interval,
/// between −(V/(h − d))·W₀ and W₋₁ of −c·(h − d)/V.
pub fn stable_sensitivities(
    driver: &Driver,
    vehicles: usize,
    length: f64,
    delay: f64,
    time: Time,
) -> Vec<(f64, f64)> {
    let range = DriverField::Sensitivity.parameter().kind.range();
    let range = range.map_or((0.0, f64::INFINITY), |range| (range.min, range.max));
    let excess = length / vehicles as f64 - driver.min_headway;
    let a = std::f64::consts::PI / vehicles as f64;
    let critical = match time {
        Time::Continuous if delay > 0.0 => a / (2.0 * delay * libm::sin(a)),
        Time::Continuous => f64::INFINITY,
        Time::Steps(dt) => libm::sin(a / (2.0 * (delay / dt).round() + 1.0)) / (dt * libm::sin(a)),
    };
    if vehicles < 2 || excess <= 0.0 || !critical.is_finite() {
        return vec![range];
    }
    let unit = driver.max_speed / excess;
    let z = -critical / unit;
    if z < -1.0 / std::f64::consts::E {
        return vec![range];
    }
    let end = |branch: i32| -unit * lambert_w(branch, Complex64::new(z, 0.0)).re;
    let (from, to) = (end(0), end(-1));
    let mut intervals = Vec::new();
    if from > range.0 {
        intervals.push((range.0, from.min(range.1)));
    }
    if to < range.1 {
        intervals.push((to.max(range.0), range.1));
    }
    intervals
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The model's specification: at N = 50, Δ = 0.5 s only 1.70 < λ < 5.38 is unstable.
    #[test]
    fn known_sensitivities() {
        let found = stable_sensitivities(&Driver::default(), 50, 1000.0, 0.5, Time::Continuous);
        assert_eq!(found.len(), 2);
        assert_eq!((found[0].0, found[1].1), (0.01, 20.0));
        assert!((1.70..1.71).contains(&found[0].1) && (5.38..5.39).contains(&found[1].0), "{found:?}");
    }

    #[test]
    fn the_ends_of_the_intervals_are_critical() {
        for time in [Time::Continuous, Time::Steps(0.01), Time::Steps(0.1)] {
            for delay in [0.3, 0.5, 0.7] {
                let found = stable_sensitivities(&Driver::default(), 50, 1000.0, delay, time);
                for end in found.iter().flat_map(|i| [i.0, i.1]).filter(|&l| l > 0.01 && l < 20.0) {
                    let driver = Driver { sensitivity: end, ..Driver::default() };
                    let critical = HomogeneousRing { vehicles: 50, slope: driver.slope(20.0) }.critical(time);
                    assert!((critical - delay).abs() < 1e-9, "{time:?} {delay} {end}: {critical}");
                }
            }
        }
        let all = vec![(0.01, 20.0)];
        assert_eq!(stable_sensitivities(&Driver::default(), 50, 1000.0, 0.0, Time::Steps(0.01)), all);
        assert_eq!(stable_sensitivities(&Driver::default(), 140, 1000.0, 3.0, Time::Continuous), all);
        assert_eq!(stable_sensitivities(&Driver::default(), 1, 1000.0, 3.0, Time::Continuous), all);
    }

    #[test]
    fn numbers_of_vehicles_agree_with_one_by_one() {
        for time in [Time::Continuous, Time::Steps(0.01), Time::Steps(0.5)] {
            for delay in [0.0, 0.3, 0.5, 0.505, 0.75, 1.5, 10.0] {
                for driver in [Driver::default(), Driver { sensitivity: 3.0, ..Driver::default() }] {
                    let found = stable_vehicles(&driver, 1000.0, delay, time, 199);
                    for n in 1..=199 {
                        let slope = driver.slope(1000.0 / f64::from(n));
                        let stable = delay < HomogeneousRing { vehicles: n as usize, slope }.critical(time);
                        let inside = found.iter().any(|&(a, b)| (a..=b).contains(&(n as usize)));
                        assert_eq!(stable, inside, "{time:?} {delay} {n}: {found:?}");
                    }
                }
            }
        }
    }
}
