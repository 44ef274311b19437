//! Trajectories: the state of every vehicle, a row for each vehicle and time; also at a collision.

use super::due_rows::DueRows;
use super::probe::Probe;
use crate::format::table::{Column, Table};
use crate::simulation::Simulation;

/// The probe of the table `trajectories`.
#[derive(Clone, Debug)]
pub struct Trajectories {
    rows: DueRows<State>,
}

/// The state of a vehicle.
#[derive(Clone, Copy, Debug)]
struct State {
    lane: u32,
    lane_changes: u32,
    position: f64,
    speed: f64,
    headway: f64,
    perceived_headway: f64,
    frustration: f64,
    distance: f64,
}

impl State {
    fn of(simulation: &Simulation, j: usize) -> Self {
        Self {
            lane: simulation.lane(j) as u32 + 1,
            lane_changes: simulation.lane_changes(j),
            position: simulation.position(j),
            speed: simulation.speed(j),
            headway: simulation.headway(j),
            perceived_headway: simulation.perceived_headway(j),
            frustration: simulation.frustration(j),
            distance: simulation.distance(j),
        }
    }
}

impl Trajectories {
    /// Rows every so many steps.
    pub fn new(every: u64) -> Self {
        Self { rows: DueRows::with_collision(every) }
    }
}

impl Probe for Trajectories {
    fn observe(&mut self, simulation: &Simulation) {
        if self.rows.begin(simulation).is_some() {
            self.rows.extend((0..simulation.vehicles()).map(|j| State::of(simulation, j)));
        }
    }

    fn table(&self) -> Table {
        let rows = &self.rows;
        let numbers = rows.times().iter().flat_map(|_| 1..=rows.per_time() as u64).collect();
        Table::new(vec![
            rows.time_column(),
            Column::whole("vehicle", "", "number of the vehicle, from 1", numbers),
            Column::whole("lane", "", "its lane; lane 1 is the outermost", rows.each(|s| s.lane.into())),
            Column::float("position_m", "m", "position of its centre on the ring", rows.each(|s| s.position)),
            Column::float(
                "speed_m_per_s",
                "m/s",
                "speed, that of the perceived headway",
                rows.each(|s| s.speed),
            ),
            Column::float("headway_m", "m", "true headway, from centre to centre", rows.each(|s| s.headway)),
            Column::float(
                "perceived_headway_m",
                "m",
                "headway as the driver perceives it, a reaction time ago",
                rows.each(|s| s.perceived_headway),
            ),
            Column::float("frustration", "", "frustration φ of the driver", rows.each(|s| s.frustration)),
            Column::float("distance_m", "m", "distance driven since t = 0", rows.each(|s| s.distance)),
            Column::whole(
                "lane_changes",
                "",
                "lane changes since t = 0",
                rows.each(|s| s.lane_changes.into()),
            ),
        ])
    }
}
