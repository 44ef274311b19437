//! What a watched run records every half second: columns of the space-time map, rows of the time series, and the
//! amplitudes from which the growth of waves is measured.
//!
//! The newest [`COLUMNS`] columns and rows, the amplitudes of the last [`GROWTH_WINDOW`] seconds and [`MODAL_ROWS`] rows of
//! all modes are kept, so that memory is bounded however long the run.

use crate::measurement::lanes::imbalance;
use crate::measurement::modal_growth::{Linear, ModalGrowth, ModeGrowth};
use crate::measurement::probe::Probe;
use crate::measurement::spectrum::{Amplitude, Slope, Spectrum};
use crate::simulation::Simulation;
use crate::stability::summary::StabilitySummary;
use std::collections::VecDeque;

/// Seconds between two columns of the map, rounded to whole steps.
pub const INTERVAL: f64 = 0.5;
/// Columns that the map keeps.
pub const COLUMNS: usize = 600;
/// Cells of the map round the ring.
pub const BINS: usize = 300;
/// Rows in the window over which flow is measured.
pub(super) const FLOW_ROWS: usize = 40;
/// Seconds over which growth is measured.
pub(super) const GROWTH_WINDOW: f64 = 60.0;
/// Growth is measured over at least so many seconds.
const SHORTEST_WINDOW: f64 = 10.0;
/// Growth is measured from at least so many amplitudes.
const FEWEST_AMPLITUDES: usize = 5;
/// Amplitude below which a wave cannot be told from rounding errors, m.
const ROUNDING: f64 = 2e-9;
/// Waves are small while no headway differs from equilibrium by more than this share of its distance from the minimum
/// headway.
const SMALL: f64 = 0.2;
/// After they were large, waves count as small again below this share.
const SMALL_AGAIN: f64 = SMALL / 4.0;
/// Number of modes whose growth is measured, from mode 1 on: twice the fastest mode, but at least 10, at most 40, and at
/// most as many as the lane has.
pub(super) fn modes_followed(simulation: &Simulation, theory: &StabilitySummary) -> usize {
    let most = simulation.vehicles_per_lane()[theory.lane - 1] / 2;
    (2 * theory.mode.unwrap_or(1)).clamp(10, 40).min(most)
}

/// Rows for which the growth of all modes is followed after a change.
const MODAL_ROWS: usize = 2400;
/// What counts as linear there; as in the table `growth`.
const LINEAR: Linear = Linear { smallest: 1e-8, nonlinearity: 0.01 };

/// One column of the map.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Column {
    /// Time, s.
    pub time: f64,
    /// The equilibrium speed at that time, m/s.
    pub equilibrium: f64,
    /// Speeds (m/s) at the centres of [`BINS`] cells from x = 0 on, lane after lane, interpolated between vehicles; NaN in
    /// an empty lane.
    pub speeds: Vec<f32>,
}

/// Growth of one wave, measured.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct MeasuredGrowth {
    /// Slope of ln|A_q|, 1/s.
    pub rate: f64,
    /// Standard error of the slope, 1/s; it allows for residuals that are correlated in time
    /// ([`crate::numerics::least_squares::line`]).
    pub standard_error: f64,
    /// How far the nonlinear part of the motion may have moved the slope, at most, 1/s.
    pub nonlinear_bound: f64,
    /// Length of the time over which the slope was taken, s.
    pub window: f64,
    /// Fourier mode q of the headways.
    pub mode: usize,
}

/// What has been recorded of a run.
#[derive(Clone, Debug)]
pub(super) struct Recorder {
    /// Steps between two rows.
    pub(super) every: u64,
    /// Vehicles (indices) whose speeds are in the rows.
    pub(super) watched: Vec<usize>,
    /// Columns made so far.
    pub(super) columns_made: u64,
    pub(super) columns: VecDeque<Column>,
    /// Rows not yet taken, one after another: time, mean speed, flow, ΔN, speeds of the watched vehicles.
    rows: Vec<f64>,
    /// Number of passings of x = L/2 since t = 0, at the times of the last rows.
    passings: VecDeque<f64>,
    /// The mode whose growth is measured, and the amplitudes of its lane; none before theory was asked.
    wave: Option<(usize, Spectrum)>,
    amplitudes: VecDeque<Amplitude>,
    /// Whether waves are too large for linear theory now.
    pub(super) is_large: bool,
    /// Growth of every mode of the same lane since the last change; none before theory was asked.
    modal: Option<ModalGrowth>,
    /// The step from which on it is measured.
    pub(super) modal_from: u64,
}

impl Recorder {
    /// Of a run at t = 0.
    pub(super) fn new(simulation: &Simulation) -> Self {
        let n = simulation.vehicles();
        Self {
            every: simulation.scenario().steps(INTERVAL).max(1),
            watched: if n < 5 { (0..n).collect() } else { (0..5).map(|k| k * n / 5).collect() },
            columns_made: 0,
            columns: VecDeque::new(),
            rows: Vec::new(),
            passings: VecDeque::new(),
            wave: None,
            amplitudes: VecDeque::new(),
            is_large: false,
            modal: None,
            modal_from: 0,
        }
    }

    /// Something has changed what theory says: growth is measured from now on, that of all modes from step `modal_from` on.
    pub(super) fn restart_growth(&mut self, modal_from: u64) {
        self.wave = None;
        self.amplitudes.clear();
        self.modal = None;
        self.modal_from = modal_from;
    }

    /// Records the state, which is one of those due every [`Self::every`] steps. `theory` is what theory says of it, where
    /// it was asked; the growth of waves is measured only then. `equilibrium` is the speed in equilibrium, m/s.
    pub(super) fn record(
        &mut self,
        simulation: &Simulation,
        equilibrium: f64,
        theory: Option<&StabilitySummary>,
    ) {
        self.record_column(simulation, equilibrium);
        self.record_row(simulation);
        if let Some(theory) = theory {
            self.record_amplitude(simulation, theory);
            self.record_modes(simulation, theory);
        }
    }

    fn record_column(&mut self, simulation: &Simulation, equilibrium: f64) {
        if self.columns.len() == COLUMNS {
            self.columns.pop_front();
        }
        self.columns_made += 1;
        let lanes = vehicles_of_lanes(simulation);
        let mut speeds = vec![f32::NAN; lanes.len() * BINS];
        for (lane, cells) in lanes.iter().zip(speeds.chunks_exact_mut(BINS)) {
            interpolate_speeds(simulation, lane, cells);
        }
        self.columns.push_back(Column { time: simulation.time(), equilibrium, speeds });
    }

    fn record_row(&mut self, s: &Simulation) {
        let (n, length) = (s.vehicles(), s.scenario().length);
        let passed: f64 = (0..n).map(|j| (s.unwrapped_position(j) / length - 0.5).floor()).sum();
        self.passings.push_back(passed);
        let window = self.flow_window(s.scenario().time_step);
        let flow = if self.passings.len() > FLOW_ROWS {
            self.passings.pop_front().map_or(f64::NAN, |before| (passed - before) / window)
        } else {
            f64::NAN
        };
        let mean = s.speeds().iter().sum::<f64>() / n as f64;
        let width = 4 + self.watched.len();
        if self.rows.len() >= width * COLUMNS {
            self.rows.drain(..width);
        }
        self.rows.extend([s.time(), mean, flow, imbalance(s.vehicles_per_lane()) as f64]);
        self.rows.extend(self.watched.iter().map(|&j| s.speed(j)));
    }

    /// The rows since this was called last.
    pub(super) fn take_rows(&mut self) -> Vec<f64> {
        std::mem::take(&mut self.rows)
    }

    /// Window of the flow in the rows, s, in steps of `time_step` seconds.
    pub(super) fn flow_window(&self, time_step: f64) -> f64 {
        self.every as f64 * time_step * FLOW_ROWS as f64
    }

    /// The amplitude of the mode that theory calls the fastest, as long as waves are small.
    fn record_amplitude(&mut self, simulation: &Simulation, theory: &StabilitySummary) {
        let Some(mode) = theory.mode else { return };
        let (_, spectrum) =
            self.wave.get_or_insert_with(|| (mode, Spectrum::new(theory.lane - 1, mode..=mode)));
        // Other vehicles in the lane make another series.
        if !spectrum.read(simulation) {
            self.amplitudes.clear();
        }
        let (amplitude, second_order) = (spectrum.amplitudes[0], spectrum.second_order);
        if amplitude.is_nan() || amplitude < ROUNDING {
            self.amplitudes.clear();
            return;
        }
        // What was measured before waves became large is kept; when they are small again, a new series begins.
        if self.is_large && spectrum.largest_share < SMALL_AGAIN {
            self.is_large = false;
            self.amplitudes.clear();
        }
        self.is_large |= spectrum.largest_share > SMALL || second_order.is_infinite();
        if self.is_large {
            return;
        }
        let time = simulation.time();
        self.amplitudes.push_back(Amplitude { time, value: amplitude, second_order });
        while self.amplitudes.front().is_some_and(|a| a.time < time - GROWTH_WINDOW) {
            self.amplitudes.pop_front();
        }
    }

    /// Growth of that mode over the last amplitudes; none where they are too few.
    pub(super) fn growth(&self) -> Option<MeasuredGrowth> {
        let (mode, spectrum) = self.wave.as_ref()?;
        let window = self.amplitudes.back()?.time - self.amplitudes.front()?.time;
        if window < SHORTEST_WINDOW || self.amplitudes.len() < FEWEST_AMPLITUDES {
            return None;
        }
        let series: Vec<Amplitude> = self.amplitudes.iter().copied().collect();
        let slope = Slope::of(&series, spectrum.linear_rate(*mode));
        Some(MeasuredGrowth {
            rate: slope.rate,
            standard_error: slope.standard_error,
            nonlinear_bound: slope.nonlinear_bound,
            window,
            mode: *mode,
        })
    }

    /// Amplitudes of all modes that are followed.
    fn record_modes(&mut self, simulation: &Simulation, theory: &StabilitySummary) {
        let (lane, modes) = (theory.lane, modes_followed(simulation, theory));
        let (every, from) = (self.every, self.modal_from);
        let modal = self.modal.get_or_insert_with(|| ModalGrowth::new(every, modes, lane - 1, from, LINEAR));
        if modal.rows() < MODAL_ROWS {
            modal.observe(simulation);
        }
    }

    /// Growth of those modes, mode 1 first; empty before theory was asked.
    pub(super) fn modal_growth(&self) -> Vec<ModeGrowth> {
        self.modal.as_ref().map(ModalGrowth::modes).unwrap_or_default()
    }
}

/// The vehicles of each lane in their order downstream, from the lowest number on.
pub(super) fn vehicles_of_lanes(simulation: &Simulation) -> Vec<Vec<usize>> {
    let mut lanes = vec![Vec::new(); simulation.scenario().lanes];
    for j in 0..simulation.vehicles() {
        let lane: &mut Vec<usize> = &mut lanes[simulation.lane(j)];
        if lane.is_empty() {
            let count = simulation.vehicles_per_lane()[simulation.lane(j)];
            let next = |&k: &usize| Some(simulation.leader(k));
            lane.extend(std::iter::successors(Some(j), next).take(count));
        }
    }
    lanes
}

/// Fills the cells round the ring with the speeds at their centres, linear between each vehicle of the lane and its leader.
/// A vehicle that has driven into its leader, with a headway of 0 or less, fills none.
fn interpolate_speeds(s: &Simulation, lane: &[usize], cells: &mut [f32]) {
    let width = s.scenario().length / cells.len() as f64;
    for &j in lane {
        let (x, headway, v) = (s.position(j), s.headway(j), s.speed(j));
        if headway <= 0.0 {
            continue;
        }
        let ahead = s.speed(s.leader(j));
        let first = (x / width - 0.5).ceil().max(0.0) as usize;
        // At most once round the ring: a loop that ended only by the share below might not end.
        for cell in first..first + cells.len() {
            let share = ((cell as f64 + 0.5) * width - x) / headway;
            if share >= 1.0 {
                break;
            }
            cells[cell % cells.len()] = (v + share * (ahead - v)) as f32;
        }
    }
}
