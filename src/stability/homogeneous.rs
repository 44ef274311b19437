//! A lane of homogeneous drivers: the closed forms.
//!
//! A small deviation of the positions, x_j ∝ e^{2πiqj/N + st} (j counted downstream), obeys
//! s = d_q·e^{−sΔ} with d_q = −c(1 − e^{2πiq/N}) = 2ic·sin a·e^{ia}, where a = πq/N and c is the slope of
//! speed against headway. Modes q and N − q are conjugate, so modes q = 1 … ⌊N/2⌋ are enough. The Euler steps of
//! a simulation obey (e^{s·dt} − 1)/dt = d_q·e^{−sΔ} instead, with Δ = m·dt: the same equation with another
//! symbol of the derivative, which [`Time`] gives.
//!
//! ```
//! use ringroad::stability::homogeneous::{HomogeneousRing, Time};
//!
//! let ring = HomogeneousRing { vehicles: 50, slope: 0.731_616 };
//! let critical = ring.critical(Time::Continuous);
//! // A little above it the longest wave grows; a little below, every wave fades.
//! assert!(ring.root(1, critical + 1e-6, Time::Continuous).re > 0.0);
//! assert!(ring.fastest(critical - 1e-6, Time::Continuous).unwrap().root.re < 0.0);
//! ```

use crate::numerics::bisection::Whole;
use crate::numerics::complex::{Complex64, exp, exp_m1, ln, norm};
use crate::numerics::lambert_w::lambert_w;
use std::f64::consts::PI;

/// Continuous time or steps: which of the two systems.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Time {
    /// The differential equation.
    Continuous,
    /// Euler steps of so many seconds: what a simulation does.
    Steps(f64),
}

impl Time {
    /// The symbol of the derivative, g(s): s, or (e^{s·dt} − 1)/dt; and its own derivative.
    pub(crate) fn derivative(self, s: Complex64) -> (Complex64, Complex64) {
        match self {
            Self::Continuous => (s, Complex64::ONE),
            Self::Steps(dt) => (exp_m1(s * dt) / dt, exp(s * dt)),
        }
    }
}

/// One mode with its dominant characteristic root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mode {
    /// q, the number of waves on the ring.
    pub mode: usize,
    /// s, 1/s: the growth rate, and the angular frequency of the headway of one vehicle. In steps, z = e^{s·dt}.
    pub root: Complex64,
}

/// A characteristic root on some branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root {
    /// k of W_k.
    pub branch: i32,
    /// s, 1/s.
    pub value: Complex64,
    /// |s − d_q·e^{−sΔ}|/max(1, |s|): what rounding leaves of the equation.
    pub residual: f64,
}

/// N homogeneous drivers in one lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HomogeneousRing {
    /// N.
    pub vehicles: usize,
    /// c = dv/dh in equilibrium, 1/s.
    pub slope: f64,
}

impl HomogeneousRing {
    /// The modes, 1 … ⌊N/2⌋.
    pub fn modes(&self) -> std::ops::RangeInclusive<usize> {
        1..=self.vehicles / 2
    }

    /// a = πq/N.
    pub fn half_angle(&self, q: usize) -> f64 {
        PI * q as f64 / self.vehicles as f64
    }

    /// d_q, the eigenvalue of the Jacobian, 1/s.
    pub fn eigenvalue(&self, q: usize) -> Complex64 {
        self.eigenvalue_at(self.half_angle(q))
    }

    fn eigenvalue_at(&self, a: f64) -> Complex64 {
        // 2ic·sin a·e^{ia}, exactly real at a = π/2.
        let (sine, cosine) = (libm::sin(a), if a == PI / 2.0 { 0.0 } else { libm::cos(a) });
        2.0 * self.slope * sine * Complex64::new(-sine, cosine)
    }

    /// Critical reaction time of a mode, s: a/(2c·sin a), or m*·dt with sin(a/(2m* + 1)) = dt·c·sin a. It is
    /// infinite in the jam (c = 0), and 0 where no delay is stable.
    pub fn critical_of(&self, q: usize, time: Time) -> f64 {
        if self.slope <= 0.0 {
            return f64::INFINITY;
        }
        let a = self.half_angle(q);
        match time {
            Time::Continuous => a / (2.0 * self.slope * libm::sin(a)),
            Time::Steps(dt) => {
                let sine = dt * self.slope * libm::sin(a);
                if sine >= 1.0 { 0.0 } else { (0.5 * dt * (a / libm::asin(sine) - 1.0)).max(0.0) }
            }
        }
    }

    /// Critical reaction time of the ring, s: that of mode 1, the smallest in continuous time as a/sin a rises, and
    /// in steps as arcsin(κ·sin a)/a falls for κ = dt·c < 1 (the arcsine is concave then); for κ ≥ 1 no
    /// delay is stable in any mode. Infinite for a vehicle alone, which has no modes.
    pub fn critical(&self, time: Time) -> f64 {
        if self.vehicles < 2 { f64::INFINITY } else { self.critical_of(1, time) }
    }

    /// Newell's limit, 1/(2c), s: the critical reaction time of an infinitely long wave.
    pub fn newell_limit(&self) -> f64 {
        if self.slope <= 0.0 { f64::INFINITY } else { 0.5 / self.slope }
    }

    /// The dominant characteristic root of a mode, 1/s, at a reaction time of `delay` seconds.
    pub fn root(&self, q: usize, delay: f64, time: Time) -> Complex64 {
        dominant_root(self.eigenvalue(q), delay, time)
    }

    /// The root on branch `k` at a reaction time of `delay` seconds, continuous time. Without a delay there is one root only,
    /// on branch 0.
    pub fn root_on(&self, q: usize, k: i32, delay: f64) -> Root {
        let d = self.eigenvalue(q);
        let value = if delay == 0.0 && k == 0 { d } else { lambert_w(k, d * delay) / delay };
        let residual = norm(value - d * exp(-value * delay)) / norm(value).max(1.0);
        Root { branch: k, value, residual }
    }

    /// The `count` leading roots of a mode in continuous time, by falling real part. The real parts fall with
    /// the distance of the branch from the principal one, so branches up to ±`count` hold them all.
    pub fn leading_roots(&self, q: usize, delay: f64, count: usize) -> Vec<Root> {
        if delay == 0.0 || self.slope <= 0.0 {
            return vec![self.root_on(q, 0, 0.0)];
        }
        let reach = count as i32;
        // The principal branch first, also where its root and that of branch −1 are conjugate.
        let mut roots = vec![self.root_on(q, 0, delay)];
        for k in (1..=reach).flat_map(|k| [-k, k]) {
            let root = self.root_on(q, k, delay);
            let place = roots[1..].partition_point(|r| r.value.re >= root.value.re);
            roots.insert(1 + place, root);
        }
        roots.truncate(count);
        roots
    }

    /// The fastest growing (or slowest fading) mode at a reaction time of `delay` seconds; none for a vehicle alone or in the
    /// jam, where no mode grows or fades.
    ///
    /// Over the modes the growth rate rises to one maximum and falls, or only falls. The maximum is found by bisection on the
    /// sign of the derivative by a, (g′/g + Δ)·ds/da = cot a + i. So a ring of a million vehicles costs hardly more than a ring
    /// of fifty. (A test compares with all modes, one by one.)
    pub fn fastest(&self, delay: f64, time: Time) -> Option<Mode> {
        if self.vehicles < 2 || self.slope <= 0.0 {
            return None;
        }
        let rises_at = |q: usize| {
            let a = self.half_angle(q);
            let s = dominant_root(self.eigenvalue_at(a), delay, time);
            let (g, slope) = time.derivative(s);
            (Complex64::new(libm::cos(a) / libm::sin(a), 1.0) / (slope / g + delay)).re > 0.0
        };
        let mode = |q: usize| Mode { mode: q, root: self.root(q, delay, time) };
        let last = self.vehicles / 2;
        if !rises_at(1) {
            return Some(mode(1));
        }
        // Beyond the last mode the rate counts as falling.
        let around = Whole::new(1, last + 1).until(rises_at);
        let below = mode(around.holds);
        if around.fails > last {
            return Some(below);
        }
        let above = mode(around.fails);
        Some(if above.root.re > below.root.re { above } else { below })
    }
}

/// The dominant solution of g(s) = d·e^{−sΔ} for an eigenvalue in the second quadrant.
///
/// With principal logarithms and 0 ≤ Im s·dt ≤ π it is the one solution of **ln g(s) + sΔ = ln d**: of all
/// solutions it has the largest real part. (For z = e^{s·dt}, |z|^m·|z − 1| is the same for all of them, so |z|
/// falls as the angle of z grows, and this equation gives the smallest angle. In continuous time it is the
/// principal branch of Lambert's W.) Newton's method starts from the continuous root at the delay Δ + dt/2, which is
/// right up to (s·dt)²/24.
pub(crate) fn dominant_root(d: Complex64, delay: f64, time: Time) -> Complex64 {
    if d == Complex64::ZERO {
        return d;
    }
    let continuous = |delay: f64| if delay == 0.0 { d } else { lambert_w(0, d * delay) / delay };
    match time {
        Time::Continuous => continuous(delay),
        Time::Steps(dt) if delay == 0.0 => crate::numerics::complex::ln_1p(d * dt) / dt,
        Time::Steps(dt) => {
            let start = continuous(delay + 0.5 * dt);
            newton(start, d, delay, dt).unwrap_or_else(|| follow_from_zero(d, delay, dt))
        }
    }
}

/// Newton's method on ln g(s) + sΔ = ln d; `None` where it does not end in the strip 0 ≤ Im s·dt ≤ π.
fn newton(start: Complex64, d: Complex64, delay: f64, dt: f64) -> Option<Complex64> {
    let time = Time::Steps(dt);
    let goal = ln(d);
    let mut s = start;
    let mut last = f64::INFINITY;
    for _ in 0..60 {
        let (g, slope) = time.derivative(s);
        let f = ln(g) + s * delay - goal;
        let step = f / (slope / g + delay);
        let size = norm(step);
        if !size.is_finite() {
            return None;
        }
        s -= step;
        // Done when the steps are as small as rounding makes them and no longer shrink.
        if size <= 1e-15 * norm(s) || (size <= 1e-11 * norm(s) && size >= 0.5 * last) {
            let turn = s.im * dt;
            let (g, _) = time.derivative(s);
            let solved = norm(ln(g) + s * delay - goal) < 1e-9;
            return (solved && (-1e-9..=PI + 1e-9).contains(&turn)).then_some(s);
        }
        last = size;
    }
    None
}

/// The same root for steps so long that Newton's method fails from the start above: followed from s = 0 while |d| grows
/// from 0 at a fixed argument of d (z starts at 1 and never meets another root in the upper half-plane).
fn follow_from_zero(d: Complex64, delay: f64, dt: f64) -> Complex64 {
    let mut share = 1e-3;
    let mut s = d * share;
    let mut ratio = 2.0;
    for _ in 0..10_000 {
        match newton(s, d * share, delay, dt) {
            Some(root) if share >= 1.0 => return root,
            Some(root) => s = root,
            None => {
                share /= ratio;
                ratio = libm::sqrt(ratio);
            }
        }
        share = (share * ratio).min(1.0);
    }
    Complex64::new(f64::NAN, f64::NAN)
}

#[cfg(test)]
#[path = "homogeneous_tests.rs"]
mod tests;
