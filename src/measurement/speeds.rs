//! Speeds of some vehicles over time, one column each; also at a collision.

use super::due_rows::DueRows;
use super::probe::Probe;
use crate::format::table::{Column, Table};
use crate::simulation::Simulation;

/// The probe of the table `speeds`.
#[derive(Clone, Debug)]
pub struct Speeds {
    /// Indices of the vehicles.
    vehicles: Vec<usize>,
    /// At each time the speed of each of them, m/s.
    speeds: DueRows<f64>,
}

impl Speeds {
    /// Rows every so many steps, for vehicles given by their numbers from 1.
    pub fn new(every: u64, numbers: &[usize]) -> Self {
        Self { vehicles: numbers.iter().map(|n| n - 1).collect(), speeds: DueRows::with_collision(every) }
    }
}

impl Probe for Speeds {
    fn observe(&mut self, simulation: &Simulation) {
        if self.speeds.begin(simulation).is_some() {
            self.speeds.extend(self.vehicles.iter().map(|&j| simulation.speed(j)));
        }
    }

    fn table(&self) -> Table {
        let mut columns = vec![Column::float("time_s", "s", "time", self.speeds.times().to_vec())];
        columns.extend(self.vehicles.iter().enumerate().map(|(k, j)| {
            let n = j + 1;
            let speeds = self.speeds.nth_of_each(k, self.vehicles.len());
            Column::float(format!("v_{n}_m_per_s"), "m/s", format!("speed of vehicle {n}"), speeds)
        }));
        Table::new(columns)
    }
}
