//! Which vehicles must be checked for passes: those that may have passed, or been passed by, a vehicle of an adjacent lane.
//!
//! A check finds how far away the nearest vehicles of the adjacent lanes are, ahead and behind. From then on the ones
//! ahead move at least as far as the slowest vehicle in every step, and the ones behind at most as far as the fastest. As
//! long as the vehicle itself stays within these two bounds nothing can have passed, and it needs no check; else it
//! is *due*. Finding the vehicles that are due takes sums and comparisons only, for a chunk of vehicles at once.

use super::padding::padded;
use super::travel_bounds::TravelBounds;
use crate::numerics::simd::{Aligned, CHUNK, Chunk, Width, chunks, kernel};

/// Distance (m) below which rounding might hide a pass, so that the exact comparison is made: far above the rounding of
/// positions, far below the length of a vehicle.
pub(crate) const ROUNDING_MARGIN: f64 = 1e-3;

/// After so many steps all vehicles are due, whatever the sums say: fewer steps than it takes to add up the rounding of
/// the sums to [`ROUNDING_MARGIN`].
const CHECK_ALL_EVERY: u32 = 1024;

/// When each vehicle is due next; arrays are padded, and the padding is never due.
#[derive(Clone, Debug)]
pub(crate) struct PassDetection {
    width: Width,
    vehicles: usize,
    /// A vehicle is due when its displacement exceeds that of the slowest by so much, m.
    ahead: Aligned,
    /// A vehicle is due when the displacement of the fastest exceeds its own by so much, m.
    behind: Aligned,
    /// One bit a vehicle: whether it is due.
    due: Vec<u8>,
}

/// Goes through the vehicles that are due. It holds no borrow, so that they can be checked on the way.
pub(crate) struct DueVehicles {
    chunk: usize,
    /// The bits of that chunk that are left.
    bits: u8,
}

impl DueVehicles {
    /// The next one, in order of number.
    #[inline]
    pub(crate) fn next(&mut self, detection: &PassDetection) -> Option<usize> {
        while self.bits == 0 {
            self.chunk += 1;
            self.bits = *detection.due.get(self.chunk)?;
        }
        let j = self.chunk * CHUNK + self.bits.trailing_zeros() as usize;
        self.bits &= self.bits - 1;
        Some(j)
    }
}

kernel! {
    fn mark_due(s: &[f64], ahead: &[f64], behind: &[f64], slowest: f64, fastest: f64, due: &mut [u8]) {
        let count = due.len();
        let (s, ahead, behind) = (&chunks(s)[..count], &chunks(ahead)[..count], &chunks(behind)[..count]);
        let (slowest, fastest) = (Chunk::splat(slowest), Chunk::splat(fastest));
        for k in 0..count {
            let s = Chunk::load(&s[k]);
            due[k] = (s - slowest).reaches(Chunk::load(&ahead[k])) | (fastest - s).reaches(Chunk::load(&behind[k]));
        }
    }
}

impl PassDetection {
    /// For so many vehicles, all due.
    pub(crate) fn new(vehicles: usize) -> Self {
        let never = Aligned::filled(f64::INFINITY, padded(vehicles));
        let due = vec![0; padded(vehicles) / CHUNK];
        let mut detection =
            Self { width: Width::widest(), vehicles, ahead: never.clone(), behind: never, due };
        detection.require_all();
        detection
    }

    /// Uses vectors of another width; results stay the same.
    pub(crate) fn set_width(&mut self, width: Width) {
        self.width = width;
    }

    /// Makes one vehicle due.
    #[inline]
    pub(crate) fn require(&mut self, j: usize) {
        self.ahead[j] = f64::NEG_INFINITY;
    }

    /// Makes all vehicles due.
    pub(crate) fn require_all(&mut self) {
        self.ahead[..self.vehicles].fill(f64::NEG_INFINITY);
    }

    /// Vehicle j at displacement `s` (m) has been checked: the nearest vehicles of the adjacent lanes are so far ahead of
    /// it and behind it, m.
    #[inline]
    pub(crate) fn checked(&mut self, j: usize, s: f64, travel: TravelBounds, [ahead, behind]: [f64; 2]) {
        // The factor and the margin allow for rounding.
        self.ahead[j] = (s - travel.slowest()) + 0.999 * (ahead - ROUNDING_MARGIN);
        self.behind[j] = (travel.fastest() - s) + 0.999 * (behind - ROUNDING_MARGIN);
    }

    /// Finds the vehicles that are due at the displacements `s` (m, padded).
    pub(crate) fn find_due(&mut self, s: &[f64], travel: TravelBounds) -> DueVehicles {
        if travel.steps().is_multiple_of(CHECK_ALL_EVERY) {
            self.require_all();
        }
        let (slowest, fastest) = (travel.slowest(), travel.fastest());
        mark_due(self.width, s, &self.ahead, &self.behind, slowest, fastest, &mut self.due);
        DueVehicles { chunk: 0, bits: self.due.first().copied().unwrap_or(0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn due(detection: &mut PassDetection, s: &[f64], travel: TravelBounds) -> Vec<usize> {
        let mut due = detection.find_due(s, travel);
        std::iter::from_fn(|| due.next(detection)).collect()
    }

    #[test]
    fn a_vehicle_is_due_when_the_bounds_allow_a_pass() {
        let n = 2 * CHUNK + 1;
        let mut detection = PassDetection::new(n);
        let mut travel = TravelBounds::default();
        let mut s = vec![0.0; padded(n)];
        assert_eq!(due(&mut detection, &s, travel), (0..n).collect::<Vec<_>>(), "all at first");
        (0..n).for_each(|j| detection.checked(j, 0.0, travel, [10.0, 10.0]));
        // Nine metres more than the slowest, ten more.
        travel.advance((0.0, 9.0));
        (s[1], s[n - 1]) = (9.0, 9.0);
        assert!(due(&mut detection, &s, travel).is_empty());
        travel.advance((0.0, 1.0));
        s[n - 1] = 10.0;
        let expected: Vec<_> = (0..n).filter(|&j| j != 1).collect();
        assert_eq!(
            due(&mut detection, &s, travel),
            expected,
            "the fastest is 10 m beyond all but the second"
        );
        detection.require(1);
        assert!(due(&mut detection, &s, travel).contains(&1));
    }
}
