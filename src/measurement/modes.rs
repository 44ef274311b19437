//! Amplitudes of the Fourier modes of the headways' deviations from equilibrium, over time, in one lane: A_q as
//! [`super::spectrum`] defines it, so that a wave of ±1 m has amplitude 1 m.

use super::due_rows::DueRows;
use super::probe::Probe;
use super::spectrum::Spectrum;
use crate::format::table::{Column, Table};
use crate::simulation::Simulation;

/// The probe of the table `modes`.
#[derive(Clone, Debug)]
pub struct Modes {
    spectrum: Spectrum,
    count: usize,
    /// At each time the largest deviation and the amplitude of each mode, m.
    values: DueRows<f64>,
}

impl Modes {
    /// Modes 1 to `modes` of a lane (from 0) every so many steps.
    pub fn new(every: u64, modes: usize, lane: usize) -> Self {
        Self { spectrum: Spectrum::new(lane, 1..=modes), count: modes, values: DueRows::every(every) }
    }
}

impl Probe for Modes {
    fn observe(&mut self, simulation: &Simulation) {
        if self.values.begin(simulation).is_some() {
            self.spectrum.read(simulation);
            self.values.push(self.spectrum.largest);
            self.values.extend(self.spectrum.amplitudes.iter().copied());
        }
    }

    fn table(&self) -> Table {
        let values = |k| self.values.nth_of_each(k, 1 + self.count);
        let mut columns = vec![
            Column::float("time_s", "s", "time", self.values.times().to_vec()),
            Column::float(
                "largest_deviation_m",
                "m",
                "largest deviation of a headway from its equilibrium value",
                values(0),
            ),
        ];
        columns.extend((1..=self.count).map(|q| {
            let meaning = format!("amplitude of Fourier mode {q} of the headways' deviations");
            Column::float(format!("amplitude_{q}_m"), "m", meaning, values(q))
        }));
        Table::new(columns)
    }
}
