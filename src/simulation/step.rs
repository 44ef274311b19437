//! The step: how a run is built and taken on.
//!
//! Where nothing but car following can happen, equal drivers on one lane within the delay, many steps are taken at once,
//! which saves memory traffic; every step computes the same bits as one by itself.

use super::attempt_sampler::Sampler;
use super::car_following::{CarFollowing, REFRESH, Scene};
use super::collision::RELIABLE;
use super::delays::{Delays, MAX_DISTINCT};
use super::history::History;
use super::lane_order::LaneOrder;
use super::padding::padded;
use super::state::{Simulation, UNKNOWN};
use super::travel_bounds::TravelBounds;
use crate::error::Error;
use crate::numerics::random::{Generator, Stream};
use crate::numerics::simd::{Aligned, Width};
use crate::scenario::Scenario;

/// Fewer steps are not taken at once: finding out whether they can be costs more.
const MIN_STEPS_AT_ONCE: u64 = 8;

/// With more vehicles steps are taken one by one: where memory is the limit, rows are best read one after the other.
const MAX_VEHICLES_AT_ONCE: usize = 4096;

impl Simulation {
    /// The state of a scenario at t = 0, after the actions due then.
    pub fn new(scenario: &Scenario) -> Result<Self, Error> {
        Self::with_sampler(scenario)
    }
}

impl<S: Sampler> Simulation<S> {
    /// The same with a sampler of one's choice.
    pub fn with_sampler(scenario: &Scenario) -> Result<Self, Error> {
        scenario.validate()?;
        let n = scenario.vehicles;
        let drivers = scenario.drivers();
        let delays = Delays::new(drivers.iter().map(|d| scenario.steps(d.reaction_time) as u32).collect());
        let mut agenda = scenario.actions_in_time();
        agenda.reverse();
        let events = if scenario.lanes > 1 { 64 + n.min(4096) } else { 1 };
        let mut simulation = Self {
            step: 0,
            last_step: scenario.last_step(),
            lane_order: LaneOrder::new(scenario),
            history: History::new(n, delays.longest_target()),
            relative: Aligned::filled(0.0, padded(n)),
            nudged: vec![0.0; n],
            braked: Vec::new(),
            frustration: Aligned::filled(0.0, padded(n)),
            frustration_step: Aligned::filled(0.0, padded(n)),
            lane_changes: vec![0; n],
            sampler: S::new(n, scenario.time_step, Generator::new(scenario.seed, Stream::LaneChanging)),
            passes: Vec::with_capacity(events),
            late_passes: Vec::with_capacity(16),
            events: Vec::with_capacity(events),
            events_step: 0,
            collision: None,
            agenda,
            width: Width::widest(),
            travel: TravelBounds::default(),
            max_speed: 0.0,
            max_vehicle_length: 0.0,
            too_dense_until: 0,
            contact_free_until: UNKNOWN,
            car_following: CarFollowing::new(&drivers, padded(n)),
            drivers,
            delays,
            scenario: scenario.clone(),
        };
        simulation.adopt_drivers(&[]);
        simulation.apply_due_actions();
        simulation.perceive(true);
        Ok(simulation)
    }

    /// Steps until that step, or the end.
    pub fn run_to(&mut self, step: u64) {
        while self.step < step && !self.is_finished() {
            if !self.step_many(step) {
                self.step();
            }
        }
    }

    /// One step; does nothing once finished.
    pub fn step(&mut self) {
        if self.is_finished() {
            return;
        }
        self.events.clear();
        self.events_step = self.step;
        let touching = self.contact_is_possible() && self.vehicles_touch();
        if self.scenario.lanes > 1 && !(touching && self.order_is_lost()) {
            self.change_lanes();
        }
        if self.contact_is_possible() {
            self.detect_collision();
            if self.collision.is_some() {
                return;
            }
        }
        self.step += 1;
        self.delays.advance();
        self.move_forward();
    }

    /// Stage 3, to the time of the present step.
    fn move_forward(&mut self) {
        let refresh = self.step.is_multiple_of(REFRESH);
        let acts = self.actions_are_due();
        let dt = self.scenario.time_step;
        let (delays, offset) = (&self.delays, self.lane_order.offsets());
        let distinct = delays.distinct();
        // With delays of a step and more the positions that drivers respond to next are known already, so that positions
        // and speeds can be computed in one go.
        let at_once =
            self.lane_order.is_in_order() && !acts && !distinct.is_empty() && !distinct.contains(&0);
        let car_following = &mut self.car_following;
        let range = self.history.advance(|new, past| {
            let old = past.row(1);
            if !at_once {
                return car_following.drive(old, dt, new);
            }
            let mut rows = [old; MAX_DISTINCT];
            for (row, &delay) in rows.iter_mut().zip(distinct) {
                *row = past.row(delay);
            }
            let scene = Scene { offset, rows: &rows[..distinct.len()], masks: delays.masks() };
            car_following.advance_in_order(old, new, scene, dt, refresh)
        });
        self.travel.advance(range);
        if at_once {
            self.hold_braked();
            return;
        }
        if acts {
            self.apply_due_actions();
        }
        self.perceive(refresh);
    }

    /// Takes as many steps at once as can bring neither an action nor a contact, up to that step, where equal drivers
    /// follow one another on one lane; returns false, with nothing done, where these are too few.
    fn step_many(&mut self, step: u64) -> bool {
        let Some(law) = self.car_following.common_law().filter(|_| self.lane_order.is_in_order()) else {
            return false;
        };
        let Some(delay) = self.delays.common().filter(|_| self.delays.are_settled()) else {
            return false;
        };
        let due = self.agenda.last().map_or(u64::MAX, |&(due, _)| due.saturating_sub(1));
        let last = step.min(self.last_step).min(due);
        let possible = last.saturating_sub(self.step).min(delay as u64);
        let too_many_vehicles = self.drivers.len() > MAX_VEHICLES_AT_ONCE;
        if too_many_vehicles
            || possible < MIN_STEPS_AT_ONCE
            || !self.braked.is_empty()
            || self.history.is_longer_than_needed()
        {
            return false;
        }
        // No vehicle moves farther in a step than this.
        let farthest = self.max_speed * self.scenario.time_step;
        let free_steps = |until: f64, travel: TravelBounds| ((until - travel.apart()) / farthest) as u64;
        let mut steps = free_steps(self.contact_free_until, self.travel);
        if steps < MIN_STEPS_AT_ONCE {
            if self.step < self.too_dense_until {
                return false;
            }
            let smallest = self.car_following.smallest_headway(self.history.now(), self.lane_order.offsets());
            self.contact_free_until = self.travel.apart() + RELIABLE * (smallest - self.max_vehicle_length);
            steps = free_steps(self.contact_free_until, self.travel);
            if steps < 2 * MIN_STEPS_AT_ONCE {
                self.too_dense_until = self.step + REFRESH;
                return false;
            }
        }
        let steps = steps.min(possible);
        let (offset, dt) = (self.lane_order.offsets(), self.scenario.time_step);
        let (car_following, first) = (&mut self.car_following, self.step);
        self.history.advance_many(steps as usize, |rows| {
            car_following.advance_many(law, rows, delay, offset, dt, first, steps as usize);
        });
        self.travel.advance_at_most(steps as f64 * farthest);
        self.step += steps;
        self.events.clear();
        self.events_step = self.step - 1;
        true
    }
}
