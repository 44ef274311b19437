//! Vehicles in each lane and their imbalance over time; also at a collision.

use super::probe::{Due, Probe, Schedule};
use crate::format::table::{Column, Table};
use crate::simulation::Simulation;

/// The probe of the table `lanes`.
#[derive(Clone, Debug)]
pub struct Lanes {
    schedule: Schedule,
    times: Vec<f64>,
    /// Vehicles of each lane.
    counts: Vec<Vec<u64>>,
    imbalance: Vec<u64>,
    changes: Vec<u64>,
}

impl Lanes {
    /// Rows every so many steps.
    pub fn new(every: u64) -> Self {
        Self {
            schedule: Schedule::with_collision(every),
            times: Vec::new(),
            counts: Vec::new(),
            imbalance: Vec::new(),
            changes: Vec::new(),
        }
    }
}

impl Probe for Lanes {
    fn observe(&mut self, simulation: &Simulation) {
        let due = self.schedule.due(simulation);
        if due == Due::Nothing {
            return;
        }
        if due == Due::Again {
            self.times.pop();
            self.imbalance.pop();
            self.changes.pop();
        }
        let rows = self.times.len();
        let counts = simulation.vehicles_per_lane();
        self.counts.resize_with(counts.len(), Vec::new);
        self.times.push(simulation.time());
        for (column, &count) in self.counts.iter_mut().zip(counts) {
            column.truncate(rows);
            column.push(count as u64);
        }
        let most = counts.iter().max().copied().unwrap_or(0);
        let fewest = counts.iter().min().copied().unwrap_or(0);
        self.imbalance.push((most - fewest) as u64);
        self.changes.push((0..simulation.vehicles()).map(|j| u64::from(simulation.lane_changes(j))).sum());
    }

    fn table(&self) -> Table {
        let mut columns = vec![Column::float("time_s", "s", "time", self.times.clone())];
        columns.extend(self.counts.iter().enumerate().map(|(l, counts)| {
            let lane = l + 1;
            Column::whole(format!("lane_{lane}"), "", format!("vehicles in lane {lane}"), counts.clone())
        }));
        columns.push(Column::whole(
            "imbalance",
            "",
            "ΔN, largest minus smallest number of vehicles in a lane",
            self.imbalance.clone(),
        ));
        columns.push(Column::whole(
            "lane_changes",
            "",
            "lane changes of all vehicles since t = 0",
            self.changes.clone(),
        ));
        Table::new(columns)
    }
}
