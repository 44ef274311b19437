//! A driver: the parameters, the law of speed against headway with its inverse and slope, and what follows from it in
//! equilibrium: the common speed and the fundamental diagram.
//!
//! The law is Newell's (Operations Research 9, 1961):
//! `v(h) = max(V − V·exp(−(λ/V)(h − d)), 0)`. A *headway* is a distance, from centre to centre of the vehicle ahead.
//!
//! ```
//! use ringroad::scenario::driver::{Driver, equilibrium};
//!
//! let driver = Driver::default();
//! let speed = driver.speed(20.0);
//! assert!((driver.headway(speed) - 20.0).abs() < 1e-12);
//!
//! // Fifty drivers on one kilometre; one of them is more sensitive and keeps a shorter headway at the same speed.
//! let mut drivers = vec![driver; 50];
//! drivers[0].sensitivity = 2.0;
//! let common = equilibrium(&drivers, 1000.0).unwrap();
//! let total: f64 = drivers.iter().map(|d| d.headway(common.speed)).sum();
//! assert!((total - 1000.0).abs() < 1e-9 && common.speed > speed);
//! ```

use crate::error::Error;
use crate::numerics::bisection::last_bit;
use crate::numerics::exp::exp;
use crate::scenario::parameters::{DriverField, Field, PARAMETERS};
use crate::scenario::value::Value;

/// One driver, with the vehicle.
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

    /// What of the driver decides on speed: V, λ and d.
    pub fn law(&self) -> SpeedLaw {
        SpeedLaw { max_speed: self.max_speed, sensitivity: self.sensitivity, min_headway: self.min_headway }
    }

    /// Speed (m/s) at headway `h` (m); see [`SpeedLaw::speed`].
    pub fn speed(&self, h: f64) -> f64 {
        self.law().speed(h)
    }

    /// Headway (m) at speed `v` (m/s); see [`SpeedLaw::headway`].
    pub fn headway(&self, v: f64) -> f64 {
        self.law().headway(v)
    }

    /// Slope dv/dh (1/s) at headway `h` (m); see [`SpeedLaw::slope`].
    pub fn slope(&self, h: f64) -> f64 {
        self.law().slope(h)
    }

    /// Flow (veh/s) at density `rho` (veh/m); see [`SpeedLaw::flow`].
    pub fn flow(&self, rho: f64) -> f64 {
        self.law().flow(rho)
    }

    /// The largest flow and its density; see [`SpeedLaw::capacity`].
    pub fn capacity(&self) -> Capacity {
        self.law().capacity()
    }
}

/// Newell's law of speed against headway, `v(h) = max(V − V·exp(−(λ/V)(h − d)), 0)`, with its inverse and its slope.
///
/// The formula stands here once. Only the step of a simulation has a second form of it, which moves many vehicles at a
/// time by a small change of headway (`simulation::car_following`); tests hold that form against this one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedLaw {
    /// V, m/s.
    pub max_speed: f64,
    /// λ, 1/s.
    pub sensitivity: f64,
    /// d, m.
    pub min_headway: f64,
}

impl SpeedLaw {
    /// The speed deficit as a share of V, (V − v)/V, at headway `h` (m); above 1 where h < d.
    fn deficit_share(&self, h: f64) -> f64 {
        exp(-(self.sensitivity / self.max_speed) * (h - self.min_headway))
    }

    /// Headway (m) at which the natural logarithm of (V − v)/V is `logarithm`.
    fn headway_at(&self, logarithm: f64) -> f64 {
        self.min_headway - self.max_speed / self.sensitivity * logarithm
    }

    /// Slope dv/dh (1/s) where the speed deficit is `share` of V.
    fn slope_at(&self, share: f64) -> f64 {
        self.sensitivity * share
    }

    /// Speed (m/s) at headway `h` (m).
    pub fn speed(&self, h: f64) -> f64 {
        (self.max_speed - self.max_speed * self.deficit_share(h)).max(0.0)
    }

    /// Headway (m) at which the speed is `v` (m/s), `0 ≤ v < V`; at `v = 0` the largest such headway, d.
    pub fn headway(&self, v: f64) -> f64 {
        self.headway_at(libm::log1p(-v / self.max_speed))
    }

    /// Slope dv/dh (1/s) at headway `h` (m): `λ·exp(−(λ/V)(h − d))` where the vehicle moves, 0 in the jam
    /// (h ≤ d).
    pub fn slope(&self, h: f64) -> f64 {
        if h <= self.min_headway { 0.0 } else { self.slope_at(self.deficit_share(h)) }
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

/// The largest flow of a fundamental diagram and its density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capacity {
    /// ρ*, veh/m.
    pub density: f64,
    /// q*, veh/s.
    pub flow: f64,
}

/// The state of a lane in which every driver keeps the same speed.
///
/// Density and flow are those of all its vehicles. The slopes of the speed laws are had from [`Equilibrium::slope`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Equilibrium {
    /// v∞, m/s.
    pub speed: f64,
    /// ρ, veh/m.
    pub density: f64,
    /// q = ρ·v∞, veh/s.
    pub flow: f64,
    point: Point,
}

/// Where on their speed laws the drivers are in equilibrium.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Point {
    /// At rest: the vehicles fill the lane.
    #[default]
    Jam,
    /// All at the same headway, m.
    Headway(f64),
    /// All at the same speed: V is the smallest maximal speed, m/s, and `logarithm` is ln(1 − v∞/V).
    Speed { slowest: f64, logarithm: f64 },
}

impl Equilibrium {
    /// The slope dv/dh (1/s) of a law that one of the lane's drivers has, in equilibrium; 0 in the jam.
    ///
    /// It is λ·(V − v∞)/V. Where v∞ is within rounding of the smallest V, as behind a slow vehicle on a long road, the
    /// difference keeps all its digits, as the logarithm of 1 − v∞/V is what was solved for.
    pub fn slope(&self, law: &SpeedLaw) -> f64 {
        match self.point {
            Point::Jam => 0.0,
            Point::Headway(h) => law.slope(h),
            Point::Speed { slowest, logarithm } => law.slope_at(share_at(law, slowest, logarithm)),
        }
    }
}

/// (V_j − v)/V_j of a law j without cancellation, where ln(1 − v/V) is `logarithm`, V = `slowest`.
fn share_at(law: &SpeedLaw, slowest: f64, logarithm: f64) -> f64 {
    (law.max_speed - slowest + slowest * exp(logarithm)) / law.max_speed
}

/// The equilibrium of `drivers` in one lane of `length` metres: the common speed v∞ with
/// Σ_j h_j(v∞) = L. Where the vehicles fill the lane (Σ d_j ≥ L) it is 0. An empty lane has none.
///
/// Where the laws are equal, every headway is L/N. Otherwise the unknown is w = −ln(1 − v/V), V the smallest maximal
/// speed, with h_j = d_j − (V_j/λ_j)·ln(1 − v/V_j), which rises with w; it is found by bisection to the last bit. In this
/// variable nothing is lost where v is within rounding of V. Then v∞ = −V·(e^{−w} − 1).
pub fn equilibrium(drivers: &[Driver], length: f64) -> Option<Equilibrium> {
    let first = drivers.first()?.law();
    let density = drivers.len() as f64 / length;
    let (speed, point) = if drivers.iter().all(|d| d.law() == first) {
        let headway = length / drivers.len() as f64;
        (first.speed(headway), Point::Headway(headway))
    } else {
        match common_speed(drivers, length) {
            None => (0.0, Point::Jam),
            Some((slowest, w)) => (-slowest * libm::expm1(-w), Point::Speed { slowest, logarithm: -w }),
        }
    };
    Some(Equilibrium { speed, density, flow: density * speed, point })
}

/// The smallest maximal speed V, and w = −ln(1 − v∞/V) of the common speed of drivers that differ; none in a jam.
fn common_speed(drivers: &[Driver], length: f64) -> Option<(f64, f64)> {
    let slowest = drivers.iter().map(|d| d.max_speed).fold(f64::INFINITY, f64::min);
    // Drivers with the same law share one evaluation.
    let mut laws: Vec<(SpeedLaw, f64)> = Vec::new();
    for law in drivers.iter().map(Driver::law) {
        match laws.iter_mut().find(|(known, _)| *known == law) {
            Some((_, count)) => *count += 1.0,
            None => laws.push((law, 1.0)),
        }
    }
    let headway = |law: &SpeedLaw, w: f64| {
        let logarithm = if law.max_speed == slowest { -w } else { libm::log(share_at(law, slowest, -w)) };
        law.headway_at(logarithm)
    };
    let fits = |w: f64| laws.iter().map(|(law, count)| count * headway(law, w)).sum::<f64>() < length;
    if !fits(0.0) {
        return None;
    }
    let mut high = 1.0;
    while fits(high) {
        high *= 2.0;
    }
    Some((slowest, last_bit(0.0, high, fits).0))
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
    fn the_fundamental_diagram_has_the_known_capacity() {
        let capacity = Driver::default().capacity();
        assert!((capacity.flow * 3600.0 - 2065.0).abs() < 1.0, "{capacity:?}");
        assert!((capacity.density * 1000.0 - 34.0).abs() < 0.5, "{capacity:?}");
        let driver = Driver::default();
        for nearby in [0.99, 1.01] {
            assert!(driver.flow(capacity.density * nearby) < capacity.flow);
        }
    }

    #[test]
    fn homogeneous_and_heterogeneous_drivers_share_one_speed_in_equilibrium() {
        let homogeneous = equilibrium(&[Driver::default(); 50], 1000.0).unwrap();
        assert!((homogeneous.flow - 0.5368).abs() < 5e-5, "{homogeneous:?}");
        let mut drivers = vec![Driver::default(); 50];
        drivers[3].sensitivity = 2.0;
        drivers[9].max_speed = 25.0;
        drivers[20].min_headway = 12.0;
        let common = equilibrium(&drivers, 1000.0).unwrap();
        let total: f64 = drivers.iter().map(|d| d.headway(common.speed)).sum();
        assert!((total - 1000.0).abs() < 1e-9);
        for driver in &drivers {
            let slope = driver.slope(driver.headway(common.speed));
            assert!((common.slope(&driver.law()) - slope).abs() < 1e-12);
        }
        assert!(equilibrium(&[], 1000.0).is_none());
    }

    #[test]
    fn a_jam_has_neither_speed_nor_slopes() {
        let mut drivers = vec![Driver::default(); 140];
        for sensitivity in [1.0, 2.0] {
            drivers[0].sensitivity = sensitivity;
            let jam = equilibrium(&drivers, 1000.0).unwrap();
            assert_eq!((jam.speed, jam.flow), (0.0, 0.0));
            assert!(drivers.iter().all(|d| jam.slope(&d.law()) == 0.0));
        }
    }

    /// Behind one slow vehicle on a long road the others keep their headway, and the slow one has the rest.
    #[test]
    fn a_slow_vehicle_on_a_long_road() {
        let mut drivers = vec![Driver::default(); 10];
        drivers[0].max_speed = 5.0;
        let common = equilibrium(&drivers, 1000.0).unwrap();
        let behind = drivers[1].headway(5.0);
        assert!((common.slope(&drivers[1].law()) - drivers[1].slope(behind)).abs() < 1e-12);
        let free = drivers[0].slope(1000.0 - 9.0 * behind);
        let slope = common.slope(&drivers[0].law());
        assert!(free < 1e-60 && (slope / free - 1.0).abs() < 1e-8, "{slope} {free}");
    }

    /// Speed and slopes come from one solution; the speed is the one that a bisection over the speed itself finds, to a few
    /// units of the last place, which the sum of the headways cannot tell apart.
    #[test]
    fn the_speed_is_that_of_a_search_over_the_speed_itself() {
        use crate::numerics::random::{Generator, Stream};
        let mut worst = 0.0_f64;
        for seed in 0..200 {
            let mut draw = Generator::new(seed, Stream::Start);
            let driver = |draw: &mut Generator| Driver {
                sensitivity: 0.5 + 2.0 * draw.uniform(),
                max_speed: 20.0 + 20.0 * draw.uniform(),
                ..Driver::default()
            };
            let drivers: Vec<_> = (0..30).map(|_| driver(&mut draw)).collect();
            let length = 300.0 + 500.0 * draw.uniform();
            let slowest = drivers.iter().map(|d| d.max_speed).fold(f64::INFINITY, f64::min);
            let needed = |v: f64| drivers.iter().map(|d| d.headway(v)).sum::<f64>();
            let direct = last_bit(0.0, slowest, |v| needed(v) < length).0;
            let common = equilibrium(&drivers, length).unwrap().speed;
            worst = worst.max((common / direct - 1.0).abs());
        }
        println!("largest relative difference: {worst:e}");
        assert!(worst < 1e-14, "{worst:e}");
    }
}
