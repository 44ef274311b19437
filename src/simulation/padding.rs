//! Padding: arrays of vehicles are filled up to whole chunks, so that every loop handles whole chunks only.
//!
//! In arrays of the state the padding repeats the first vehicles: a place of the padding is an *image* of a vehicle. What
//! is done to all vehicles chunk by chunk is done to the images too, in the same way, and an image never differs from
//! its vehicle.

use crate::numerics::simd::CHUNK;

/// The number of vehicles, rounded up to whole chunks.
pub(crate) fn padded(vehicles: usize) -> usize {
    vehicles.next_multiple_of(CHUNK)
}

/// The places of a vehicle in padded arrays: its own and those of its images.
pub(crate) fn images(vehicle: usize, vehicles: usize) -> impl Iterator<Item = usize> {
    (vehicle..padded(vehicles)).step_by(vehicles)
}
