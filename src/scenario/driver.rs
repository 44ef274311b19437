//! A driver: the law of speed against headway, its inverse and slope, and what follows from it in equilibrium: the common
//! speed and the fundamental diagram. The headway is the distance from the centre of a vehicle to the centre of the next one
//! ahead, in m.
//!
//! The law is Newell's (Operations Research 9, 1961):
//! `v(h) = max(V − V·exp(−(λ/V)(h − d)), 0)`.
//!
//! ```
//! use ringroad::scenario::driver::{Driver, equilibrium};
//!
//! let driver = Driver::default();
//! assert_eq!(driver.speed(driver.min_headway), 0.0);
//! assert!((driver.headway(driver.speed(20.0)) - 20.0).abs() < 1e-12);
//! let uniform = equilibrium(&[driver; 50], 1000.0).unwrap();
//! assert_eq!((uniform.density, uniform.speed), (0.05, driver.speed(20.0)));
//! ```

use crate::error::Error;
use crate::numerics::exp::exp;
use crate::scenario::parameters::{DriverField, Field, PARAMETERS};
use crate::scenario::value::Value;

/// A driver together with the vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Driver {
    /// V, m/s.
    pub max_speed: f64,
    /// λ, 1/s.
    pub sensitivity: f64,
    /// d, m.
    pub min_headway: f64,
    /// C, m.
    pub vehicle_length: f64,
    /// Δ, s.
    pub reaction_time: f64,
    /// r, 1/s.
    pub frustration_rate: f64,
    /// p.
    pub pass_frustration: f64,
}

impl Default for Driver {
    fn default() -> Self {
        let mut driver = Self {
            max_speed: f64::NAN,
            sensitivity: f64::NAN,
            min_headway: f64::NAN,
            vehicle_length: f64::NAN,
            reaction_time: f64::NAN,
            frustration_rate: f64::NAN,
            pass_frustration: f64::NAN,
        };
        for parameter in &PARAMETERS {
            if let Field::Driver(field) = parameter.field {
                driver.set(field, parameter.default);
            }
        }
        driver
    }
}

impl Driver {
    /// The value of a field.
    pub fn value(&self, field: DriverField) -> Value {
        // Every field is named, so that one without a parameter does not compile.
        let &Self {
            max_speed,
            sensitivity,
            min_headway,
            vehicle_length,
            reaction_time,
            frustration_rate,
            pass_frustration,
        } = self;
        match field {
            DriverField::MaxSpeed => max_speed.into(),
            DriverField::Sensitivity => sensitivity.into(),
            DriverField::MinHeadway => min_headway.into(),
            DriverField::VehicleLength => vehicle_length.into(),
            DriverField::ReactionTime => reaction_time.into(),
            DriverField::FrustrationRate => frustration_rate.into(),
            DriverField::PassFrustration => pass_frustration.into(),
        }
    }

    /// Gives a field a value that its parameter allows; a value of another kind changes nothing.
    pub fn set(&mut self, field: DriverField, value: Value) {
        let Some(number) = value.number() else { return };
        match field {
            DriverField::MaxSpeed => self.max_speed = number,
            DriverField::Sensitivity => self.sensitivity = number,
            DriverField::MinHeadway => self.min_headway = number,
            DriverField::VehicleLength => self.vehicle_length = number,
            DriverField::ReactionTime => self.reaction_time = number,
            DriverField::FrustrationRate => self.frustration_rate = number,
            DriverField::PassFrustration => self.pass_frustration = number,
        }
    }

    /// Whether the vehicle fits into the smallest headway, d > C.
    pub(crate) fn check(&self) -> Result<(), Error> {
        if self.min_headway > self.vehicle_length {
            Ok(())
        } else {
            let allowed = format!("more than the vehicle length, {} m", self.vehicle_length);
            Err(Error::conflict("min-headway", format!("{} m", self.min_headway), allowed))
        }
    }

    /// Speed (m/s) at headway `h` (m).
    pub fn speed(&self, h: f64) -> f64 {
        let deficit = exp(-(self.sensitivity / self.max_speed) * (h - self.min_headway));
        (self.max_speed - self.max_speed * deficit).max(0.0)
    }

    /// Headway (m) at which the speed is `v` (m/s), `0 ≤ v < V`: the inverse of [`Self::speed`]. At `v = 0`, where every
    /// headway up to d has that speed, it is d.
    pub fn headway(&self, v: f64) -> f64 {
        self.min_headway - self.max_speed / self.sensitivity * libm::log1p(-v / self.max_speed)
    }

    /// Slope dv/dh (1/s) at headway `h` (m): `λ·exp(−(λ/V)(h − d))` where the vehicle moves, 0 in the jam
    /// (h ≤ d).
    pub fn slope(&self, h: f64) -> f64 {
        if h <= self.min_headway {
            0.0
        } else {
            self.sensitivity * exp(-(self.sensitivity / self.max_speed) * (h - self.min_headway))
        }
    }

    /// Flow (veh/s) of a lane of such drivers at density `rho` (veh/m): `ρ·v(1/ρ)`.
    pub fn flow(&self, rho: f64) -> f64 {
        if rho == 0.0 { 0.0 } else { rho * self.speed(1.0 / rho) }
    }

    /// The largest flow and the density where it occurs.
    ///
    /// With u = (λ/V)(h − d), dq/dρ = 0 reads `e^u = 1 + u + λd/V`; the root is found by Newton's method
    /// from above, where the function is convex.
    pub fn capacity(&self) -> Capacity {
        let k = self.sensitivity * self.min_headway / self.max_speed;
        let mut u = 1.0 + libm::log1p(k) + libm::sqrt(2.0 * k);
        for _ in 0..200 {
            let e = exp(u);
            let next = u - (e - 1.0 - u - k) / (e - 1.0);
            if next >= u || next <= 0.0 {
                break;
            }
            u = next;
        }
        let h = self.min_headway + u * self.max_speed / self.sensitivity;
        Capacity { density: 1.0 / h, flow: self.flow(1.0 / h) }
    }
}

/// The largest flow of the fundamental diagram, and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capacity {
    /// ρ*, veh/m.
    pub density: f64,
    /// q*, veh/s.
    pub flow: f64,
}

/// The state of a lane in which every driver keeps the same speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equilibrium {
    /// v∞, m/s.
    pub speed: f64,
    /// ρ, veh/m.
    pub density: f64,
    /// q = ρ·v∞, veh/s.
    pub flow: f64,
}

/// The equilibrium of `drivers` in one lane of `length` metres: the common speed v∞ with
/// Σ_j h_j(v∞) = L, found by bisection to the last bit. Where the vehicles fill the lane
/// (Σ d_j ≥ L) it is 0. An empty lane has none.
pub fn equilibrium(drivers: &[Driver], length: f64) -> Option<Equilibrium> {
    let first = drivers.first()?;
    let density = drivers.len() as f64 / length;
    let same_law = |d: &Driver| {
        (d.max_speed, d.sensitivity, d.min_headway) == (first.max_speed, first.sensitivity, first.min_headway)
    };
    let speed = if drivers.iter().all(same_law) {
        first.speed(length / drivers.len() as f64)
    } else {
        let needed = |v: f64| drivers.iter().map(|d| d.headway(v)).sum::<f64>();
        let (mut low, mut high) = (0.0, drivers.iter().map(|d| d.max_speed).fold(f64::INFINITY, f64::min));
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
        low
    };
    Some(Equilibrium { speed, density, flow: density * speed })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_law_its_inverse_and_its_slope_belong_together() {
        let driver = Driver { sensitivity: 1.3, max_speed: 33.0, ..Driver::default() };
        for i in 1..400 {
            let h = 7.5 + f64::from(i) * 0.5;
            let v = driver.speed(h);
            assert!((driver.headway(v) - h).abs() < 1e-9 * h * exp(1.3 / 33.0 * h), "h = {h}");
            let numeric = (driver.speed(h + 1e-4) - driver.speed(h - 1e-4)) / 2e-4;
            assert!((driver.slope(h) - numeric).abs() < 1e-7, "h = {h}");
        }
        for h in [-50.0, 0.0, 5.0, 7.5] {
            assert_eq!((driver.speed(h), driver.slope(h)), (0.0, 0.0));
        }
        assert_eq!(driver.headway(0.0), driver.min_headway);
    }

    /// Values of the model's specification.
    #[test]
    fn the_largest_flow_is_that_of_the_paper() {
        let top = Driver::default().capacity();
        assert!((top.flow * 3600.0 - 2065.0).abs() < 1.0, "{top:?}");
        assert!((top.density * 1000.0 - 34.0).abs() < 0.5, "{top:?}");
        let driver = Driver::default();
        for nearby in [0.99, 1.01] {
            assert!(driver.flow(top.density * nearby) < top.flow);
        }
    }

    #[test]
    fn homogeneous_and_heterogeneous_drivers_have_one_speed_in_equilibrium() {
        let homogeneous = equilibrium(&[Driver::default(); 50], 1000.0).unwrap();
        assert!((homogeneous.flow - 0.5368).abs() < 5e-5, "{homogeneous:?}");
        let mut drivers = vec![Driver::default(); 50];
        drivers[3].sensitivity = 2.0;
        drivers[9].max_speed = 25.0;
        let heterogeneous = equilibrium(&drivers, 1000.0).unwrap();
        let total: f64 = drivers.iter().map(|d| d.headway(heterogeneous.speed)).sum();
        assert!((total - 1000.0).abs() < 1e-9);
        let jammed = equilibrium(&[Driver::default(); 140], 1000.0).unwrap();
        assert_eq!(jammed.speed, 0.0);
        assert!(equilibrium(&[], 1000.0).is_none());
    }
}
