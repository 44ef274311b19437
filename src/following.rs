//! Car following, all vehicles at once: perceived headways to speeds.
//!
//! # The gap factor
//!
//! v = max(V − V·y, 0) with the *gap factor* y = exp(−(λ/V)(h − d)). From one step to the next h moves by a little,
//! so y moves by a factor e^a with a small a = −(λ/V)·δh: |a| ≤ λ·dt for equal drivers. Where |a| ≤ 2⁻⁶ the factor is
//! multiplied by the Taylor polynomial of degree 6, whose remainder a⁷/7! is below 5·10⁻¹⁷ relative; where a is
//! larger (a nudge, a lane change, a large λ·dt) that vehicle's factor is evaluated in full. The choice is made
//! vehicle by vehicle, so that it does not depend on the width of the vectors.
//!
//! **Accuracy.** One multiplication by the polynomial rounds like y·(1 + ε) with |ε| under 5·10⁻¹⁶, the
//! rounding of a itself included; every [`REFRESH`] steps all factors are evaluated in full. So y stays within
//! 64·5·10⁻¹⁶ ≈ 3·10⁻¹⁴ of exp, for ever, over the whole range of the parameters, and v within V·y times that.
//! Arguments of the full evaluation are held to ±700: y then means "stand still" (e^700) or "as fast as possible"
//! (e^−700) and stays so through [`REFRESH`] steps of at most 2⁻⁶ each.

use crate::driver::Driver;
use crate::exp::exp_within;
use crate::history::LANE;

/// Steps between full evaluations of all factors.
pub const REFRESH: u64 = 64;

/// Largest |a| that the polynomial serves.
const SMALL: f64 = 1.0 / 64.0;

/// V, −λ/V and d of a vehicle's driver.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Law {
    max_speed: f64,
    rate: f64,
    min_headway: f64,
}

impl Law {
    fn of(driver: &Driver) -> Self {
        Self {
            max_speed: driver.max_speed,
            rate: -(driver.sensitivity / driver.max_speed),
            min_headway: driver.min_headway,
        }
    }
}

/// Perceived headways, gap factors and speeds of all vehicles; padded to whole vectors.
#[derive(Clone, Debug)]
pub struct Following {
    perceived: Vec<f64>,
    factor: Vec<f64>,
    speed: Vec<f64>,
    max_speed: Vec<f64>,
    rate: Vec<f64>,
    min_headway: Vec<f64>,
    /// The one law of all vehicles, if there is one: its constants then need not be read vehicle by vehicle.
    common: Option<Law>,
}

/// A new factor from the old one: by the polynomial, which is wrong where `a` is not small.
#[inline(always)]
fn moved(factor: f64, a: f64) -> f64 {
    let p = 1.0 + a * (1.0 / 6.0);
    let p = 1.0 + a * (p * 0.2);
    let p = 1.0 + a * (p * 0.25);
    let p = 1.0 + a * (p * (1.0 / 3.0));
    let p = 1.0 + a * (p * 0.5);
    let p = 1.0 + a * p;
    factor * p
}

#[inline(always)]
fn is_small(a: f64) -> bool {
    // False for NaN: a vehicle without a valid factor.
    a.abs() <= SMALL
}

impl Following {
    /// For these drivers; no factor is valid yet.
    pub fn new(drivers: &[Driver]) -> Self {
        let width = drivers.len().next_multiple_of(LANE);
        let mut following = Self {
            perceived: vec![f64::NAN; width],
            factor: vec![1.0; width],
            speed: vec![0.0; width],
            max_speed: vec![1.0; width],
            rate: vec![-1.0; width],
            min_headway: vec![1.0; width],
            common: None,
        };
        for (j, driver) in drivers.iter().enumerate() {
            following.write_law(j, Law::of(driver));
        }
        following.find_common_law(drivers);
        following
    }

    fn write_law(&mut self, j: usize, law: Law) {
        (self.max_speed[j], self.rate[j], self.min_headway[j]) = (law.max_speed, law.rate, law.min_headway);
    }

    /// Takes over the law of a driver that has changed; the vehicle's factor is no longer valid.
    pub fn set_driver(&mut self, j: usize, driver: &Driver) {
        self.write_law(j, Law::of(driver));
        self.invalidate(j);
    }

    /// To be called after [`Self::set_driver`], once for all that changed.
    pub fn find_common_law(&mut self, drivers: &[Driver]) {
        let first = Law::of(&drivers[0]);
        self.common = drivers.iter().all(|d| Law::of(d) == first).then_some(first);
    }

    /// Has the vehicle's factor evaluated in full next time.
    pub fn invalidate(&mut self, j: usize) {
        self.perceived[j] = f64::NAN;
    }

    /// Perceived headways, m (padded).
    pub fn perceived(&self) -> &[f64] {
        &self.perceived
    }

    /// Speeds, m/s (padded).
    pub fn speeds(&self) -> &[f64] {
        &self.speed
    }

    /// Overrules the law: a braked vehicle.
    pub fn set_speed(&mut self, j: usize, speed: f64) {
        self.speed[j] = speed;
    }

    /// New speeds for the perceived headways `scene` (m, padded); all factors in full where `refresh` says so.
    pub fn respond(&mut self, scene: &[f64], refresh: bool) {
        match (self.common, refresh) {
            (Some(law), false) => self.respond_with(scene, |_| law, is_small),
            (Some(law), true) => self.respond_with(scene, |_| law, |_| false),
            (None, _) => self.respond_mixed(scene, refresh),
        }
    }

    fn respond_mixed(&mut self, scene: &[f64], refresh: bool) {
        let (max_speed, rate, min_headway) = (
            std::mem::take(&mut self.max_speed),
            std::mem::take(&mut self.rate),
            std::mem::take(&mut self.min_headway),
        );
        let law = |j| Law { max_speed: max_speed[j], rate: rate[j], min_headway: min_headway[j] };
        if refresh {
            self.respond_with(scene, law, |_| false);
        } else {
            self.respond_with(scene, law, is_small);
        }
        (self.max_speed, self.rate, self.min_headway) = (max_speed, rate, min_headway);
    }

    #[inline(always)]
    fn respond_with(&mut self, scene: &[f64], law: impl Fn(usize) -> Law, small: impl Fn(f64) -> bool) {
        for start in (0..scene.len()).step_by(LANE) {
            let end = start + LANE;
            let (scene, perceived) = (&scene[start..end], &mut self.perceived[start..end]);
            let (factor, speed) = (&mut self.factor[start..end], &mut self.speed[start..end]);
            let mut next = [0.0; LANE];
            let mut all_small = true;
            for j in 0..LANE {
                let a = law(start + j).rate * (scene[j] - perceived[j]);
                next[j] = moved(factor[j], a);
                all_small &= small(a);
            }
            if !all_small {
                for j in 0..LANE {
                    let law = law(start + j);
                    let a = law.rate * (scene[j] - perceived[j]);
                    let full = exp_within(law.rate * (scene[j] - law.min_headway));
                    next[j] = if small(a) { next[j] } else { full };
                }
            }
            for j in 0..LANE {
                let max_speed = law(start + j).max_speed;
                let v = max_speed - max_speed * next[j];
                speed[j] = if v > 0.0 { v } else { 0.0 };
                factor[j] = next[j];
                perceived[j] = scene[j];
            }
        }
    }

    /// The same for one vehicle whose scene has changed within a step.
    pub fn respond_one(&mut self, j: usize, scene: f64) {
        let (max_speed, rate) = (self.max_speed[j], self.rate[j]);
        let a = rate * (scene - self.perceived[j]);
        let factor = if is_small(a) {
            moved(self.factor[j], a)
        } else {
            exp_within(rate * (scene - self.min_headway[j]))
        };
        let v = max_speed - max_speed * factor;
        self.speed[j] = if v > 0.0 { v } else { 0.0 };
        self.factor[j] = factor;
        self.perceived[j] = scene;
    }
}
