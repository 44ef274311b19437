//! What the linear theory asks of a lane: for every driver the slope of speed against headway in equilibrium, and
//! the delay. Drivers who share both are one *kind*; their places on the ring do not enter.

use super::homogeneous::HomogeneousRing;
use crate::numerics::exp::exp;
use crate::scenario::driver::Driver;

/// Drivers who are the same to the linear theory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriverClass {
    /// How many.
    pub count: usize,
    /// c = dv/dh in equilibrium, 1/s.
    pub slope: f64,
    /// Δ, s.
    pub delay: f64,
}

/// The drivers of a lane, by kind.
///
/// Kinds are sorted, so that two rings with the same drivers in another order are equal to the last bit.
#[derive(Clone, Debug, PartialEq)]
pub struct DriverClasses {
    classes: Vec<DriverClass>,
    vehicles: usize,
}

impl DriverClasses {
    /// A ring of drivers given by slope (1/s) and delay (s).
    pub fn new(drivers: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let mut classes: Vec<DriverClass> = Vec::new();
        let mut vehicles = 0;
        for (slope, delay) in drivers {
            vehicles += 1;
            let order = |kind: &DriverClass| kind.slope.total_cmp(&slope).then(kind.delay.total_cmp(&delay));
            match classes.binary_search_by(order) {
                Ok(place) => classes[place].count += 1,
                Err(place) => classes.insert(place, DriverClass { count: 1, slope, delay }),
            }
        }
        Self { classes, vehicles }
    }

    /// The drivers of a lane of `length` metres in equilibrium, each with the delay (s) in `delays`.
    pub fn of(drivers: &[Driver], delays: impl IntoIterator<Item = f64>, length: f64) -> Self {
        Self::new(slopes(drivers, length).into_iter().zip(delays))
    }

    /// N.
    pub fn vehicles(&self) -> usize {
        self.vehicles
    }

    /// The kinds, by rising slope, then delay.
    pub fn classes(&self) -> &[DriverClass] {
        &self.classes
    }

    /// The ring and the delay of drivers who are all alike.
    pub fn equal(&self) -> Option<(HomogeneousRing, f64)> {
        match self.classes.as_slice() {
            [kind] => Some((HomogeneousRing { vehicles: kind.count, slope: kind.slope }, kind.delay)),
            _ => None,
        }
    }

    /// Whether nobody moves: all slopes are 0. A ring without vehicles counts as one.
    pub fn is_jammed(&self) -> bool {
        self.classes.iter().all(|kind| kind.slope <= 0.0)
    }

    /// Mean delay, s; 0 without vehicles.
    pub fn mean_delay(&self) -> f64 {
        let sum: f64 = self.classes.iter().map(|kind| kind.count as f64 * kind.delay).sum();
        sum / self.vehicles.max(1) as f64
    }

    /// The slope of equal drivers who would carry long waves as fast: the harmonic mean, 1/s.
    pub fn mean_slope(&self) -> f64 {
        match self.classes.as_slice() {
            // Exactly, not up to rounding.
            [kind] => kind.slope,
            classes => {
                let sum: f64 = classes.iter().map(|kind| kind.count as f64 / kind.slope).sum();
                if sum == 0.0 { 0.0 } else { self.vehicles as f64 / sum }
            }
        }
    }

    /// The mean delay (s) at which infinitely long waves are critical, all delays in proportion (all alike where they are
    /// 0): from the product equation to second order in s, Σ Δ_j/c_j = Σ 1/(2c_j²). Of equal drivers Newell's
    /// 1/(2c); infinite in the jam.
    pub fn newell_limit(&self) -> f64 {
        if let Some((ring, _)) = self.equal() {
            return ring.newell_limit();
        }
        let mean = self.mean_delay();
        let (mut squares, mut shares) = (0.0, 0.0);
        for kind in &self.classes {
            let weight = kind.count as f64 / kind.slope;
            squares += 0.5 * weight / kind.slope;
            shares += weight * if mean > 0.0 { kind.delay / mean } else { 1.0 };
        }
        if self.is_jammed() { f64::INFINITY } else { squares / shares }
    }

    /// The same ring with other delays, each from the old.
    #[must_use]
    pub fn with_delays(&self, delay: impl Fn(f64) -> f64) -> Self {
        let classes =
            self.classes.iter().map(|kind| DriverClass { delay: delay(kind.delay), ..*kind }).collect();
        Self { classes, vehicles: self.vehicles }
    }
}

/// The slopes dv/dh (1/s) of the drivers of a lane of `length` metres in equilibrium; all 0 in a jam (Σ d_j ≥ L).
///
/// The common speed is sought as w = −ln(1 − v/V), V the smallest maximal speed: Σ_j h_j = L with
/// h_j = d_j − (V_j/λ_j)·ln(1 − v/V_j), which rises with w. In this variable nothing is lost where v is within
/// rounding of V, as behind a slow vehicle on a long road; c_j = λ_j(1 − v/V_j).
pub fn slopes(drivers: &[Driver], length: f64) -> Vec<f64> {
    let Some(first) = drivers.first() else { return Vec::new() };
    let law = |d: &Driver| (d.max_speed, d.sensitivity, d.min_headway);
    if drivers.iter().all(|d| law(d) == law(first)) {
        return vec![first.slope(length / drivers.len() as f64); drivers.len()];
    }
    let slowest = drivers.iter().map(|d| d.max_speed).fold(f64::INFINITY, f64::min);
    // 1 − v/V_j, without cancellation, and its logarithm.
    let spare = |d: &Driver, w: f64| (d.max_speed - slowest + slowest * exp(-w)) / d.max_speed;
    let headway = |d: &Driver, w: f64| {
        let log = if d.max_speed == slowest { -w } else { libm::log(spare(d, w)) };
        d.min_headway - d.max_speed / d.sensitivity * log
    };
    // Drivers with the same law share one evaluation.
    let mut laws: Vec<(&Driver, f64)> = Vec::new();
    for driver in drivers {
        match laws.iter_mut().find(|(d, _)| law(d) == law(driver)) {
            Some((_, count)) => *count += 1.0,
            None => laws.push((driver, 1.0)),
        }
    }
    let needed = |w: f64| laws.iter().map(|(d, count)| count * headway(d, w)).sum::<f64>();
    if needed(0.0) >= length {
        return vec![0.0; drivers.len()];
    }
    let (mut low, mut high) = (0.0, 1.0);
    while needed(high) < length {
        high *= 2.0;
    }
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if needed(middle) < length {
            low = middle;
        } else {
            high = middle;
        }
    }
    drivers.iter().map(|d| d.sensitivity * spare(d, low)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::driver::equilibrium;

    #[test]
    fn slopes_are_those_of_the_headways_in_equilibrium() {
        let mut drivers = vec![Driver::default(); 50];
        drivers[3].sensitivity = 2.0;
        drivers[9].max_speed = 25.0;
        drivers[20].min_headway = 12.0;
        let speed = equilibrium(&drivers, 1000.0).unwrap().speed;
        for (driver, slope) in drivers.iter().zip(slopes(&drivers, 1000.0)) {
            assert!((slope - driver.slope(driver.headway(speed))).abs() < 1e-12);
        }
        assert_eq!(slopes(&[Driver::default(); 140], 1000.0), [0.0; 140]);
        let mut jam = vec![Driver::default(); 140];
        jam[0].sensitivity = 2.0;
        assert_eq!(slopes(&jam, 1000.0), [0.0; 140]);
    }

    /// Behind one slow vehicle on a long road the others keep their distance, and the slow one has the rest.
    #[test]
    fn a_slow_vehicle_on_a_long_road() {
        let mut drivers = vec![Driver::default(); 10];
        drivers[0].max_speed = 5.0;
        let slopes = slopes(&drivers, 1000.0);
        let behind = drivers[1].headway(5.0);
        assert!((slopes[1] - drivers[1].slope(behind)).abs() < 1e-12);
        let free = drivers[0].slope(1000.0 - 9.0 * behind);
        assert!(free < 1e-60 && (slopes[0] / free - 1.0).abs() < 1e-8, "{} {free}", slopes[0]);
    }

    #[test]
    fn order_does_not_matter_to_the_last_bit() {
        let ring = DriverClasses::new([(1.0, 0.5), (0.7, 0.0), (1.0, 0.5), (0.7, 0.2)]);
        assert_eq!(ring, DriverClasses::new([(0.7, 0.2), (1.0, 0.5), (1.0, 0.5), (0.7, 0.0)]));
        assert_eq!((ring.vehicles(), ring.classes().len()), (4, 3));
        assert!((ring.mean_delay() - 0.3).abs() < 1e-15);
        assert_eq!(
            DriverClasses::new([(0.3, 1.0); 7]).equal().unwrap().0,
            HomogeneousRing { vehicles: 7, slope: 0.3 }
        );
    }
}
