//! How far the slowest and the fastest vehicle may have travelled, as sums over the steps.
//!
//! In every step the smallest and the largest distance that a vehicle has moved are known. Their sums bound the motion of
//! every vehicle: one that was h ahead of another cannot be reached before the sum of (largest − smallest) is h. So
//! passes and collisions need to be looked for only where such a sum allows one.

/// Distances summed over the steps, m.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TravelBounds {
    slowest: f64,
    fastest: f64,
    apart: f64,
    steps: u32,
}

impl TravelBounds {
    /// Adds a step in which the slowest and the fastest vehicle have moved so far.
    #[inline]
    pub(crate) fn advance(&mut self, (slowest, fastest): (f64, f64)) {
        self.slowest += slowest;
        self.fastest += fastest;
        self.apart += fastest - slowest;
        self.steps = self.steps.wrapping_add(1);
    }

    /// Adds steps in which no vehicle has moved farther than another by more than `apart` metres. On one lane only, where
    /// nothing but [`Self::apart`] is used.
    #[inline]
    pub(crate) fn advance_at_most(&mut self, apart: f64) {
        self.apart += apart;
    }

    /// No vehicle has moved less.
    #[inline]
    pub(crate) fn slowest(&self) -> f64 {
        self.slowest
    }

    /// No vehicle has moved farther.
    #[inline]
    pub(crate) fn fastest(&self) -> f64 {
        self.fastest
    }

    /// The sum over the steps of the difference between fastest and slowest: no headway has become smaller by more.
    #[inline]
    pub(crate) fn apart(&self) -> f64 {
        self.apart
    }

    /// Steps added by [`Self::advance`].
    #[inline]
    pub(crate) fn steps(&self) -> u32 {
        self.steps
    }
}
