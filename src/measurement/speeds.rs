//! Speeds of some vehicles over time, one column each; also at a collision.

use super::probe::{Due, Probe, Schedule};
use crate::format::table::{Column, Table};
use crate::simulation::Simulation;

/// The probe of the table `speeds`.
#[derive(Clone, Debug)]
pub struct Speeds {
    schedule: Schedule,
    times: Vec<f64>,
    /// Index of each vehicle and its speeds.
    of: Vec<(usize, Vec<f64>)>,
}

impl Speeds {
    /// Rows every so many steps, for vehicles given by their numbers from 1.
    pub fn new(every: u64, numbers: &[usize]) -> Self {
        let of = numbers.iter().map(|n| (n - 1, Vec::new())).collect();
        Self { schedule: Schedule::with_collision(every), times: Vec::new(), of }
    }
}

impl Probe for Speeds {
    fn observe(&mut self, simulation: &Simulation) {
        let due = self.schedule.due(simulation);
        if due == Due::Nothing {
            return;
        }
        if due == Due::Again {
            self.times.pop();
        }
        let rows = self.times.len();
        self.times.push(simulation.time());
        for (j, speeds) in &mut self.of {
            speeds.truncate(rows);
            speeds.push(simulation.speed(*j));
        }
    }

    fn table(&self) -> Table {
        let mut columns = vec![Column::float("time_s", "s", "time", self.times.clone())];
        columns.extend(self.of.iter().map(|(j, speeds)| {
            let n = j + 1;
            Column::float(format!("v_{n}_m_per_s"), "m/s", format!("speed of vehicle {n}"), speeds.clone())
        }));
        Table::new(columns)
    }
}
