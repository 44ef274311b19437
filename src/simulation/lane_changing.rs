//! Stage 1 of a step: lane changing, vehicle by vehicle in order of number, each change taking effect at once.
//!
//! First the adjacent leaders are brought up to date, which tells the passes since the step before. Then every vehicle
//! compares its perceived headway with the better one of the adjacent lanes, which changes its frustration (rules 1 and 2
//! of [`super::frustration`]); passes add to it (rule 3); and the sampler decides whether it attempts a lane change. Almost
//! always nothing more happens. So vehicles that were not passed are handled a chunk at a time, up to the first chunk with
//! an attempt in it; the others one by one. Both ways compute the same bits.

use super::attempt_sampler::Sampler;
use super::collision::RELIABLE;
use super::frustration::{Comparison, compare_chunks, compared};
use super::lane_order::{Pass, Side};
use super::padding::padded;
use super::state::{Event, Simulation};
use crate::numerics::simd::CHUNK;
use std::ops::Range;

impl<S: Sampler> Simulation<S> {
    /// The whole stage.
    pub(super) fn change_lanes(&mut self) {
        self.passes.clear();
        self.late_passes.clear();
        self.lane_order.follow_motion(self.travel, self.history.now(), &mut self.passes);
        let n = self.drivers.len();
        let (mut j, mut next_pass) = (0, 0);
        while j < n {
            // The next vehicle that was passed; the ones before it have only headways to compare.
            let passed = if self.late_passes.is_empty() {
                self.passes.get(next_pass).map_or(n, |pass| pass.passed as usize)
            } else {
                j
            };
            let attempt = if j < passed {
                self.compare_unpassed(j..passed)
            } else {
                let mut count = 0;
                while let Some(&pass) = self.passes.get(next_pass).filter(|p| p.passed as usize == j) {
                    next_pass += 1;
                    count += self.count_pass(pass);
                }
                for k in 0..self.late_passes.len() {
                    if self.late_passes[k].passed as usize == j {
                        count += self.count_pass(self.late_passes[k]);
                    }
                }
                self.compare(j..j + 1, count)
            };
            j = match attempt {
                Some((k, adjacent)) => {
                    self.attempt(k, adjacent);
                    k + 1
                }
                None => passed.max(j + 1),
            };
        }
    }

    /// [`Self::compare`] for vehicles that were not passed: whole chunks at a time as far as no vehicle attempts a change.
    fn compare_unpassed(&mut self, vehicles: Range<usize>) -> Option<(usize, [f64; 2])> {
        let Range { start: mut j, end } = vehicles;
        // In the padding there are no attempts.
        let chunks = if end == self.drivers.len() { padded(end) } else { end } / CHUNK;
        while j < end {
            if j.is_multiple_of(CHUNK)
                && let (Some(delay), Some((clocks, per_step))) = (self.delays.common(), self.sampler.clocks())
            {
                let comparison = Comparison {
                    perceived: self.history.row(delay),
                    adjacent: self.lane_order.adjacent_leaders(),
                    offsets: self.lane_order.offsets(),
                    relative: self.car_following.relative_displacements(),
                    change: &self.frustration_step,
                };
                let frustration = &mut self.frustration;
                let mut next = j / CHUNK;
                compare_chunks(self.width, comparison, frustration, clocks, per_step, &mut next, chunks);
                j = next * CHUNK;
            }
            let stop = (j + 1).next_multiple_of(CHUNK).min(end);
            if j < stop {
                let attempt = self.compare(j..stop, 0);
                if attempt.is_some() {
                    return attempt;
                }
                j = stop;
            }
        }
        None
    }

    /// Rules 1 and 2 for vehicles that were passed by `passes` others each, then rule 3, up to the first that attempts a
    /// lane change: that vehicle, and the headways it perceives in the outer and the inner adjacent lane.
    fn compare(&mut self, vehicles: Range<usize>, passes: u32) -> Option<(usize, [f64; 2])> {
        let (history, delays) = (&self.history, &self.delays);
        let common = delays.common().map(|delay| history.row(delay));
        let (offsets, relative) = (self.lane_order.offsets(), self.car_following.relative_displacements());
        for j in vehicles {
            let perceived = match common {
                Some(row) => row,
                None => history.row(delays.of(j)),
            };
            let [outer, inner] =
                Side::BOTH.map(|side| self.lane_order.adjacent_leader(j, side).distance(j, perceived));
            let best = if outer > inner { outer } else { inner };
            let mut frustration =
                compared(self.frustration[j], offsets[j] + relative[j], best, self.frustration_step[j]);
            for _ in 0..passes {
                frustration += self.drivers[j].pass_frustration;
            }
            self.frustration[j] = frustration;
            if self.sampler.attempts(j, frustration) {
                return Some((j, [outer, inner]));
            }
        }
        None
    }

    /// Whether a pass counts for rule 3 (1) or not (0): it does if the passer is in an adjacent lane now.
    #[cold]
    fn count_pass(&mut self, pass: Pass) -> u32 {
        let (passer, passed) = (pass.passer as usize, pass.passed as usize);
        if self.lane_order.lane(passer).abs_diff(self.lane_order.lane(passed)) != 1 {
            return 0;
        }
        self.events.push(Event::Pass { passer, passed });
        1
    }

    /// An attempt to change to the adjacent lane with the larger perceived headway.
    #[cold]
    fn attempt(&mut self, j: usize, [outer, inner]: [f64; 2]) {
        let side =
            if outer > inner || (outer == inner && self.sampler.coin()) { Side::Outer } else { Side::Inner };
        let from = self.lane_order.lane(j);
        let to = self.lane_order.adjacent_lane(j, side).expect("the better lane exists");
        let frustration = self.frustration[j];
        let s = self.history.now();
        let min_headway = self.drivers[j].min_headway;
        let leader = self.lane_order.adjacent_leader(j, side);
        if let Some(ahead) = leader.vehicle() {
            let behind = self.lane_order.behind(ahead);
            let free = leader.distance(j, s) > min_headway
                && self.lane_order.distance_behind(behind, j, s) > min_headway;
            if !free {
                self.events.push(Event::Refused { vehicle: j, from, to, frustration });
                return;
            }
        }
        let follower = self.lane_order.behind(j);
        self.lane_order.change_lane(j, side, self.history.row(1), s, &mut self.late_passes);
        self.events.push(Event::LaneChange { vehicle: j, from, to, frustration });
        self.frustration[j] = 0.0;
        self.lane_changes[j] += 1;
        for vehicle in [follower, self.lane_order.behind(j), j] {
            self.perceive_new_leader(vehicle);
            let contact = self.travel.apart() + RELIABLE * self.gap(vehicle);
            self.contact_free_until = self.contact_free_until.min(contact);
        }
    }
}
