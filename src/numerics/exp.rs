//! The exponential function: the same bits on every target, and a form that the compiler turns into vectors.
//!
//! **Method.** x = k·ln 2 + r with |r| ≤ ln 2 / 2 and k·ln 2 subtracted in two parts (Cody and Waite, 1980);
//! e^r by its Taylor polynomial of degree 13, whose remainder there, r¹⁴/14!, is under 5·10⁻¹⁸ relative;
//! 2^k through the exponent's bits. Only additions and multiplications that round once each, in one fixed
//! order, never fused: so a scalar, a vector of any width and WebAssembly agree to the last bit.
//!
//! **Accuracy.** Under 1 ulp over the whole range; a test holds it against a reference in twice the precision.
//!
//! **Outside.** [`exp`] gives 0 below −745.14, +∞ above 709.79, subnormal numbers between −745.14 and −708.4,
//! NaN for NaN. [`exp_within`] holds its argument to ±700 first, which is what the car-following law needs:
//! e^700 and all above mean "stand still", e^−700 and all below mean "maximum speed".
//!
//! ```
//! use ringroad::numerics::exp::{exp, exp_within};
//!
//! assert!((exp(1.0) - std::f64::consts::E).abs() <= f64::EPSILON * 2.0);
//! assert_eq!((exp(-800.0), exp(800.0)), (0.0, f64::INFINITY));
//! assert_eq!(exp_within(800.0), exp(700.0));
//! ```

use crate::numerics::simd::Real;

/// 1/k! for k = 2 … 13.
#[allow(clippy::excessive_precision)] // the decimal expansions of the quotients, rounded by the compiler
const COEFFICIENTS: [f64; 12] = [
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5040.0,
    1.0 / 40320.0,
    1.0 / 362_880.0,
    1.0 / 3_628_800.0,
    1.0 / 39_916_800.0,
    1.0 / 479_001_600.0,
    1.0 / 6_227_020_800.0,
];

/// ln 2 in two parts: the first has 21 trailing zero bits, so that k times it is exact for |k| < 2^21.
const LN_2_HIGH: f64 = f64::from_bits(0x3FE6_2E42_FEE0_0000);
const LN_2_LOW: f64 = f64::from_bits(0x3DEA_39EF_3579_3C76);

/// Adding and subtracting 1.5·2^52 rounds to the nearest whole number, in any register width.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// Splits x into k (as the low bits of a float near [`ROUNDER`]) and e^r.
#[inline(always)]
fn reduced<T: Real>(x: T) -> (T, T) {
    let all = T::all;
    let shifted = x * all(std::f64::consts::LOG2_E) + all(ROUNDER);
    let k = shifted - all(ROUNDER);
    let r = (x - k * all(LN_2_HIGH)) - k * all(LN_2_LOW);
    let c = |j: usize| all(COEFFICIENTS[j]);
    let r2 = r * r;
    let r4 = r2 * r2;
    // Estrin's scheme: short chains, so that a vector unit stays busy.
    let low = (c(0) + c(1) * r) + (c(2) + c(3) * r) * r2;
    let middle = (c(4) + c(5) * r) + (c(6) + c(7) * r) * r2;
    let high = (c(8) + c(9) * r) + (c(10) + c(11) * r) * r2;
    let tail = (low + middle * r4) + high * (r4 * r4);
    (shifted, all(1.0) + (r + tail * r2))
}

/// e^x for −700 ≤ x ≤ 700; outside, the value at the nearer end. Without a branch. NaN gives NaN.
#[inline(always)]
pub fn exp_within(x: f64) -> f64 {
    all_within(x)
}

/// [`exp_within`] of one number, or of every number of a chunk.
#[inline(always)]
pub(crate) fn all_within<T: Real>(x: T) -> T {
    let x = x.least(T::all(700.0)).most(T::all(-700.0));
    let (shifted, fraction) = reduced(x);
    // The low bits of `shifted` hold k.
    fraction.times_power_of_two(shifted)
}

/// e^x.
pub fn exp(x: f64) -> f64 {
    if x.is_nan() {
        return x;
    }
    if (-700.0..=700.0).contains(&x) {
        return exp_within(x);
    }
    let x = x.clamp(-746.0, 710.0);
    let (shifted, fraction) = reduced(x);
    let k = (shifted - ROUNDER) as i64;
    // In two steps, since 2^k alone may not be a normal number; the last product rounds once.
    let half = k / 2;
    let power = |k: i64| f64::from_bits(((1023 + k) as u64) << 52);
    fraction * power(half) * power(k - half)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// e^x as an unevaluated sum of two doubles, good to about 10⁻³⁰ relative: argument halved 2^10 times in
    /// double-double arithmetic, Taylor series, then squared back. Written for this test alone; slow.
    mod reference {
        pub(super) type Pair = (f64, f64);
        fn two_sum(a: f64, b: f64) -> Pair {
            let s = a + b;
            let bb = s - a;
            (s, (a - (s - bb)) + (b - bb))
        }
        fn split(a: f64) -> Pair {
            let t = 134_217_729.0 * a;
            let high = t - (t - a);
            (high, a - high)
        }
        fn two_product(a: f64, b: f64) -> Pair {
            let p = a * b;
            let ((ah, al), (bh, bl)) = (split(a), split(b));
            (p, ((ah * bh - p) + ah * bl + al * bh) + al * bl)
        }
        fn add(a: Pair, b: Pair) -> Pair {
            let (s, e) = two_sum(a.0, b.0);
            two_sum(s, e + a.1 + b.1)
        }
        fn multiply(a: Pair, b: Pair) -> Pair {
            let (p, e) = two_product(a.0, b.0);
            two_sum(p, e + a.0 * b.1 + a.1 * b.0)
        }
        /// Σ x^n/n!, minus 1, of a small x.
        fn expm1_small(x: Pair) -> Pair {
            let mut sum = (0.0, 0.0);
            for n in (1..=14).rev() {
                // Horner: sum = (x/n)·(1 + sum)
                let one_more = add((1.0, 0.0), sum);
                let product = multiply(x, one_more);
                let q = product.0 / f64::from(n);
                let (p, e) = two_product(q, f64::from(n));
                sum = two_sum(q, ((product.0 - p) - e + product.1) / f64::from(n));
            }
            sum
        }
        /// (fraction as a pair, k) with e^x = fraction·2^k.
        pub(super) fn exp(x: f64) -> (Pair, i32) {
            // ln 2 to 107 bits.
            const LN_2: Pair = (std::f64::consts::LN_2, 2.319_046_813_846_299_6e-17);
            let k = (x / std::f64::consts::LN_2).round();
            let product = multiply((k, 0.0), LN_2);
            let r = add((x, 0.0), (-product.0, -product.1));
            let small = (r.0 / 1024.0, r.1 / 1024.0);
            let mut m = expm1_small(small);
            for _ in 0..10 {
                // (1 + m)² − 1 = 2m + m²
                m = add((2.0 * m.0, 2.0 * m.1), multiply(m, m));
            }
            (add((1.0, 0.0), m), k as i32)
        }
    }

    /// Distance of `value` from e^x in units of the last place of a normal result.
    fn ulps(x: f64, value: f64) -> f64 {
        let ((high, low), k) = reference::exp(x);
        let scale = |v: f64| {
            let half = k / 2;
            v * f64::from_bits(((1023 - half) as u64) << 52)
                * f64::from_bits(((1023 - (k - half)) as u64) << 52)
        };
        let scaled = scale(value);
        let unit = if high >= 1.0 { f64::EPSILON } else { f64::EPSILON / 2.0 };
        ((scaled - high) - low).abs() / unit
    }

    #[test]
    fn the_reference_has_e_to_thirty_digits() {
        // e to 32 digits: 2.7182818284590452353602874713527
        let ((high, low), k) = reference::exp(1.0);
        let scale = f64::from_bits(((1023 + k) as u64) << 52);
        assert_eq!(high * scale, std::f64::consts::E);
        assert!((low * scale - 1.445_646_891_729_250_2e-16).abs() < 1e-30);
        assert_eq!(reference::exp(0.0), ((1.0, 0.0), 0));
    }

    #[test]
    fn within_one_unit_in_the_last_place_over_the_whole_range() {
        let mut worst = 0.0_f64;
        let n = 400_000;
        for i in 0..=n {
            // An irrational stride visits every binade and every reduced argument.
            let x = -708.0 + 1417.0 * (f64::from(i) * 0.618_033_988_749_894_9).fract();
            worst = worst.max(ulps(x, exp(x)));
            let near = (x / 708.0) * 0.5;
            worst = worst.max(ulps(near, exp(near)));
            let tiny = near * near * near * 1e-3;
            worst = worst.max(ulps(tiny, exp(tiny)));
        }
        println!("largest error: {worst:.4} ulp");
        assert!(worst < 1.0, "largest error {worst} ulp");
    }

    #[test]
    fn the_ends_of_the_range() {
        assert_eq!(exp(0.0), 1.0);
        assert_eq!(exp(-0.0), 1.0);
        assert_eq!(exp(f64::INFINITY), f64::INFINITY);
        assert_eq!(exp(f64::NEG_INFINITY), 0.0);
        assert_eq!(exp(710.0), f64::INFINITY);
        assert_eq!(exp(-746.0), 0.0);
        assert!(exp(709.78).is_finite());
        assert!(exp(-745.0) > 0.0 && exp(-745.0) < f64::MIN_POSITIVE);
        assert!(exp(f64::NAN).is_nan() && exp_within(f64::NAN).is_nan());
        assert_eq!(exp_within(1e9), exp(700.0));
        assert_eq!(exp_within(f64::NEG_INFINITY), exp(-700.0));
        for x in [-700.0, -1.0, 1e-300, 3.5, 700.0] {
            assert_eq!(exp(x), exp_within(x));
        }
    }

    #[test]
    fn it_is_monotonic() {
        let mut last = 0.0;
        for i in -70_000..70_000 {
            let value = exp(f64::from(i) * 0.01);
            assert!(value >= last);
            last = value;
        }
    }
}
