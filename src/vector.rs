//! Vectors as wide as the machine has them, chosen at run time; the one room with `unsafe` in it.
//!
//! A *kernel* is a plain loop over chunks of [`CHUNK`] numbers, which the compiler turns into vectors.
//! `kernel!` compiles it once for each width that the target knows. All versions do the same
//! operations on each number, each rounding once, so that results do not depend on the width: a test holds one
//! against the other.

/// Numbers that a kernel handles at a time: a whole number of vectors of every width.
pub const CHUNK: usize = 8;

/// Width of the vectors that a kernel uses; one that this machine has, since only [`Width::available`] makes wider
/// ones than the target's own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Width(pub(crate) Kind);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// What the target has by itself: 128 bits on x86-64 and in WebAssembly.
    Target,
    /// AVX2.
    #[cfg(target_arch = "x86_64")]
    Bits256,
    /// AVX-512.
    #[cfg(target_arch = "x86_64")]
    Bits512,
}

impl Width {
    /// The target's own: 128 bits on every x86-64 processor and in WebAssembly with simd128.
    pub const NARROWEST: Self = Self(Kind::Target);

    /// Every width that this machine has, narrowest first.
    pub fn available() -> Vec<Self> {
        #[allow(unused_mut)] // some targets have one width only
        let mut widths = vec![Self::NARROWEST];
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") {
                widths.push(Self(Kind::Bits256));
            }
            if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
                widths.push(Self(Kind::Bits512));
            }
        }
        widths
    }

    /// The widest that this machine has.
    pub fn widest() -> Self {
        *Self::available().last().expect("the target's own width is always there")
    }
}

/// The larger of each two numbers; `a` where they are equal or one is NaN.
#[inline(always)]
pub(crate) fn larger(a: &[f64; CHUNK], b: &[f64; CHUNK]) -> [f64; CHUNK] {
    #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
    return by_pairs(a, b, |a, b| std::arch::wasm32::f64x2_pmax(a, b));
    #[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
    std::array::from_fn(|j| if a[j] < b[j] { b[j] } else { a[j] })
}

/// The smaller of each two numbers; `a` where they are equal or one is NaN.
#[inline(always)]
pub(crate) fn smaller(a: &[f64; CHUNK], b: &[f64; CHUNK]) -> [f64; CHUNK] {
    #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
    return by_pairs(a, b, |a, b| std::arch::wasm32::f64x2_pmin(a, b));
    #[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
    std::array::from_fn(|j| if b[j] < a[j] { b[j] } else { a[j] })
}

/// Left to itself the compiler makes scalars of selections in WebAssembly, and of what leads to them.
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
#[inline(always)]
fn by_pairs(
    a: &[f64; CHUNK],
    b: &[f64; CHUNK],
    choose: impl Fn(std::arch::wasm32::v128, std::arch::wasm32::v128) -> std::arch::wasm32::v128,
) -> [f64; CHUNK] {
    use std::arch::wasm32::{f64x2, f64x2_extract_lane};
    let mut chosen = [0.0; CHUNK];
    for j in (0..CHUNK).step_by(2) {
        let pair = choose(f64x2(a[j], a[j + 1]), f64x2(b[j], b[j + 1]));
        (chosen[j], chosen[j + 1]) = (f64x2_extract_lane::<0>(pair), f64x2_extract_lane::<1>(pair));
    }
    chosen
}

/// Defines a function that is compiled for every [`Width`] and takes the width to use as its first argument.
macro_rules! kernel {
    ($(#[$meta:meta])* $vis:vis fn $name:ident($($arg:ident: $type:ty),* $(,)?) $body:block) => {
        $(#[$meta])*
        #[allow(clippy::too_many_arguments)] // slices of one shape, side by side
        $vis fn $name(width: $crate::vector::Width, $($arg: $type),*) {
            #[inline(always)]
            #[allow(clippy::too_many_arguments)]
            fn body($($arg: $type),*) $body
            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = "avx2")]
            #[allow(clippy::too_many_arguments)]
            fn body_256($($arg: $type),*) { body($($arg),*) }
            #[cfg(target_arch = "x86_64")]
            #[target_feature(enable = "avx512f,avx512dq")]
            #[allow(clippy::too_many_arguments)]
            fn body_512($($arg: $type),*) { body($($arg),*) }
            match width.0 {
                $crate::vector::Kind::Target => body($($arg),*),
                // SAFETY: a width other than the target's own comes from `Width::available`, which has asked the
                // processor for these features.
                #[cfg(target_arch = "x86_64")]
                #[allow(unsafe_code)]
                $crate::vector::Kind::Bits256 => unsafe { body_256($($arg),*) },
                #[cfg(target_arch = "x86_64")]
                #[allow(unsafe_code)]
                $crate::vector::Kind::Bits512 => unsafe { body_512($($arg),*) },
            }
        }
    };
}
pub(crate) use kernel;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_equals_and_beside_nan() {
        let a = [1.0, 2.0, 0.0, -0.0, f64::NAN, 3.0, f64::INFINITY, -1.0];
        let b = [2.0, 1.0, -0.0, 0.0, 3.0, f64::NAN, 0.0, f64::NEG_INFINITY];
        let bits = |chunk: [f64; CHUNK]| chunk.map(f64::to_bits);
        assert_eq!(bits(larger(&a, &b)), bits([2.0, 2.0, 0.0, -0.0, f64::NAN, 3.0, f64::INFINITY, -1.0]));
        assert_eq!(bits(smaller(&a, &b)), bits([1.0, 1.0, 0.0, -0.0, f64::NAN, 3.0, 0.0, f64::NEG_INFINITY]));
    }
}
