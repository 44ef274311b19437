//! The stability plane of one lane of equal drivers: critical reaction times against the number of vehicles in it, and
//! the map of the largest growth rate over number and reaction time.

use super::homogeneous::{HomogeneousRing, Time};
use crate::scenario::Scenario;
use crate::scenario::driver::Driver;

/// A lane that any number of equal drivers may share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StabilityDiagram {
    /// Every driver; the reaction time plays no part.
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
    /// The plane of a scenario's default driver.
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

    /// Numbers of vehicles at which a picture of the plane asks for its curves: from 2 to the jam, or to the `own`
    /// number of the lane where that is larger, evenly spread, not many more than `points`. The last is always
    /// among them.
    pub fn numbers(&self, own: usize, points: usize) -> Vec<usize> {
        let last = (self.jam() as usize).max(own).max(2);
        let stride = last.div_ceil(points.max(1));
        let mut numbers: Vec<_> = (2..last).step_by(stride).collect();
        numbers.push(last);
        numbers
    }

    /// The curves of the plane.
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
    /// steps are what z^m means for a real m; the map has no stairs.
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

    /// Mode 1 is the ring's own curve; the shorter the wave, the longer the delay that it tolerates.
    #[test]
    fn every_mode_has_a_curve_of_its_own() {
        let plane = StabilityDiagram { time_step: 0.05, ..StabilityDiagram::of(&Scenario::default()) };
        let numbers = plane.numbers(150, 400);
        let curves = plane.curves(numbers.iter().copied());
        for (in_steps, of_the_ring) in [(false, &curves.continuous_s), (true, &curves.discrete_s)] {
            let modes: Vec<_> =
                (1..=75).map(|q| plane.critical_of_mode(q, &numbers, plane.time(in_steps))).collect();
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
    fn the_map_changes_sign_on_the_curve() {
        let plane = StabilityDiagram::of(&Scenario::default());
        for n in [2, 10, 50, 133] {
            let critical = plane.curves(n..=n);
            for (in_steps, tau) in [(false, critical.continuous_s[0]), (true, critical.discrete_s[0])] {
                let tau = tau.unwrap();
                let row = plane.growth_rates(n, [tau - 1e-6, tau + 1e-6], plane.time(in_steps));
                assert!(row[0] < 0.0 && row[1] > 0.0, "{n} {in_steps} {row:?}");
            }
        }
        assert_eq!(plane.growth_rates(140, [0.0, 5.0], Time::Continuous), [0.0, 0.0]);
        assert!(plane.growth_rates(1, [1.0], Time::Continuous)[0].is_nan());
    }

    #[test]
    fn pictures_reach_from_two_vehicles_to_the_jam() {
        let plane = StabilityDiagram::of(&Scenario::default());
        assert_eq!(plane.numbers(50, 400), (2..=133).collect::<Vec<_>>());
        assert_eq!(plane.numbers(150, 400).last(), Some(&150));
        let road = StabilityDiagram { length: 1e5, ..plane };
        let spread = road.numbers(50, 400);
        assert!(spread.len() <= 401 && spread.last() == Some(&13_333), "{}", spread.len());
        assert!(spread.windows(2).all(|w| w[0] < w[1]));
    }
}
