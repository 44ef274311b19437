//! Random numbers: the only source of randomness of the project.
//!
//! The generator is ChaCha with 8 rounds, a stream cipher, from the crate `rand_chacha`, which promises the same output
//! on every platform (`rand`'s own `ChaCha8Rng` cannot be cloned, and a simulation can); the draws are those of the crate
//! `rand`. A scenario has one seed; each [`Stream`] is a separate stream of the cipher, so that the numbers
//! drawn for one purpose do not depend on how many are drawn for another.
//!
//! | draw | made by | random bits |
//! |---|---|---|
//! | [`Generator::uniform`] | `rand`'s `StandardUniform` for `f64` | 64 a number, the upper 53 used |
//! | [`Generator::exponential`] | −ln(1 − u) of such a uniform u, by `libm` | 64 a number |
//! | [`Generator::coin`] | `rand`'s `Bernoulli` | 64 a draw |
//! | [`Generator::below`] | `rand`'s `Uniform` for `u64` (Lemire's method, 2019, without bias) | 64 a draw, more after a rejection |
//! | [`Generator::choose`] | `rand`'s `SliceRandom::partial_shuffle` (Fisher–Yates) | 32 for one draw or several |
//!
//! No draw has the width of a pointer. `partial_shuffle` works on slices, but draws 32-bit numbers for every length
//! below 2³² − 1, on platforms of 32 and of 64 bits; longer ones are refused here. (`rand::seq::index::sample` would do as
//! well; its three algorithms would add 2.4 kB, compressed, to the page's first module.) `rand` changes such values with a
//! new minor version only (0.10 to 0.11); a test holds the values of this one.
//!
//! ```
//! use ringroad::numerics::random::{Generator, Stream};
//!
//! let mut generator = Generator::new(1, Stream::Start);
//! let uniform = generator.uniform();
//! assert!((0.0..1.0).contains(&uniform));
//! // The same seed and stream give the same numbers, another stream gives others.
//! assert_eq!(Generator::new(1, Stream::Start).uniform(), uniform);
//! assert_ne!(Generator::new(1, Stream::LaneChanging).uniform(), uniform);
//! ```

use rand::distr::{Distribution, Uniform};
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// What randomness is drawn for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// Positions of a random start.
    Start,
    /// Lane changing.
    LaneChanging,
    /// The vehicles of a share in the driver override at this place in the list.
    DriverOverride(usize),
    /// The vehicles of a share in the action at this place in the list.
    Action(usize),
}

impl Stream {
    /// The number of the cipher's stream.
    fn number(self) -> u64 {
        match self {
            Self::Start => 0,
            Self::LaneChanging => 1,
            Self::DriverOverride(k) => (1 << 40) + k as u64,
            Self::Action(k) => (2 << 40) + k as u64,
        }
    }
}

/// One stream of random numbers.
#[derive(Clone, Debug)]
pub struct Generator(ChaCha8Rng);

impl Generator {
    /// The stream of that seed for that purpose.
    pub fn new(seed: u64, stream: Stream) -> Self {
        let mut cipher = ChaCha8Rng::seed_from_u64(seed);
        cipher.set_stream(stream.number());
        Self(cipher)
    }

    /// Uniform in [0, 1), a multiple of 2⁻⁵³.
    pub fn uniform(&mut self) -> f64 {
        self.0.random()
    }

    /// Exponential with mean 1: −ln(1 − u), finite since u < 1.
    pub fn exponential(&mut self) -> f64 {
        -libm::log1p(-self.uniform())
    }

    /// One of two, with equal probability. (The negation gives the values of version 0.1.)
    pub fn coin(&mut self) -> bool {
        !self.0.random_bool(0.5)
    }

    /// A whole number in 0 … n − 1, every one equally likely.
    ///
    /// # Panics
    /// If n = 0.
    pub fn below(&mut self, n: u64) -> u64 {
        Uniform::new(0, n).expect("a number below 0 was asked for").sample(&mut self.0)
    }

    /// `count` different indices below `n`, ascending, every set equally likely.
    ///
    /// # Panics
    /// If `count` > `n`, or `n` ≥ 2³² − 1.
    pub fn choose(&mut self, count: usize, n: usize) -> Vec<usize> {
        assert!(count <= n && n < u32::MAX as usize, "{count} of {n} indices");
        let mut indices: Vec<u32> = (0..n as u32).collect();
        let (drawn, _) = indices.partial_shuffle(&mut self.0, count);
        let mut chosen = vec![false; n];
        for &k in &*drawn {
            chosen[k as usize] = true;
        }
        (0..n).filter(|&k| chosen[k]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::Rng;

    #[test]
    fn streams_and_seeds_are_separate_and_repeat() {
        let draw = |seed, stream| Generator::new(seed, stream).0.next_u64();
        assert_eq!(draw(1, Stream::Start), draw(1, Stream::Start));
        let all = [
            draw(1, Stream::Start),
            draw(1, Stream::LaneChanging),
            draw(1, Stream::DriverOverride(0)),
            draw(1, Stream::DriverOverride(1)),
            draw(1, Stream::Action(0)),
            draw(2, Stream::Start),
        ];
        for (i, a) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|b| a != b));
        }
    }

    #[test]
    fn means_are_what_they_should_be() {
        let mut generator = Generator::new(7, Stream::Start);
        let n = 100_000;
        let mean = |f: &mut dyn FnMut() -> f64| (0..n).map(|_| f()).sum::<f64>() / f64::from(n);
        // Five standard errors.
        assert!((mean(&mut || generator.uniform()) - 0.5).abs() < 5.0 * 0.2887 / 316.2);
        assert!((mean(&mut || generator.exponential()) - 1.0).abs() < 5.0 / 316.2);
        assert!((mean(&mut || f64::from(u8::from(generator.coin()))) - 0.5).abs() < 5.0 * 0.5 / 316.2);
        assert!((mean(&mut || generator.below(7) as f64) - 3.0).abs() < 5.0 * 2.0 / 316.2);
    }

    #[test]
    fn a_choice_has_the_requested_size() {
        for count in 0..=20 {
            let chosen = Generator::new(count, Stream::DriverOverride(0)).choose(count as usize, 20);
            assert_eq!(chosen.len(), count as usize);
            assert!(chosen.windows(2).all(|w| w[0] < w[1]) && chosen.iter().all(|&k| k < 20));
        }
    }

    /// Every index is chosen equally often, within five standard errors: few of many, many of few, and a small share of a
    /// long list.
    #[test]
    fn every_index_is_equally_likely() {
        for (count, n, draws) in [(3, 30, 20_000_u32), (20, 30, 20_000), (170, 60_000, 3_000)] {
            let mut generator = Generator::new(3, Stream::Action(1));
            // Counted in ten parts of the list.
            let mut parts = [0_u32; 10];
            for _ in 0..draws {
                for k in generator.choose(count, n) {
                    parts[k * 10 / n] += 1;
                }
            }
            let expected = f64::from(draws) * count as f64 / 10.0;
            for part in parts {
                let deviation = (f64::from(part) - expected).abs();
                assert!(deviation < 5.0 * expected.sqrt(), "{parts:?} of {count} in {n}");
            }
        }
    }

    /// The values of this release: where one changes, so do runs, and the version of the crate must be raised.
    #[test]
    fn draws_are_those_of_this_release() {
        let generator = || Generator::new(1, Stream::LaneChanging);
        let words: [u64; 3] = [0xda16_ea55_e3f5_ade7, 0x0d08_a889_e871_fc06, 0x8f0a_6837_389a_34a6];
        let mut draw = generator();
        assert_eq!([(); 3].map(|()| draw.0.next_u64()), words);
        // Uniform, coin and bounded numbers by their definitions, from the same words.
        let mut draw = generator();
        assert_eq!(draw.uniform(), (words[0] >> 11) as f64 / 9_007_199_254_740_992.0);
        assert_eq!(draw.coin(), words[1] >> 63 == 1);
        assert_eq!(draw.below(1000), ((u128::from(words[2]) * 1000) >> 64) as u64);
        assert_eq!(generator().choose(5, 20), [2, 7, 8, 10, 18]);
        assert_eq!(generator().choose(5, 1_000_000), [50_913, 221_102, 851_909, 890_463, 907_987]);
    }
}
