//! Driver classes. The linear theory needs of every driver the slope of speed against headway in equilibrium, and the delay.
//! Drivers with the same two numbers form one *class*; their order on the ring does not matter.
//!
//! ```
//! use ringroad::stability::driver_classes::DriverClasses;
//!
//! // Two drivers with the slope 1 /s and a delay of 0.5 s, and one without delay: (slope, delay).
//! let classes = DriverClasses::new([(1.0, 0.5), (1.0, 0.0), (1.0, 0.5)]);
//! assert_eq!((classes.vehicles(), classes.classes().len()), (3, 2));
//! assert!(classes.homogeneous().is_none());
//! assert!((classes.mean_delay() - 1.0 / 3.0).abs() < 1e-15);
//! ```

use super::homogeneous::HomogeneousRing;
use crate::scenario::driver::{Driver, Equilibrium, equilibrium};

/// Drivers that are the same to the linear theory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriverClass {
    /// How many.
    pub count: usize,
    /// c = dv/dh in equilibrium, 1/s.
    pub slope: f64,
    /// Δ, s.
    pub delay: f64,
}

/// The drivers of a lane, by class.
///
/// Classes are sorted, so that two lanes with the same drivers in another order are equal to the last bit.
#[derive(Clone, Debug, PartialEq)]
pub struct DriverClasses {
    classes: Vec<DriverClass>,
    vehicles: usize,
}

impl DriverClasses {
    /// Drivers given by slope (1/s) and delay (s).
    pub fn new(drivers: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let mut classes: Vec<DriverClass> = Vec::new();
        let mut vehicles = 0;
        for (slope, delay) in drivers {
            vehicles += 1;
            let order =
                |class: &DriverClass| class.slope.total_cmp(&slope).then(class.delay.total_cmp(&delay));
            match classes.binary_search_by(order) {
                Ok(place) => classes[place].count += 1,
                Err(place) => classes.insert(place, DriverClass { count: 1, slope, delay }),
            }
        }
        Self { classes, vehicles }
    }

    /// The drivers of a lane of `length` metres in equilibrium, each with the delay (s) in `delays`.
    pub fn of(drivers: &[Driver], delays: impl IntoIterator<Item = f64>, length: f64) -> Self {
        let equilibrium = equilibrium(drivers, length).unwrap_or_default();
        Self::in_equilibrium(drivers, delays, &equilibrium)
    }

    /// The same where the equilibrium of these drivers is known already.
    pub fn in_equilibrium(
        drivers: &[Driver],
        delays: impl IntoIterator<Item = f64>,
        equilibrium: &Equilibrium,
    ) -> Self {
        Self::new(drivers.iter().map(|driver| equilibrium.slope(&driver.law())).zip(delays))
    }

    /// N.
    pub fn vehicles(&self) -> usize {
        self.vehicles
    }

    /// The classes, by rising slope, then delay.
    pub fn classes(&self) -> &[DriverClass] {
        &self.classes
    }

    /// Ring and delay (s) where all drivers are of one class; none otherwise.
    pub fn homogeneous(&self) -> Option<(HomogeneousRing, f64)> {
        match self.classes.as_slice() {
            [class] => Some((HomogeneousRing { vehicles: class.count, slope: class.slope }, class.delay)),
            _ => None,
        }
    }

    /// Whether all vehicles stand, so that all slopes are 0. So it is without vehicles, too.
    pub fn is_jammed(&self) -> bool {
        self.classes.iter().all(|class| class.slope <= 0.0)
    }

    /// Mean delay, s; 0 without vehicles.
    pub fn mean_delay(&self) -> f64 {
        let sum: f64 = self.classes.iter().map(|class| class.count as f64 * class.delay).sum();
        sum / self.vehicles.max(1) as f64
    }

    /// The slope (1/s) of homogeneous drivers with the same speed of long waves: the harmonic mean.
    pub fn mean_slope(&self) -> f64 {
        match self.classes.as_slice() {
            // Exactly, not up to rounding.
            [class] => class.slope,
            classes => {
                let sum: f64 = classes.iter().map(|class| class.count as f64 / class.slope).sum();
                if sum == 0.0 { 0.0 } else { self.vehicles as f64 / sum }
            }
        }
    }

    /// The mean delay (s) at which infinitely long waves are critical when all delays change in proportion (when all are 0:
    /// when all grow alike). From the product equation to second order in s, Σ Δ_j/c_j = Σ 1/(2c_j²); for homogeneous drivers
    /// it is Newell's 1/(2c). Infinite in the jam.
    pub fn newell_limit(&self) -> f64 {
        if let Some((ring, _)) = self.homogeneous() {
            return ring.newell_limit();
        }
        let mean = self.mean_delay();
        let (mut squares, mut shares) = (0.0, 0.0);
        for class in &self.classes {
            let weight = class.count as f64 / class.slope;
            squares += 0.5 * weight / class.slope;
            shares += weight * if mean > 0.0 { class.delay / mean } else { 1.0 };
        }
        if self.is_jammed() { f64::INFINITY } else { squares / shares }
    }

    /// The same drivers with other delays, each a function of the old one (s).
    #[must_use]
    pub fn with_delays(&self, delay: impl Fn(f64) -> f64) -> Self {
        let classes =
            self.classes.iter().map(|class| DriverClass { delay: delay(class.delay), ..*class }).collect();
        Self { classes, vehicles: self.vehicles }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_does_not_matter_to_the_last_bit() {
        let classes = DriverClasses::new([(1.0, 0.5), (0.7, 0.0), (1.0, 0.5), (0.7, 0.2)]);
        assert_eq!(classes, DriverClasses::new([(0.7, 0.2), (1.0, 0.5), (1.0, 0.5), (0.7, 0.0)]));
        assert_eq!((classes.vehicles(), classes.classes().len()), (4, 3));
        assert!((classes.mean_delay() - 0.3).abs() < 1e-15);
        assert_eq!(
            DriverClasses::new([(0.3, 1.0); 7]).homogeneous().unwrap().0,
            HomogeneousRing { vehicles: 7, slope: 0.3 }
        );
    }
}
