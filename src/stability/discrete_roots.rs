//! The growth factors of a simulation: all solutions z = e^{s·dt} of its difference equation **z^m·(z − 1) = w**,
//! w = dt·d_q, for a delay of m whole steps.
//!
//! With z = r·e^{iθ} and z − 1 = ρ·e^{iψ}, root number k is the one whose turns add up to mθ + ψ = arg w + 2πk. There are
//! m + 1 numbers for which that is possible, |arg w + 2πk| ≤ (m + 1)π, and as many roots: one each. Given θ, the
//! triangle 0, 1, z gives r = sin ψ/sin(ψ − θ) and ρ = sin θ/sin(ψ − θ); what is left, m·ln r + ln ρ = ln|w|, is
//! solved by bisection between the ends of the interval in which the triangle exists, where the left side goes to ∓∞. Only where
//! w is negative can roots be real; those are found on the axis.
//!
//! ```
//! use ringroad::stability::homogeneous::HomogeneousRing;
//!
//! let ring = HomogeneousRing { vehicles: 50, slope: 0.731_616 };
//! // A delay of 75 steps of 0.01 s: the polynomial has degree 76, and so many roots.
//! let roots = ring.leading_factors(8, 75, 0.01, 100);
//! assert_eq!(roots.len(), 76);
//! assert!(roots.iter().all(|root| root.residual < 1e-10));
//! assert!(roots[0].real_per_s > 0.0 && roots[1].real_per_s < 0.0);
//! ```

use super::homogeneous::{HomogeneousRing, Time};
use crate::numerics::bisection::last_bit;
use crate::numerics::complex::{Complex64, arg, exp, ln, norm};
use serde::Serialize;
use std::f64::consts::PI;

/// A root of a mode in the steps of a simulation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct DiscreteRoot {
    /// q.
    pub mode: usize,
    /// k; of heterogeneous drivers, that of the root of homogeneous drivers from which it was followed.
    pub branch: i32,
    /// Re z.
    pub factor_real: f64,
    /// Im z.
    pub factor_imaginary: f64,
    /// ln|z|/dt, 1/s.
    pub real_per_s: f64,
    /// arg z/dt, 1/s.
    pub imaginary_per_s: f64,
    /// What rounding leaves of the equation (z − 1)/dt = d_q·z^−m, relative to max(1, |s|); of heterogeneous drivers, as
    /// a change of the root.
    pub residual: f64,
}

impl DiscreteRoot {
    /// The root s (1/s) in steps of `time_step` seconds.
    pub fn new(mode: usize, branch: i32, s: Complex64, time_step: f64, residual: f64) -> Self {
        let z = exp(s * time_step);
        Self {
            mode,
            branch,
            factor_real: z.re,
            factor_imaginary: z.im,
            real_per_s: s.re,
            imaginary_per_s: s.im,
            residual,
        }
    }
}

impl HomogeneousRing {
    /// The `count` leading roots of a mode, all of them where there are fewer, for a delay of m steps of `time_step`
    /// seconds, by falling |z|. As |k| grows, the argument of z grows and |z| falls, so the numbers up to ±`count` hold
    /// them all.
    pub fn leading_factors(
        &self,
        q: usize,
        delay_steps: u64,
        time_step: f64,
        count: usize,
    ) -> Vec<DiscreteRoot> {
        let (d, m) = (self.eigenvalue(q), delay_steps as f64);
        if d == Complex64::ZERO {
            return vec![DiscreteRoot::new(q, 0, d, time_step, 0.0)];
        }
        let reach = count as i32;
        let mut roots: Vec<_> = (-reach..=reach)
            .filter_map(|k| {
                let s = if k == 0 {
                    self.root(q, m * time_step, Time::Steps(time_step))
                } else {
                    ln(factor(d * time_step, m, k)?) / time_step
                };
                let z = exp(s * time_step);
                let rest = (z - 1.0) / time_step - d * exp(-m * time_step * s);
                Some(DiscreteRoot::new(q, k, s, time_step, norm(rest) / norm(s).max(1.0)))
            })
            .collect();
        roots.sort_by(|a, b| b.real_per_s.total_cmp(&a.real_per_s));
        roots.truncate(count);
        roots
    }
}

/// Root number k of z^m·(z − 1) = w; `None` where there is no such root.
fn factor(w: Complex64, m: f64, k: i32) -> Option<Complex64> {
    let (size, turn) = (norm(w), arg(w) + 2.0 * PI * f64::from(k));
    let most = (m + 1.0) * PI;
    if turn.abs() > most + 1e-9 || (m == 0.0 && k != 0) {
        return None;
    }
    if m == 0.0 {
        return Some(1.0 + w);
    }
    if most - turn.abs() <= 1e-9 {
        // Both ends are the same root, on the negative axis.
        return (turn > 0.0)
            .then(|| Complex64::new(-rising(|r| power(r, m) * (1.0 + r), size, 0.0, size + 1.0), 0.0));
    }
    let meeting = m / (m + 1.0);
    if arg(w) == PI && (k == 0 || k == -1) && size <= power(meeting, m) / (m + 1.0) {
        let at = |r: f64| power(r, m) * (1.0 - r);
        let r = if k == 0 { rising(|r| -at(r), -size, meeting, 1.0) } else { rising(at, size, 0.0, meeting) };
        return Some(Complex64::new(r, 0.0));
    }
    let up = turn.abs();
    let triangle = |theta: f64| {
        let psi = up - m * theta;
        let third = libm::sin(psi - theta);
        (libm::sin(psi) / third, libm::sin(theta) / third)
    };
    let left = |theta: f64| {
        let (r, rho) = triangle(theta);
        m * libm::log(r) + libm::log(rho)
    };
    let theta = rising(left, libm::log(size), ((up - PI) / m).max(0.0), up / (m + 1.0));
    let (r, _) = triangle(theta);
    let mut z = Complex64::new(r * libm::cos(theta), r * libm::sin(theta));
    if turn < 0.0 {
        z = z.conj();
    }
    // Small angles have lost digits: Newton's method on the logarithm restores them.
    for _ in 0..3 {
        let mut rest = m * ln(z) + ln(z - 1.0) - ln(w);
        rest.im -= 2.0 * PI * (rest.im / (2.0 * PI)).round();
        z -= rest / (m / z + 1.0 / (z - 1.0));
    }
    Some(z)
}

fn power(r: f64, m: f64) -> f64 {
    crate::numerics::exp::exp(m * libm::log(r))
}

/// Where a rising function has a value, between `low` and `high`.
fn rising(f: impl Fn(f64) -> f64, value: f64, low: f64, high: f64) -> f64 {
    let (below, above) = last_bit(low, high, |x| f(x) < value);
    0.5 * (below + above)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// There are as many roots as the polynomial z^{m+1} − z^m − w has, all different, and each solves it. Their sum is 1
    /// (1 + w without a delay) and their product ±w, so none is missing.
    #[test]
    fn all_roots_of_the_polynomial() {
        let (mut real, mut modes) = (0, 0);
        for (vehicles, slope) in [(50, 0.73), (13, 1.0), (2, 0.9), (3, 3.0)] {
            for m in [0, 1, 2, 3, 10, 75, 76] {
                for time_step in [0.01, 0.1, 0.5] {
                    let ring = HomogeneousRing { vehicles, slope };
                    for q in ring.modes() {
                        let roots = ring.leading_factors(q, m, time_step, 200);
                        let place = format!("N = {vehicles}, mode {q}, {m} steps of {time_step} s");
                        assert_eq!(roots.len() as u64, m + 1, "{place}");
                        let w = ring.eigenvalue(q) * time_step;
                        let z = |f: &DiscreteRoot| Complex64::new(f.factor_real, f.factor_imaginary);
                        let (mut sum, mut product) = (Complex64::ZERO, Complex64::ONE);
                        for (k, root) in roots.iter().enumerate() {
                            assert!(root.residual < 1e-10, "{place}: {root:?}");
                            assert!(
                                roots[..k].iter().all(|other| norm(z(other) - z(root)) > 1e-6),
                                "{place}"
                            );
                            sum += z(root);
                            product *= z(root);
                        }
                        let should = if m == 0 { 1.0 + w } else { Complex64::ONE };
                        let sign = if m % 2 == 0 { 1.0 } else { -1.0 };
                        let product_should = if m == 0 { should } else { sign * w };
                        assert!(norm(sum - should) < 1e-9, "{place}: sum {sum}");
                        assert!(norm(product - product_should) < 1e-9, "{place}: product {product}");
                        real += usize::from(roots.iter().any(|r| r.factor_imaginary.abs() < 1e-12));
                        modes += 1;
                        // The leading roots are the same when fewer are asked for.
                        for (leading, root) in ring.leading_factors(q, m, time_step, 5).iter().zip(&roots) {
                            assert!((leading.real_per_s - root.real_per_s).abs() < 1e-9, "{place}");
                        }
                    }
                }
            }
        }
        println!("{modes} modes, {real} of them with real roots");
        assert!(real > 20);
    }
}
