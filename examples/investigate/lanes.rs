//! Two lanes without reaction time, with the choices that the paper leaves open, and plausible slips, as
//! parameters. Plain loops over all pairs.

use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};
use std::fmt;

pub const N: usize = 50;
const L: f64 = 1000.0;
const V: f64 = 40.0;
const D: f64 = 7.5;
const C: f64 = 5.0;

/// How far from other vehicles of the target lane a change is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gap {
    /// d, as the text says.
    MinHeadway,
    /// C, the length of a vehicle.
    Length,
}

/// By what a step moves frustration.
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

/// What counts as being passed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Passes {
    /// A vehicle of the other lane comes past, alongside.
    Alongside,
    /// Also at the far side of the ring, where the shorter way round changes its sign.
    FarSideToo,
    /// Positions compared as numbers from 0 to L: whoever crosses the origin is passed by all the other lane, and passes
    /// nobody.
    Wrapped,
    /// The vehicle next ahead in the other lane is another one than before.
    NextChanged,
    /// No pass counts.
    Never,
}

/// In which order vehicles change lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Order {
    /// By number, each change at once.
    InTurn,
    /// By number, backwards.
    Backwards,
    /// All decide on the same scene, and all that may, change.
    Together,
}

/// One reading of the paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    pub r: f64,
    pub p: f64,
    pub dt: f64,
    pub gap: Gap,
    pub rise: Rise,
    pub attempt: Attempt,
    pub passes: Passes,
    pub order: Order,
    /// Whether frustration returns to 0 after a failed attempt as well.
    pub reset_always: bool,
}

impl Reading {
    /// The text, to the letter.
    pub fn literal(r: f64, p: f64) -> Self {
        Self {
            r,
            p,
            dt: 0.05,
            gap: Gap::MinHeadway,
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
            "{:?} | {:?} | {:?} | {:?} | {:?} | {reset}",
            self.gap, self.rise, self.attempt, self.passes, self.order
        )
    }
}

/// The distance from b ahead to a, in (0, L]: one exactly alongside is a lap ahead.
fn ahead_by(a: f64, b: f64) -> f64 {
    if a > b { a - b } else { a - b + L }
}

/// The state.
pub struct Lanes {
    reading: Reading,
    generator: ChaCha8Rng,
    /// Unwrapped positions.
    pub x: [f64; N],
    /// Positions in [0, L), now and a step ago.
    wrapped: [f64; N],
    before: [f64; N],
    pub lane: [usize; N],
    sensitivity: [f64; N],
    frustration: [f64; N],
    pub changes: [u32; N],
    next_beside: [usize; N],
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
        Self {
            reading,
            generator: ChaCha8Rng::seed_from_u64(seed),
            x,
            wrapped: x,
            before: x,
            lane,
            sensitivity,
            frustration: [0.0; N],
            changes: [0; N],
            next_beside: [usize::MAX; N],
            crashed: false,
            first: true,
        }
    }

    /// The vehicle next ahead of j in a lane and its distance in (0, L]; none: infinity.
    fn ahead(&self, j: usize, lane: usize) -> (usize, f64) {
        let mut best = (usize::MAX, f64::INFINITY);
        for i in 0..N {
            if self.lane[i] == lane && i != j {
                let gap = ahead_by(self.wrapped[i], self.wrapped[j]);
                if gap < best.1 {
                    best = (i, gap);
                }
            }
        }
        best
    }

    fn headway(&self, j: usize) -> f64 {
        self.ahead(j, self.lane[j]).1.min(L)
    }

    fn passes(&mut self, j: usize) -> f64 {
        let mut count = 0.0;
        if self.reading.passes == Passes::NextChanged {
            let next = self.ahead(j, 1 - self.lane[j]).0;
            if !self.first && next != self.next_beside[j] {
                count = 1.0;
            }
            self.next_beside[j] = next;
            return count;
        }
        for i in 0..N {
            if self.lane[i] == self.lane[j] {
                continue;
            }
            let (then, now) =
                (ahead_by(self.before[i], self.before[j]), ahead_by(self.wrapped[i], self.wrapped[j]));
            let alongside = then - now > L / 2.0;
            let passed = match self.reading.passes {
                Passes::Alongside => alongside,
                Passes::FarSideToo => alongside || (then <= L / 2.0 && now > L / 2.0 && now - then < L / 2.0),
                Passes::Wrapped => self.wrapped[i] > self.wrapped[j] && self.before[i] <= self.before[j],
                Passes::NextChanged | Passes::Never => false,
            };
            if passed {
                count += 1.0;
            }
        }
        count
    }

    fn is_free(&self, j: usize, lane: usize) -> bool {
        let gap = if self.reading.gap == Gap::MinHeadway { D } else { C };
        (0..N).all(|i| {
            self.lane[i] != lane || {
                let g = (self.wrapped[i] - self.wrapped[j]).abs();
                g.min(L - g) > gap
            }
        })
    }

    fn probability(&self, frustration: f64) -> f64 {
        let p = std::f64::consts::FRAC_2_PI * frustration.atan();
        let rescaled = |p: f64| 1.0 - (1.0 - p).powf(self.reading.dt);
        match self.reading.attempt {
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
            let (own, beside) = (self.headway(j), self.ahead(j, other).1);
            let mut frustration = self.frustration[j];
            frustration += if own < beside { change } else { 0.0 } - if own > beside { change } else { 0.0 };
            frustration = frustration.max(0.0) + p * self.passes(j);
            self.frustration[j] = frustration;
            let uniform = (self.generator.next_u64() >> 11) as f64 / 9_007_199_254_740_992.0;
            if uniform < self.probability(frustration) {
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
        let headways: Vec<f64> = (0..N).map(|j| self.headway(j)).collect();
        if headways.iter().any(|&h| h <= C) {
            self.crashed = true;
            return;
        }
        self.before = self.wrapped;
        for (j, headway) in headways.iter().enumerate() {
            let v = V - V * (-(self.sensitivity[j] / V) * (headway - D)).exp();
            self.x[j] += v.max(0.0) * dt;
            self.wrapped[j] = self.x[j].rem_euclid(L);
        }
    }

    fn change(&mut self, j: usize) {
        self.lane[j] = 1 - self.lane[j];
        self.frustration[j] = 0.0;
        self.changes[j] += 1;
        self.next_beside[j] = self.ahead(j, 1 - self.lane[j]).0;
    }

    pub fn imbalance(&self) -> f64 {
        let outer = self.lane.iter().filter(|&&l| l == 0).count() as f64;
        (2.0 * outer - N as f64).abs()
    }

    /// Vehicles that have come past the middle of the ring since ever.
    pub fn passings(&self) -> f64 {
        self.x.iter().map(|x| ((x - L / 2.0) / L).floor()).sum()
    }
}
