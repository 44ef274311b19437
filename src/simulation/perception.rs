//! What the drivers perceive, and the speeds that follow.
//!
//! A driver perceives the headway to the vehicle that is ahead now, both positions as they were one delay ago. Where all
//! drivers have one delay, a single row of the history serves them all.

use super::attempt_sampler::Sampler;
use super::history::History;
use super::state::Simulation;

impl<S: Sampler> Simulation<S> {
    /// Finds what all drivers perceive now, and all speeds; with all exponentials evaluated in full where `refresh` says
    /// so.
    pub(super) fn perceive(&mut self, refresh: bool) {
        let (leaders, offsets) = (self.lane_order.leaders(), self.lane_order.offsets());
        if let Some(delay) = self.delays.common() {
            self.car_following.respond(self.history.row(delay), leaders, offsets, refresh);
        } else {
            find_relative(leaders, self.delays.all(), &self.history, &mut self.relative);
            self.car_following.respond_to_relative(&self.relative, offsets, refresh);
        }
        self.hold_braked();
    }

    /// The same for one vehicle that has got another leader within this step.
    pub(super) fn perceive_new_leader(&mut self, j: usize) {
        let s = self.history.row(self.delays.of(j));
        let relative = s[self.lane_order.ahead(j)] - s[j];
        self.car_following.respond_to_new_leader(j, relative, self.lane_order.offsets()[j]);
        if self.braked.iter().any(|&(braked, _)| braked == j) {
            self.car_following.set_speed(j, 0.0);
        }
    }

    /// Sets the speed of braked vehicles to 0, until the step in which they are released.
    pub(super) fn hold_braked(&mut self) {
        if !self.braked.is_empty() {
            let step = self.step;
            self.braked.retain(|&(_, released)| released > step);
            for &(j, _) in &self.braked {
                self.car_following.set_speed(j, 0.0);
            }
        }
    }
}

/// Displacements of the leaders relative to each vehicle, m, where drivers have different delays.
fn find_relative(leaders: &[u32], delays: &[u32], history: &History, relative: &mut [f64]) {
    for (j, ((relative, &leader), &delay)) in relative.iter_mut().zip(leaders).zip(delays).enumerate() {
        let s = history.row(delay as usize);
        *relative = s[leader as usize] - s[j];
    }
}
