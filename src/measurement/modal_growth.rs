//! Modal growth rates σ_q: the slope of ln|A_q(t)| in the linear regime, with its standard error, next to the rate that
//! linear theory predicts.
//!
//! # The linear window
//!
//! To second order, the nonlinear part of the motion of mode q is the product of other modes. The speed law makes it at
//! most the share `(λ/V)·mean(δ²)/A_q` of the linear part, and this changes the growth rate by at most 2c·sin(πq/N) times
//! the share. So a weak mode leaves the linear regime while the strong ones are still in it.
//!
//! The linear window of a mode begins with the first row, from a given time on, in which that share is small. It ends
//! before the first row in which the share is large, or the amplitude is lost in rounding errors (on a ring of ten
//! kilometres they come to some 10⁻¹¹ m), or the lane was disturbed: by an action, or by a vehicle that changed
//! lanes. In the window the amplitude of a mode of equal drivers is one complex exponential, as soon as what the start
//! excited besides the leading root has died away.
//!
//! Waves that count as small may still be large enough to change the slope measurably. So each slope comes with the bound
//! that the share sets (see [`ModeGrowth::nonlinear_bound`]).
//!
//! # Drivers that differ
//!
//! With heterogeneous drivers the modes of the ring are no longer Fourier modes. The rate predicted for Fourier mode q is the
//! root that is followed from mode q of equal drivers. Where the drivers of each class are spread over the ring, that
//! is the rate measured, except for modes that fade much faster than others and are hidden by them. Where a
//! class drives in a block, a Fourier mode is a mixture of several exponentials: its standard error is large, and its
//! slope tends to the fastest growth rate.
//!
//! ```
//! use ringroad::measurement::modal_growth::{Linear, ModalGrowth, WindowEnd};
//! use ringroad::measurement::Probe;
//! use ringroad::scenario::Scenario;
//! use ringroad::simulation::Simulation;
//!
//! let mut scenario = Scenario { until: 100.0, ..Scenario::default() };
//! scenario.driver.reaction_time = 0.75;
//! scenario.actions.push("at=0:1:nudge=0.01".parse()?);
//! let linear = Linear { smallest: 1e-8, nonlinearity: 0.01 };
//! // Amplitudes of modes 1 to 5 of lane 0 every 50 steps, from step 1500 on.
//! let mut growth = ModalGrowth::new(50, 5, 0, 1500, linear);
//! let mut simulation = Simulation::new(&scenario)?;
//! while !simulation.is_finished() {
//!     simulation.step();
//!     growth.observe(&simulation);
//! }
//! let mode = &growth.modes()[4];
//! assert!((mode.rate - mode.predicted).abs() < 0.01 * mode.predicted);
//! assert_eq!(mode.ended_by, WindowEnd::EndOfRun);
//! # Ok::<(), ringroad::error::Error>(())
//! ```

use super::due_rows::DueRows;
use super::probe::Probe;
use super::spectrum::{Amplitude, Slope, Spectrum, linear_rate};
use crate::format::table::{Column, Table};
use crate::simulation::Simulation;
use crate::stability::driver_classes::DriverClasses;
use crate::stability::homogeneous::Time;
use serde::Serialize;
use std::cell::OnceCell;
use std::ops::Range;

/// The probe of the table `growth`.
#[derive(Clone, Debug)]
pub struct ModalGrowth {
    spectrum: Spectrum,
    modes: usize,
    lane: usize,
    from: u64,
    linear: Linear,
    rows: DueRows<Row>,
    /// The driver classes that the lane has had so far, each with the delays in force.
    theories: Vec<Theory>,
    /// s.
    time_step: f64,
}

/// What counts as linear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear {
    /// Smallest amplitude, m.
    pub smallest: f64,
    /// Largest share of what is not linear.
    pub nonlinearity: f64,
}

/// What ended the linear window of a mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum WindowEnd {
    /// Nothing: it lasts to the last row.
    EndOfRun,
    /// The waves became too large.
    LeftLinearRegime,
    /// The amplitude became too small to be told from rounding errors.
    SankIntoRounding,
    /// An action, or a vehicle that changed into the lane or out of it.
    Disturbed,
    /// There is no window: the waves were too large in every row.
    NeverLinear,
}

impl WindowEnd {
    /// The text in the column `ended_by` of the table.
    pub fn text(self) -> &'static str {
        match self {
            Self::EndOfRun => "end of the run",
            Self::LeftLinearRegime => "left the linear regime",
            Self::SankIntoRounding => "sank into rounding",
            Self::Disturbed => "disturbed",
            Self::NeverLinear => "never in the linear regime",
        }
    }
}

/// Growth of one Fourier mode in its linear window: a row of the table `growth`. Numbers are NaN where the window has too
/// few rows, or none.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ModeGrowth {
    /// Fourier mode q, from 1: waves round the ring.
    pub mode: usize,
    /// Slope of ln|A_q|, 1/s.
    pub rate: f64,
    /// Standard error of the slope, 1/s; see [`crate::numerics::least_squares::line`].
    pub standard_error: f64,
    /// Growth rate by linear theory for the steps and the delays in force at the end of the window, 1/s.
    pub predicted: f64,
    /// How far the nonlinear part of the motion may have moved the slope, at most, 1/s.
    pub nonlinear_bound: f64,
    /// Time of the first row of the window, s.
    pub from: f64,
    /// Time of the last row of the window, s.
    pub to: f64,
    /// A_q in the first row, m.
    pub first_amplitude: f64,
    /// A_q in the last row, m.
    pub last_amplitude: f64,
    /// Number of rows in the window.
    pub points: usize,
    /// What ended the window.
    pub ended_by: WindowEnd,
}

/// What is kept of a state.
#[derive(Clone, Debug)]
struct Row {
    /// (λ/V)·mean(δ²), m; NaN where the lane was disturbed since the row before.
    second_order: f64,
    /// Which of the theories is that of the lane at this time.
    theory: usize,
    /// A_q from mode 1 on, m.
    amplitudes: Vec<f64>,
}

/// A lane as linear theory needs it. The growth rates (1/s) of its modes are computed when they are first asked for.
#[derive(Clone, Debug)]
struct Theory {
    classes: DriverClasses,
    rates: OnceCell<Vec<f64>>,
}

impl Theory {
    /// Growth rates of modes 1 … `modes` in steps of `time_step` seconds; NaN where there is no such mode, or where
    /// its root cannot be followed.
    fn rates(&self, modes: usize, time_step: f64) -> &[f64] {
        let time = Time::Steps(time_step);
        let rate = |q: usize| match self.classes.homogeneous() {
            _ if 2 * q > self.classes.vehicles() => f64::NAN,
            Some((ring, delay)) => ring.root(q, delay, time).re,
            None if self.classes.is_jammed() => 0.0,
            None => self.classes.follow(q, 0, time).map_or(f64::NAN, |s| s.re),
        };
        self.rates.get_or_init(|| (1..=modes).map(rate).collect())
    }
}

/// Whether an action was due after the time `since` (s), up to now.
fn acted(simulation: &Simulation, since: f64) -> bool {
    let scenario = simulation.scenario();
    let steps = scenario.steps(since) + 1..=simulation.step_index();
    scenario.actions.iter().any(|action| steps.contains(&scenario.steps(action.at)))
}

impl ModalGrowth {
    /// Modes 1 to `modes` of a lane (from 0), amplitudes every so many steps from step `from` on; `linear` says which of
    /// them are fitted.
    pub fn new(every: u64, modes: usize, lane: usize, from: u64, linear: Linear) -> Self {
        Self {
            spectrum: Spectrum::new(lane, 1..=modes),
            modes,
            lane,
            from,
            linear,
            rows: DueRows::every(every),
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
        self.rows.rows().len()
    }

    /// Growth of every mode in the rows so far, mode 1 first.
    pub fn modes(&self) -> Vec<ModeGrowth> {
        (1..=self.modes).map(|q| self.growth(q)).collect()
    }

    fn growth(&self, q: usize) -> ModeGrowth {
        let (window, ended_by) = self.window(q);
        let theory = window.clone().next_back().map(|row| &self.theories[self.rows.rows()[row].theory]);
        let series: Vec<Amplitude> = window.map(|row| self.amplitude(q, row)).collect();
        let slope = Slope::of(
            &series,
            theory.map_or(f64::NAN, |theory| {
                let c = theory.classes.classes().last().map_or(f64::NAN, |class| class.slope);
                linear_rate(c, q, theory.classes.vehicles())
            }),
        );
        let [first, last] = [series.first(), series.last()];
        let or_none = |a: Option<&Amplitude>, value: fn(&Amplitude) -> f64| a.map_or(f64::NAN, value);
        ModeGrowth {
            mode: q,
            rate: slope.rate,
            standard_error: slope.standard_error,
            predicted: theory.map_or(f64::NAN, |theory| theory.rates(self.modes, self.time_step)[q - 1]),
            nonlinear_bound: slope.nonlinear_bound,
            from: or_none(first, |a| a.time),
            to: or_none(last, |a| a.time),
            first_amplitude: or_none(first, |a| a.value),
            last_amplitude: or_none(last, |a| a.value),
            points: series.len(),
            ended_by,
        }
    }

    /// The rows of the linear window of mode q, and what ended it.
    fn window(&self, q: usize) -> (Range<usize>, WindowEnd) {
        let rows = self.rows();
        let Some(first) = (0..rows).find(|&row| self.outside(q, row) != Some(WindowEnd::LeftLinearRegime))
        else {
            return (0..0, WindowEnd::NeverLinear);
        };
        let end = (first..rows).find_map(|row| Some((row, self.outside(q, row)?)));
        let (end, why) = end.unwrap_or((rows, WindowEnd::EndOfRun));
        (first..end, why)
    }

    /// Why a row is outside the linear window of mode q; none where it may be inside.
    fn outside(&self, q: usize, row: usize) -> Option<WindowEnd> {
        let Amplitude { value: amplitude, second_order, .. } = self.amplitude(q, row);
        if second_order.is_nan() {
            Some(WindowEnd::Disturbed)
        } else if amplitude.is_nan() || amplitude < self.linear.smallest {
            Some(WindowEnd::SankIntoRounding)
        } else if second_order > self.linear.nonlinearity * amplitude {
            Some(WindowEnd::LeftLinearRegime)
        } else {
            None
        }
    }

    fn amplitude(&self, q: usize, row: usize) -> Amplitude {
        let Row { second_order, ref amplitudes, .. } = self.rows.rows()[row];
        Amplitude { time: self.rows.times()[row], value: amplitudes[q - 1], second_order }
    }
}

impl Probe for ModalGrowth {
    fn observe(&mut self, simulation: &Simulation) {
        if simulation.step_index() < self.from {
            return;
        }
        let Some(replaced) = self.rows.begin(simulation) else { return };
        let rows = self.rows();
        // The row before has the time before the last, which is that of this state.
        let since = rows.checked_sub(1).map_or(0.0, |before| self.rows.times()[before]);
        let same = self.spectrum.read(simulation)
            && !replaced.iter().any(|row| row.second_order.is_nan())
            && !acted(simulation, since);
        let classes = self.spectrum.classes(simulation);
        if self.theories.last().is_none_or(|theory| theory.classes != classes) {
            self.theories.push(Theory { classes, rates: OnceCell::new() });
        }
        self.time_step = simulation.scenario().time_step;
        self.rows.push(Row {
            second_order: if same || rows == 0 { self.spectrum.second_order } else { f64::NAN },
            theory: self.theories.len() - 1,
            amplitudes: self.spectrum.amplitudes.clone(),
        });
    }

    fn table(&self) -> Table {
        let modes = self.modes();
        let column = |f: fn(&ModeGrowth) -> f64| modes.iter().map(f).collect();
        let whole = |f: fn(&ModeGrowth) -> usize| modes.iter().map(|mode| f(mode) as u64).collect();
        Table::new(vec![
            Column::whole("lane", "", "the lane", vec![self.lane as u64 + 1; modes.len()]),
            Column::whole("mode", "", "Fourier mode q: waves round the ring", whole(|m| m.mode)),
            Column::float(
                "growth_rate_per_s",
                "1/s",
                "slope of ln|amplitude| in the linear window",
                column(|m| m.rate),
            ),
            Column::float(
                "standard_error_per_s",
                "1/s",
                "standard error of the slope",
                column(|m| m.standard_error),
            ),
            Column::float(
                "predicted_per_s",
                "1/s",
                "growth rate by linear theory, for the steps and the delay in force; of drivers that differ that of the \
                 root followed from this mode of equal drivers",
                column(|m| m.predicted),
            ),
            Column::float(
                "nonlinear_bound_per_s",
                "1/s",
                "how far the waves' size may have moved the slope, at most",
                column(|m| m.nonlinear_bound),
            ),
            Column::float("from_s", "s", "start of the linear window", column(|m| m.from)),
            Column::float("to_s", "s", "end of the linear window", column(|m| m.to)),
            Column::float(
                "first_amplitude_m",
                "m",
                "amplitude at the start of the window",
                column(|m| m.first_amplitude),
            ),
            Column::float(
                "last_amplitude_m",
                "m",
                "amplitude at the end of the window",
                column(|m| m.last_amplitude),
            ),
            Column::whole("points", "", "number of amplitudes fitted", whole(|m| m.points)),
            Column::text(
                "ended_by",
                "what ended the linear window",
                modes.iter().map(|m| m.ended_by.text().to_owned()).collect(),
            ),
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The page gets the names, the table the texts.
    #[test]
    fn every_window_end_has_a_name_and_a_text() {
        for (end, name, text) in [
            (WindowEnd::EndOfRun, "end_of_run", "end of the run"),
            (WindowEnd::LeftLinearRegime, "left_linear_regime", "left the linear regime"),
            (WindowEnd::SankIntoRounding, "sank_into_rounding", "sank into rounding"),
            (WindowEnd::Disturbed, "disturbed", "disturbed"),
            (WindowEnd::NeverLinear, "never_linear", "never in the linear regime"),
        ] {
            assert_eq!(serde_json::to_value(end).unwrap(), name);
            assert_eq!(end.text(), text);
        }
    }
}
