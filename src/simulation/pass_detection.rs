//! Who has to be looked at closely: where vehicles of adjacent lanes may have come past one another.
//!
//! A vehicle that was looked at knows how far away the nearest ones of the adjacent lanes were, ahead and behind. From
//! then on those ahead have driven at least as far as the slowest of each step, those behind at most as far as the
//! fastest: so nobody need be looked at who has driven less far than that, on either side. Only sums and
//! comparisons, all vehicles at once.

use crate::numerics::simd::{Aligned, CHUNK, Chunk, Width, chunks, kernel};
use crate::simulation::history::padded;

/// How far vehicles may have come, summed over the steps, m.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TravelBounds {
    slowest: f64,
    fastest: f64,
    apart: f64,
    steps: u32,
}

impl TravelBounds {
    /// A step in which the slowest and the fastest vehicle have gone so far.
    #[inline]
    pub(crate) fn advance(&mut self, (slowest, fastest): (f64, f64)) {
        self.slowest += slowest;
        self.fastest += fastest;
        self.apart += fastest - slowest;
        self.steps = self.steps.wrapping_add(1);
    }

    /// So many metres that nobody has gone farther ahead of anybody.
    #[inline]
    pub(crate) fn advance_at_most(&mut self, apart: f64) {
        self.apart += apart;
    }

    /// How far the fastest of each step has gone ahead of the slowest: no two vehicles have come closer by more.
    #[inline]
    pub(crate) fn apart(&self) -> f64 {
        self.apart
    }
}

/// Distance (m) under which rounding might hide a pass, so that it is looked at exactly; far above the rounding of
/// positions, far below a vehicle's length.
pub(crate) const NEAR: f64 = 1e-3;

/// Steps after which everyone is looked at, whatever the sums say: fewer than can add up their rounding to [`NEAR`].
const SURE: u32 = 1024;

/// What is known of each vehicle; padded, where the padding is never due.
#[derive(Clone, Debug)]
pub(crate) struct PassDetection {
    width: Width,
    vehicles: usize,
    /// Due as soon as the vehicle has gone so far ahead of the slowest, m.
    ahead: Aligned,
    /// Due as soon as the fastest has gone so far ahead of the vehicle, m.
    behind: Aligned,
    /// Who is due, a bit a vehicle.
    due: Vec<u8>,
}

kernel! {
    fn mark(s: &[f64], ahead: &[f64], behind: &[f64], slowest: f64, fastest: f64, due: &mut [u8]) {
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
        let mut watch = Self { width: Width::widest(), vehicles, ahead: never.clone(), behind: never, due };
        watch.look_at_all();
        watch
    }

    /// Uses vectors of another width; results stay the same.
    pub(crate) fn set_width(&mut self, width: Width) {
        self.width = width;
    }

    /// One vehicle is due next time.
    #[inline]
    pub(crate) fn look_at(&mut self, j: usize) {
        self.ahead[j] = f64::NEG_INFINITY;
    }

    /// All vehicles are due next time.
    pub(crate) fn look_at_all(&mut self) {
        self.ahead[..self.vehicles].fill(f64::NEG_INFINITY);
    }

    /// A vehicle at displacement `s` has been looked at: the nearest ones of the adjacent lanes are so far ahead of it
    /// and behind it, m.
    #[inline]
    pub(crate) fn looked_at(&mut self, j: usize, s: f64, odometer: TravelBounds, [ahead, behind]: [f64; 2]) {
        // The factor and `NEAR` leave room for rounding.
        self.ahead[j] = (s - odometer.slowest) + 0.999 * (ahead - NEAR);
        self.behind[j] = (odometer.fastest - s) + 0.999 * (behind - NEAR);
    }

    /// Marks who is due at the displacements `s`, a bit a vehicle. The marks are lent: [`Self::give_back`].
    pub(crate) fn take_due(&mut self, s: &[f64], odometer: TravelBounds) -> Vec<u8> {
        if odometer.steps.is_multiple_of(SURE) {
            self.look_at_all();
        }
        mark(self.width, s, &self.ahead, &self.behind, odometer.slowest, odometer.fastest, &mut self.due);
        std::mem::take(&mut self.due)
    }

    /// Takes the marks back.
    pub(crate) fn give_back(&mut self, due: Vec<u8>) {
        self.due = due;
    }
}
