//! The twin: a second implementation of lane changing, slow and as close to the sentences of the model as possible. It
//! keeps every position since t = 0, searches all vehicles whenever it needs one, and shares with the fast code the
//! sampler and the start only.
//!
//! The distances that vehicles move in a step are checked against the law of speed and then taken over from the fast
//! code to the last bit; so the comparison does not depend on how an exponential is rounded.

use ringroad::numerics::random::{Generator, Stream};
use ringroad::scenario::action::{Action, Effect, VehicleSelector};
use ringroad::scenario::driver::Driver;
use ringroad::scenario::{Scenario, Start};
use ringroad::simulation::Side;
use ringroad::simulation::attempt_sampler::Sampler;
use ringroad::simulation::frustration::EQUAL;
use ringroad::simulation::{Event, Simulation};

/// A vehicle ahead: it is `constant + s_it − s_own` metres away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ahead {
    pub vehicle: usize,
    pub constant: f64,
}

pub struct Twin<S> {
    pub scenario: Scenario,
    pub step: usize,
    pub drivers: Vec<Driver>,
    /// Unwrapped positions at the start.
    x0: Vec<f64>,
    /// Driven and nudged since t = 0: by step, then by vehicle.
    s: Vec<Vec<f64>>,
    nudges: Vec<f64>,
    pub lane: Vec<usize>,
    pub leader: Vec<Ahead>,
    pub frustration: Vec<f64>,
    pub lane_changes: Vec<u32>,
    /// Delay in force, now and in the step before.
    pub delay: Vec<usize>,
    delay_before: Vec<usize>,
    /// First step in which a vehicle is not braked.
    released: Vec<u64>,
    sampler: S,
    pub events: Vec<Event>,
    pub collided: bool,
    /// Coins tossed, for the test to know that ties occurred.
    pub coins: usize,
}

impl<S: Sampler> Twin<S> {
    pub fn new(scenario: &Scenario) -> Self {
        let n = scenario.vehicles;
        let drivers = scenario.drivers();
        let undisturbed = Simulation::new(&Scenario { actions: Vec::new(), ..scenario.clone() }).unwrap();
        let mut twin = Self {
            step: 0,
            x0: (0..n).map(|j| undisturbed.unwrapped_position(j)).collect(),
            s: vec![vec![0.0; n]],
            nudges: vec![0.0; n],
            lane: Vec::new(),
            leader: Vec::new(),
            frustration: vec![0.0; n],
            lane_changes: vec![0; n],
            delay: vec![0; n],
            delay_before: vec![0; n],
            released: vec![0; n],
            sampler: S::new(n, scenario.time_step, Generator::new(scenario.seed, Stream::LaneChanging)),
            events: Vec::new(),
            collided: false,
            coins: 0,
            drivers,
            scenario: scenario.clone(),
        };
        twin.deal();
        for j in 0..n {
            twin.check_start(j, undisturbed.headway(j));
        }
        twin.act_now();
        twin
    }

    /// Numbers in blocks, lane 1 first and with the remainder; or all in one lane.
    fn deal(&mut self) {
        let (n, lanes) = (self.scenario.vehicles, self.scenario.lanes);
        for lane in 0..lanes {
            let share = match self.scenario.start {
                Start::OneLane(all) => {
                    if lane + 1 == all {
                        n
                    } else {
                        0
                    }
                }
                _ if lane == 0 => n - (lanes - 1) * (n / lanes),
                _ => n / lanes,
            };
            self.lane.extend(std::iter::repeat_n(lane, share));
        }
    }

    /// The headway at the start, as the start defines it, and the position.
    fn check_start(&mut self, j: usize, headway: f64) {
        let Scenario { vehicles, length, lanes, start, .. } = self.scenario;
        let lane = self.lane[j];
        let (first, count) = (
            self.lane.iter().position(|&l| l == lane).unwrap(),
            self.lane.iter().filter(|&&l| l == lane).count(),
        );
        let vehicle = if j + 1 == first + count { first } else { j + 1 };
        self.leader.push(Ahead { vehicle, constant: headway });
        if start == Start::Random {
            assert!(headway >= self.drivers[j].min_headway * (1.0 - 1e-12));
            let lap = if vehicle == first { length } else { 0.0 };
            assert!((self.x0[vehicle] + lap - self.x0[j] - headway).abs() < 1e-9 * length);
        } else {
            assert_eq!(headway, length / count as f64);
            let shift = if start == Start::Staggered { (lanes - lane - 1) as f64 } else { 0.0 };
            let x0 = (j - first) as f64 * length / count as f64 + shift * length / vehicles as f64;
            assert!((self.x0[j] - x0).abs() < 1e-9 * length);
        }
    }

    pub fn vehicles(&self) -> usize {
        self.drivers.len()
    }

    fn now(&self) -> &[f64] {
        &self.s[self.step]
    }

    // ---- Positions and leaders --------------------------------------------------------------------------------------------

    /// ⌈g/L⌉ with g = x_i − x_j: the least n with (x⁰_i − x⁰_j) − n·L + (s_i − s_j) ≤ 0.
    fn laps(&self, i: usize, j: usize, s: &[f64]) -> f64 {
        let (base, driven, length) = (self.x0[i] - self.x0[j], s[i] - s[j], self.scenario.length);
        let mut n = ((base + driven) / length).floor() - 2.0;
        while (base - n * length) + driven > 0.0 {
            n += 1.0;
        }
        n
    }

    /// From j forward to i, in (0, L].
    fn forward(&self, i: usize, j: usize) -> Ahead {
        let laps = self.laps(i, j, self.now()) - 1.0;
        Ahead { vehicle: i, constant: (self.x0[i] - self.x0[j]) - laps * self.scenario.length }
    }

    /// Metres to a vehicle ahead now.
    fn distance(&self, j: usize, ahead: Ahead) -> f64 {
        ahead.constant + (self.now()[ahead.vehicle] - self.now()[j])
    }

    /// Metres from j back to i, in [0, L).
    fn backward(&self, i: usize, j: usize) -> f64 {
        let s = self.now();
        -(((self.x0[i] - self.x0[j]) - self.laps(i, j, s) * self.scenario.length) + (s[i] - s[j]))
    }

    /// The next vehicle ahead of j in a lane.
    pub fn next_ahead(&self, j: usize, lane: usize) -> Option<Ahead> {
        (0..self.vehicles())
            .filter(|&i| i != j && self.lane[i] == lane)
            .map(|i| self.forward(i, j))
            .min_by(|a, b| self.distance(j, *a).total_cmp(&self.distance(j, *b)))
    }

    /// The same in its own lane: its own image when alone.
    pub fn search_leader(&self, j: usize) -> Ahead {
        self.next_ahead(j, self.lane[j]).unwrap_or(Ahead { vehicle: j, constant: self.scenario.length })
    }

    /// Adjacent lanes that exist, the outer one first.
    fn adjacent_lanes(&self, j: usize) -> Vec<usize> {
        let lane = self.lane[j];
        (0..self.scenario.lanes).filter(|&other| other.abs_diff(lane) == 1).collect()
    }

    pub fn adjacent(&self, j: usize, side: Side) -> Option<usize> {
        let lane = match side {
            Side::Outer => self.lane[j].checked_sub(1)?,
            Side::Inner => self.lane[j] + 1,
        };
        self.next_ahead(j, lane).map(|ahead| ahead.vehicle)
    }

    pub fn headway(&self, j: usize) -> f64 {
        self.distance(j, self.leader[j])
    }

    /// Whether a vehicle has moved through the one ahead.
    pub fn order_is_lost(&self) -> bool {
        (0..self.vehicles()).any(|j| self.headway(j) <= 0.0)
    }

    /// The vehicle ahead *now*, both where they were Δ ago.
    fn perceived(&self, j: usize, ahead: Ahead) -> f64 {
        let then = &self.s[self.step - self.delay[j]];
        ahead.constant + (then[ahead.vehicle] - then[j])
    }

    pub fn perceived_headway(&self, j: usize) -> f64 {
        self.perceived(j, self.leader[j])
    }

    pub fn speed(&self, j: usize) -> f64 {
        if self.released[j] > self.step as u64 {
            0.0
        } else {
            self.drivers[j].speed(self.perceived_headway(j))
        }
    }

    // ---- The stages of a step ------------------------------------------------------------------------------------

    /// Stages 1 and 2.
    pub fn change_lanes_and_collide(&mut self) {
        self.events.clear();
        if self.scenario.lanes > 1 && !self.order_is_lost() {
            for j in 0..self.vehicles() {
                self.consider(j);
            }
        }
        for j in 0..self.vehicles() {
            let ahead = self.leader[j].vehicle;
            let contact = 0.5 * (self.drivers[j].vehicle_length + self.drivers[ahead].vehicle_length);
            if self.headway(j) <= contact {
                self.collided = true;
                self.events.push(Event::Collision { behind: j, ahead, lane: self.lane[j] });
                return;
            }
        }
    }

    fn consider(&mut self, j: usize) {
        let own = self.perceived_headway(j);
        let perceived: Vec<(usize, f64)> = self
            .adjacent_lanes(j)
            .into_iter()
            .map(|lane| (lane, self.next_ahead(j, lane).map_or(f64::INFINITY, |a| self.perceived(j, a))))
            .collect();
        let adjacent = perceived.iter().map(|&(_, h)| h).fold(f64::NEG_INFINITY, f64::max);
        let change = self.drivers[j].frustration_rate * self.scenario.time_step;
        let mut phi = self.frustration[j];
        if own + EQUAL < adjacent {
            phi += change; // rule 1
        } else if own > adjacent + EQUAL {
            phi = (phi - change).max(0.0); // rule 2
        }
        if self.step > 0 {
            for i in 0..self.vehicles() {
                let adjacent = self.lane[i].abs_diff(self.lane[j]) == 1;
                if adjacent && self.laps(i, j, self.now()) > self.laps(i, j, &self.s[self.step - 1]) {
                    phi += self.drivers[j].pass_frustration; // rule 3
                    self.events.push(Event::Pass { passer: i, passed: j });
                }
            }
        }
        self.frustration[j] = phi;
        if self.sampler.attempts(j, phi) {
            let best: Vec<usize> =
                perceived.iter().filter(|&&(_, h)| h == adjacent).map(|&(l, _)| l).collect();
            let tie = best.len() == 2;
            self.coins += usize::from(tie);
            // Heads: the outer one.
            let to = if tie && !self.sampler.coin() { best[1] } else { best[0] };
            self.attempt(j, to);
        }
    }

    fn attempt(&mut self, j: usize, to: usize) {
        let (from, frustration, d) = (self.lane[j], self.frustration[j], self.drivers[j].min_headway);
        let occupied = (0..self.vehicles())
            .filter(|&i| self.lane[i] == to)
            .any(|i| self.distance(j, self.forward(i, j)) <= d || self.backward(i, j) <= d);
        if occupied {
            self.events.push(Event::Refused { vehicle: j, from, to, frustration });
            return;
        }
        self.events.push(Event::LaneChange { vehicle: j, from, to, frustration });
        self.lane[j] = to;
        self.frustration[j] = 0.0; // rule 4
        self.lane_changes[j] += 1;
        for k in 0..self.vehicles() {
            let found = self.search_leader(k);
            if k == j || found.vehicle != self.leader[k].vehicle {
                self.leader[k] = found;
            }
        }
    }

    /// Stage 3, and the actions due then. `displacements`: the fast code's, nudges included.
    pub fn forward_all(&mut self, displacements: &[f64]) {
        let dt = self.scenario.time_step;
        let row: Vec<f64> = (0..self.vehicles()).map(|j| self.now()[j] + self.speed(j) * dt).collect();
        self.s.push(row);
        self.step += 1;
        self.delay_before.clone_from(&self.delay);
        self.find_delays();
        self.act_now();
        self.take_over(displacements);
    }

    fn take_over(&mut self, displacements: &[f64]) {
        for (j, (own, fast)) in self.s[self.step].iter_mut().zip(displacements).enumerate() {
            assert!((*own - fast).abs() < 1e-9, "vehicle {j} is at {own}, the fast one at {fast}");
            *own = *fast;
        }
    }

    /// Grows by at most one step per step towards the target, falls at once.
    fn find_delays(&mut self) {
        for j in 0..self.vehicles() {
            let target = (self.drivers[j].reaction_time / self.scenario.time_step).round() as usize;
            let most = if self.step == 0 { 0 } else { self.delay_before[j] + 1 };
            self.delay[j] = target.min(most);
        }
    }

    // ---- Actions -------------------------------------------------------------------------------------------------

    fn act_now(&mut self) {
        for (k, action) in self.scenario.actions.clone().iter().enumerate() {
            if (action.at / self.scenario.time_step).round() as usize == self.step {
                self.act(k, action);
            }
        }
    }

    /// An action made live; the fast code has made it already.
    pub fn act_live(&mut self, mut action: Action, displacements: &[f64]) {
        action.at = self.step as f64 * self.scenario.time_step;
        self.scenario.actions.push(action.clone());
        self.act(self.scenario.actions.len() - 1, &action);
        self.take_over(displacements);
    }

    fn act(&mut self, place: usize, action: &Action) {
        let n = self.vehicles();
        let members: Vec<usize> = match action.vehicles {
            VehicleSelector::All => (0..n).collect(),
            VehicleSelector::Vehicle(number) => vec![number - 1],
            VehicleSelector::Range(first, last) => (first - 1..last).collect(),
            VehicleSelector::Share(percent) => {
                let count = (percent / 100.0 * n as f64).round() as usize;
                Generator::new(self.scenario.seed, Stream::Action(place)).choose(count, n)
            }
        };
        for j in members {
            for &effect in &action.effects {
                match effect {
                    Effect::Set(field, value) => self.set(j, field.parameter().name, value.number().unwrap()),
                    Effect::Brake(seconds) => {
                        let steps = (seconds / self.scenario.time_step).round() as u64;
                        self.released[j] = self.released[j].max(self.step as u64 + steps);
                    }
                    Effect::Nudge(metres) => self.nudge(j, metres),
                }
            }
        }
        self.find_delays();
    }

    fn set(&mut self, j: usize, name: &str, value: f64) {
        let driver = &mut self.drivers[j];
        *match name {
            "max_speed" => &mut driver.max_speed,
            "sensitivity" => &mut driver.sensitivity,
            "min_headway" => &mut driver.min_headway,
            "vehicle_length" => &mut driver.vehicle_length,
            "reaction_time" => &mut driver.reaction_time,
            "frustration_rate" => &mut driver.frustration_rate,
            "pass_frustration" => &mut driver.pass_frustration,
            other => panic!("{other} is no parameter of a driver"),
        } = value;
    }

    /// At t = 0 another start; later a displacement.
    fn nudge(&mut self, j: usize, metres: f64) {
        if self.step > 0 {
            self.s[self.step][j] += metres;
            self.nudges[j] += metres;
            return;
        }
        self.x0[j] += metres;
        for k in 0..self.vehicles() {
            let Ahead { vehicle, constant } = &mut self.leader[k];
            match (k == j, *vehicle == j) {
                (true, false) => *constant -= metres,
                (false, true) => *constant += metres,
                _ => {}
            }
        }
    }

    /// Sum of the nudges after t = 0.
    pub fn nudged(&self, j: usize) -> f64 {
        self.nudges[j]
    }
}

/// Passes of one vehicle by several others in one step have no order in the model.
pub fn canonical(events: &[Event]) -> Vec<Event> {
    let mut events = events.to_vec();
    let whom = |event: &Event| if let Event::Pass { passed, .. } = event { Some(*passed) } else { None };
    for run in events.chunk_by_mut(|a, b| whom(a).is_some() && whom(a) == whom(b)) {
        run.sort_by_key(|event| if let Event::Pass { passer, .. } = event { *passer } else { 0 });
    }
    events
}
