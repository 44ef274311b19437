//! A simulator of a single lane of 50 vehicles; the choices that the paper leaves open are its parameters.

use std::fmt;

const N: usize = 50;
const L: f64 = 1000.0;
const V: f64 = 40.0;
const D: f64 = 7.5;
const C: f64 = 5.0;

/// The headways that drivers perceive before t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Past {
    /// Those after the displacement, at all times before 0. (A past in which all vehicles moved at v∞ has the same
    /// headways and so gives the same run.)
    Displaced,
    /// The equal headways before the displacement.
    Equal,
    /// None: there is no delay until Δ has passed, then the whole delay.
    NoDelayYet,
}

/// How positions are updated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Update {
    /// All speeds first, then all positions.
    Together,
    /// One vehicle after another, in order of number. Vehicle 1, the leader of vehicle N, has moved before vehicle N
    /// does; so vehicle N perceives its headway of one step later.
    InTurn,
    /// All speeds first, from headways one step older than the delay says.
    OneStepLate,
}

/// One reading of the paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Displacement of vehicle 1 at t = 0, m.
    pub displacement: f64,
    /// Δ, s.
    pub reaction_time: f64,
    /// Steps added to round(Δ/dt).
    pub extra_steps: i64,
    /// Time step, s.
    pub dt: f64,
    pub past: Past,
    pub update: Update,
}

impl fmt::Display for Reading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} m | {:+} | {} s | {:?} | {:?}",
            self.displacement, self.extra_steps, self.dt, self.past, self.update
        )
    }
}

/// The speed law of the paper at a headway (m), m/s.
fn speed(h: f64) -> f64 {
    (V - V * (-(1.0 / V) * (h - D)).exp()).max(0.0)
}

/// Time of the collision, s; `None` where there is none before `until`.
pub fn collision(reading: Reading, until: f64) -> Option<f64> {
    let Reading { displacement, reaction_time, extra_steps, dt, past, update } = reading;
    let delay = ((reaction_time / dt).round() as i64 + extra_steps).max(0) as usize;
    let late = usize::from(update == Update::OneStepLate);
    let rows = delay + late + 2;
    // Headways instead of positions, so that rounding errors stay small. The rows are reused in turn.
    let mut history = vec![[L / N as f64; N]; rows];
    let displaced = |h: &mut [f64; N]| {
        h[0] -= displacement;
        h[N - 1] += displacement;
    };
    if past == Past::Equal {
        displaced(&mut history[0]);
    } else {
        history.iter_mut().for_each(displaced);
    }
    let steps = (until / dt).round() as usize;
    for step in 0..steps {
        let now = step % rows;
        if history[now].iter().any(|&h| h <= C) {
            return Some(step as f64 * dt);
        }
        let back = if past == Past::NoDelayYet && step < delay { 0 } else { delay + late };
        let perceived = history[(now + rows - back) % rows];
        let later = history[(now + rows - back.saturating_sub(1)) % rows];
        let mut v = [0.0; N];
        for j in 0..N {
            // In turn: vehicle 1, the leader of the last vehicle, has moved already.
            let headway = if update == Update::InTurn && j == N - 1 { later[j] } else { perceived[j] };
            v[j] = speed(headway);
        }
        let mut next = history[now];
        for j in 0..N {
            next[j] += dt * (v[(j + 1) % N] - v[j]);
        }
        history[(now + 1) % rows] = next;
    }
    None
}
