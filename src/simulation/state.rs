//! The state of a run: what it holds and how it is read.
//!
//! Between two steps everything can be read as it is at time t = i·dt: positions, the headways that drivers perceive
//! then, and the speeds that follow from them. Vehicles are indices from 0 (vehicle 1 of a scenario is index 0), lanes count
//! from 0, the outermost one.

use super::attempt_sampler::{ExponentialClock, Sampler};
use super::car_following::CarFollowing;
use super::delays::Delays;
use super::history::History;
use super::lane_order::{LaneOrder, Pass, Side};
use super::travel_bounds::TravelBounds;
use crate::numerics::simd::{Aligned, Width};
use crate::scenario::Scenario;
use crate::scenario::driver::Driver;

/// Two vehicles have touched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Collision {
    /// Time, s.
    pub time: f64,
    /// Index of the vehicle behind.
    pub behind: usize,
    /// Index of the vehicle ahead.
    pub ahead: usize,
    /// Lane, from 0.
    pub lane: usize,
}

/// Something that happened in the last step. Vehicles are indices, lanes count from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // the fields are the words of the sentence above them
pub enum Event {
    /// A vehicle has changed to an adjacent lane; its frustration before.
    LaneChange { vehicle: usize, from: usize, to: usize, frustration: f64 },
    /// An attempt failed: a vehicle of the target lane was within the minimum headway, ahead or behind.
    Refused { vehicle: usize, from: usize, to: usize, frustration: f64 },
    /// A vehicle in an adjacent lane has passed another.
    Pass { passer: usize, passed: usize },
    /// Two vehicles have touched; the run is over.
    Collision { behind: usize, ahead: usize, lane: usize },
}

/// The state of a run. Built from a scenario, it steps, and can be read and cloned; the type parameter says how attempts
/// to change lanes are drawn.
#[derive(Clone, Debug)]
pub struct Simulation<S: Sampler = ExponentialClock> {
    pub(super) scenario: Scenario,
    pub(super) step: u64,
    pub(super) last_step: u64,
    pub(super) drivers: Vec<Driver>,
    pub(super) lane_order: LaneOrder,
    pub(super) history: History,
    pub(super) delays: Delays,
    pub(super) car_following: CarFollowing,
    /// Perceived displacements relative to the leaders, m, while they are being found (padded).
    pub(super) relative: Aligned,
    /// Sum of the nudges after t = 0, m.
    pub(super) nudged: Vec<f64>,
    /// Braked vehicles and the step in which they are released.
    pub(super) braked: Vec<(usize, u64)>,
    /// φ (padded).
    pub(super) frustration: Aligned,
    /// r·dt of every driver (padded).
    pub(super) frustration_step: Aligned,
    pub(super) lane_changes: Vec<u32>,
    pub(super) sampler: S,
    /// Passes of the present step, in order of the vehicle that was passed.
    pub(super) passes: Vec<Pass>,
    /// Passes that count because of a lane change in the present step.
    pub(super) late_passes: Vec<Pass>,
    pub(super) events: Vec<Event>,
    pub(super) events_step: u64,
    pub(super) collision: Option<Collision>,
    /// Actions to come as (step, place in the list), the next one last.
    pub(super) agenda: Vec<(u64, usize)>,
    pub(super) width: Width,
    pub(super) travel: TravelBounds,
    /// The largest maximum speed, m/s.
    pub(super) max_speed: f64,
    /// The length of the longest vehicle, m.
    pub(super) max_vehicle_length: f64,
    /// Until this step vehicles are too close to one another for several steps at once.
    pub(super) too_dense_until: u64,
    /// As long as [`TravelBounds::apart`] is below this, no two vehicles can touch, m.
    pub(super) contact_free_until: f64,
}

/// Value of `contact_free_until` where the headways must be examined first.
pub(super) const UNKNOWN: f64 = f64::NEG_INFINITY;

impl<S: Sampler> Simulation<S> {
    /// The scenario, with the actions made while running: run again, it gives this state to the last bit.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }
    /// Steps taken, i.
    pub fn step_index(&self) -> u64 {
        self.step
    }
    /// t = i·dt, s.
    pub fn time(&self) -> f64 {
        self.step as f64 * self.scenario.time_step
    }
    /// Whether further steps do nothing: after a collision, or at the end of the scenario.
    pub fn is_finished(&self) -> bool {
        self.collision.is_some() || self.step >= self.last_step
    }
    /// The collision that ended the run.
    pub fn collision(&self) -> Option<Collision> {
        self.collision
    }
    /// What happened in the last step taken, in order.
    pub fn events(&self) -> &[Event] {
        &self.events
    }
    /// Time of the [`Self::events`]: that at which the last step started, s.
    pub fn events_time(&self) -> f64 {
        self.events_step as f64 * self.scenario.time_step
    }
    /// Number of vehicles.
    pub fn vehicles(&self) -> usize {
        self.drivers.len()
    }
    /// The lane of a vehicle, from 0.
    pub fn lane(&self, j: usize) -> usize {
        self.lane_order.lane(j)
    }
    /// Vehicles in each lane, outermost first.
    pub fn vehicles_per_lane(&self) -> &[usize] {
        self.lane_order.vehicles_per_lane()
    }
    /// The next vehicle ahead in the lane; itself when alone.
    pub fn leader(&self, j: usize) -> usize {
        self.lane_order.ahead(j)
    }
    /// The next vehicle behind in the lane; itself when alone.
    pub fn follower(&self, j: usize) -> usize {
        self.lane_order.behind(j)
    }
    /// The adjacent leader on that side: the next vehicle ahead in the adjacent lane; none in an empty lane or where there is
    /// no lane.
    pub fn adjacent(&self, j: usize, side: Side) -> Option<usize> {
        self.lane_order.adjacent(j, side, self.history.now())
    }
    /// Displacements, m: the distances moved since t = 0, nudges after t = 0 included.
    pub fn displacements(&self) -> &[f64] {
        &self.history.now()[..self.vehicles()]
    }
    /// Position without wrapping: that at the start plus the displacement, m.
    pub fn unwrapped_position(&self, j: usize) -> f64 {
        self.lane_order.start(j) + self.history.now()[j]
    }
    /// Position in [0, L), m.
    pub fn position(&self, j: usize) -> f64 {
        let x = self.unwrapped_position(j).rem_euclid(self.scenario.length);
        // Rounding may reach L itself.
        if x < self.scenario.length { x } else { 0.0 }
    }
    /// Speed, m/s.
    pub fn speed(&self, j: usize) -> f64 {
        self.car_following.speeds()[j]
    }
    /// All speeds, m/s.
    pub fn speeds(&self) -> &[f64] {
        &self.car_following.speeds()[..self.vehicles()]
    }
    /// True headway, m: the distance from centre to centre of the vehicle ahead in the lane.
    pub fn headway(&self, j: usize) -> f64 {
        self.lane_order.headway(j, self.history.now())
    }
    /// Perceived headway, m: to the vehicle ahead now, both positions as they were one delay ago.
    pub fn perceived_headway(&self, j: usize) -> f64 {
        self.lane_order.offsets()[j] + self.car_following.relative_displacements()[j]
    }
    /// φ.
    pub fn frustration(&self, j: usize) -> f64 {
        self.frustration[j]
    }
    /// Distance driven since t = 0, nudges excluded, m.
    pub fn distance(&self, j: usize) -> f64 {
        self.history.now()[j] - self.nudged[j]
    }
    /// Lane changes since t = 0.
    pub fn lane_changes(&self, j: usize) -> u32 {
        self.lane_changes[j]
    }
    /// The driver, with the parameters in force now.
    pub fn driver(&self, j: usize) -> &Driver {
        &self.drivers[j]
    }
    /// Delay in force, steps.
    pub fn delay_steps(&self, j: usize) -> usize {
        self.delays.of(j)
    }
    /// Bytes of the history of displacements.
    pub fn history_bytes(&self) -> usize {
        self.history.bytes()
    }
}
