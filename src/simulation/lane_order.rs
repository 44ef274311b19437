//! The order of the vehicles: for every vehicle the ones ahead and behind in its lane, and its adjacent leaders, the next
//! vehicles ahead in the adjacent lanes. All are kept up to date as vehicles pass and change lanes; nothing is sorted.
//!
//! # Terms
//!
//! *Unwrapped position*: position at the start plus displacement, x = x⁰ + s. *Offset* of i relative to j: the number
//! o = (x⁰_i − x⁰_j) − n·L with a whole number of laps n, such that the distance o + (s_i − s_j) lies in (0, L]:
//! a vehicle exactly alongside is a lap ahead. That whole number is n = ⌈g/L⌉ − 1 with g = x_i − x_j; it is
//! found by comparing rounded sums, which are the same on every machine, so that "has passed" is exact and
//! no pass is counted twice.
//!
//! # Method
//!
//! The vehicles of a lane form a circular list, linked both ways. The adjacent leader of a vehicle is updated from the one
//! known before: where vehicles have passed, by walking along that lane from it; where a vehicle has changed lanes, for
//! the vehicles around it only. Cost: O(1) a vehicle and step, plus passes and lane changes.

use super::padding::{images, padded};
use super::pass_detection::{PassDetection, ROUNDING_MARGIN};
use super::travel_bounds::TravelBounds;
use crate::numerics::random::{Generator, Stream};
use crate::numerics::simd::{Aligned, Width};
use crate::scenario::{Scenario, Start};

/// An adjacent lane: towards lane 1, or away from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The lane with the next smaller number.
    Outer,
    /// The lane with the next larger number.
    Inner,
}

impl Side {
    /// Both sides, the outer one first.
    pub const BOTH: [Self; 2] = [Self::Outer, Self::Inner];

    /// The other side.
    #[must_use]
    pub fn opposite(self) -> Self {
        match self {
            Self::Outer => Self::Inner,
            Self::Inner => Self::Outer,
        }
    }
}

/// An adjacent leader and its offset.
///
/// Where there is none it is the vehicle itself with an infinite offset: +∞ for an empty lane, −∞ for no lane. So
/// `offset + (s_i − s_j)` holds in all three cases.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AdjacentLeader {
    vehicle: u32,
    offset: f64,
}

impl AdjacentLeader {
    /// The vehicle, if there is one.
    #[inline]
    pub(crate) fn vehicle(self) -> Option<usize> {
        self.offset.is_finite().then_some(self.vehicle as usize)
    }

    /// Distance from j to it, m, at the displacements `s`; infinite where there is none.
    #[inline(always)]
    pub(crate) fn distance(self, j: usize, s: &[f64]) -> f64 {
        self.offset + (s[self.vehicle as usize] - s[j])
    }

    fn empty_lane(j: usize) -> Self {
        Self { vehicle: j as u32, offset: f64::INFINITY }
    }

    fn no_lane(j: usize) -> Self {
        Self { vehicle: j as u32, offset: f64::NEG_INFINITY }
    }
}

/// The adjacent leaders of all vehicles on one side, padded as for vehicles that have no lane there.
#[derive(Clone, Debug, Default)]
pub(crate) struct AdjacentLeaders {
    /// The vehicles.
    pub(crate) vehicles: Vec<u32>,
    /// Their offsets, m.
    pub(crate) offsets: Aligned,
}

impl AdjacentLeaders {
    fn of(vehicles: usize) -> Self {
        let none = (0..padded(vehicles)).map(AdjacentLeader::no_lane);
        Self {
            vehicles: none.clone().map(|b| b.vehicle).collect(),
            offsets: Aligned::of(&none.map(|b| b.offset).collect::<Vec<_>>()),
        }
    }
}

/// Vehicle `passer` has gone past `passed`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Pass {
    pub(crate) passer: u32,
    pub(crate) passed: u32,
}

/// The order of the vehicles in their lanes.
#[derive(Clone, Debug)]
pub(crate) struct LaneOrder {
    length: f64,
    /// x⁰: positions at t = 0, unwrapped, m.
    start: Vec<f64>,
    lane: Vec<u8>,
    ahead: Vec<u32>,
    behind: Vec<u32>,
    /// Offset of the leader, m; for vehicles that still follow the same leader, the headway at the start.
    offset: Vec<f64>,
    /// On either side; empty on one lane.
    adjacent: [AdjacentLeaders; 2],
    /// The adjacent leaders are not known yet, at t = 0: they are found when they are first needed, after all nudges of
    /// the start.
    adjacent_unknown: bool,
    detection: PassDetection,
    /// Vehicles per lane.
    count: Vec<usize>,
    /// One vehicle of each lane; none in an empty lane.
    member: Vec<Option<usize>>,
    /// There is one lane, where the leader of j is always j + 1, and that of the last vehicle the first.
    in_order: bool,
}

impl LaneOrder {
    /// The start of a valid scenario, before any nudge.
    pub(crate) fn new(scenario: &Scenario) -> Self {
        let n = scenario.vehicles;
        let length = scenario.length;
        let count = scenario.vehicles_per_lane();
        let mut order = Self {
            length,
            start: Vec::with_capacity(n),
            lane: Vec::with_capacity(n),
            ahead: Vec::with_capacity(n),
            behind: Vec::with_capacity(n),
            offset: Vec::with_capacity(n),
            adjacent: [AdjacentLeaders::default(), AdjacentLeaders::default()],
            adjacent_unknown: scenario.lanes > 1,
            detection: PassDetection::new(if scenario.lanes > 1 { n } else { 0 }),
            member: vec![None; scenario.lanes],
            count,
            in_order: scenario.lanes == 1,
        };
        let drivers = if scenario.start == Start::Random { scenario.drivers() } else { Vec::new() };
        let mut generator = Generator::new(scenario.seed, Stream::Start);
        for lane in 0..scenario.lanes {
            let vehicles = order.count[lane];
            if vehicles == 0 {
                continue;
            }
            let first = order.start.len();
            order.member[lane] = Some(first);
            for k in 0..vehicles {
                order.lane.push(lane as u8);
                order.ahead.push((first + if k + 1 == vehicles { 0 } else { k + 1 }) as u32);
                order.behind.push((first + if k == 0 { vehicles - 1 } else { k - 1 }) as u32);
            }
            if scenario.start == Start::Random {
                let min_headways = drivers[first..first + vehicles].iter().map(|d| d.min_headway);
                order.place_at_random(min_headways, &mut generator);
            } else {
                let headway = length / vehicles as f64;
                let shift = if scenario.start == Start::Staggered {
                    (scenario.lanes - 1 - lane) as f64 * (length / n as f64)
                } else {
                    0.0
                };
                order.start.extend((0..vehicles).map(|k| k as f64 * headway + shift));
                order.offset.extend((0..vehicles).map(|_| headway));
            }
        }
        if scenario.lanes > 1 {
            order.adjacent = [AdjacentLeaders::of(n), AdjacentLeaders::of(n)];
        }
        for image in n..padded(n) {
            order.offset.push(order.offset[image - n]);
            order.ahead.push(order.ahead[image - n]);
        }
        order
    }

    /// Adds a lane in which every headway is the driver's minimum and a share of the free length, uniformly
    /// distributed over all ways to share it; the whole lane is turned by a uniform angle.
    fn place_at_random(
        &mut self,
        min_headways: impl ExactSizeIterator<Item = f64> + Clone,
        generator: &mut Generator,
    ) {
        let free = self.length - min_headways.clone().sum::<f64>();
        let mut cuts: Vec<f64> = (1..min_headways.len()).map(|_| generator.uniform() * free).collect();
        cuts.sort_unstable_by(f64::total_cmp);
        cuts.push(free);
        let mut position = generator.uniform() * self.length;
        let mut last = 0.0;
        for (min_headway, cut) in min_headways.zip(cuts) {
            let headway = min_headway + (cut - last);
            self.start.push(position);
            self.offset.push(headway);
            position += headway;
            last = cut;
        }
    }

    /// Vehicles per lane, outermost first.
    pub(crate) fn vehicles_per_lane(&self) -> &[usize] {
        &self.count
    }
    /// The lane of a vehicle, from 0.
    #[inline]
    pub(crate) fn lane(&self, j: usize) -> usize {
        usize::from(self.lane[j])
    }
    /// The next vehicle ahead in its lane; itself when alone.
    #[inline]
    pub(crate) fn ahead(&self, j: usize) -> usize {
        self.ahead[j] as usize
    }
    /// The next vehicle behind in its lane; itself when alone.
    #[inline]
    pub(crate) fn behind(&self, j: usize) -> usize {
        self.behind[j] as usize
    }
    /// Offsets of the leaders, m (padded).
    #[inline]
    pub(crate) fn offsets(&self) -> &[f64] {
        &self.offset
    }
    /// The leaders (padded).
    #[inline]
    pub(crate) fn leaders(&self) -> &[u32] {
        &self.ahead
    }
    /// Whether the leader of j is j + 1 and that of the last vehicle the first: on one lane.
    pub(crate) fn is_in_order(&self) -> bool {
        self.in_order
    }
    /// Position at the start, m.
    #[inline]
    pub(crate) fn start(&self, j: usize) -> f64 {
        self.start[j]
    }
    /// The adjacent leader on that side, as of the last [`Self::follow_motion`] and the lane changes since then.
    #[inline]
    pub(crate) fn adjacent_leader(&self, j: usize, side: Side) -> AdjacentLeader {
        let all = &self.adjacent[side as usize];
        AdjacentLeader { vehicle: all.vehicles[j], offset: all.offsets[j] }
    }

    #[inline]
    fn set_adjacent_leader(&mut self, j: usize, side: Side, found: AdjacentLeader) {
        let all = &mut self.adjacent[side as usize];
        (all.vehicles[j], all.offsets[j]) = (found.vehicle, found.offset);
    }

    /// The adjacent leaders of all vehicles, on the outer side and on the inner side.
    #[inline]
    pub(crate) fn adjacent_leaders(&self) -> [&AdjacentLeaders; 2] {
        self.adjacent.each_ref()
    }

    /// Uses vectors of another width; results stay the same.
    pub(crate) fn set_width(&mut self, width: Width) {
        self.detection.set_width(width);
    }

    /// The lane on that side of vehicle `j`, if there is one.
    #[inline]
    pub(crate) fn adjacent_lane(&self, j: usize, side: Side) -> Option<usize> {
        let lane = self.lane(j);
        match side {
            Side::Outer => lane.checked_sub(1),
            Side::Inner => (lane + 1 < self.count.len()).then_some(lane + 1),
        }
    }

    /// Moves the position at the start: a nudge at t = 0.
    pub(crate) fn nudge_start(&mut self, j: usize, metres: f64) {
        self.start[j] += metres;
        let follower = self.behind(j);
        if follower != j {
            self.set_offset(j, self.offset[j] - metres);
            self.set_offset(follower, self.offset[follower] + metres);
        }
    }

    /// ⌈(x_i − x_j)/L⌉, exact: the least n with (x⁰_i − x⁰_j) − n·L + (s_i − s_j) ≤ 0 as rounded sums.
    pub(crate) fn laps(&self, i: usize, j: usize, s: &[f64]) -> f64 {
        let base = self.start[i] - self.start[j];
        let driven = s[i] - s[j];
        let mut n = ((base + driven) / self.length).ceil();
        while (base - n * self.length) + driven > 0.0 {
            n += 1.0;
        }
        while (base - (n - 1.0) * self.length) + driven <= 0.0 {
            n -= 1.0;
        }
        n
    }

    /// Offset of i relative to j, m; the distance `offset + (s_i − s_j)` is in (0, L].
    fn offset_of(&self, i: usize, j: usize, s: &[f64]) -> f64 {
        (self.start[i] - self.start[j]) - (self.laps(i, j, s) - 1.0) * self.length
    }

    /// Distance from j back to i, m, in [0, L).
    pub(crate) fn distance_behind(&self, i: usize, j: usize, s: &[f64]) -> f64 {
        -(((self.start[i] - self.start[j]) - self.laps(i, j, s) * self.length) + (s[i] - s[j]))
    }

    /// Whether i is ahead of j, given its distance up to rounding, `about`, in (−L, L); its offset if so.
    fn offset_if_ahead(&self, i: usize, j: usize, s: &[f64], about: f64) -> Option<f64> {
        let offset = self.offset_of(i, j, s);
        let distance = offset + (s[i] - s[j]);
        ((distance - about).abs() < 0.5 * self.length).then_some(offset)
    }

    /// True headway of j, m.
    #[inline]
    pub(crate) fn headway(&self, j: usize, s: &[f64]) -> f64 {
        self.offset[j] + (s[self.ahead(j)] - s[j])
    }

    /// Finds all adjacent leaders from nothing, lane by lane; O(N) after a search for one vehicle a lane.
    #[cold]
    fn find_adjacent_leaders(&mut self, s: &[f64]) {
        self.adjacent_unknown = false;
        for lane in 0..self.count.len() {
            let Some(first) = self.member[lane] else { continue };
            for side in Side::BOTH {
                let Some(target) = self.adjacent_lane(first, side) else { continue };
                let mut j = first;
                let mut found = self.search(first, target, s);
                loop {
                    self.set_adjacent_leader(j, side, found);
                    let next = self.ahead(j);
                    if next == first {
                        break;
                    }
                    // The one ahead of `next` is the one ahead of j, or ahead of that.
                    found = match found.vehicle() {
                        Some(i) => self.walk_ahead(next, i, found.distance(j, s) - self.headway(j, s), s),
                        None => AdjacentLeader::empty_lane(next),
                    };
                    j = next;
                }
            }
        }
        self.require_checks();
    }

    /// Has all vehicles checked for passes in the next [`Self::follow_motion`]: after a jump in positions.
    pub(crate) fn require_checks(&mut self) {
        self.detection.require_all();
    }

    /// The next vehicle ahead of j in a lane, by examining all of them.
    fn search(&self, j: usize, lane: usize, s: &[f64]) -> AdjacentLeader {
        let mut best = AdjacentLeader::empty_lane(j);
        let Some(first) = self.member[lane] else { return best };
        let mut i = first;
        loop {
            let candidate = AdjacentLeader { vehicle: i as u32, offset: self.offset_of(i, j, s) };
            if candidate.distance(j, s) < best.distance(j, s) {
                best = candidate;
            }
            i = self.ahead(i);
            if i == first {
                return best;
            }
        }
    }

    /// The next vehicle ahead of j, which is i or ahead of i; i is `about` metres ahead up to rounding (negative: behind).
    fn walk_ahead(&self, j: usize, mut i: usize, mut about: f64, s: &[f64]) -> AdjacentLeader {
        let lane = self.lane(i);
        for _ in 0..=2 * self.count[lane] {
            if let Some(offset) = self.offset_if_ahead(i, j, s, about) {
                return AdjacentLeader { vehicle: i as u32, offset };
            }
            about += self.headway(i, s);
            i = self.ahead(i);
        }
        // Not found in two rounds: after nudges the order in the lane is not valid, or a vehicle is several laps ahead.
        self.search(j, lane, s)
    }

    /// Brings the adjacent leaders up to date after the vehicles have moved to the displacements `s`, and adds the passes
    /// since the last call to `passes`, in order of the vehicle that was passed.
    pub(crate) fn follow_motion(&mut self, travel: TravelBounds, s: &[f64], passes: &mut Vec<Pass>) {
        if self.adjacent_unknown {
            self.find_adjacent_leaders(s);
        }
        let mut due = self.detection.find_due(s, travel);
        while let Some(j) = due.next(&self.detection) {
            let mut nearest = [f64::INFINITY; 2];
            for side in Side::BOTH {
                let pass = |i: usize| passes.push(Pass { passer: i as u32, passed: j as u32 });
                let Some((found, [ahead, behind])) = self.check_side(j, side, s, pass) else { continue };
                self.set_adjacent_leader(j, side, found);
                nearest = [nearest[0].min(ahead), nearest[1].min(behind)];
            }
            self.detection.checked(j, s[j], travel, nearest);
        }
    }

    /// The adjacent leader of j on one side at the displacements `s`, and how far away the nearest vehicles there are, ahead
    /// and behind, m; none in an empty lane or where there is no lane. Starts from the adjacent leader known before, and
    /// calls `pass` with every vehicle that has passed j since then.
    fn check_side(
        &self,
        j: usize,
        side: Side,
        s: &[f64],
        mut pass: impl FnMut(usize),
    ) -> Option<(AdjacentLeader, [f64; 2])> {
        let mut found = self.adjacent_leader(j, side);
        let mut i = found.vehicle()?;
        let mut distance = found.distance(j, s);
        if distance <= 0.0 {
            // j has passed i, and perhaps more vehicles.
            found = self.walk_ahead(j, self.ahead(i), distance + self.headway(i, s), s);
            i = found.vehicle as usize;
            distance = found.distance(j, s);
        }
        let mut walked = 0;
        loop {
            let follower = self.behind(i);
            let about = distance - self.headway(follower, s);
            if about <= -ROUNDING_MARGIN {
                return Some((found, [distance, -about]));
            }
            // The vehicle behind i was at most alongside j before; where it is now is computed exactly.
            let candidate =
                AdjacentLeader { vehicle: follower as u32, offset: self.offset_of(follower, j, s) };
            let more_laps = ((about - candidate.distance(j, s)) / self.length).round();
            if more_laps < 0.0 {
                return Some((found, [0.0; 2]));
            }
            // After a whole round all vehicles of that lane have passed, and each is counted once.
            if walked < self.count[self.lane(follower)] {
                pass(follower);
            }
            walked += 1;
            (found, i) = (candidate, follower);
            distance = candidate.distance(j, s) + more_laps * self.length;
        }
    }

    /// The adjacent leader on that side at the displacements `s`, wherever the vehicles have moved since the last
    /// [`Self::follow_motion`]; none in an empty lane or where there is no lane.
    pub(crate) fn adjacent(&self, j: usize, side: Side, s: &[f64]) -> Option<usize> {
        let lane = self.adjacent_lane(j, side)?;
        if self.adjacent_unknown {
            return self.search(j, lane, s).vehicle();
        }
        self.check_side(j, side, s, |_| {}).map(|(found, _)| found.vehicle as usize)
    }

    /// Moves `m` to the lane on that side, and updates the adjacent leaders of the vehicles around. With the change, the
    /// lane beyond becomes adjacent: `crossed` gets the vehicles there that m has passed on the way from the displacements
    /// `before` to `s`.
    pub(crate) fn change_lane(
        &mut self,
        m: usize,
        side: Side,
        before: &[f64],
        s: &[f64],
        crossed: &mut Vec<Pass>,
    ) {
        let to = self.adjacent_lane(m, side).expect("an attempt aims at a lane that exists");
        let front = self.adjacent_leader(m, side).vehicle();
        self.update_for_departure(m, s);
        let leader = self.leave(m, s);
        self.enter(m, to, front, s);
        let left = match leader {
            Some(i) => AdjacentLeader { vehicle: i as u32, offset: self.offset_of(i, m, s) },
            None => AdjacentLeader::empty_lane(m),
        };
        self.set_adjacent_leader(m, side.opposite(), left);
        self.set_adjacent_leader(m, side, self.find_in_lane_beyond(m, side, s));
        self.detection.require(m);
        for side in Side::BOTH {
            self.update_for_arrival(m, side, s);
        }
        self.find_crossed(m, side, before, s, crossed);
    }

    /// Before m leaves its lane: the vehicles that have m as adjacent leader get the vehicle ahead of m instead. They are
    /// the ones just behind m in the adjacent lanes.
    fn update_for_departure(&mut self, m: usize, s: &[f64]) {
        let leader = self.ahead(m);
        for side in Side::BOTH {
            let toward = side.opposite();
            let mut walk = self.back_from_adjacent(m, side);
            while let Some(j) = walk.step(&self.behind) {
                if self.adjacent_leader(j, toward).vehicle() != Some(m) {
                    if walk.may_be_alongside() {
                        continue;
                    }
                    break;
                }
                let found = if leader == m {
                    AdjacentLeader::empty_lane(j)
                } else {
                    AdjacentLeader { vehicle: leader as u32, offset: self.offset_of(leader, j, s) }
                };
                self.set_adjacent_leader(j, toward, found);
            }
        }
    }

    /// After m has arrived in its lane: the vehicles behind m in the lane on that side get m as adjacent leader, as far back
    /// as m is the next one ahead. The vehicles between m and its leader now have m near behind them; they must be checked
    /// for passes.
    fn update_for_arrival(&mut self, m: usize, side: Side, s: &[f64]) {
        let toward = side.opposite();
        let mut walk = self.back_from_adjacent(m, side);
        while let Some(j) = walk.step(&self.behind) {
            let arrived = AdjacentLeader { vehicle: m as u32, offset: self.offset_of(m, j, s) };
            if self.adjacent_leader(j, toward).distance(j, s) <= arrived.distance(j, s) {
                if walk.may_be_alongside() {
                    self.detection.require(j);
                    continue;
                }
                break;
            }
            self.set_adjacent_leader(j, toward, arrived);
            self.detection.require(j);
        }
        let Some(mut j) = self.adjacent_leader(m, side).vehicle() else { return };
        for _ in 0..self.count[self.lane(j)] {
            if self.adjacent_leader(j, toward).vehicle() != Some(self.ahead(m)) {
                break;
            }
            self.detection.require(j);
            j = self.ahead(j);
        }
    }

    /// Adds the vehicles of the lane on that side that m has passed since the displacements `before`. They are just behind m.
    fn find_crossed(&self, m: usize, side: Side, before: &[f64], s: &[f64], crossed: &mut Vec<Pass>) {
        let mut walk = self.back_from_adjacent(m, side);
        while let Some(j) = walk.step(&self.behind) {
            if self.laps(m, j, s) <= self.laps(m, j, before) {
                if walk.may_be_alongside() {
                    continue;
                }
                break;
            }
            crossed.push(Pass { passer: m as u32, passed: j as u32 });
        }
    }

    /// Goes through the vehicles of the lane on that side of m, once round, backwards from the first that is at most
    /// alongside m.
    fn back_from_adjacent(&self, m: usize, side: Side) -> BackWalk {
        match self.adjacent_leader(m, side).vehicle() {
            Some(i) => BackWalk::new(self.behind(i), self.count[self.lane(i)]),
            None => BackWalk::new(0, 0),
        }
    }

    fn set_ahead(&mut self, j: usize, leader: usize) {
        for image in images(j, self.lane.len()) {
            self.ahead[image] = leader as u32;
        }
    }

    fn set_offset(&mut self, j: usize, offset: f64) {
        for image in images(j, self.lane.len()) {
            self.offset[image] = offset;
        }
    }

    /// Takes m out of its lane; returns its leader there, if it was not alone.
    fn leave(&mut self, m: usize, s: &[f64]) -> Option<usize> {
        let (from, leader, follower) = (self.lane(m), self.ahead(m), self.behind(m));
        self.count[from] -= 1;
        if leader == m {
            self.member[from] = None;
            return None;
        }
        self.set_ahead(follower, leader);
        self.behind[leader] = follower as u32;
        self.set_offset(follower, self.offset_of(leader, follower, s));
        self.member[from] = Some(leader);
        Some(leader)
    }

    /// Puts m into a lane, behind `front`, or alone.
    fn enter(&mut self, m: usize, to: usize, front: Option<usize>, s: &[f64]) {
        self.lane[m] = to as u8;
        self.count[to] += 1;
        self.member[to] = Some(m);
        let front = front.unwrap_or(m);
        let rear = if front == m { m } else { self.behind(front) };
        self.set_ahead(m, front);
        self.set_ahead(rear, m);
        (self.behind[m], self.behind[front]) = (rear as u32, m as u32);
        self.set_offset(rear, self.offset_of(m, rear, s));
        self.set_offset(m, self.offset_of(front, m, s));
    }

    /// The next vehicle ahead of m in the lane on that side, starting from the adjacent leader of the vehicle behind m.
    fn find_in_lane_beyond(&self, m: usize, side: Side, s: &[f64]) -> AdjacentLeader {
        let Some(lane) = self.adjacent_lane(m, side) else { return AdjacentLeader::no_lane(m) };
        let rear = self.behind(m);
        let hint = self.adjacent_leader(rear, side);
        match hint.vehicle() {
            Some(i) if rear != m => self.walk_ahead(m, i, hint.distance(rear, s) - self.headway(rear, s), s),
            _ => self.search(m, lane, s),
        }
    }
}

/// Goes backwards through a lane; see [`LaneOrder::back_from_adjacent`]. It holds no borrow, so that the order can be
/// changed on the way: [`BackWalk::step`] is given the links each time.
struct BackWalk {
    next: usize,
    count: usize,
    left: usize,
}

impl BackWalk {
    fn new(next: usize, count: usize) -> Self {
        Self { next, count, left: count }
    }

    /// Whether the vehicle given last is the first of the walk. If that is exactly alongside, it counts as a lap ahead, and
    /// its answer says nothing about the vehicles behind it.
    fn may_be_alongside(&self) -> bool {
        self.left + 1 == self.count
    }

    fn step(&mut self, behind: &[u32]) -> Option<usize> {
        self.left = self.left.checked_sub(1)?;
        let j = self.next;
        self.next = behind[j] as usize;
        Some(j)
    }
}
