//! The Lambert W function of a complex argument, on every branch: the solutions w of w·e^w = z.
//!
//! Branches are numbered and cut as by Corless, Gonnet, Hare, Jeffrey and Knuth, *On the Lambert W function*
//! (1996). With principal logarithms, w = W_k(z) is the one solution of **w + ln w = ln z + 2πik** (their
//! equation 4.4; on branch −1 with −1/e ≤ z < 0 the 2πik falls away, since w is real). Branches other than the
//! principal one are solved in that form by Newton's method: it names the branch, neither overflows nor
//! underflows, and is nearly linear. The principal branch passes through 0 and through the branch point −1/e; it is solved
//! in the form w·e^w = z by Halley's method.
//!
//! The crate `lambert_w` does this too, and is the reference of the tests. It is not used here for two reasons: near z = 0
//! it can give another branch than the requested one (W₁ of 5.2·10⁻⁷ − 1.9·10⁻⁷i becomes W₃), and as soon as any other
//! crate of a build turns its feature "std" on, it takes functions from the platform, so that bits would differ.

use super::complex::{Complex64, arg, exp, ln, norm, sqrt};
use std::f64::consts::{E, PI};

/// W_k(z). At z = 0 the principal branch is 0 and the others are −∞.
pub(crate) fn lambert_w(k: i32, z: Complex64) -> Complex64 {
    if z == Complex64::ZERO {
        return Complex64::new(if k == 0 { 0.0 } else { f64::NEG_INFINITY }, 0.0);
    }
    // Both halves of the plane by one function: W_k of the conjugate is the conjugate of W_{−k}.
    if arg(z) < 0.0 { upper(-k, z.conj()).conj() } else { upper(k, z) }
}

/// For 0 ≤ arg z ≤ π.
fn upper(k: i32, z: Complex64) -> Complex64 {
    if k == 0 { principal(z) } else { other(k, z) }
}

fn principal(z: Complex64) -> Complex64 {
    // Distance from the branch point, in the variable in which the branch is analytic there.
    let p = sqrt(2.0 * (E * z + 1.0));
    let mut w = if norm(p) < 2.2 {
        -1.0 + p * (1.0 - p * (1.0 / 3.0 - p * (11.0 / 72.0)))
    } else if norm(z) < 20.0 {
        // Winitzki's uniform approximation.
        let l = ln(1.0 + z);
        l * (1.0 - ln(1.0 + l) / (2.0 + l))
    } else {
        let l = ln(z);
        l - ln(l)
    };
    for _ in 0..50 {
        // Halley's step, divided by e^w.
        let f = w - z * exp(-w);
        let one_more = w + 1.0;
        let slope = one_more - (w + 2.0) * f / (2.0 * one_more);
        let step = f / slope;
        if step == Complex64::ZERO || step.is_nan() {
            // Exactly solved, or exactly on the branch point (0/0).
            break;
        }
        w -= step;
        if norm(step) <= 2e-16 * norm(w) {
            break;
        }
    }
    w
}

fn other(k: i32, z: Complex64) -> Complex64 {
    let log_z = ln(z);
    if k == -1 && z.im == 0.0 && z.re < 0.0 && z.re >= -1.0 / E {
        return real_lower(z.re);
    }
    let goal = log_z + Complex64::new(0.0, 2.0 * PI * f64::from(k));
    let p = sqrt(2.0 * (E * z + 1.0));
    // Of the other branches, −1 alone touches the branch point from this half of the plane.
    let mut w = if k == -1 && norm(p) < 1.0 {
        -1.0 - p * (1.0 + p * (1.0 / 3.0 + p * (11.0 / 72.0)))
    } else {
        goal - ln(goal)
    };
    for _ in 0..100 {
        // Near the negative real axis the branch decides on which side the logarithm is taken.
        let mut log_w = ln(w);
        if k < 0 && log_w.im > 0.0 && w.re < 0.0 {
            log_w.im -= 2.0 * PI;
        }
        let step = (w + log_w - goal) * w / (w + 1.0);
        if step == Complex64::ZERO || step.is_nan() {
            break;
        }
        w -= step;
        if norm(step) <= 2e-16 * norm(w) {
            break;
        }
    }
    w
}

/// W₋₁(x) for −1/e ≤ x < 0, where it is real: with u = −w ≥ 1, u − ln u = −ln(−x), by Newton's method from above, where the left
/// side is convex.
fn real_lower(x: f64) -> Complex64 {
    let goal = -libm::log(-x);
    let mut u = goal + libm::sqrt(2.0 * (goal - 1.0).max(0.0));
    for _ in 0..100 {
        if u <= 1.0 {
            u = 1.0;
            break;
        }
        let next = u - (u - libm::log(u) - goal) * u / (u - 1.0);
        if next >= u {
            break;
        }
        u = next;
    }
    Complex64::new(-u, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> impl Iterator<Item = Complex64> {
        (0..60).flat_map(|i| {
            (-18..=18).map(move |j| {
                let r = crate::numerics::exp::exp(f64::from(i) * 0.4 - 16.0);
                let angle = f64::from(j) * PI / 18.0;
                Complex64::new(r * libm::cos(angle), r * libm::sin(angle))
            })
        })
    }

    /// The residual of w + ln w = ln z + 2πik.
    fn residual(k: i32, z: Complex64, w: Complex64) -> f64 {
        norm(w + ln(w) - ln(z) - Complex64::new(0.0, 2.0 * PI * f64::from(k)))
    }

    #[test]
    fn every_branch_solves_its_equation() {
        for z in grid() {
            for k in -6..=6 {
                let w = lambert_w(k, z);
                // On the cut, W₋₁ and W₁ are real up to rounding, and rounding decides whether ln w is πi or −πi.
                let on_the_cut = k.abs() == 1 && w.re < -1.0 && w.im.abs() < 1e-14;
                let there = residual(k, z, w);
                let residual = if on_the_cut { there.min(residual(0, z, w)) } else { there };
                assert!(residual < 1e-13 * (1.0 + norm(w)), "W_{k}({z}) = {w}: {residual:e}");
            }
        }
    }

    /// An independent implementation agrees wherever it is on the branch it was asked for.
    #[cfg(not(target_arch = "wasm32"))] // the other crate is there for native tests only
    #[test]
    fn it_is_the_same_function_as_elsewhere() {
        let (mut same, mut strayed) = (0, 0);
        for z in grid() {
            for k in -6..=6 {
                let ours = lambert_w(k, z);
                let (re, im) = lambert_w::lambert_w(k, z.re, z.im, f64::EPSILON);
                let theirs = Complex64::new(re, im);
                if residual(k, z, theirs) > 1.0 {
                    strayed += 1;
                    continue;
                }
                assert!(norm(ours - theirs) <= 1e-12 * norm(ours), "W_{k}({z}): {ours} and {theirs}");
                same += 1;
            }
        }
        println!("{same} values agree; in {strayed} cases the reference is on another branch");
        assert!(same > 20 * strayed);
    }

    #[test]
    fn known_values() {
        let w = |k, re| lambert_w(k, Complex64::new(re, 0.0));
        assert!((w(0, 1.0).re - 0.567_143_290_409_783_8).abs() < 1e-15);
        assert!(norm(w(0, E) - 1.0) < 1e-15);
        assert!(norm(w(0, -PI / 2.0) - Complex64::new(0.0, PI / 2.0)) < 1e-15);
        assert!((w(-1, -0.1).re + 3.577_152_063_957_297).abs() < 1e-14 && w(-1, -0.1).im == 0.0);
        assert!(norm(w(0, -1.0 / E) + 1.0) < 1e-7 && norm(w(-1, -1.0 / E) + 1.0) < 1e-7);
        assert_eq!(w(0, 0.0), Complex64::ZERO);
        assert_eq!(w(3, 0.0).re, f64::NEG_INFINITY);
    }
}
