//! A simulation: the only state. Built from a scenario, it steps; it can be read and cloned; its randomness comes
//! from the scenario's seed alone.
//!
//! # One step, in the paper's order
//!
//! 1. Lane changing, vehicle by vehicle in order of number, each change taking effect at once.
//! 2. Collision, from true headways. The first ends the run; the state stays readable.
//! 3. Forward: all positions at once, x += v·dt. Then the actions due at the new time are applied and all speeds are
//!    found from the headways perceived there: between two steps everything can be read as it is at time t = i·dt.
//!
//! # Choices
//!
//! - Where a forward move has carried a vehicle through its leader (headway ≤ 0), the order in the lane is lost
//!   already: stage 1 is left out in that step, and stage 2 reports the collision. So vehicles of one lane never change
//!   order without a reported collision.
//! - Two headways are equal when they differ by no more than rounding may: see [`crate::simulation::frustration::EQUAL`].
//! - A tie between two adjacent lanes is broken by a coin that is tossed at an attempt only.
//! - Nudges move a vehicle past others as driving does: in its own lane that is a collision, in an adjacent one a
//!   pass.
//!
//! # Memory
//!
//! A vehicle takes 8 bytes for every step that the longest delay in use looks back, and for two steps more; beside that 215
//! bytes at most, 275 with several lanes. No step asks for memory.

pub mod attempt_sampler;
pub mod car_following;
pub mod delays;
pub mod frustration;
pub mod history;
pub mod lane_order;
pub(crate) mod pass_detection;

use crate::error::{Error, quoted};
use crate::numerics::random::{Generator, Stream};
use crate::numerics::simd::{Aligned, CHUNK, Width};
use crate::scenario::Scenario;
use crate::scenario::action::{Action, Effect, VehicleSelector};
use crate::scenario::driver::Driver;
use crate::scenario::parameters::RoadField;
use crate::simulation::attempt_sampler::{ExponentialClock, Sampler};
use crate::simulation::car_following::{CarFollowing, REFRESH, Scene};
use crate::simulation::delays::{Delays, FEW};
use crate::simulation::frustration::{Comparison, compare_quietly, compared};
use crate::simulation::history::{History, padded};
use crate::simulation::lane_order::{LaneOrder, Pass, Side};
use crate::simulation::pass_detection::TravelBounds;
use std::ops::Range;

/// A reading that the odometer has always passed: look at once.
const LOOK: f64 = f64::NEG_INFINITY;

/// Fewer steps are not taken at once: finding out whether they can be costs more.
const FEWEST_AT_ONCE: u64 = 8;

/// More vehicles are not driven on: where memory is the limit, rows are best read one after the other.
const MOST_AT_ONCE: usize = 4096;

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
    /// A vehicle has gone to an adjacent lane; its frustration before.
    LaneChange { vehicle: usize, from: usize, to: usize, frustration: f64 },
    /// An attempt failed: the target lane was occupied within the minimum headway.
    Refused { vehicle: usize, from: usize, to: usize, frustration: f64 },
    /// A vehicle in an adjacent lane has passed another.
    Pass { passer: usize, passed: usize },
    /// Two vehicles have touched; the run is over.
    Collision { behind: usize, ahead: usize, lane: usize },
}

/// The state of a run.
#[derive(Clone, Debug)]
pub struct Simulation<S: Sampler = ExponentialClock> {
    scenario: Scenario,
    step: u64,
    last_step: u64,
    drivers: Vec<Driver>,
    ring: LaneOrder,
    history: History,
    /// The history looks farther back than anyone does any more.
    history_is_long: bool,
    delays: Delays,
    following: CarFollowing,
    /// Gaps in the making.
    seen: Aligned,
    /// Sum of the nudges since the start, m.
    nudged: Vec<f64>,
    /// Braked vehicles and the step in which they are released.
    braked: Vec<(usize, u64)>,
    frustration: Aligned,
    /// r·dt of every driver (padded, as φ is).
    frustration_step: Aligned,
    lane_changes: Vec<u32>,
    sampler: S,
    passes: Vec<Pass>,
    late_passes: Vec<Pass>,
    events: Vec<Event>,
    events_step: u64,
    collision: Option<Collision>,
    /// Actions still to come, the next one last: (step, place in the list).
    agenda: Vec<(u64, usize)>,
    width: Width,
    odometer: TravelBounds,
    /// The largest maximum speed, m/s, and the length of the longest vehicle, m.
    fastest: f64,
    longest: f64,
    /// Until this step vehicles are too close for several steps at once.
    dense_until: u64,
    /// How far the fastest must have gone ahead of the slowest before two vehicles can touch, m: see
    /// [`TravelBounds::apart`].
    clear_until: f64,
}

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
        let target = drivers.iter().map(|d| scenario.steps(d.reaction_time) as u32).collect();
        let delays = Delays::new(target);
        let following = CarFollowing::new(&drivers, padded(n));
        let mut agenda = scenario.actions_in_time();
        agenda.reverse();
        let events = if scenario.lanes > 1 { 64 + n.min(4096) } else { 1 };
        let mut simulation = Self {
            step: 0,
            last_step: scenario.last_step(),
            ring: LaneOrder::new(scenario),
            history: History::new(n, delays.longest_target()),
            history_is_long: false,
            seen: Aligned::filled(0.0, padded(n)),
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
            odometer: TravelBounds::default(),
            fastest: 0.0,
            longest: 0.0,
            dense_until: 0,
            clear_until: LOOK,
            drivers,
            delays,
            following,
            scenario: scenario.clone(),
        };
        simulation.know_drivers();
        simulation.apply_due_actions();
        if scenario.lanes > 1 {
            simulation.ring.find_beside(simulation.history.now());
        }
        simulation.look(true);
        Ok(simulation)
    }

    // ---- Reading -----------------------------------------------------------------------------------------------

    /// The scenario, with the actions made live: run again, it gives this state to the last bit.
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
    /// Whether further steps do nothing: a collision, or the end of the scenario.
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
        self.ring.lane(j)
    }
    /// Vehicles in each lane, outermost first.
    pub fn vehicles_per_lane(&self) -> &[usize] {
        self.ring.vehicles_per_lane()
    }
    /// The next vehicle ahead in the lane; itself when alone.
    pub fn leader(&self, j: usize) -> usize {
        self.ring.ahead(j)
    }
    /// The next vehicle behind in the lane; itself when alone.
    pub fn follower(&self, j: usize) -> usize {
        self.ring.behind(j)
    }
    /// The next vehicle ahead in an adjacent lane; none in an empty lane or where there is no lane.
    pub fn adjacent(&self, j: usize, side: Side) -> Option<usize> {
        self.ring.adjacent(j, side, self.history.now())
    }
    /// Displacements since t = 0, nudges after it included, m.
    pub fn displacements(&self) -> &[f64] {
        &self.history.now()[..self.vehicles()]
    }
    /// Position without wrapping: that at the start plus all displacements, m.
    pub fn unwrapped_position(&self, j: usize) -> f64 {
        self.ring.start(j) + self.history.now()[j]
    }
    /// Position in [0, L), m.
    pub fn position(&self, j: usize) -> f64 {
        let x = self.unwrapped_position(j).rem_euclid(self.scenario.length);
        // Rounding may reach L itself.
        if x < self.scenario.length { x } else { 0.0 }
    }
    /// Speed, m/s.
    pub fn speed(&self, j: usize) -> f64 {
        self.following.speeds()[j]
    }
    /// All speeds, m/s.
    pub fn speeds(&self) -> &[f64] {
        &self.following.speeds()[..self.vehicles()]
    }
    /// True headway, m.
    pub fn headway(&self, j: usize) -> f64 {
        self.ring.headway(j, self.history.now())
    }
    /// The headway as the driver sees it now, m.
    pub fn perceived_headway(&self, j: usize) -> f64 {
        self.ring.offsets()[j] + self.following.gaps()[j]
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
    /// The driver as he or she is now.
    pub fn driver(&self, j: usize) -> &Driver {
        &self.drivers[j]
    }
    /// Delay in force, steps.
    pub fn delay_steps(&self, j: usize) -> usize {
        self.delays.of(j)
    }
    /// Bytes of the history of positions.
    pub fn history_bytes(&self) -> usize {
        self.history.bytes()
    }

    // ---- Stepping ----------------------------------------------------------------------------------------------

    /// Steps until that step, or the end.
    pub fn run_to(&mut self, step: u64) {
        while self.step < step && !self.is_finished() {
            if !self.drive_on(step) {
                self.step();
            }
        }
    }

    /// As many steps at once as bring nothing but driving, up to that step, where equal drivers follow one another on one
    /// lane; false if there are too few to be worth it.
    fn drive_on(&mut self, step: u64) -> bool {
        let in_order = self.ring.is_in_order() && self.following.has_one_law();
        let delay = match self.delays.few() {
            &[delay] if in_order && self.delays.are_settled() => delay,
            _ => return false,
        };
        let due = self.agenda.last().map_or(u64::MAX, |&(due, _)| due.saturating_sub(1));
        let last = step.min(self.last_step).min(due);
        let possible = last.saturating_sub(self.step).min(delay as u64);
        let few = self.drivers.len() <= MOST_AT_ONCE;
        if !few || possible < FEWEST_AT_ONCE || !self.braked.is_empty() || self.history_is_long {
            return false;
        }
        // Nobody goes farther in a step than this.
        let farthest = self.fastest * self.scenario.time_step;
        let room =
            |clear_until: f64, odometer: TravelBounds| ((clear_until - odometer.apart()) / farthest) as u64;
        let mut steps = room(self.clear_until, self.odometer);
        if steps < FEWEST_AT_ONCE {
            if self.step < self.dense_until {
                return false;
            }
            let least = self.following.least_headway(self.history.now(), self.ring.offsets());
            self.clear_until = self.odometer.apart() + 0.999 * (least - self.longest);
            steps = room(self.clear_until, self.odometer);
            if steps < 2 * FEWEST_AT_ONCE {
                self.dense_until = self.step + REFRESH;
                return false;
            }
        }
        let steps = steps.min(possible);
        let (offset, dt) = (self.ring.offsets(), self.scenario.time_step);
        self.following.drive_on(&mut self.history, delay, offset, dt, self.step, steps as usize);
        self.odometer.advance_at_most(steps as f64 * farthest);
        self.step += steps;
        self.events.clear();
        self.events_step = self.step - 1;
        true
    }

    /// One step; does nothing once finished.
    pub fn step(&mut self) {
        if self.is_finished() {
            return;
        }
        self.events.clear();
        self.events_step = self.step;
        let touching = self.odometer.apart() >= self.clear_until && !self.find_clearance();
        if self.scenario.lanes > 1 && !(touching && self.order_is_lost()) {
            self.change_lanes();
        }
        if self.odometer.apart() >= self.clear_until {
            self.detect_collision();
            if self.collision.is_some() {
                return;
            }
        }
        self.step += 1;
        self.delays.advance();
        if self.history_is_long {
            self.history.look_back(self.delays.longest_target());
            self.history_is_long = false;
        }
        self.forward();
    }

    /// Stage 3, to the time of the present step.
    fn forward(&mut self) {
        let refresh = self.step.is_multiple_of(REFRESH);
        let acts = self.agenda.last().is_some_and(|&(due, _)| due <= self.step);
        let dt = self.scenario.time_step;
        let offset = self.ring.offsets();
        let (new, past) = self.history.advance();
        let old = past.seen(1);
        let delays = self.delays.few();
        // Where what is seen next is there already, positions and speeds come in one go.
        let at_once = self.ring.is_in_order() && !acts && !delays.is_empty() && !delays.contains(&0);
        if at_once {
            let mut seen = [old; FEW];
            for (row, &delay) in seen.iter_mut().zip(delays) {
                *row = past.seen(delay);
            }
            let scene = Scene { offset, seen: &seen[..delays.len()], chosen: self.delays.chosen() };
            self.odometer.advance(self.following.advance_in_order(old, new, scene, dt, refresh));
            self.history.close();
            self.hold_braked();
        } else {
            self.odometer.advance(self.following.drive(old, dt, new));
            self.history.close();
            if acts {
                self.apply_due_actions();
            }
            self.look(refresh);
        }
    }

    /// What everyone sees now, and the speeds that follow: the vehicle in front now, both where they were the
    /// driver's delay ago.
    fn look(&mut self, refresh: bool) {
        let (leaders, offsets) = (self.ring.leaders(), self.ring.offsets());
        if let Some(delay) = self.delays.common() {
            self.following.respond(self.history.seen(delay), leaders, offsets, refresh);
        } else {
            see_apart(leaders, self.delays.all(), &self.history, &mut self.seen);
            self.following.respond_to_gaps(&self.seen, offsets, refresh);
        }
        self.hold_braked();
    }

    /// Braked vehicles stand still until they are released.
    fn hold_braked(&mut self) {
        if !self.braked.is_empty() {
            let step = self.step;
            self.braked.retain(|&(_, released)| released > step);
            for &(j, _) in &self.braked {
                self.following.set_speed(j, 0.0);
            }
        }
    }

    /// Stage 1.
    fn change_lanes(&mut self) {
        self.passes.clear();
        self.late_passes.clear();
        self.ring.follow_motion(self.odometer, self.history.now(), &mut self.passes);
        let n = self.drivers.len();
        let (mut j, mut next_pass) = (0, 0);
        while j < n {
            // As far as the next vehicle that was passed there are only headways to compare.
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
                Some((k, beside)) => {
                    self.attempt(k, beside);
                    k + 1
                }
                None => passed.max(j + 1),
            };
        }
    }

    /// [`Self::compare`] for vehicles that nobody has passed, as many at once as are quiet.
    fn compare_unpassed(&mut self, vehicles: Range<usize>) -> Option<(usize, [f64; 2])> {
        let Range { start: mut j, end } = vehicles;
        // The padding is always quiet.
        let chunks = if end == self.drivers.len() { padded(end) } else { end } / CHUNK;
        while j < end {
            if j.is_multiple_of(CHUNK)
                && let (Some(delay), Some((clocks, per_step))) = (self.delays.common(), self.sampler.clocks())
            {
                let comparison = Comparison {
                    seen: self.history.seen(delay),
                    beside: self.ring.all_beside(),
                    offsets: self.ring.offsets(),
                    gaps: self.following.gaps(),
                    change: &self.frustration_step,
                };
                let mut next = j / CHUNK;
                compare_quietly(
                    self.width,
                    comparison,
                    &mut self.frustration,
                    clocks,
                    per_step,
                    &mut next,
                    chunks,
                );
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

    /// Rules 1 and 2 for vehicles that have been passed by `passes` others each, then rule 3, up to the first that
    /// attempts a lane change: which, and the headways it perceives in the adjacent lanes.
    fn compare(&mut self, vehicles: Range<usize>, passes: u32) -> Option<(usize, [f64; 2])> {
        let (history, delays) = (&self.history, &self.delays);
        let common = delays.common().map(|delay| history.seen(delay));
        let (offsets, gaps) = (self.ring.offsets(), self.following.gaps());
        for j in vehicles {
            let seen = match common {
                Some(row) => row,
                None => history.seen(delays.of(j)),
            };
            let [outer, inner] = Side::BOTH.map(|side| self.ring.beside(j, side).distance(j, seen));
            let best = if outer > inner { outer } else { inner };
            let mut frustration =
                compared(self.frustration[j], offsets[j] + gaps[j], best, self.frustration_step[j]);
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

    /// Whether a pass counts for rule 3 (1) or not (0): where the passer is in an adjacent lane now.
    #[cold]
    fn count_pass(&mut self, pass: Pass) -> u32 {
        let (passer, passed) = (pass.passer as usize, pass.passed as usize);
        if self.ring.lane(passer).abs_diff(self.ring.lane(passed)) != 1 {
            return 0;
        }
        self.events.push(Event::Pass { passer, passed });
        1
    }

    /// An attempt, aimed at the better adjacent lane.
    #[cold]
    fn attempt(&mut self, j: usize, [outer, inner]: [f64; 2]) {
        let side =
            if outer > inner || (outer == inner && self.sampler.coin()) { Side::Outer } else { Side::Inner };
        let from = self.ring.lane(j);
        let to = self.ring.lane_beside(j, side).expect("the better lane exists");
        let frustration = self.frustration[j];
        let s = self.history.now();
        let gap = self.drivers[j].min_headway;
        let beside = self.ring.beside(j, side);
        if let Some(ahead) = beside.vehicle() {
            let behind = self.ring.behind(ahead);
            let free = beside.distance(j, s) > gap && self.ring.distance_behind(behind, j, s) > gap;
            if !free {
                self.events.push(Event::Refused { vehicle: j, from, to, frustration });
                return;
            }
        }
        let follower = self.ring.behind(j);
        self.ring.change_lane(j, side, self.history.seen(1), s, &mut self.late_passes);
        self.events.push(Event::LaneChange { vehicle: j, from, to, frustration });
        self.frustration[j] = 0.0;
        self.lane_changes[j] += 1;
        for vehicle in [follower, self.ring.behind(j), j] {
            self.look_again(vehicle);
            self.clear_until = self.clear_until.min(self.odometer.apart() + 0.999 * self.clearance(vehicle));
        }
    }

    /// One vehicle has another leader within this step.
    fn look_again(&mut self, j: usize) {
        let seen = self.history.seen(self.delays.of(j));
        let gap = seen[self.ring.ahead(j)] - seen[j];
        self.following.respond_to_another(j, gap, self.ring.offsets()[j]);
        if self.braked.iter().any(|&(braked, _)| braked == j) {
            self.following.set_speed(j, 0.0);
        }
    }

    /// Distance between a vehicle and its leader, bumper to bumper, m: 0 or less where they touch.
    fn clearance(&self, j: usize) -> f64 {
        let contact =
            0.5 * (self.drivers[j].vehicle_length + self.drivers[self.ring.ahead(j)].vehicle_length);
        self.headway(j) - contact
    }

    /// Whether nobody touches; the closest pair tells for how long nobody can. The factor leaves room for rounding.
    fn find_clearance(&mut self) -> bool {
        let closest = (0..self.drivers.len()).map(|j| self.clearance(j)).fold(f64::INFINITY, f64::min);
        self.clear_until = self.odometer.apart() + 0.999 * closest;
        closest > 0.0
    }

    /// Whether a vehicle has gone through its leader.
    fn order_is_lost(&self) -> bool {
        (0..self.drivers.len()).any(|j| self.headway(j) <= 0.0)
    }

    /// Stage 2, where somebody may touch: the lowest number behind.
    fn detect_collision(&mut self) {
        if let Some(behind) = (0..self.drivers.len()).find(|&j| self.clearance(j) <= 0.0) {
            let (ahead, lane) = (self.ring.ahead(behind), self.ring.lane(behind));
            self.collision = Some(Collision { time: self.time(), behind, ahead, lane });
            self.events.push(Event::Collision { behind, ahead, lane });
        }
    }

    // ---- Acting ------------------------------------------------------------------------------------------------

    /// Does something now: `at` becomes the present time, and the action is added to the scenario, so that a
    /// replay gives the same bits. A refused action changes nothing; after a collision every action is refused, since
    /// a replay would make it before.
    pub fn act(&mut self, mut action: Action) -> Result<(), Error> {
        action.at = self.scenario.time_of(self.step);
        if self.collision.is_some() {
            return Err(Error::conflict("action", quoted(&action.to_string()), "none after a collision"));
        }
        self.scenario.check_action(&action)?;
        let index = self.scenario.actions.len();
        let members = self.scenario.selected(action.vehicles, Stream::Action(index));
        let mut longest = 0.0_f64;
        for &j in &members {
            let mut driver = self.drivers[j];
            for effect in &action.effects {
                if let Effect::Set(field, value) = *effect {
                    driver.set(field, value);
                }
            }
            driver.check()?;
            longest = longest.max(driver.reaction_time);
        }
        self.scenario.check_history(longest)?;
        self.scenario.actions.push(action);
        self.apply(index);
        if self.step == 0 && self.scenario.lanes > 1 {
            self.ring.find_beside(self.history.now());
        }
        self.look(false);
        Ok(())
    }

    /// Takes out of the scenario what was done in this step and is undone by the last [`Self::act`]: a replay gives
    /// the same bits with fewer actions.
    pub fn forget_replaced(&mut self) {
        let Some((last, before)) = self.scenario.actions.split_last() else { return };
        // A share is drawn by its place in the list, which therefore stays.
        let first =
            before.iter().rposition(|a| matches!(a.vehicles, VehicleSelector::Share(_))).map_or(0, |k| k + 1);
        let replaced = |&k: &usize| {
            self.scenario.steps(before[k].at) == self.step
                && self.scenario.steps(last.at) == self.step
                && last.replaces(&before[k])
        };
        let places: Vec<usize> = (first..before.len()).rev().filter(replaced).collect();
        for k in places {
            let mut fewer = self.scenario.clone();
            fewer.actions.remove(k);
            // What came in between may hold only because of it: a headway that fits a shorter vehicle.
            if fewer.validate().is_ok() {
                self.scenario = fewer;
                for (_, index) in &mut self.agenda {
                    *index -= usize::from(*index > k);
                }
            }
        }
    }

    /// Computes with vectors of another width; results stay the same to the last bit.
    pub fn set_width(&mut self, width: Width) {
        self.width = width;
        self.following.set_width(width);
        self.ring.set_width(width);
    }

    /// Moves the end of the run, s.
    pub fn set_until(&mut self, until: f64) -> Result<(), Error> {
        self.scenario.set(RoadField::Until.parameter(), until)?;
        self.last_step = self.scenario.last_step();
        Ok(())
    }

    fn apply_due_actions(&mut self) {
        while let Some(&(due, index)) = self.agenda.last() {
            if due > self.step {
                return;
            }
            self.agenda.pop();
            self.apply(index);
        }
    }

    fn apply(&mut self, index: usize) {
        let Action { vehicles, effects, .. } = self.scenario.actions[index].clone();
        let mut any_set = false;
        for j in self.scenario.selected(vehicles, Stream::Action(index)) {
            for &effect in &effects {
                match effect {
                    Effect::Set(field, value) => {
                        any_set = true;
                        self.drivers[j].set(field, value);
                        self.following.set_driver(j, &self.drivers[j]);
                        let target = self.scenario.steps(self.drivers[j].reaction_time) as u32;
                        self.delays.set_target(j, target);
                    }
                    Effect::Brake(seconds) => {
                        self.braked.push((j, self.step + self.scenario.steps(seconds)));
                    }
                    Effect::Nudge(metres) => self.nudge(j, metres),
                }
            }
        }
        if any_set {
            self.know_drivers();
        }
    }

    fn nudge(&mut self, j: usize, metres: f64) {
        if self.step == 0 {
            self.ring.nudge_start(j, metres);
        } else {
            self.history.displace(j, metres);
            self.nudged[j] += metres;
        }
        self.following.invalidate(j);
        self.following.invalidate(self.ring.behind(j));
        self.clear_until = LOOK;
        self.ring.watch_all();
    }

    /// What is known of all drivers together.
    fn know_drivers(&mut self) {
        self.following.find_common_law(&self.drivers);
        self.delays.find_few();
        // Longer at once, shorter with the next step only: another action of this step may bring back what this one
        // took away.
        let longest = self.delays.longest_target();
        self.history.look_back(longest.max(self.history.looks_back()));
        self.history_is_long = longest < self.history.looks_back();
        let dt = self.scenario.time_step;
        for (step, driver) in self.frustration_step.iter_mut().zip(&self.drivers) {
            *step = driver.frustration_rate * dt;
        }
        let largest = |of: fn(&Driver) -> f64| self.drivers.iter().map(of).fold(0.0, f64::max);
        (self.fastest, self.longest) = (largest(|d| d.max_speed), largest(|d| d.vehicle_length));
        self.clear_until = LOOK;
    }
}

/// Gaps that drivers with delays of their own see.
fn see_apart(leaders: &[u32], delays: &[u32], history: &History, gaps: &mut [f64]) {
    for (j, ((gap, &leader), &delay)) in gaps.iter_mut().zip(leaders).zip(delays).enumerate() {
        let seen = history.seen(delay as usize);
        *gap = seen[leader as usize] - seen[j];
    }
}
