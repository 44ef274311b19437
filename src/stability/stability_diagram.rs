//! The stability diagram of one lane of homogeneous drivers: critical reaction times against the number of vehicles, and
//! the map of the largest growth rate over number and reaction time.
//!
//! ```
//! use ringroad::scenario::Scenario;
//! use ringroad::stability::homogeneous::Time;
//! use ringroad::stability::stability_diagram::StabilityDiagram;
//!
//! let diagram = StabilityDiagram::of(&Scenario::default());
//! let curves = diagram.curves([25, 50, 140]);
//! assert!(curves.continuous_s[0] > curves.continuous_s[1]); // more vehicles are less stable,
//! assert_eq!(curves.continuous_s[2], None); // up to the jam, where every reaction time is stable
//! let rates = diagram.growth_rates(50, [0.5, 0.75], Time::Continuous);
//! assert!(rates[0] < 0.0 && rates[1] > 0.0);
//! ```

use super::homogeneous::{HomogeneousRing, Time};
use crate::scenario::Scenario;
use crate::scenario::driver::Driver;

/// The lane of the diagram: any number of homogeneous drivers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StabilityDiagram {
    /// Every driver; the reaction time is not used.
    pub driver: Driver,
    /// L, m.
    pub length: f64,
    /// dt, s.
    pub time_step: f64,
}

/// Critical reaction times over the number of vehicles in the lane. What is infinite is `None`.
#[derive(Clone, Debug, PartialEq)]
pub struct Curves {
    /// N.
    pub vehicles: Vec<usize>,
    /// τ(N), continuous time, s.
    pub continuous_s: Vec<Option<f64>>,
    /// τ_dt(N), the scenario's steps, s.
    pub discrete_s: Vec<Option<f64>>,
    /// Newell's limit 1/(2c), s.
    pub newell_s: Vec<Option<f64>>,
}

impl StabilityDiagram {
    /// The diagram of a scenario's default driver.
    pub fn of(scenario: &Scenario) -> Self {
        Self { driver: scenario.driver, length: scenario.length, time_step: scenario.time_step }
    }

    fn ring(&self, vehicles: usize) -> HomogeneousRing {
        HomogeneousRing { vehicles, slope: self.driver.slope(self.length / vehicles as f64) }
    }

    /// Steps or continuous time.
    pub fn time(&self, in_steps: bool) -> Time {
        if in_steps { Time::Steps(self.time_step) } else { Time::Continuous }
    }

    /// The number of vehicles beyond which the lane is a jam.
    pub fn jam(&self) -> f64 {
        self.length / self.driver.min_headway
    }

    /// Numbers of vehicles for the curves of a picture: from 2 to the jam, or to the lane's `own` number where that is larger,
    /// evenly spread, not many more than `points`. The last is always among them.
    pub fn numbers(&self, own: usize, points: usize) -> Vec<usize> {
        let last = (self.jam() as usize).max(own).max(2);
        let stride = last.div_ceil(points.max(1));
        let mut numbers: Vec<_> = (2..last).step_by(stride).collect();
        numbers.push(last);
        numbers
    }

    /// The neutral stability curves, and Newell's limit, at these numbers of vehicles.
    pub fn curves(&self, vehicles: impl IntoIterator<Item = usize>) -> Curves {
        let vehicles: Vec<_> = vehicles.into_iter().collect();
        let column = |of: &dyn Fn(&HomogeneousRing) -> f64| {
            let finite = |&n: &usize| Some(of(&self.ring(n))).filter(|x| x.is_finite());
            vehicles.iter().map(finite).collect()
        };
        let continuous_s = column(&|ring| ring.critical(Time::Continuous));
        let discrete_s = column(&|ring| ring.critical(Time::Steps(self.time_step)));
        let newell_s = column(&HomogeneousRing::newell_limit);
        Curves { vehicles, continuous_s, discrete_s, newell_s }
    }

    /// Critical reaction time (s) of a mode at every number of `vehicles`; infinite in the jam, NaN where there
    /// are too few vehicles for it.
    pub fn critical_of_mode(&self, mode: usize, vehicles: &[usize], time: Time) -> Vec<f64> {
        let critical =
            |&n: &usize| if 2 * mode > n { f64::NAN } else { self.ring(n).critical_of(mode, time) };
        vehicles.iter().map(critical).collect()
    }

    /// One row of the map: the largest growth rate (1/s) with `vehicles` vehicles at each reaction time (s), a number
    /// for every one: 0 in the jam, NaN for a vehicle alone, which has no modes. In steps, delays between whole
    /// steps are those of z^m for a real m, so that the map is smooth.
    pub fn growth_rates(
        &self,
        vehicles: usize,
        reaction_times: impl IntoIterator<Item = f64>,
        time: Time,
    ) -> Vec<f64> {
        let ring = self.ring(vehicles);
        let rate = |delay: f64| match ring.fastest(delay, time) {
            Some(mode) => mode.root.re,
            None if vehicles > 1 => 0.0,
            None => f64::NAN,
        };
        reaction_times.into_iter().map(rate).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The curve of mode 1 is that of the ring; a shorter wave has a larger critical delay.
    #[test]
    fn every_mode_has_a_curve_of_its_own() {
        let diagram = StabilityDiagram { time_step: 0.05, ..StabilityDiagram::of(&Scenario::default()) };
        let numbers = diagram.numbers(150, 400);
        let curves = diagram.curves(numbers.iter().copied());
        for (in_steps, of_the_ring) in [(false, &curves.continuous_s), (true, &curves.discrete_s)] {
            let modes: Vec<_> =
                (1..=75).map(|q| diagram.critical_of_mode(q, &numbers, diagram.time(in_steps))).collect();
            for (k, &n) in numbers.iter().enumerate() {
                assert_eq!(Some(modes[0][k]).filter(|tau| tau.is_finite()), of_the_ring[k]);
                assert_eq!(modes.iter().filter(|mode| !mode[k].is_nan()).count(), n / 2);
                let rising = modes[..n / 2].windows(2).all(|w| w[0][k] < w[1][k]);
                assert!(rising || n > 133, "{n}");
            }
            assert_eq!(modes[20][numbers.len() - 1], f64::INFINITY, "the jam");
        }
    }

    #[test]
    fn the_map_changes_sign_on_the_neutral_curve() {
        let diagram = StabilityDiagram::of(&Scenario::default());
        for n in [2, 10, 50, 133] {
            let critical = diagram.curves(n..=n);
            for (in_steps, tau) in [(false, critical.continuous_s[0]), (true, critical.discrete_s[0])] {
                let tau = tau.unwrap();
                let row = diagram.growth_rates(n, [tau - 1e-6, tau + 1e-6], diagram.time(in_steps));
                assert!(row[0] < 0.0 && row[1] > 0.0, "{n} {in_steps} {row:?}");
            }
        }
        assert_eq!(diagram.growth_rates(140, [0.0, 5.0], Time::Continuous), [0.0, 0.0]);
        assert!(diagram.growth_rates(1, [1.0], Time::Continuous)[0].is_nan());
    }

    #[test]
    fn pictures_reach_from_two_vehicles_to_the_jam() {
        let diagram = StabilityDiagram::of(&Scenario::default());
        assert_eq!(diagram.numbers(50, 400), (2..=133).collect::<Vec<_>>());
        assert_eq!(diagram.numbers(150, 400).last(), Some(&150));
        let road = StabilityDiagram { length: 1e5, ..diagram };
        let spread = road.numbers(50, 400);
        assert!(spread.len() <= 401 && spread.last() == Some(&13_333), "{}", spread.len());
        assert!(spread.windows(2).all(|w| w[0] < w[1]));
    }
}
