//! Heterogeneous drivers: roots and critical reaction times of the exact characteristic equation.
//!
//! Once round the ring, a deviation e^{st} must return to itself: **Π_j u_j = 1, u_j = 1 + g(s)·e^{sΔ_j}/c_j**, with
//! g(s) = s in continuous time and (e^{s·dt} − 1)/dt in steps ([`Time`]). In logarithms, mode q is the solution of
//!
//! Σ_j ln u_j = 2πiq,
//!
//! each logarithm continued from that of homogeneous drivers, where every u_j = e^{2πiq/N}. So a root keeps the number of its
//! mode while slopes and delays change gradually from equal ones to the real ones. This change is made in steps of the
//! parameter σ from 0 to 1: the tangent predicts the root, Newton's method corrects it, and a step that needs more than a few
//! corrections is tried again at half the length. Where two roots meet between (u = 0, or the derivative of the sum is 0),
//! Newton's method fails for real σ; then σ takes a path through complex numbers, around the meeting.
//!
//! This method cannot show that no root was lost. So [`DriverClasses::unstable_roots`] counts the roots with Re s > 0 by the
//! argument principle.
//!
//! ```
//! use ringroad::stability::driver_classes::DriverClasses;
//! use ringroad::stability::homogeneous::Time;
//!
//! // Fifty drivers with the slope 0.731616 /s; some without delay, the others with 0.75 s.
//! let with = |quick: usize| {
//!     DriverClasses::new((0..50).map(|j| (0.731_616, if j < quick { 0.0 } else { 0.75 })))
//! };
//! let time = Time::Steps(0.01);
//! assert!(with(4).fastest(time).unwrap().root.re > 0.0);
//! assert!(with(5).fastest(time).unwrap().root.re < 0.0);
//! assert_eq!(with(5).unstable_roots(time), Some(0));
//! ```

use super::driver_classes::{DriverClass, DriverClasses};
use super::homogeneous::{HomogeneousRing, Mode, Time, dominant_root};
use crate::numerics::bisection::{Whole, last_bit};
use crate::numerics::complex::{Complex64, arg, exp, exp_m1, ln, ln_1p, norm};
use crate::numerics::lambert_w::lambert_w;
use std::f64::consts::PI;

/// Beyond this real part of ln x, 1 + x is x to the last bit.
const LARGE: f64 = 40.0;

/// A driver class as a function of σ, from the mean driver (σ = 0) to the class itself (σ = 1): ln(1/c) and the delay as a
/// share of the mean delay change linearly.
#[derive(Clone, Copy, Debug)]
struct Path {
    count: f64,
    log_start: f64,
    log_change: f64,
    share_change: f64,
}

/// A root at some σ; the delays are τ times their shares.
#[derive(Clone, Copy, Debug)]
struct Place {
    s: Complex64,
    tau: f64,
    sigma: Complex64,
}

/// Σ ln u_j − 2πiq at a place, with its derivatives.
#[derive(Clone, Copy, Debug)]
struct Sum {
    value: Complex64,
    by_s: Complex64,
    by_tau: Complex64,
    by_sigma: Complex64,
}

/// What is solved for: the root at given delays, or frequency and mean delay of a root on the imaginary axis.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Unknown {
    Root,
    Crossing,
}

/// A mode that is followed from σ = 0 to 1. `turns` are the continued arguments of the u_j.
#[derive(Clone, Debug)]
struct Continuation<'a> {
    paths: &'a [Path],
    time: Time,
    goal: f64,
    unknown: Unknown,
    place: Place,
    turns: Vec<f64>,
}

impl Continuation<'_> {
    /// Evaluates the sum at a place. The arguments of the u_j are taken nearest to `turns`, and written there.
    fn sum(&self, place: Place, turns: &mut [f64]) -> Sum {
        let (g, slope) = self.time.derivative(place.s);
        let log_g = ln(g);
        let zero = Complex64::ZERO;
        let mut sum =
            Sum { value: Complex64::new(0.0, -self.goal), by_s: zero, by_tau: zero, by_sigma: zero };
        for (path, turn) in self.paths.iter().zip(turns) {
            let log_inverse = path.log_start + place.sigma * path.log_change;
            let share = 1.0 + place.sigma * path.share_change;
            let log_y = log_inverse + place.s * place.tau * share;
            let large = log_y.re + log_g.re > LARGE;
            // x = u − 1, and x/u.
            let (log_u, part, part_by_s) = if large {
                (log_y + log_g, Complex64::ONE, slope / g + place.tau * share)
            } else {
                let y = exp(log_y);
                let x = g * y;
                let u = 1.0 + x;
                (ln_1p(x), x / u, y * (slope + g * place.tau * share) / u)
            };
            let turned = log_u.im + 2.0 * PI * ((*turn - log_u.im) / (2.0 * PI)).round();
            *turn = turned;
            sum.value += path.count * Complex64::new(log_u.re, turned);
            sum.by_s += path.count * part_by_s;
            sum.by_tau += path.count * part * place.s * share;
            sum.by_sigma += path.count * part * (path.log_change + place.s * place.tau * path.share_change);
        }
        sum
    }

    /// The change of the unknowns that changes the sum by `−by`.
    fn step(&self, sum: &Sum, by: Complex64) -> (Complex64, f64) {
        match self.unknown {
            Unknown::Root => (-by / sum.by_s, 0.0),
            Unknown::Crossing => {
                // i·by_s·dω + by_tau·dτ = −by, for real dω and dτ.
                let a = Complex64::new(-sum.by_s.im, sum.by_s.re);
                let b = sum.by_tau;
                let determinant = a.re * b.im - a.im * b.re;
                let frequency = (-by.re * b.im + by.im * b.re) / determinant;
                let tau = (-a.re * by.im + a.im * by.re) / determinant;
                (Complex64::new(0.0, frequency), tau)
            }
        }
    }

    /// Newton's method at the σ of `place`, changing `place` and `turns`; whether it converged in `most` steps.
    fn correct(&self, place: &mut Place, turns: &mut [f64], most: usize) -> bool {
        let mut last = f64::INFINITY;
        for _ in 0..most {
            let sum = self.sum(*place, turns);
            let (s, tau) = self.step(&sum, sum.value);
            place.s += s;
            place.tau += tau;
            let size = norm(s) / norm(place.s) + (tau / place.tau.abs().max(1e-300)).abs();
            if !size.is_finite() {
                return false;
            }
            if size < 4e-15 || (size < 1e-12 && size > 0.25 * last) {
                return true;
            }
            last = size;
        }
        false
    }

    /// Follows the mode from σ = 0 to 1, along a path that `detour` bends into the complex plane; `None` where the path ends
    /// at a meeting of roots.
    fn follow(mut self, detour: f64) -> Option<Place> {
        let (mut place, mut turns) = (self.place, self.turns.clone());
        if !self.correct(&mut place, &mut turns, 30) {
            return None;
        }
        (self.place, self.turns) = (place, turns);
        let at = |share: f64| Complex64::new(share, detour * share * (1.0 - share));
        let (mut share, mut length) = (0.0, 0.25);
        for _ in 0..2000 {
            let next = f64::min(share + length, 1.0);
            let mut turns = self.turns.clone();
            let sum = self.sum(self.place, &mut turns);
            let sigma = at(next);
            let (s, tau) = self.step(&sum, sum.by_sigma * (sigma - self.place.sigma));
            let predicted = Place { s: self.place.s + s, tau: self.place.tau + tau, sigma };
            let mut place = predicted;
            let gentle = norm(s) < 0.3 * norm(self.place.s);
            if gentle
                && self.correct(&mut place, &mut turns, 6)
                && norm(place.s - predicted.s) < 0.1 * norm(self.place.s)
                && turns.iter().zip(&self.turns).all(|(a, b)| (a - b).abs() < 0.5)
            {
                (share, self.place, self.turns) = (next, place, turns);
                if share >= 1.0 {
                    return Some(place);
                }
                length *= 2.0;
            } else {
                length *= 0.5;
                if length < 1e-7 {
                    return None;
                }
            }
        }
        None
    }
}

/// All roots that were followed, and the count that shows whether growing ones are missing.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Followed {
    /// Mode by mode, in order of q.
    pub modes: Vec<Mode>,
    /// Roots with Re s > 0 among them, conjugates counted.
    pub unstable: usize,
    /// Roots with Re s > 0 by the argument principle; `None` where it was not computed: on rings too large for it, where a
    /// root lies on the imaginary axis, or with very long steps.
    pub counted: Option<usize>,
}

impl Followed {
    /// The fastest growing, or slowest fading, mode.
    pub fn fastest(&self) -> Option<Mode> {
        self.modes.iter().copied().max_by(|a, b| a.root.re.total_cmp(&b.root.re))
    }
}

/// In rings of more vehicles only some modes are followed, and unstable roots are not counted.
pub const ALL_MODES: usize = 1000;

impl DriverClasses {
    /// The paths of all classes, the slope (1/s) of the mean driver, and the mean delay (s). Slopes are held above 1e-300, so
    /// that their logarithms exist.
    fn paths(&self) -> (Vec<Path>, f64, f64) {
        let n = self.vehicles() as f64;
        let log = |slope: f64| -libm::log(slope.max(1e-300));
        let mean_log =
            self.classes().iter().map(|class| class.count as f64 * log(class.slope)).sum::<f64>() / n;
        let tau = self.mean_delay();
        let path = |class: &DriverClass| Path {
            count: class.count as f64,
            log_start: mean_log,
            log_change: log(class.slope) - mean_log,
            share_change: if tau > 0.0 { class.delay / tau - 1.0 } else { 0.0 },
        };
        (self.classes().iter().map(path).collect(), crate::numerics::exp::exp(-mean_log), tau)
    }

    /// |Π u_j − 1| at s, as the distance of s from where it vanishes, 1/s.
    pub fn residual(&self, s: Complex64, time: Time) -> f64 {
        let (g, slope) = time.derivative(s);
        let (mut sum, mut by_s) = (Complex64::ZERO, Complex64::ZERO);
        for class in self.classes() {
            let (n, y) = (class.count as f64, exp(s * class.delay) / class.slope);
            sum += n * ln_1p(g * y);
            by_s += n * y * (slope + g * class.delay) / (1.0 + g * y);
        }
        norm(exp_m1(sum) / by_s)
    }

    /// The root (1/s) of mode q, followed from branch k of homogeneous drivers. `None` where it could not be followed, or
    /// where no root is on that branch (several branches exist only where there is a delay).
    pub fn follow(&self, q: usize, k: i32, time: Time) -> Option<Complex64> {
        let (paths, slope, tau) = self.paths();
        self.follow_along(&paths, slope, tau, q, k, time)
    }

    fn follow_along(
        &self,
        paths: &[Path],
        slope: f64,
        tau: f64,
        q: usize,
        k: i32,
        time: Time,
    ) -> Option<Complex64> {
        let mean = HomogeneousRing { vehicles: self.vehicles(), slope };
        let d = mean.eigenvalue(q);
        let start = if k == 0 {
            dominant_root(d, tau, time)
        } else if tau == 0.0 {
            return None;
        } else {
            let delay = if let Time::Steps(dt) = time { tau + 0.5 * dt } else { tau };
            lambert_w(k, d * delay) / delay
        };
        let goal = 2.0 * PI * q as f64;
        let continuation = Continuation {
            paths,
            time,
            goal,
            unknown: Unknown::Root,
            place: Place { s: start, tau, sigma: Complex64::ZERO },
            turns: vec![goal / self.vehicles() as f64; paths.len()],
        };
        let mut detours = [0.0, 0.5, -0.5, 1.5].into_iter();
        detours.find_map(|detour| continuation.clone().follow(detour)).map(|place| place.s)
    }

    /// The dominant root of every mode, and the count of unstable roots, which shows whether one is missing. In rings of more
    /// than [`ALL_MODES`] vehicles: of modes 1 … 100, of some others, and of those around the fastest.
    pub fn followed(&self, time: Time) -> Followed {
        let (paths, slope, tau) = self.paths();
        let last = self.vehicles() / 2;
        let root = |q: usize, k: i32| self.follow_along(&paths, slope, tau, q, k, time);
        let mut modes = Vec::new();
        if self.is_jammed() || last == 0 {
            return Followed { modes, unstable: 0, counted: Some(0) };
        }
        let follow = |q: usize| root(q, 0).map(|root| Mode { mode: q, root });
        if self.vehicles() > ALL_MODES {
            modes.extend(some_modes(last).filter_map(follow));
            refine_around_fastest(&mut modes, last, follow);
            let unstable = unstable_among(&modes);
            return Followed { modes, unstable, counted: None };
        }
        modes.extend((1..=last).filter_map(follow));
        let counted = self.unstable_roots(time);
        let mut unstable = unstable_among(&modes);
        // A root from another branch of homogeneous drivers may have a larger real part by now.
        for k in [-1, 1, -2, 2, -3, 3] {
            if counted.is_none_or(|counted| counted <= unstable) {
                break;
            }
            for q in 1..=last {
                if let Some(s) = root(q, k)
                    && s.re > 0.0
                    && !modes.iter().any(|m| same(m.root, s))
                {
                    insert(&mut modes, Mode { mode: q, root: s });
                }
            }
            unstable = unstable_among(&modes);
        }
        Followed { modes, unstable, counted }
    }

    /// The fastest growing (or slowest fading) mode; of homogeneous drivers by the closed form.
    pub fn fastest(&self, time: Time) -> Option<Mode> {
        match self.homogeneous() {
            Some((ring, delay)) => ring.fastest(delay, time),
            None => self.followed(time).fastest(),
        }
    }

    /// The mean delay (s) at which the ring becomes unstable when all delays change in proportion (when all are 0:
    /// when all grow alike). For homogeneous drivers it is their critical reaction time. Infinite in the jam and for
    /// a vehicle alone, 0 where no delay is stable.
    ///
    /// Each mode's crossing of the imaginary axis is followed from homogeneous drivers, and the smallest is taken. A root
    /// from another branch may cross earlier: the count of unstable roots just below the smallest shows it, and then the
    /// threshold is found by bisection on the count. In rings of more than [`ALL_MODES`] vehicles only some modes are
    /// followed and nothing is counted: the smallest is then right to some 10⁻⁴ of its value.
    pub fn critical(&self, time: Time) -> f64 {
        if let Some((ring, _)) = self.homogeneous() {
            return ring.critical(time);
        }
        if self.vehicles() < 2 || self.is_jammed() {
            return f64::INFINITY;
        }
        let count_at = |tau: f64| self.at_mean_delay(tau).unstable_roots(time);
        let counts = self.vehicles() <= ALL_MODES;
        if counts && count_at(0.0).is_some_and(|count| count > 0) {
            return 0.0;
        }
        let last = self.vehicles() / 2;
        let candidates = some_modes(last).filter_map(|q| self.crossing(q, time));
        let smallest = candidates.filter(|tau| *tau > 0.0).fold(f64::INFINITY, f64::min);
        let below = smallest * (1.0 - 1e-7);
        if !counts || !smallest.is_finite() || count_at(below).is_none_or(|count| count == 0) {
            return smallest;
        }
        last_bit(0.0, below, |tau| count_at(tau).is_none_or(|count| count == 0)).1
    }

    /// The same drivers with all delays in proportion, so that their mean is `tau` seconds; all equal where they were 0.
    #[must_use]
    pub fn at_mean_delay(&self, tau: f64) -> Self {
        let mean = self.mean_delay();
        self.with_delays(|delay| if mean > 0.0 { delay / mean * tau } else { tau })
    }

    /// Mean delay (s) at which the root of mode q crosses the imaginary axis.
    fn crossing(&self, q: usize, time: Time) -> Option<f64> {
        let (paths, slope, _) = self.paths();
        let mean = HomogeneousRing { vehicles: self.vehicles(), slope };
        let tau = mean.critical_of(q, time);
        if tau <= 0.0 || !tau.is_finite() {
            return None;
        }
        let a = mean.half_angle(q);
        let sine = slope * libm::sin(a);
        let frequency = match time {
            Time::Continuous => 2.0 * sine,
            Time::Steps(dt) => 2.0 * libm::asin(dt * sine) / dt,
        };
        let goal = 2.0 * PI * q as f64;
        let continuation = Continuation {
            paths: &paths,
            time,
            goal,
            unknown: Unknown::Crossing,
            place: Place { s: Complex64::new(0.0, frequency), tau, sigma: Complex64::ZERO },
            turns: vec![goal / self.vehicles() as f64; paths.len()],
        };
        // A crossing has real unknowns, so σ must stay real.
        continuation.follow(0.0).map(|place| place.tau)
    }

    /// The number of characteristic roots with Re s > 0 (|z| > 1 in steps), by the argument principle; `None`
    /// where one is on the imaginary axis to within rounding, or where the steps are so long that the contour would
    /// leave the strip |Im s|·dt < π.
    ///
    /// With H(s) = (Π u_j − 1)/g(s), which has no root s = 0 (a shift of all vehicles), the argument of H is
    /// followed from 0 up the imaginary axis to iR and back along an arc to R; by symmetry it changes by −π for
    /// every root in the half-disc. All of them are in it: for |g| > 2·max c every |u_j| > 1.
    pub fn unstable_roots(&self, time: Time) -> Option<usize> {
        if self.is_jammed() || self.vehicles() < 2 {
            return Some(0);
        }
        let largest = self.classes().last().map_or(0.0, |class| class.slope);
        // |g(s)| ≥ (2/π)|s| in the strip.
        let radius = match time {
            Time::Continuous => 3.0 * largest,
            Time::Steps(_) => 3.5 * largest,
        };
        if let Time::Steps(dt) = time
            && radius * dt > 3.0
        {
            return None;
        }
        let up =
            self.change_of_argument(time, |x| (Complex64::new(0.0, x), Complex64::new(0.0, 1.0)), radius)?;
        let arc = |x: f64| {
            let angle = 0.5 * PI - x;
            let s = Complex64::new(radius * libm::cos(angle), radius * libm::sin(angle));
            (s, Complex64::new(s.im, -s.re))
        };
        let along = self.change_of_argument(time, arc, 0.5 * PI)?;
        let turns = -(up + along) / PI;
        let count = turns.round();
        ((turns - count).abs() < 0.1 && count >= 0.0).then_some(count as usize)
    }

    /// Change of arg H along a curve s(x), 0 ≤ x ≤ `end`, given with its derivative.
    fn change_of_argument(
        &self,
        time: Time,
        curve: impl Fn(f64) -> (Complex64, Complex64),
        end: f64,
    ) -> Option<f64> {
        let at = |x: f64| {
            let (s, direction) = curve(x);
            let (angle, logarithmic) = self.logarithmic_derivative(time, s);
            (angle, norm(logarithmic * direction))
        };
        // H is real and regular at s = 0, where the curve may start.
        let mut x = 0.0;
        let (mut angle, mut rate) = at(1e-9 * end);
        let mut total = angle;
        if curve(0.0).0 != Complex64::ZERO {
            total = 0.0;
        }
        let mut length = 1e-3 * end;
        while x < end {
            length = f64::min(length, 0.5 / rate);
            // Also where the rate is infinite or not a number: then a root is on the curve.
            if length.is_nan() || length < 1e-13 * end {
                return None;
            }
            let next = f64::min(x + length, end);
            let (new_angle, new_rate) = at(next);
            let mut change = new_angle - angle;
            change -= 2.0 * PI * (change / (2.0 * PI)).round();
            if new_rate * (next - x) < 1.5 && change.abs() < 1.5 {
                total += change;
                (x, angle, rate) = (next, new_angle, new_rate);
                length *= 2.0;
            } else {
                length *= 0.5;
            }
        }
        Some(total)
    }

    /// arg H(s) up to whole turns, and H′/H.
    fn logarithmic_derivative(&self, time: Time, s: Complex64) -> (f64, Complex64) {
        let (g, slope) = time.derivative(s);
        let log_g = ln(g);
        let (mut sum, mut by_s) = (Complex64::ZERO, Complex64::ZERO);
        for class in self.classes() {
            let inverse = 1.0 / class.slope.max(1e-300);
            let log_y = s * class.delay;
            let n = class.count as f64;
            if log_y.re + log_g.re + libm::log(inverse) > LARGE {
                sum += n * (log_y + log_g + libm::log(inverse));
                by_s += n * (slope / g + class.delay);
            } else {
                let y = exp(log_y) * inverse;
                let x = g * y;
                sum += n * ln_1p(x);
                by_s += n * y * (slope + g * class.delay) / (1.0 + x);
            }
        }
        // P − 1 and P/(P − 1) without overflow.
        let (angle, ratio) = if sum.re > LARGE {
            (sum.im, Complex64::ONE)
        } else {
            let less = exp_m1(sum);
            (arg(less), (less + 1.0) / less)
        };
        (angle - log_g.im, by_s * ratio - slope / g)
    }
}

/// Modes to follow: all of a small ring; of a large one 1 … 100, then in steps of 2 %.
fn some_modes(last: usize) -> impl Iterator<Item = usize> {
    let next = move |q: &usize| if last <= ALL_MODES / 2 { q + 1 } else { q + (q / 50).max(1) };
    std::iter::successors(Some(1), move |q| Some(next(q))).take_while(move |q| *q <= last)
}

/// Adds modes around the fastest until both neighbours of the fastest are among them.
fn refine_around_fastest(modes: &mut Vec<Mode>, last: usize, follow: impl Fn(usize) -> Option<Mode>) {
    let rates = modes.iter().enumerate();
    let Some((place, _)) = rates.max_by(|a, b| a.1.root.re.total_cmp(&b.1.root.re)) else {
        return;
    };
    let low = if place == 0 { 1 } else { modes[place - 1].mode };
    let high = modes.get(place + 1).map_or(last, |m| m.mode);
    // Between these neighbours the growth rate has one maximum: it rises from a mode to the next one, then falls.
    let mut rises = Whole::new(low, high.saturating_sub(1));
    while let Some(middle) = rises.middle() {
        let (Some(a), Some(b)) = (follow(middle), follow(middle + 1)) else { return };
        rises.narrow(middle, a.root.re < b.root.re);
        for mode in [a, b] {
            if modes.binary_search_by_key(&mode.mode, |m| m.mode).is_err() {
                insert(modes, mode);
            }
        }
    }
}

/// Inserts a mode in order of q, after others of the same q.
fn insert(modes: &mut Vec<Mode>, mode: Mode) {
    modes.insert(modes.partition_point(|m| m.mode <= mode.mode), mode);
}

fn same(a: Complex64, b: Complex64) -> bool {
    let tolerance = 1e-7 * norm(a).max(1e-6);
    norm(a - b) < tolerance || norm(a - b.conj()) < tolerance
}

/// Roots with Re s > 0, each counted with its conjugate.
fn unstable_among(modes: &[Mode]) -> usize {
    let growing = modes.iter().filter(|m| m.root.re > 0.0);
    growing.map(|m| if m.root.im.abs() > 1e-9 * norm(m.root) { 2 } else { 1 }).sum()
}

#[cfg(test)]
#[path = "heterogeneous_tests.rs"]
mod tests;
