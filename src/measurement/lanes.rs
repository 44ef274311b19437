//! Vehicles in each lane and their imbalance over time; also at a collision.

use super::due_rows::DueRows;
use super::probe::Probe;
use crate::format::table::{Column, Table};
use crate::simulation::Simulation;

/// ΔN: largest minus smallest number of vehicles in a lane.
pub(crate) fn imbalance(vehicles_per_lane: &[usize]) -> usize {
    let most = vehicles_per_lane.iter().max().copied().unwrap_or(0);
    let fewest = vehicles_per_lane.iter().min().copied().unwrap_or(0);
    most - fewest
}

/// Lane changes of all vehicles since t = 0.
pub(super) fn lane_changes(simulation: &Simulation) -> u64 {
    (0..simulation.vehicles()).map(|j| u64::from(simulation.lane_changes(j))).sum()
}

/// The probe of the table `lanes`.
#[derive(Clone, Debug)]
pub struct Lanes {
    /// Number of lanes; 0 before the first state.
    lanes: usize,
    /// At each time the number of vehicles in each lane, ΔN, and the number of lane changes.
    counts: DueRows<u64>,
}

impl Lanes {
    /// Rows every so many steps.
    pub fn new(every: u64) -> Self {
        Self { lanes: 0, counts: DueRows::with_collision(every) }
    }
}

impl Probe for Lanes {
    fn observe(&mut self, simulation: &Simulation) {
        if self.counts.begin(simulation).is_some() {
            let counts = simulation.vehicles_per_lane();
            self.lanes = counts.len();
            self.counts.extend(counts.iter().map(|&count| count as u64));
            self.counts.extend([imbalance(counts) as u64, lane_changes(simulation)]);
        }
    }

    fn table(&self) -> Table {
        let values = |k| self.counts.nth_of_each(k, self.lanes + 2);
        let mut columns = vec![Column::float("time_s", "s", "time", self.counts.times().to_vec())];
        columns.extend((0..self.lanes).map(|l| {
            let lane = l + 1;
            Column::whole(format!("lane_{lane}"), "", format!("vehicles in lane {lane}"), values(l))
        }));
        columns.push(Column::whole(
            "imbalance",
            "",
            "ΔN, largest minus smallest number of vehicles in a lane",
            values(self.lanes),
        ));
        columns.push(Column::whole(
            "lane_changes",
            "",
            "lane changes of all vehicles since t = 0",
            values(self.lanes + 1),
        ));
        Table::new(columns)
    }
}
