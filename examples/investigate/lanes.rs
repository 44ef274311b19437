//! A simulator of two lanes without reaction time. The choices that the paper leaves open, and plausible slips in its
//! program, are its parameters. The order of all vehicles along the ring is kept sorted, so that leaders and passes are
//! found in one sweep instead of a loop over all pairs.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use ringroad::numerics::exp::exp_within;
use std::fmt;

pub const N: usize = 50;
const L: f64 = 1000.0;
const V: f64 = 40.0;
const D: f64 = 7.5;
const C: f64 = 5.0;

/// The smallest allowed distance (centre to centre) to a vehicle of the target lane in a lane change. The tables call
/// it gap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Clearance {
    /// d, as the text says.
    MinHeadway,
    /// C, the length of a vehicle.
    Length,
}

/// The change of frustration in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rise {
    /// r·dt.
    TimesStep,
    /// r·0.01 s, the step of the single-lane figures.
    TimesOtherStep,
    /// r, as if a step were a second.
    WholeR,
}

/// The probability of an attempt in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Attempt {
    /// P* = 1 − (1 − P)^dt.
    Rescaled,
    /// P* put through the same formula again.
    Twice,
    /// P itself, every step.
    EveryStep,
}

/// The events that count as being passed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Passes {
    /// A vehicle of the other lane passes.
    Alongside,
    /// The same, and also half a ring away, where the shorter way along the ring changes its sign.
    FarSideToo,
    /// Positions are compared as numbers from 0 to L: a vehicle that crosses the origin is passed by the whole other
    /// lane and passes no vehicle itself.
    Wrapped,
    /// The adjacent leader is another vehicle than before.
    NextChanged,
    /// No pass counts.
    Never,
}

/// The order in which vehicles change lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Order {
    /// By number, each change at once.
    InTurn,
    /// By number, backwards.
    Backwards,
    /// All decide from the same state; then all that may change do so together.
    Together,
}

/// One reading of the paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    pub r: f64,
    pub p: f64,
    pub dt: f64,
    pub clearance: Clearance,
    pub rise: Rise,
    pub attempt: Attempt,
    pub passes: Passes,
    pub order: Order,
    /// Whether frustration returns to 0 after a failed attempt as well.
    pub reset_always: bool,
}

impl Reading {
    /// The paper to the letter.
    pub fn literal(r: f64, p: f64) -> Self {
        Self {
            r,
            p,
            dt: 0.05,
            clearance: Clearance::MinHeadway,
            rise: Rise::TimesStep,
            attempt: Attempt::Rescaled,
            passes: Passes::Alongside,
            order: Order::InTurn,
            reset_always: false,
        }
    }
}

impl fmt::Display for Reading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let reset = if self.reset_always { "every attempt" } else { "a change" };
        write!(
            f,
            "{:?} | {:?} | {:?} | {:?} | {:?} | {reset} | {} s",
            self.clearance, self.rise, self.attempt, self.passes, self.order, self.dt
        )
    }
}

/// All vehicles in the order of their positions modulo a period.
struct Cycle {
    period: f64,
    order: [usize; N],
    /// Positions, shifted by whole periods so that they rise along `order` and span less than a period.
    key: [f64; N],
}

impl Cycle {
    fn new(x: &[f64; N], period: f64) -> Self {
        let key = x.map(|x| x.rem_euclid(period));
        let mut order: [usize; N] = std::array::from_fn(|j| j);
        order.sort_by(|&a, &b| key[a].total_cmp(&key[b]));
        Self { period, order, key }
    }

    /// Moves every vehicle by its way (m) and sorts again; appends (passer, passed) for every pass.
    fn advance(&mut self, way: &[f64; N], passes: &mut Vec<(usize, usize)>) {
        for (key, way) in self.key.iter_mut().zip(way) {
            *key += way;
        }
        loop {
            for end in 1..N {
                let mut k = end;
                while k > 0 && self.key[self.order[k - 1]] > self.key[self.order[k]] {
                    passes.push((self.order[k - 1], self.order[k]));
                    self.order.swap(k - 1, k);
                    k -= 1;
                }
            }
            // The last may have passed the first, which is one period ahead of it.
            let (first, last) = (self.order[0], self.order[N - 1]);
            if self.key[last] <= self.key[first] + self.period {
                return;
            }
            passes.push((last, first));
            self.key[last] -= self.period;
            self.key[first] += self.period;
            self.order.swap(0, N - 1);
        }
    }
}

/// The state of both lanes.
pub struct Lanes {
    reading: Reading,
    generator: ChaCha8Rng,
    /// Unwrapped positions.
    x: [f64; N],
    /// Positions in [0, L), now and a step ago, and whether a vehicle has crossed 0 in between.
    wrapped: [f64; N],
    before: [f64; N],
    over_origin: bool,
    cycle: Cycle,
    /// The order modulo half the ring, in which a vehicle half a ring away is adjacent as well.
    half: Option<Cycle>,
    /// (passer, passed) of the step before, in whichever lanes.
    passed: Vec<(usize, usize)>,
    lane: [usize; N],
    /// The next vehicle ahead in each lane and its headway (m); infinite where there is none.
    next: [[usize; N]; 2],
    headway: [[f64; N]; 2],
    sensitivity: [f64; N],
    frustration: [f64; N],
    pub changes: [u32; N],
    adjacent_leader: [usize; N],
    pub crashed: bool,
    first: bool,
}

impl Lanes {
    /// All in lane 0 with equal headways, or staggered with vehicle 0 aggressive.
    pub fn new(reading: Reading, aggressive: bool, seed: u64) -> Self {
        let (mut x, mut lane, mut sensitivity) = ([0.0; N], [0; N], [1.0; N]);
        for j in 0..N {
            if aggressive {
                lane[j] = usize::from(j >= N / 2);
                x[j] = (j % (N / 2)) as f64 * L / 25.0 + if j < N / 2 { L / 50.0 } else { 0.0 };
            } else {
                x[j] = j as f64 * L / 50.0;
            }
        }
        if aggressive {
            sensitivity[0] = 2.0;
        }
        let far = reading.passes == Passes::FarSideToo;
        let mut lanes = Self {
            reading,
            generator: ChaCha8Rng::seed_from_u64(seed),
            x,
            wrapped: x,
            before: x,
            over_origin: false,
            cycle: Cycle::new(&x, L),
            half: far.then(|| Cycle::new(&x, L / 2.0)),
            passed: Vec::new(),
            lane,
            next: [[usize::MAX; N]; 2],
            headway: [[f64::INFINITY; N]; 2],
            sensitivity,
            frustration: [0.0; N],
            changes: [0; N],
            adjacent_leader: [usize::MAX; N],
            crashed: false,
            first: true,
        };
        lanes.find_leaders();
        lanes
    }

    /// Finds the leaders in both lanes: upstream along the ring, starting with the first vehicle of each lane, shifted by
    /// one period.
    fn find_leaders(&mut self) {
        let Cycle { order, key, .. } = &self.cycle;
        let mut ahead = [(usize::MAX, f64::INFINITY); 2];
        for (lane, ahead) in ahead.iter_mut().enumerate() {
            if let Some(&j) = order.iter().find(|&&j| self.lane[j] == lane) {
                *ahead = (j, key[j] + L);
            }
        }
        for &j in order.iter().rev() {
            for (lane, ahead) in ahead.iter().enumerate() {
                self.next[lane][j] = ahead.0;
                self.headway[lane][j] = ahead.1 - key[j];
            }
            ahead[self.lane[j]] = (j, key[j]);
        }
    }

    /// Number of passes of vehicle j in the step before.
    fn passes(&mut self, j: usize) -> f64 {
        let other = 1 - self.lane[j];
        match self.reading.passes {
            Passes::Never => 0.0,
            Passes::NextChanged => {
                let next = self.next[other][j];
                let changed = !self.first && next != self.adjacent_leader[j];
                self.adjacent_leader[j] = next;
                f64::from(u8::from(changed))
            }
            Passes::Wrapped if self.over_origin => {
                let passed = |i: &usize| {
                    self.lane[*i] == other
                        && self.wrapped[*i] > self.wrapped[j]
                        && self.before[*i] <= self.before[j]
                };
                (0..N).filter(passed).count() as f64
            }
            Passes::Alongside | Passes::FarSideToo | Passes::Wrapped => {
                self.passed.iter().filter(|(i, passed)| *passed == j && self.lane[*i] == other).count() as f64
            }
        }
    }

    /// Whether vehicle j may change to a lane.
    fn is_free(&self, j: usize, lane: usize) -> bool {
        let clearance = if self.reading.clearance == Clearance::MinHeadway { D } else { C };
        (0..N).all(|i| {
            self.lane[i] != lane || {
                let g = (self.wrapped[i] - self.wrapped[j]).abs();
                g.min(L - g) > clearance
            }
        })
    }

    /// Whether an attempt is made in this step; `uniform` is a random number in [0, 1).
    fn attempts(&self, frustration: f64, uniform: f64) -> bool {
        let dt = self.reading.dt;
        // Since −ln(1 − P) < 0.75 φ, most attempts can be ruled out without the costly formulas.
        let bound = if self.reading.attempt == Attempt::EveryStep { 1.0 } else { dt };
        if uniform >= 0.75 * frustration * bound {
            return false;
        }
        let p = std::f64::consts::FRAC_2_PI * frustration.atan();
        let rescaled = |p: f64| 1.0 - (1.0 - p).powf(dt);
        uniform
            < match self.reading.attempt {
                Attempt::Rescaled => rescaled(p),
                Attempt::Twice => rescaled(rescaled(p)),
                Attempt::EveryStep => p,
            }
    }

    /// One step.
    pub fn step(&mut self) {
        let Reading { r, p, dt, rise, order, reset_always, .. } = self.reading;
        let change = match rise {
            Rise::TimesStep => r * dt,
            Rise::TimesOtherStep => r * 0.01,
            Rise::WholeR => r,
        };
        let mut together = Vec::new();
        for k in 0..N {
            let j = if order == Order::Backwards { N - 1 - k } else { k };
            let other = 1 - self.lane[j];
            let (own, adjacent) = (self.headway[1 - other][j], self.headway[other][j]);
            let mut frustration = self.frustration[j];
            frustration +=
                if own < adjacent { change } else { 0.0 } - if own > adjacent { change } else { 0.0 };
            frustration = frustration.max(0.0) + p * self.passes(j);
            self.frustration[j] = frustration;
            let uniform = (self.generator.next_u64() >> 11) as f64 / 9_007_199_254_740_992.0;
            if self.attempts(frustration, uniform) {
                if self.is_free(j, other) {
                    if order == Order::Together { together.push(j) } else { self.change(j) }
                } else if reset_always {
                    self.frustration[j] = 0.0;
                }
            }
        }
        for j in together {
            self.change(j);
        }
        self.first = false;
        let headways: [f64; N] = std::array::from_fn(|j| self.headway[self.lane[j]][j]);
        if headways.iter().any(|&h| h <= C) {
            self.crashed = true;
            return;
        }
        let way: [f64; N] = std::array::from_fn(|j| {
            let v = V - V * exp_within(-(self.sensitivity[j] / V) * (headways[j] - D));
            v.max(0.0) * dt
        });
        self.before = self.wrapped;
        self.over_origin = false;
        for (j, way) in way.iter().enumerate() {
            self.x[j] += way;
            self.wrapped[j] += way;
            if self.wrapped[j] >= L {
                self.wrapped[j] -= L;
                self.over_origin = true;
            }
        }
        self.passed.clear();
        self.cycle.advance(&way, &mut self.passed);
        if let Some(half) = &mut self.half {
            self.passed.clear();
            half.advance(&way, &mut self.passed);
        }
        self.find_leaders();
    }

    fn change(&mut self, j: usize) {
        self.lane[j] = 1 - self.lane[j];
        self.frustration[j] = 0.0;
        self.changes[j] += 1;
        self.find_leaders();
        self.adjacent_leader[j] = self.next[1 - self.lane[j]][j];
    }

    pub fn imbalance(&self) -> f64 {
        let outer = self.lane.iter().filter(|&&l| l == 0).count() as f64;
        (2.0 * outer - N as f64).abs()
    }

    /// Number of times that a vehicle has passed the middle of the ring, plus a constant.
    pub fn passings(&self) -> f64 {
        self.x.iter().map(|x| ((x - L / 2.0) / L).floor()).sum()
    }
}
