//! Vectors as wide as the machine has them, chosen at run time. This is the only file with `unsafe` code.
//!
//! A *kernel* is a loop over chunks of `CHUNK` numbers. `kernel!` compiles it once for each width that the
//! target knows. On x86-64 the compiler turns the chunks' arrays into vectors of that width; in WebAssembly, where
//! the page's code is built for size, they are vectors of 128 bits by name. All versions do the same operations on
//! each number, each rounding once, so that results do not depend on the width; a test compares them.
//!
//! ```
//! use ringroad::numerics::simd::Width;
//!
//! let widths = Width::available();
//! assert_eq!(widths[0], Width::NARROWEST);
//! assert_eq!(widths.last(), Some(&Width::widest()));
//! ```

use std::ops::{Add, Deref, DerefMut, Mul, Sub};

/// Numbers that a kernel handles at a time: a whole number of vectors of every width. In WebAssembly, where there is one
/// width and there are only sixteen registers, two vectors.
pub(crate) const CHUNK: usize =
    if cfg!(all(target_arch = "wasm32", target_feature = "simd128")) { 4 } else { 8 };

/// The operations of formulas that are written once, for one number and for a chunk of them.
pub(crate) trait Real: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// The same number in every place.
    fn all(value: f64) -> Self;
    /// `other` where it is smaller; NaN in `self` stays.
    fn least(self, other: Self) -> Self;
    /// `other` where it is larger; NaN in `self` stays.
    fn most(self, other: Self) -> Self;
    /// Times 2^k, for the whole number k in the lowest 12 bits of `exponent`.
    fn times_power_of_two(self, exponent: Self) -> Self;
}

impl Real for f64 {
    #[inline(always)]
    fn all(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn least(self, other: Self) -> Self {
        if other < self { other } else { self }
    }
    #[inline(always)]
    fn most(self, other: Self) -> Self {
        if self < other { other } else { self }
    }
    #[inline(always)]
    fn times_power_of_two(self, exponent: Self) -> Self {
        Self::from_bits(self.to_bits().wrapping_add(exponent.to_bits() << 52))
    }
}

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
mod chunk {
    use super::{CHUNK, Real};

    /// [`CHUNK`] numbers side by side.
    #[derive(Clone, Copy)]
    pub(crate) struct Chunk([f64; CHUNK]);

    impl Chunk {
        #[inline(always)]
        pub(crate) fn load(from: &[f64; CHUNK]) -> Self {
            Self(*from)
        }
        /// The numbers at these places of a slice.
        #[inline(always)]
        pub(crate) fn gather(from: &[f64], places: &[u32; CHUNK]) -> Self {
            Self(places.map(|place| from[place as usize]))
        }
        #[inline(always)]
        pub(crate) fn store(self, to: &mut [f64; CHUNK]) {
            *to = self.0;
        }
        #[inline(always)]
        pub(crate) fn splat(value: f64) -> Self {
            Self([value; CHUNK])
        }
        #[inline(always)]
        fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
            Self(std::array::from_fn(|j| f(self.0[j], other.0[j])))
        }
        /// Whether all are at most `bound`; NaN is not.
        #[inline(always)]
        pub(crate) fn are_at_most(self, bound: Self) -> bool {
            let mut within = true;
            for j in 0..CHUNK {
                within &= self.0[j] <= bound.0[j];
            }
            within
        }
        /// A bit for each number, the first one lowest: whether it is at least the other one.
        #[inline(always)]
        pub(crate) fn reaches(self, other: Self) -> u8 {
            let mut bits = 0;
            for j in 0..CHUNK {
                bits |= u8::from(self.0[j] >= other.0[j]) << j;
            }
            bits
        }
        /// `value` where the number is smaller than the other one, else 0.
        #[inline(always)]
        pub(crate) fn where_below(self, other: Self, value: Self) -> Self {
            Self(std::array::from_fn(|j| if self.0[j] < other.0[j] { value.0[j] } else { 0.0 }))
        }
        /// A mask: all bits set where the number is at most `bound`, else none.
        #[inline(always)]
        pub(crate) fn at_most(self, bound: Self) -> Self {
            self.zip(bound, |x, bound| f64::from_bits(if x <= bound { u64::MAX } else { 0 }))
        }
        /// `yes` where all bits of the number in `self` are set, `no` where none is.
        #[inline(always)]
        pub(crate) fn choose(self, yes: Self, no: Self) -> Self {
            let one = |j: usize| {
                let mask = self.0[j].to_bits();
                f64::from_bits((yes.0[j].to_bits() & mask) | (no.0[j].to_bits() & !mask))
            };
            Self(std::array::from_fn(one))
        }
    }

    /// The smallest and the largest number of all chunks taken so far; it does not depend on their order.
    #[derive(Clone, Copy)]
    pub(crate) struct Extremes {
        least: Chunk,
        most: Chunk,
    }

    impl Extremes {
        #[inline(always)]
        pub(crate) fn of(chunk: Chunk) -> Self {
            Self { least: chunk, most: chunk }
        }
        #[inline(always)]
        pub(crate) fn take(&mut self, chunk: Chunk) {
            (self.least, self.most) = (self.least.least(chunk), self.most.most(chunk));
        }
        /// (smallest, largest)
        #[inline(always)]
        pub(crate) fn reduced(self) -> (f64, f64) {
            // Hidden from the compiler, which otherwise takes the vectors of the whole loop apart for this.
            let [a, b, c, d, e, f, g, h] = std::hint::black_box(self.least.0);
            let [p, q, r, s, t, u, v, w] = std::hint::black_box(self.most.0);
            (
                a.least(b).least(c.least(d)).least(e.least(f).least(g.least(h))),
                p.most(q).most(r.most(s)).most(t.most(u).most(v.most(w))),
            )
        }
    }

    impl Real for Chunk {
        #[inline(always)]
        fn all(value: f64) -> Self {
            Self::splat(value)
        }
        #[inline(always)]
        fn least(self, other: Self) -> Self {
            self.zip(other, Real::least)
        }
        #[inline(always)]
        fn most(self, other: Self) -> Self {
            self.zip(other, Real::most)
        }
        #[inline(always)]
        fn times_power_of_two(self, exponent: Self) -> Self {
            self.zip(exponent, Real::times_power_of_two)
        }
    }

    impl std::ops::Add for Chunk {
        type Output = Self;
        #[inline(always)]
        fn add(self, other: Self) -> Self {
            self.zip(other, |a, b| a + b)
        }
    }
    impl std::ops::Sub for Chunk {
        type Output = Self;
        #[inline(always)]
        fn sub(self, other: Self) -> Self {
            self.zip(other, |a, b| a - b)
        }
    }
    impl std::ops::Mul for Chunk {
        type Output = Self;
        #[inline(always)]
        fn mul(self, other: Self) -> Self {
            self.zip(other, |a, b| a * b)
        }
    }
}

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod chunk {
    use super::{CHUNK, Real};
    use core::arch::wasm32::{
        f64x2, f64x2_add, f64x2_extract_lane, f64x2_ge, f64x2_le, f64x2_lt, f64x2_mul, f64x2_pmax,
        f64x2_pmin, f64x2_splat, f64x2_sub, i64x2_add, i64x2_bitmask, i64x2_shl, v128, v128_and,
        v128_bitselect, v128_load, v128_store,
    };

    /// [`CHUNK`] numbers side by side.
    #[derive(Clone, Copy)]
    pub(crate) struct Chunk([v128; CHUNK / 2]);

    impl Chunk {
        #[inline(always)]
        #[allow(unsafe_code, clippy::cast_ptr_alignment)]
        pub(crate) fn load(from: &[f64; CHUNK]) -> Self {
            let from = from.as_ptr().cast::<v128>();
            // SAFETY: CHUNK numbers are two vectors; the load needs no alignment.
            unsafe { Self([v128_load(from), v128_load(from.add(1))]) }
        }
        /// The numbers at these places of a slice.
        #[inline(always)]
        pub(crate) fn gather(from: &[f64], places: &[u32; CHUNK]) -> Self {
            let pair = |j: usize| f64x2(from[places[j] as usize], from[places[j + 1] as usize]);
            Self([pair(0), pair(2)])
        }
        #[inline(always)]
        #[allow(unsafe_code, clippy::cast_ptr_alignment)]
        pub(crate) fn store(self, to: &mut [f64; CHUNK]) {
            let to = to.as_mut_ptr().cast::<v128>();
            let [a, b] = self.0;
            // SAFETY: as in `load`.
            unsafe {
                v128_store(to, a);
                v128_store(to.add(1), b);
            }
        }
        #[inline(always)]
        pub(crate) fn splat(value: f64) -> Self {
            // Built for size, `[v; 2]` might be a loop through memory.
            let v = f64x2_splat(value);
            Self([v, v])
        }
        #[inline(always)]
        fn zip(self, other: Self, f: impl Fn(v128, v128) -> v128) -> Self {
            let (a, b) = (self.0, other.0);
            Self([f(a[0], b[0]), f(a[1], b[1])])
        }
        /// Whether all are at most `bound`; NaN is not.
        #[inline(always)]
        pub(crate) fn are_at_most(self, bound: Self) -> bool {
            let (x, y) = (self.0, bound.0);
            i64x2_bitmask(v128_and(f64x2_le(x[0], y[0]), f64x2_le(x[1], y[1]))) == 3
        }
        /// A bit for each number, the first one lowest: whether it is at least the other one.
        #[inline(always)]
        pub(crate) fn reaches(self, other: Self) -> u8 {
            let (x, y) = (self.0, other.0);
            let bits = |j: usize| i64x2_bitmask(f64x2_ge(x[j], y[j])) << (2 * j);
            bits(0) | bits(1)
        }
        /// `value` where the number is smaller than the other one, else 0.
        #[inline(always)]
        pub(crate) fn where_below(self, other: Self, value: Self) -> Self {
            let (x, y, v) = (self.0, other.0, value.0);
            let one = |j: usize| v128_and(f64x2_lt(x[j], y[j]), v[j]);
            Self([one(0), one(1)])
        }
        /// A mask: all bits set where the number is at most `bound`, else none.
        #[inline(always)]
        pub(crate) fn at_most(self, bound: Self) -> Self {
            self.zip(bound, |a, b| f64x2_le(a, b))
        }
        /// `yes` where all bits of the number in `self` are set, `no` where none is.
        #[inline(always)]
        pub(crate) fn choose(self, yes: Self, no: Self) -> Self {
            let (mask, a, b) = (self.0, yes.0, no.0);
            let one = |j: usize| v128_bitselect(a[j], b[j], mask[j]);
            Self([one(0), one(1)])
        }
    }

    /// The smallest and the largest number of all chunks taken so far; it does not depend on their order. (In two
    /// vectors, since there are only sixteen registers.)
    #[derive(Clone, Copy)]
    pub(crate) struct Extremes {
        least: v128,
        most: v128,
    }

    impl Extremes {
        #[inline(always)]
        pub(crate) fn of(chunk: Chunk) -> Self {
            let mut extremes = Self { least: chunk.0[0], most: chunk.0[0] };
            extremes.take(chunk);
            extremes
        }
        #[inline(always)]
        pub(crate) fn take(&mut self, chunk: Chunk) {
            let [a, b] = chunk.0;
            self.least = f64x2_pmin(self.least, f64x2_pmin(a, b));
            self.most = f64x2_pmax(self.most, f64x2_pmax(a, b));
        }
        /// (smallest, largest)
        #[inline(always)]
        pub(crate) fn reduced(self) -> (f64, f64) {
            let (least, most) = (self.least, self.most);
            (
                f64x2_extract_lane::<0>(least).least(f64x2_extract_lane::<1>(least)),
                f64x2_extract_lane::<0>(most).most(f64x2_extract_lane::<1>(most)),
            )
        }
    }

    impl Real for Chunk {
        #[inline(always)]
        fn all(value: f64) -> Self {
            Self::splat(value)
        }
        #[inline(always)]
        fn least(self, other: Self) -> Self {
            self.zip(other, |a, b| f64x2_pmin(a, b))
        }
        #[inline(always)]
        fn most(self, other: Self) -> Self {
            self.zip(other, |a, b| f64x2_pmax(a, b))
        }
        #[inline(always)]
        fn times_power_of_two(self, exponent: Self) -> Self {
            self.zip(exponent, |x, k| i64x2_add(x, i64x2_shl(k, 52)))
        }
    }

    impl std::ops::Add for Chunk {
        type Output = Self;
        #[inline(always)]
        fn add(self, other: Self) -> Self {
            self.zip(other, |a, b| f64x2_add(a, b))
        }
    }
    impl std::ops::Sub for Chunk {
        type Output = Self;
        #[inline(always)]
        fn sub(self, other: Self) -> Self {
            self.zip(other, |a, b| f64x2_sub(a, b))
        }
    }
    impl std::ops::Mul for Chunk {
        type Output = Self;
        #[inline(always)]
        fn mul(self, other: Self) -> Self {
            self.zip(other, |a, b| f64x2_mul(a, b))
        }
    }
}

pub(crate) use chunk::{Chunk, Extremes};

impl Chunk {
    /// The numbers, one by one.
    #[inline(always)]
    pub(crate) fn to_array(self) -> [f64; CHUNK] {
        let mut out = [0.0; CHUNK];
        self.store(&mut out);
        out
    }
}

/// Numbers that begin where a cache line does, so that no chunk lies across two lines.
#[derive(Clone, Debug, Default)]
pub(crate) struct Aligned {
    lines: Vec<CacheLine>,
    len: usize,
}

#[repr(C, align(64))]
#[derive(Clone, Copy, Debug)]
struct CacheLine([f64; CacheLine::LEN]);

impl CacheLine {
    const LEN: usize = 8;
}

impl Aligned {
    /// `len` times the same number.
    pub(crate) fn filled(value: f64, len: usize) -> Self {
        Self { lines: vec![CacheLine([value; CacheLine::LEN]); len.div_ceil(CacheLine::LEN)], len }
    }

    /// These numbers.
    pub(crate) fn of(numbers: &[f64]) -> Self {
        let mut aligned = Self::filled(0.0, numbers.len());
        aligned.copy_from_slice(numbers);
        aligned
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> usize {
        self.lines.capacity() * size_of::<CacheLine>()
    }
}

impl Deref for Aligned {
    type Target = [f64];
    #[inline(always)]
    #[allow(unsafe_code)]
    fn deref(&self) -> &[f64] {
        // SAFETY: a cache line is an array of eight numbers of 64 bytes together, without padding (`repr(C)`); the lines
        // lie one after the other, and hold at least `len` numbers.
        unsafe { std::slice::from_raw_parts(self.lines.as_ptr().cast(), self.len) }
    }
}

impl DerefMut for Aligned {
    #[inline(always)]
    #[allow(unsafe_code)]
    fn deref_mut(&mut self) -> &mut [f64] {
        // SAFETY: as in `deref`.
        unsafe { std::slice::from_raw_parts_mut(self.lines.as_mut_ptr().cast(), self.len) }
    }
}

/// The whole chunks of a slice; a rest at its end is left out.
#[inline(always)]
pub(crate) fn chunks(slice: &[f64]) -> &[[f64; CHUNK]] {
    slice.as_chunks().0
}

/// The same, mutable.
#[inline(always)]
pub(crate) fn chunks_mut(slice: &mut [f64]) -> &mut [[f64; CHUNK]] {
    slice.as_chunks_mut().0
}

/// Width of the vectors that a kernel uses. A value is always one that this machine has: only [`Width::available`] makes
/// others than the target's own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Width(pub(crate) Features);

/// The processor features that a kernel is compiled for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Features {
    /// Those of the target itself: vectors of 128 bits on x86-64 and in WebAssembly.
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
    pub const NARROWEST: Self = Self(Features::Target);

    /// Every width that this machine has, narrowest first.
    pub fn available() -> Vec<Self> {
        #[allow(unused_mut)] // some targets have one width only
        let mut widths = vec![Self::NARROWEST];
        #[cfg(target_arch = "x86_64")]
        {
            if is_x86_feature_detected!("avx2") {
                widths.push(Self(Features::Bits256));
            }
            if is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("avx512dq") {
                widths.push(Self(Features::Bits512));
            }
        }
        widths
    }

    /// The widest that this machine has.
    pub fn widest() -> Self {
        *Self::available().last().expect("the target's own width is always there")
    }
}

/// Defines a function that is compiled for every [`Width`] and takes the width to use as its first argument.
macro_rules! kernel {
    ($(#[$meta:meta])* $vis:vis fn $name:ident($($arg:ident: $type:ty),* $(,)?) $body:block) => {
        $(#[$meta])*
        #[allow(clippy::too_many_arguments)] // slices of one shape, side by side
        $vis fn $name(width: $crate::numerics::simd::Width, $($arg: $type),*) {
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
                $crate::numerics::simd::Features::Target => body($($arg),*),
                // SAFETY: a width other than the target's own comes from `Width::available`, which has found
                // these features in the processor.
                #[cfg(target_arch = "x86_64")]
                #[allow(unsafe_code)]
                $crate::numerics::simd::Features::Bits256 => unsafe { body_256($($arg),*) },
                #[cfg(target_arch = "x86_64")]
                #[allow(unsafe_code)]
                $crate::numerics::simd::Features::Bits512 => unsafe { body_512($($arg),*) },
            }
        }
    };
}
pub(crate) use kernel;
