//! Fourier modes of the headways of one lane. This file defines the amplitude of a mode; the tables `modes` and `growth`
//! and the watched run all take it from here.
//!
//! δ_k = h_k − h_k(v∞) is the deviation of a headway from its equilibrium value, where k counts the n vehicles of the lane
//! downstream. The amplitude of mode q is
//!
//! `A_q = (2/n)·|Σ_k δ_k·e^{2πi·qk/n}|`, half of that for q = n/2,
//!
//! so that a wave of ±1 m has amplitude 1 m.

use crate::numerics::least_squares;
use crate::scenario::driver::{Driver, equilibrium};
use crate::simulation::Simulation;
use crate::stability::driver_classes::DriverClasses;
use std::f64::consts::PI;
use std::ops::RangeInclusive;

/// The amplitudes of some modes of a lane in the state that was read last.
#[derive(Clone, Debug)]
pub(crate) struct Spectrum {
    lane: usize,
    modes: RangeInclusive<usize>,
    /// A_q of each of the modes, m; NaN for modes above n/2.
    pub amplitudes: Vec<f64>,
    /// Largest |δ_k|, m.
    pub largest: f64,
    /// Largest |δ_k| as a share of the distance from the equilibrium headway h_k(v∞) to the minimum headway.
    pub largest_share: f64,
    /// Mean over the lane of (λ/V)·δ_k², m: divided by an amplitude it is the second-order term of the speed law as a share of
    /// the first. Infinite while a vehicle stands that moves in equilibrium: there the speed law has a kink, and no
    /// expansion holds.
    pub second_order: f64,
    /// Vehicles in the lane from the lowest number on, downstream.
    order: Vec<usize>,
    /// Their drivers, h_k(v∞), and the slopes of speed against headway there, 1/s.
    drivers: Vec<Driver>,
    equilibrium: Vec<f64>,
    slopes: Vec<f64>,
    /// cos and sin of 2πk/n.
    circle: Vec<(f64, f64)>,
}

impl Spectrum {
    /// Of these modes of a lane (from 0).
    pub(crate) fn new(lane: usize, modes: RangeInclusive<usize>) -> Self {
        Self {
            lane,
            amplitudes: vec![f64::NAN; modes.clone().count()],
            modes,
            largest: f64::NAN,
            largest_share: f64::NAN,
            second_order: f64::NAN,
            order: Vec::new(),
            drivers: Vec::new(),
            equilibrium: Vec::new(),
            slopes: Vec::new(),
            circle: Vec::new(),
        }
    }

    /// Reads a state. Returns whether the lane holds the same vehicles, in the same order and with the same
    /// equilibrium as the state read before.
    pub(crate) fn read(&mut self, simulation: &Simulation) -> bool {
        let same = self.is_prepared_for(simulation);
        if !same {
            self.prepare(simulation);
        }
        let n = self.order.len();
        self.largest = self.deviations(simulation).map(f64::abs).fold(0.0, f64::max);
        let room = self.equilibrium.iter().zip(&self.drivers).map(|(h, driver)| h - driver.min_headway);
        self.largest_share =
            self.deviations(simulation).zip(room).map(|(x, r)| x.abs() / r).fold(0.0, f64::max);
        let squares = self.deviations(simulation).zip(&self.drivers);
        self.second_order = squares.map(|(x, d)| d.sensitivity / d.max_speed * x * x).sum::<f64>() / n as f64;
        let stands = |(&j, driver): (&usize, &Driver)| {
            simulation.headway(j).min(simulation.perceived_headway(j)) <= driver.min_headway
        };
        if self.slopes.iter().any(|&c| c > 0.0) && self.order.iter().zip(&self.drivers).any(stands) {
            self.second_order = f64::INFINITY;
        }
        for (place, q) in self.modes.clone().enumerate() {
            if 2 * q > n {
                self.amplitudes[place] = f64::NAN;
                continue;
            }
            let (mut real, mut imaginary, mut k) = (0.0, 0.0, 0);
            for deviation in self.deviations(simulation) {
                let (cos, sin) = self.circle[k];
                real += deviation * cos;
                imaginary += deviation * sin;
                k += q;
                if k >= n {
                    k -= n;
                }
            }
            let scale = if 2 * q == n { 1.0 } else { 2.0 } / n as f64;
            self.amplitudes[place] = scale * libm::hypot(real, imaginary);
        }
        same
    }

    /// The drivers of the lane read last as linear theory needs them, with the delays in force now.
    pub(super) fn classes(&self, simulation: &Simulation) -> DriverClasses {
        let dt = simulation.scenario().time_step;
        let delay = |&j: &usize| simulation.delay_steps(j) as f64 * dt;
        DriverClasses::new(self.slopes.iter().copied().zip(self.order.iter().map(delay)))
    }

    /// The rate of the linear motion of a mode in the lane read last; see [`linear_rate`].
    pub(crate) fn linear_rate(&self, mode: usize) -> f64 {
        linear_rate(self.slopes.iter().copied().fold(f64::NAN, f64::max), mode, self.order.len())
    }

    fn deviations<'a>(&'a self, simulation: &'a Simulation) -> impl Iterator<Item = f64> + 'a {
        self.order.iter().zip(&self.equilibrium).map(|(&j, h)| simulation.headway(j) - h)
    }

    fn is_prepared_for(&self, simulation: &Simulation) -> bool {
        let n = self.order.len();
        simulation.vehicles_per_lane()[self.lane] == n
            && n > 0
            && self.order.iter().zip(&self.drivers).enumerate().all(|(k, (&j, driver))| {
                simulation.lane(j) == self.lane
                    && simulation.leader(j) == self.order[(k + 1) % n]
                    && simulation.driver(j).law() == driver.law()
            })
    }

    fn prepare(&mut self, simulation: &Simulation) {
        let n = simulation.vehicles_per_lane()[self.lane];
        let length = simulation.scenario().length;
        self.order.clear();
        let mut next = (0..simulation.vehicles()).find(|&j| simulation.lane(j) == self.lane);
        while let Some(j) = next.filter(|_| self.order.len() < n) {
            self.order.push(j);
            next = Some(simulation.leader(j));
        }
        self.drivers.clear();
        self.drivers.extend(self.order.iter().map(|&j| *simulation.driver(j)));
        self.equilibrium.clear();
        self.slopes.clear();
        if let Some(first) = self.drivers.first() {
            // Equal drivers share the ring, also where it is jammed and the law has no inverse.
            let equal = self.drivers.iter().all(|d| d.law() == first.law());
            let common = equilibrium(&self.drivers, length).unwrap_or_default();
            let headway = |d: &Driver| if equal { length / n as f64 } else { d.headway(common.speed) };
            self.equilibrium.extend(self.drivers.iter().map(headway));
            self.slopes.extend(self.drivers.iter().map(|d| common.slope(&d.law())));
        }
        self.circle.clear();
        self.circle.extend((0..n).map(|k| {
            let angle = 2.0 * PI * k as f64 / n as f64;
            (libm::cos(angle), libm::sin(angle))
        }));
    }
}

/// 2c·sin(πq/n), 1/s: how fast the headways of mode q change for each metre of amplitude, where `slope` is c, the largest
/// slope dv/dh (1/s) in equilibrium. It is the modulus of the eigenvalue d_q of the Jacobian.
pub(super) fn linear_rate(slope: f64, mode: usize, vehicles: usize) -> f64 {
    2.0 * slope * libm::sin(PI * mode as f64 / vehicles as f64)
}

/// The amplitude of one mode at a time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Amplitude {
    /// Time, s.
    pub time: f64,
    /// A_q, m; positive.
    pub value: f64,
    /// [`Spectrum::second_order`] then, m.
    pub second_order: f64,
}

/// Growth of one mode over a series of its amplitudes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slope {
    /// Slope of ln|A_q|, 1/s; NaN for fewer than two amplitudes.
    pub rate: f64,
    /// Standard error of the slope, 1/s, which allows for correlated residuals: see [`least_squares::line`].
    pub standard_error: f64,
    /// How far the nonlinear part of the motion may have moved the slope, at most, 1/s: `linear_rate` times the mean of
    /// second_order/A_q, with the weight t(T − t) that a constant addition to the rate at time t has in the slope of a
    /// straight line over the time T.
    pub nonlinear_bound: f64,
}

impl Slope {
    /// Of amplitudes in order of time; for `linear_rate` see the function of that name.
    pub(crate) fn of(series: &[Amplitude], linear_rate: f64) -> Self {
        let logarithms: Vec<_> = series.iter().map(|a| (a.time, libm::log(a.value))).collect();
        let line = least_squares::line(&logarithms);
        let (mut sum, mut weights) = (0.0, 0.0);
        if let [first, .., last] = series {
            for a in series {
                let weight = (a.time - first.time) * (last.time - a.time);
                sum += weight * a.second_order / a.value;
                weights += weight;
            }
        }
        Self {
            rate: line.map_or(f64::NAN, |l| l.slope),
            standard_error: line.map_or(f64::NAN, |l| l.slope_error),
            nonlinear_bound: linear_rate * sum / weights,
        }
    }
}
