//! Lane changes, distance and mean speed: of every vehicle, and of every group of like drivers. Also at a collision.
//!
//! A group is named by what sets its drivers apart from the scenario's default driver in the first state seen:
//! `sensitivity=2`, or `default`.

use super::probe::{Due, Probe, Schedule};
use crate::format::table::{Column, Table};
use crate::scenario::action::Effect;
use crate::scenario::driver::Driver;
use crate::scenario::parameters::{Field, PARAMETERS};
use crate::simulation::Simulation;

/// Names of the groups, and the group of every vehicle.
#[derive(Clone, Debug, Default)]
struct Groups {
    names: Vec<String>,
    sizes: Vec<u64>,
    of: Vec<usize>,
}

fn name(driver: &Driver, default: &Driver) -> String {
    let differing = PARAMETERS.iter().filter_map(|parameter| match parameter.field {
        Field::Driver(field) if driver.value(field) != default.value(field) => {
            Some(Effect::Set(field, driver.value(field)).to_string())
        }
        _ => None,
    });
    let name = differing.collect::<Vec<_>>().join(" ");
    if name.is_empty() { "default".to_owned() } else { name }
}

impl Groups {
    fn new(simulation: &Simulation) -> Self {
        let mut groups = Self::default();
        let mut known: Vec<Driver> = Vec::new();
        for j in 0..simulation.vehicles() {
            let driver = simulation.driver(j);
            let group = known.iter().position(|d| d == driver).unwrap_or_else(|| {
                known.push(*driver);
                groups.names.push(name(driver, &simulation.scenario().driver));
                groups.sizes.push(0);
                known.len() - 1
            });
            groups.sizes[group] += 1;
            groups.of.push(group);
        }
        groups
    }
}

/// Mean speed since t = 0, m/s; none at t = 0.
fn mean_speed(distance: f64, time: f64) -> f64 {
    if time > 0.0 { distance / time } else { f64::NAN }
}

/// The probe of the table `drivers`: a row for each group and time.
#[derive(Clone, Debug)]
pub struct DriverGroups {
    schedule: Schedule,
    groups: Groups,
    times: Vec<f64>,
    /// Sums over each group.
    changes: Vec<u64>,
    distances: Vec<f64>,
}

impl DriverGroups {
    /// Rows every so many steps.
    pub fn new(every: u64) -> Self {
        let schedule = Schedule::with_collision(every);
        Self { schedule, groups: Groups::default(), times: vec![], changes: vec![], distances: vec![] }
    }
}

impl Probe for DriverGroups {
    fn observe(&mut self, simulation: &Simulation) {
        let due = self.schedule.due(simulation);
        if due == Due::Nothing {
            return;
        }
        if due == Due::Again {
            self.times.pop();
        }
        if self.times.is_empty() {
            self.groups = Groups::new(simulation);
        }
        let groups = self.groups.names.len();
        let start = self.times.len() * groups;
        self.times.push(simulation.time());
        self.changes.truncate(start);
        self.changes.resize(start + groups, 0);
        self.distances.truncate(start);
        self.distances.resize(start + groups, 0.0);
        for (j, &group) in self.groups.of.iter().enumerate() {
            self.changes[start + group] += u64::from(simulation.lane_changes(j));
            self.distances[start + group] += simulation.distance(j);
        }
    }

    fn table(&self) -> Table {
        let groups = self.groups.names.len();
        let rows = self.times.len() * groups;
        let size = |row: usize| self.groups.sizes[row % groups] as f64;
        let distance = |row: usize| self.distances[row] / size(row);
        let time = |row: usize| self.times[row / groups];
        Table::new(vec![
            Column::float("time_s", "s", "time", (0..rows).map(time).collect()),
            Column::text(
                "group",
                "what sets these drivers apart from the default one",
                (0..rows).map(|r| self.groups.names[r % groups].clone()).collect(),
            ),
            Column::whole(
                "vehicles",
                "",
                "vehicles in the group",
                (0..rows).map(|r| self.groups.sizes[r % groups]).collect(),
            ),
            Column::float(
                "lane_changes_per_vehicle",
                "",
                "lane changes since t = 0, mean over the group",
                (0..rows).map(|r| self.changes[r] as f64 / size(r)).collect(),
            ),
            Column::float(
                "distance_per_vehicle_m",
                "m",
                "distance driven since t = 0, mean over the group",
                (0..rows).map(distance).collect(),
            ),
            Column::float(
                "mean_speed_m_per_s",
                "m/s",
                "mean speed since t = 0",
                (0..rows).map(|r| mean_speed(distance(r), time(r))).collect(),
            ),
        ])
    }
}

/// The probe of the table `vehicles`: a row for each vehicle and time.
#[derive(Clone, Debug)]
pub struct Vehicles {
    schedule: Schedule,
    groups: Groups,
    times: Vec<f64>,
    lanes: Vec<u64>,
    changes: Vec<u64>,
    distances: Vec<f64>,
}

impl Vehicles {
    /// Rows every so many steps.
    pub fn new(every: u64) -> Self {
        let schedule = Schedule::with_collision(every);
        Self {
            schedule,
            groups: Groups::default(),
            times: vec![],
            lanes: vec![],
            changes: vec![],
            distances: vec![],
        }
    }
}

impl Probe for Vehicles {
    fn observe(&mut self, simulation: &Simulation) {
        let due = self.schedule.due(simulation);
        if due == Due::Nothing {
            return;
        }
        if due == Due::Again {
            self.times.pop();
        }
        if self.times.is_empty() {
            self.groups = Groups::new(simulation);
        }
        let start = self.times.len() * simulation.vehicles();
        self.times.push(simulation.time());
        self.lanes.truncate(start);
        self.changes.truncate(start);
        self.distances.truncate(start);
        for j in 0..simulation.vehicles() {
            self.lanes.push(simulation.lane(j) as u64 + 1);
            self.changes.push(u64::from(simulation.lane_changes(j)));
            self.distances.push(simulation.distance(j));
        }
    }

    fn table(&self) -> Table {
        let n = self.groups.of.len();
        let rows = self.times.len() * n;
        let time = |row: usize| self.times[row / n];
        let group = |row: usize| self.groups.names[self.groups.of[row % n]].clone();
        Table::new(vec![
            Column::float("time_s", "s", "time", (0..rows).map(time).collect()),
            Column::whole(
                "vehicle",
                "",
                "number of the vehicle, from 1",
                (0..rows).map(|r| (r % n) as u64 + 1).collect(),
            ),
            Column::text(
                "group",
                "what sets its driver apart from the default one",
                (0..rows).map(group).collect(),
            ),
            Column::whole("lane", "", "its lane", self.lanes.clone()),
            Column::whole("lane_changes", "", "lane changes since t = 0", self.changes.clone()),
            Column::float("distance_m", "m", "distance driven since t = 0", self.distances.clone()),
            Column::float(
                "mean_speed_m_per_s",
                "m/s",
                "mean speed since t = 0",
                (0..rows).map(|r| mean_speed(self.distances[r], time(r))).collect(),
            ),
        ])
    }
}
