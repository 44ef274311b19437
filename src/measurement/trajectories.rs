//! Trajectories: the state of every vehicle, a row for each vehicle and time, also at a collision.

use super::probe::{Due, Probe, Schedule};
use crate::format::table::{Column, Table};
use crate::simulation::Simulation;

/// The probe of the table `trajectories`.
#[derive(Clone, Debug)]
pub struct Trajectories {
    schedule: Schedule,
    vehicles: usize,
    times: Vec<f64>,
    lane: Vec<u64>,
    position: Vec<f64>,
    speed: Vec<f64>,
    headway: Vec<f64>,
    perceived: Vec<f64>,
    frustration: Vec<f64>,
    distance: Vec<f64>,
    lane_changes: Vec<u64>,
}

impl Trajectories {
    /// Rows every so many steps.
    pub fn new(every: u64) -> Self {
        Self {
            schedule: Schedule::with_collision(every),
            vehicles: 0,
            times: Vec::new(),
            lane: Vec::new(),
            position: Vec::new(),
            speed: Vec::new(),
            headway: Vec::new(),
            perceived: Vec::new(),
            frustration: Vec::new(),
            distance: Vec::new(),
            lane_changes: Vec::new(),
        }
    }
}

impl Probe for Trajectories {
    fn observe(&mut self, simulation: &Simulation) {
        let due = self.schedule.due(simulation);
        if due == Due::Nothing {
            return;
        }
        self.vehicles = simulation.vehicles();
        if due == Due::Again {
            self.times.pop();
            let rows = self.times.len() * self.vehicles;
            self.lane.truncate(rows);
            self.lane_changes.truncate(rows);
            for column in [
                &mut self.position,
                &mut self.speed,
                &mut self.headway,
                &mut self.perceived,
                &mut self.frustration,
                &mut self.distance,
            ] {
                column.truncate(rows);
            }
        }
        self.times.push(simulation.time());
        for j in 0..self.vehicles {
            self.lane.push(simulation.lane(j) as u64 + 1);
            self.position.push(simulation.position(j));
            self.speed.push(simulation.speed(j));
            self.headway.push(simulation.headway(j));
            self.perceived.push(simulation.perceived_headway(j));
            self.frustration.push(simulation.frustration(j));
            self.distance.push(simulation.distance(j));
            self.lane_changes.push(u64::from(simulation.lane_changes(j)));
        }
    }

    fn table(&self) -> Table {
        let n = self.vehicles;
        let times = self.times.iter().flat_map(|&t| std::iter::repeat_n(t, n)).collect();
        let numbers = self.times.iter().flat_map(|_| 1..=n as u64).collect();
        Table::new(vec![
            Column::float("time_s", "s", "time", times),
            Column::whole("vehicle", "", "number of the vehicle, from 1", numbers),
            Column::whole("lane", "", "its lane; lane 1 is the outermost", self.lane.clone()),
            Column::float("position_m", "m", "position of its centre on the ring", self.position.clone()),
            Column::float("speed_m_per_s", "m/s", "speed, that of the perceived headway", self.speed.clone()),
            Column::float("headway_m", "m", "true headway, from centre to centre", self.headway.clone()),
            Column::float(
                "perceived_headway_m",
                "m",
                "headway as the driver perceives it, a reaction time ago",
                self.perceived.clone(),
            ),
            Column::float("frustration", "", "frustration φ of the driver", self.frustration.clone()),
            Column::float("distance_m", "m", "distance driven since t = 0", self.distance.clone()),
            Column::whole("lane_changes", "", "lane changes since t = 0", self.lane_changes.clone()),
        ])
    }
}
