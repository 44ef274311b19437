//! Complex functions with the same bits everywhere.
//!
//! The functions of `num_complex` use the platform's library as soon as any crate of the build turns its feature "std" on;
//! these use [`crate::numerics::exp`] and `libm` alone. [`exp_m1`] and [`ln_1p`] keep the digits near 0 that e^z − 1 and
//! ln(1 + w) lose.

use crate::numerics::exp::exp as real_exp;
pub(crate) use num_complex::Complex64;

/// |z|.
pub(crate) fn norm(z: Complex64) -> f64 {
    libm::hypot(z.re, z.im)
}

/// Argument in (−π, π]; a number on the negative real axis has +π whatever the sign of its zero.
pub(crate) fn arg(z: Complex64) -> f64 {
    // Adding 0 turns −0 into +0.
    libm::atan2(z.im + 0.0, z.re)
}

/// e^z.
pub(crate) fn exp(z: Complex64) -> Complex64 {
    let r = real_exp(z.re);
    Complex64::new(r * libm::cos(z.im), r * libm::sin(z.im))
}

/// e^z − 1, without loss of digits near z = 0.
pub(crate) fn exp_m1(z: Complex64) -> Complex64 {
    let half_sine = libm::sin(0.5 * z.im);
    let re = libm::expm1(z.re) * libm::cos(z.im) - 2.0 * half_sine * half_sine;
    Complex64::new(re, real_exp(z.re) * libm::sin(z.im))
}

/// Principal logarithm, argument as in [`arg`].
pub(crate) fn ln(z: Complex64) -> Complex64 {
    Complex64::new(libm::log(norm(z)), arg(z))
}

/// ln(1 + w), without loss of digits near w = 0.
pub(crate) fn ln_1p(w: Complex64) -> Complex64 {
    let one_more = Complex64::new(1.0 + w.re, w.im);
    let square = w.re * (2.0 + w.re) + w.im * w.im;
    // Near w = −1 the square cancels, and the plain form is the exact one.
    let re = if square > -0.5 { 0.5 * libm::log1p(square) } else { libm::log(norm(one_more)) };
    Complex64::new(re, arg(one_more))
}

/// Principal square root.
pub(crate) fn sqrt(z: Complex64) -> Complex64 {
    let r = norm(z);
    // The larger part first, without cancellation; the other from 2·re·im = Im z.
    if z.re >= 0.0 {
        let re = libm::sqrt(0.5 * (r + z.re));
        Complex64::new(re, if re == 0.0 { 0.0 } else { 0.5 * z.im / re })
    } else {
        let im = libm::sqrt(0.5 * (r - z.re));
        let im = if z.im + 0.0 < 0.0 { -im } else { im };
        Complex64::new(0.5 * z.im / im, im)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_undo_their_inverses() {
        for k in 0..200 {
            let angle = f64::from(k) * 0.37;
            let r = real_exp(f64::from(k % 40) - 30.0);
            let z = Complex64::new(r * libm::cos(angle), r * libm::sin(angle));
            let root = sqrt(z);
            assert!(norm(root * root - z) <= 4e-16 * r && root.re >= 0.0, "{z}");
            assert!(norm(exp(ln(z)) - z) <= 1e-14 * r, "{z}");
            if r < 1.0 {
                assert!(norm(exp_m1(ln_1p(z)) - z) <= 2e-15 * r, "{z}");
            }
        }
        assert_eq!(arg(Complex64::new(-1.0, -0.0)), std::f64::consts::PI);
    }
}
