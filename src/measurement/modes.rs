//! Amplitudes of the Fourier modes of the headways' deviations from equilibrium, over time, in one lane:
//! `A_q = (2/n)·|Σ_k δ_k·e^{2πi·qk/n}|` (half of that for q = n/2), so that a wave of ±1 m has amplitude 1 m.

use super::probe::{Due, Probe, Schedule};
use super::spectrum::Spectrum;
use crate::format::table::{Column, Table};
use crate::simulation::Simulation;

/// The probe of the table `modes`.
#[derive(Clone, Debug)]
pub struct Modes {
    schedule: Schedule,
    spectrum: Spectrum,
    times: Vec<f64>,
    largest: Vec<f64>,
    amplitudes: Vec<Vec<f64>>,
}

impl Modes {
    /// Modes 1 to `modes` of a lane (from 0) every so many steps.
    pub fn new(every: u64, modes: usize, lane: usize) -> Self {
        Self {
            schedule: Schedule::new(every),
            spectrum: Spectrum::new(lane, modes),
            times: Vec::new(),
            largest: Vec::new(),
            amplitudes: vec![Vec::new(); modes],
        }
    }
}

impl Probe for Modes {
    fn observe(&mut self, simulation: &Simulation) {
        let due = self.schedule.due(simulation);
        if due == Due::Nothing {
            return;
        }
        if due == Due::Again {
            self.times.pop();
            self.largest.pop();
        }
        self.spectrum.read(simulation);
        let rows = self.times.len();
        self.times.push(simulation.time());
        self.largest.push(self.spectrum.largest);
        for (column, &amplitude) in self.amplitudes.iter_mut().zip(&self.spectrum.amplitudes) {
            column.truncate(rows);
            column.push(amplitude);
        }
    }

    fn table(&self) -> Table {
        let mut columns = vec![
            Column::float("time_s", "s", "time", self.times.clone()),
            Column::float(
                "largest_deviation_m",
                "m",
                "largest deviation of a headway from its equilibrium value",
                self.largest.clone(),
            ),
        ];
        columns.extend(self.amplitudes.iter().enumerate().map(|(k, values)| {
            let q = k + 1;
            let meaning = format!("amplitude of Fourier mode {q} of the headways' deviations");
            Column::float(format!("amplitude_{q}_m"), "m", meaning, values.clone())
        }));
        Table::new(columns)
    }
}
