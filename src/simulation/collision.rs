//! Stage 2 of a step: collisions, from true headways.
//!
//! Two vehicles touch when their gap, the distance from bumper to bumper, is 0 or less. The smallest gap bounds the time to
//! the next contact: it cannot shrink faster than the fastest vehicle gains on the slowest. So gaps are computed only when
//! the travel since the last computation has used up the smallest one.

use super::attempt_sampler::Sampler;
use super::state::{Collision, Event, Simulation};

/// Share of the smallest gap that is relied on; the rest allows for rounding.
pub(super) const RELIABLE: f64 = 0.999;

impl<S: Sampler> Simulation<S> {
    /// Gap between a vehicle and its leader, bumper to bumper, m: 0 or less where they touch.
    pub(super) fn gap(&self, j: usize) -> f64 {
        let contact =
            0.5 * (self.drivers[j].vehicle_length + self.drivers[self.lane_order.ahead(j)].vehicle_length);
        self.headway(j) - contact
    }

    /// Whether two vehicles may touch, as far as the sums of [`super::travel_bounds`] say.
    #[inline]
    pub(super) fn contact_is_possible(&self) -> bool {
        self.travel.apart() >= self.contact_free_until
    }

    /// Whether vehicles touch. If none do, no contact is possible before the smallest gap is used up.
    pub(super) fn vehicles_touch(&mut self) -> bool {
        let smallest = (0..self.drivers.len()).map(|j| self.gap(j)).fold(f64::INFINITY, f64::min);
        self.contact_free_until = self.travel.apart() + RELIABLE * smallest;
        smallest <= 0.0
    }

    /// Whether a vehicle has moved through its leader.
    pub(super) fn order_is_lost(&self) -> bool {
        (0..self.drivers.len()).any(|j| self.headway(j) <= 0.0)
    }

    /// Ends the run if two vehicles touch; of several pairs the one with the lowest number behind is reported.
    pub(super) fn detect_collision(&mut self) {
        if let Some(behind) = (0..self.drivers.len()).find(|&j| self.gap(j) <= 0.0) {
            let (ahead, lane) = (self.lane_order.ahead(behind), self.lane_order.lane(behind));
            self.collision = Some(Collision { time: self.time(), behind, ahead, lane });
            self.events.push(Event::Collision { behind, ahead, lane });
        }
    }
}
