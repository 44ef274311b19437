//! Fourier modes of the headways of one lane: what [`super::modes`] and [`super::modal_growth`] share.

use crate::scenario::driver::{Driver, equilibrium};
use crate::simulation::Simulation;
use crate::stability::driver_classes::DriverClasses;

/// Amplitudes of the modes of δ_k = h_k − h_k(v∞), where k counts the vehicles of the lane downstream:
/// `A_q = (2/n)·|Σ_k δ_k·e^{2πi·qk/n}|`, half of that for q = n/2; so a wave of ±1 m has amplitude 1 m.
#[derive(Clone, Debug)]
pub(super) struct Spectrum {
    lane: usize,
    /// A_q of q = 1 … at index q − 1, m; NaN for modes above n/2.
    pub amplitudes: Vec<f64>,
    /// Largest |δ_k|, m.
    pub largest: f64,
    /// (λ/V)·mean of δ_k², m: the second order of the speed law against its first, before division by an amplitude.
    /// Infinite while somebody stands who in equilibrium drives: the law has a kink there.
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
    pub(super) fn new(lane: usize, modes: usize) -> Self {
        Self {
            lane,
            amplitudes: vec![f64::NAN; modes],
            largest: f64::NAN,
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
    pub(super) fn read(&mut self, simulation: &Simulation) -> bool {
        let same = self.is_prepared_for(simulation);
        if !same {
            self.prepare(simulation);
        }
        let n = self.order.len();
        self.largest = self.deviations(simulation).map(f64::abs).fold(0.0, f64::max);
        let squares = self.deviations(simulation).zip(&self.drivers);
        self.second_order = squares.map(|(x, d)| d.sensitivity / d.max_speed * x * x).sum::<f64>() / n as f64;
        let stands = |(&j, driver): (&usize, &Driver)| {
            simulation.headway(j).min(simulation.perceived_headway(j)) <= driver.min_headway
        };
        if self.slopes.iter().any(|&c| c > 0.0) && self.order.iter().zip(&self.drivers).any(stands) {
            self.second_order = f64::INFINITY;
        }
        for q in 1..=self.amplitudes.len() {
            if 2 * q > n {
                self.amplitudes[q - 1] = f64::NAN;
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
            self.amplitudes[q - 1] = scale * libm::hypot(real, imaginary);
        }
        same
    }

    /// The lane read last as linear theory sees it, with the delays in force now.
    pub(super) fn ring(&self, simulation: &Simulation) -> DriverClasses {
        let dt = simulation.scenario().time_step;
        let delay = |&j: &usize| simulation.delay_steps(j) as f64 * dt;
        DriverClasses::new(self.slopes.iter().copied().zip(self.order.iter().map(delay)))
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
            let angle = 2.0 * std::f64::consts::PI * k as f64 / n as f64;
            (libm::cos(angle), libm::sin(angle))
        }));
    }
}
