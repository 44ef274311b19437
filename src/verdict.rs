//! What linear theory says of the ring as it runs, in the few numbers of one sentence.

use crate::driver::{Driver, Equilibrium, equilibrium};
use num_complex::Complex64;

/// The sentence's numbers, of the least stable lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// Whether every wave fades, in the run's steps; none where no wave can exist.
    pub stable: Option<bool>,
    /// Whether all drivers of the lane are alike.
    pub alike: bool,
    /// The largest reaction time of any driver in whole steps, s.
    pub reaction_time: f64,
    /// Critical reaction time in continuous time, s; none if every one is stable, or drivers differ.
    pub critical: Option<f64>,
    /// The same for the run's time step.
    pub critical_discrete: Option<f64>,
    /// The largest growth rate in the run, 1/s.
    pub rate: Option<f64>,
    /// Number of jams of the fastest wave.
    pub mode: Option<usize>,
    /// The lane's equilibrium.
    pub equilibrium: Equilibrium,
    /// Lane, from 1.
    pub lane: usize,
}

impl Default for Verdict {
    fn default() -> Self {
        Self {
            stable: None,
            alike: true,
            reaction_time: 0.0,
            critical: None,
            critical_discrete: None,
            rate: None,
            mode: None,
            equilibrium: Equilibrium { speed: 0.0, density: 0.0, flow: 0.0 },
            lane: 1,
        }
    }
}

/// The verdict on lanes of drivers on a ring of `length` metres, in steps of `time_step` seconds.
pub fn verdict(lanes: &[Vec<Driver>], length: f64, time_step: f64) -> Verdict {
    let mut worst = Verdict::default();
    for (k, drivers) in lanes.iter().enumerate() {
        let Some(equilibrium) = equilibrium(drivers, length) else { continue };
        let of_lane = of_lane(drivers, equilibrium, length, time_step);
        if worst.rate.is_none() || of_lane.rate > worst.rate {
            worst = Verdict { lane: k + 1, ..of_lane };
        }
    }
    worst
}

fn of_lane(drivers: &[Driver], equilibrium: Equilibrium, length: f64, dt: f64) -> Verdict {
    let n = drivers.len();
    let delay = drivers.iter().map(|d| (d.reaction_time / dt).round()).fold(0.0, f64::max);
    let alike = drivers.iter().all(|d| {
        (d.max_speed, d.sensitivity, d.min_headway, d.reaction_time)
            == (
                drivers[0].max_speed,
                drivers[0].sensitivity,
                drivers[0].min_headway,
                drivers[0].reaction_time,
            )
    });
    let mut verdict = Verdict { alike, reaction_time: delay * dt, equilibrium, ..Verdict::default() };
    let c = drivers[0].slope(length / n as f64);
    if n < 2 || c == 0.0 {
        return verdict;
    }
    let a = std::f64::consts::PI / n as f64;
    verdict.critical = Some(a / (2.0 * c * libm::sin(a)));
    verdict.critical_discrete = Some((a / libm::asin(dt * c * libm::sin(a)) - 1.0) / 2.0 * dt);
    for q in 1..=(n / 2).min(100) {
        let angle = 2.0 * a * q as f64;
        let d = Complex64::new(libm::cos(angle) - 1.0, libm::sin(angle)) * (c * dt);
        let mut z = d + 1.0;
        for m in 1..=delay as i32 {
            for _ in 0..6 {
                let power = z.powi(m);
                z -= (power * (z - 1.0) - d) / (power * (1.0 + f64::from(m) * (z - 1.0) / z));
            }
        }
        let rate = libm::log(z.norm()) / dt;
        if verdict.rate.is_none_or(|r| rate > r) {
            (verdict.rate, verdict.mode) = (Some(rate), Some(q));
        }
    }
    verdict.stable = verdict.rate.map(|r| r < 0.0);
    verdict
}
