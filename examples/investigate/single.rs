//! A single lane of 50 vehicles, with the choices that the paper leaves open as parameters.

use std::fmt;

const N: usize = 50;
const L: f64 = 1000.0;
const V: f64 = 40.0;
const D: f64 = 7.5;
const C: f64 = 5.0;

/// What drivers see before t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Past {
    /// The displaced scene, for ever. (A past in which all drove at v∞ gives the same headways, and so the same run.)
    Displaced,
    /// The equal headways before the displacement.
    Equal,
    /// No delay until Δ has passed, then all of it.
    NoDelayYet,
}

/// How positions are updated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Update {
    /// All speeds first, then all positions.
    Together,
    /// One vehicle after another, in order of number: vehicle N sees its leader, vehicle 1, moved already, and so a
    /// scene one step younger.
    InTurn,
    /// All speeds first, from the scene one step later than asked for.
    OneStepLate,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    pub displacement: f64,
    /// Δ, s.
    pub reaction_time: f64,
    /// Steps added to round(Δ/dt).
    pub extra_steps: i64,
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

fn speed(h: f64) -> f64 {
    (V - V * (-(1.0 / V) * (h - D)).exp()).max(0.0)
}

/// Time of the collision, s; none before `until`.
pub fn collision(reading: Reading, until: f64) -> Option<f64> {
    let Reading { displacement, reaction_time, extra_steps, dt, past, update } = reading;
    let delay = ((reaction_time / dt).round() as i64 + extra_steps).max(0) as usize;
    let late = usize::from(update == Update::OneStepLate);
    let rows = delay + late + 2;
    // Headways, not positions, so that rounding stays small.
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
        let seen = history[(now + rows - back) % rows];
        let younger = history[(now + rows - back.saturating_sub(1)) % rows];
        let mut v = [0.0; N];
        for j in 0..N {
            // In turn: the leader of the last vehicle, vehicle 1, has been moved already.
            let scene = if update == Update::InTurn && j == N - 1 { younger[j] } else { seen[j] };
            v[j] = speed(scene);
        }
        let mut next = history[now];
        for j in 0..N {
            next[j] += dt * (v[(j + 1) % N] - v[j]);
        }
        history[(now + 1) % rows] = next;
    }
    None
}
