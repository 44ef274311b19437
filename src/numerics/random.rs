//! The only source of randomness: ChaCha with 8 rounds, from the crate `rand_chacha`, whose output is promised to
//! be the same on every platform.
//!
//! One seed per scenario; each [`Stream`] is a separate stream of the cipher, so that what is drawn for one purpose
//! never shifts what is drawn for another.

use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

/// What randomness is drawn for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// Positions of a random start.
    Start,
    /// Lane changing.
    LaneChanging,
    /// The vehicles of a share in the exception at this place in the list.
    DriverOverride(usize),
    /// The vehicles of a share in the action at this place in the list.
    Action(usize),
}

impl Stream {
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
        (self.0.next_u64() >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }

    /// Exponential with mean 1: −ln(1 − u), finite since u < 1.
    pub fn exponential(&mut self) -> f64 {
        -libm::log1p(-self.uniform())
    }

    /// One of two, with equal probability.
    pub fn coin(&mut self) -> bool {
        self.0.next_u64() >> 63 == 1
    }

    /// Whole number in 0 … n − 1, without bias: Lemire's multiplication with rejection (2019).
    pub fn below(&mut self, n: u64) -> u64 {
        loop {
            let product = u128::from(self.0.next_u64()) * u128::from(n);
            if product as u64 >= n.wrapping_neg() % n {
                return (product >> 64) as u64;
            }
        }
    }

    /// `count` different indices below `n`, ascending, every set equally likely (Floyd's algorithm).
    pub fn choose(&mut self, count: usize, n: usize) -> Vec<usize> {
        let mut chosen = vec![false; n];
        for j in n - count..n {
            let k = self.below(j as u64 + 1) as usize;
            let new = if chosen[k] { j } else { k };
            chosen[new] = true;
        }
        (0..n).filter(|&k| chosen[k]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
    fn a_choice_has_the_size_asked_for() {
        for count in 0..=20 {
            let chosen = Generator::new(count, Stream::DriverOverride(0)).choose(count as usize, 20);
            assert_eq!(chosen.len(), count as usize);
            assert!(chosen.windows(2).all(|w| w[0] < w[1]) && chosen.iter().all(|&k| k < 20));
        }
    }
}
