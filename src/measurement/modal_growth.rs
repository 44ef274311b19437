//! Modal growth rates σ_q: the slope of ln|A_q(t)| in the linear regime, with its standard error, beside what
//! linear theory predicts.
//!
//! What is not linear in the motion of mode q is, to second order, the product of other modes: the speed law gives
//! it at most the share `(λ/V)·mean(δ²)/A_q` of the linear part, and the growth rate an error of at most 2c·sin(πq/N)
//! times that. So a weak mode leaves the linear regime while the strong ones are still in it.
//!
//! The linear window of a mode begins with the first state, from a given time on, where that share is small; it
//! ends before the first where it is large, where the amplitude has sunk into rounding (over ten kilometres it
//! comes to some 10⁻¹¹ m), or where the lane is disturbed: by an action, or by a vehicle that changes
//! lanes. In the window a mode of equal drivers is one complex exponential, as soon as what the start excited beside
//! the leading root has died away.
//!
//! Waves that count as small may still be large enough to be seen in the slope. So each slope comes with the bound that
//! the share sets: its mean over the window, with the weight t(T − t) that a constant addition to the rate at time t has
//! in the slope of a straight line.
//!
//! Drivers that differ: the ring's own modes are no longer Fourier's. Beside Fourier mode q stands the root that is
//! followed from mode q of equal drivers. Where each kind is spread over the ring, that is the rate measured, but for
//! modes that fade much faster than others and are drowned by them. Where a kind drives in a block, a Fourier
//! mode is a mixture of several exponentials: its standard error is large, and its slope tends to the fastest growth rate.

use super::probe::{Due, Probe, Schedule};
use super::spectrum::Spectrum;
use crate::format::table::{Column, Table};
use crate::numerics::least_squares;
use crate::simulation::Simulation;
use crate::stability::driver_classes::DriverClasses;
use crate::stability::homogeneous::Time;
use std::cell::OnceCell;
use std::f64::consts::PI;
use std::ops::Range;

/// The probe of the table `growth`.
#[derive(Clone, Debug)]
pub struct ModalGrowth {
    schedule: Schedule,
    spectrum: Spectrum,
    lane: usize,
    from: u64,
    linear: Linear,
    times: Vec<f64>,
    /// (λ/V)·mean(δ²), m; NaN where the lane was disturbed since the row before.
    second_order: Vec<f64>,
    amplitudes: Vec<Vec<f64>>,
    /// The lane with its delays in force: at every row the place in the list of those that there were.
    lanes: Vec<usize>,
    theories: Vec<Theory>,
    time_step: f64,
}

/// A lane as linear theory sees it; the growth rates (1/s) of its modes are computed when they are first asked for.
#[derive(Clone, Debug)]
struct Theory {
    ring: DriverClasses,
    rates: OnceCell<Vec<f64>>,
}

impl Theory {
    /// Growth rates of modes 1 … `modes` in steps of `time_step` seconds; NaN where there is no such mode, or where
    /// its root cannot be followed.
    fn rates(&self, modes: usize, time_step: f64) -> &[f64] {
        let time = Time::Steps(time_step);
        let rate = |q: usize| match self.ring.homogeneous() {
            _ if 2 * q > self.ring.vehicles() => f64::NAN,
            Some((ring, delay)) => ring.root(q, delay, time).re,
            None if self.ring.is_jammed() => 0.0,
            None => self.ring.follow(q, 0, time).map_or(f64::NAN, |s| s.re),
        };
        self.rates.get_or_init(|| (1..=modes).map(rate).collect())
    }
}

const NOT_LINEAR: &str = "left the linear regime";

/// What counts as linear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear {
    /// Smallest amplitude, m.
    pub smallest: f64,
    /// Largest share of what is not linear.
    pub nonlinearity: f64,
}

/// Whether something was done to the traffic after the time `since`.
fn acted(simulation: &Simulation, since: f64) -> bool {
    let scenario = simulation.scenario();
    let steps = scenario.steps(since) + 1..=simulation.step_index();
    scenario.actions.iter().any(|action| steps.contains(&scenario.steps(action.at)))
}

impl ModalGrowth {
    /// Modes 1 to `modes` of a lane (from 0), amplitudes every so many steps from a step on; `linear` says which of
    /// them are fitted.
    pub fn new(every: u64, modes: usize, lane: usize, from: u64, linear: Linear) -> Self {
        Self {
            schedule: Schedule::new(every),
            spectrum: Spectrum::new(lane, modes),
            lane,
            from,
            linear,
            times: Vec::new(),
            second_order: Vec::new(),
            amplitudes: vec![Vec::new(); modes],
            lanes: Vec::new(),
            theories: Vec::new(),
            time_step: f64::NAN,
        }
    }

    /// The step from which on states are looked at.
    pub fn from(&self) -> u64 {
        self.from
    }

    /// Rows held so far.
    pub fn rows(&self) -> usize {
        self.times.len()
    }

    /// Why a row is outside the linear window of a mode.
    fn outside(&self, mode: usize, row: usize) -> Option<&'static str> {
        let (second_order, amplitude) = (self.second_order[row], self.amplitudes[mode][row]);
        if second_order.is_nan() {
            Some("disturbed")
        } else if amplitude.is_nan() || amplitude < self.linear.smallest {
            Some("sank into rounding")
        } else if second_order > self.linear.nonlinearity * amplitude {
            Some(NOT_LINEAR)
        } else {
            None
        }
    }

    /// The growth rate that the difference equation gives the mode at the end of its window.
    fn predicted(&self, mode: usize, window: &Range<usize>) -> f64 {
        let last = window.clone().next_back().map(|row| &self.theories[self.lanes[row]]);
        last.map_or(f64::NAN, |theory| theory.rates(self.amplitudes.len(), self.time_step)[mode])
    }

    /// How far what is not linear may have moved the slope over the window, 1/s.
    fn bound(&self, mode: usize, window: &Range<usize>) -> f64 {
        let (Some(first), Some(last)) = (window.clone().next(), window.clone().next_back()) else {
            return f64::NAN;
        };
        let ring = &self.theories[self.lanes[last]].ring;
        let slope = ring.classes().last().map_or(f64::NAN, |kind| kind.slope);
        let linear = 2.0 * slope * libm::sin(PI * (mode + 1) as f64 / ring.vehicles() as f64);
        let (mut sum, mut weights) = (0.0, 0.0);
        for row in window.clone() {
            let weight = (self.times[row] - self.times[first]) * (self.times[last] - self.times[row]);
            sum += weight * self.second_order[row] / self.amplitudes[mode][row];
            weights += weight;
        }
        linear * sum / weights
    }

    /// The rows of a mode's linear window, and what ended it.
    fn window(&self, mode: usize) -> (Range<usize>, &'static str) {
        let rows = self.times.len();
        let Some(first) = (0..rows).find(|&row| self.outside(mode, row) != Some(NOT_LINEAR)) else {
            return (0..0, "never in the linear regime");
        };
        let end = (first..rows).find(|&row| self.outside(mode, row).is_some());
        let why = end.and_then(|row| self.outside(mode, row)).unwrap_or("end of the run");
        (first..end.unwrap_or(rows), why)
    }
}

impl Probe for ModalGrowth {
    fn observe(&mut self, simulation: &Simulation) {
        if simulation.step_index() < self.from {
            return;
        }
        let due = self.schedule.due(simulation);
        if due == Due::Nothing {
            return;
        }
        let again = due == Due::Again;
        let replaced = if again { self.second_order.pop() } else { None };
        if again {
            self.times.pop();
        }
        let rows = self.times.len();
        let same = self.spectrum.read(simulation)
            && !replaced.is_some_and(f64::is_nan)
            && !acted(simulation, self.times.last().copied().unwrap_or(0.0));
        self.times.push(simulation.time());
        self.lanes.truncate(rows);
        let ring = self.spectrum.ring(simulation);
        if self.theories.last().is_none_or(|theory| theory.ring != ring) {
            self.theories.push(Theory { ring, rates: OnceCell::new() });
        }
        self.lanes.push(self.theories.len() - 1);
        self.time_step = simulation.scenario().time_step;
        self.second_order.push(if same || rows == 0 { self.spectrum.second_order } else { f64::NAN });
        for (column, &amplitude) in self.amplitudes.iter_mut().zip(&self.spectrum.amplitudes) {
            column.truncate(rows);
            column.push(amplitude);
        }
    }

    fn table(&self) -> Table {
        let modes = self.amplitudes.len();
        let (mut rates, mut errors, mut from, mut to) = (vec![], vec![], vec![], vec![]);
        let (mut first, mut last, mut points, mut ends) = (vec![], vec![], vec![], vec![]);
        let (mut predicted, mut bounds) = (vec![], vec![]);
        for mode in 0..modes {
            let (window, end) = self.window(mode);
            predicted.push(self.predicted(mode, &window));
            bounds.push(self.bound(mode, &window));
            let amplitudes = &self.amplitudes[mode][window.clone()];
            let times = &self.times[window];
            let logarithms: Vec<_> = times.iter().zip(amplitudes).map(|(&t, &a)| (t, libm::log(a))).collect();
            let line = least_squares::line(&logarithms);
            let or_none = |x: Option<&f64>| x.copied().unwrap_or(f64::NAN);
            rates.push(line.map_or(f64::NAN, |l| l.slope));
            errors.push(line.map_or(f64::NAN, |l| l.slope_error));
            from.push(or_none(times.first()));
            to.push(or_none(times.last()));
            first.push(or_none(amplitudes.first()));
            last.push(or_none(amplitudes.last()));
            points.push(times.len() as u64);
            ends.push(end.to_owned());
        }
        Table::new(vec![
            Column::whole("lane", "", "the lane", vec![self.lane as u64 + 1; modes]),
            Column::whole("mode", "", "Fourier mode q: waves round the ring", (1..=modes as u64).collect()),
            Column::float("growth_rate_per_s", "1/s", "slope of ln|amplitude| in the linear window", rates),
            Column::float("standard_error_per_s", "1/s", "standard error of the slope", errors),
            Column::float(
                "predicted_per_s",
                "1/s",
                "growth rate by linear theory, for the steps and the delay in force; of drivers that differ that of the \
                 root followed from this mode of equal drivers",
                predicted,
            ),
            Column::float(
                "nonlinear_bound_per_s",
                "1/s",
                "how far the waves' size may have moved the slope, at most",
                bounds,
            ),
            Column::float("from_s", "s", "start of the linear window", from),
            Column::float("to_s", "s", "end of the linear window", to),
            Column::float("first_amplitude_m", "m", "amplitude at the start of the window", first),
            Column::float("last_amplitude_m", "m", "amplitude at the end of the window", last),
            Column::whole("points", "", "number of amplitudes fitted", points),
            Column::text("ended_by", "what ended the linear window", ends),
        ])
    }
}
