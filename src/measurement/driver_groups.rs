//! Lane changes, distance and mean speed: of every vehicle, and of every group of equal drivers. Also at a collision.
//!
//! A group is named by the parameters in which its drivers differ from the scenario's default driver in the first state:
//! `sensitivity=2`, or `default` where there is none.

use super::due_rows::DueRows;
use super::probe::Probe;
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
        let mut drivers: Vec<Driver> = Vec::new();
        for j in 0..simulation.vehicles() {
            let driver = simulation.driver(j);
            let group = drivers.iter().position(|d| d == driver).unwrap_or_else(|| {
                drivers.push(*driver);
                groups.names.push(name(driver, &simulation.scenario().driver));
                groups.sizes.push(0);
                drivers.len() - 1
            });
            groups.sizes[group] += 1;
            groups.of.push(group);
        }
        groups
    }
}

/// Mean speed since t = 0, m/s; NaN at t = 0.
fn mean_speed(distance: f64, time: f64) -> f64 {
    if time > 0.0 { distance / time } else { f64::NAN }
}

/// The probe of the table `drivers`: a row for each group and time.
#[derive(Clone, Debug)]
pub struct DriverGroups {
    groups: Groups,
    rows: DueRows<GroupSums>,
}

/// Sums over the vehicles of a group.
#[derive(Clone, Copy, Debug, Default)]
struct GroupSums {
    lane_changes: u64,
    distance: f64,
}

impl DriverGroups {
    /// Rows every so many steps.
    pub fn new(every: u64) -> Self {
        Self { groups: Groups::default(), rows: DueRows::with_collision(every) }
    }
}

impl Probe for DriverGroups {
    fn observe(&mut self, simulation: &Simulation) {
        if self.rows.begin(simulation).is_none() {
            return;
        }
        if self.rows.times().len() == 1 {
            self.groups = Groups::new(simulation);
        }
        let mut sums = vec![GroupSums::default(); self.groups.names.len()];
        for (j, &group) in self.groups.of.iter().enumerate() {
            sums[group].lane_changes += u64::from(simulation.lane_changes(j));
            sums[group].distance += simulation.distance(j);
        }
        self.rows.extend(sums);
    }

    fn table(&self) -> Table {
        let (sums, times) = (self.rows.rows(), self.rows.time_of_rows());
        let groups = self.groups.names.len();
        let size = |row: usize| self.groups.sizes[row % groups] as f64;
        let distance = |row: usize| sums[row].distance / size(row);
        let rows = 0..sums.len();
        let mean_speeds = rows.clone().map(|r| mean_speed(distance(r), times[r])).collect();
        Table::new(vec![
            self.rows.time_column(),
            Column::text(
                "group",
                "what sets these drivers apart from the default one",
                rows.clone().map(|r| self.groups.names[r % groups].clone()).collect(),
            ),
            Column::whole(
                "vehicles",
                "",
                "vehicles in the group",
                rows.clone().map(|r| self.groups.sizes[r % groups]).collect(),
            ),
            Column::float(
                "lane_changes_per_vehicle",
                "",
                "lane changes since t = 0, mean over the group",
                rows.clone().map(|r| sums[r].lane_changes as f64 / size(r)).collect(),
            ),
            Column::float(
                "distance_per_vehicle_m",
                "m",
                "distance driven since t = 0, mean over the group",
                rows.map(distance).collect(),
            ),
            Column::float("mean_speed_m_per_s", "m/s", "mean speed since t = 0", mean_speeds),
        ])
    }
}

/// The probe of the table `vehicles`: a row for each vehicle and time.
#[derive(Clone, Debug)]
pub struct Vehicles {
    groups: Groups,
    rows: DueRows<VehicleRow>,
}

/// Values of a vehicle at a time.
#[derive(Clone, Copy, Debug)]
struct VehicleRow {
    lane: u64,
    lane_changes: u64,
    distance: f64,
}

impl Vehicles {
    /// Rows every so many steps.
    pub fn new(every: u64) -> Self {
        Self { groups: Groups::default(), rows: DueRows::with_collision(every) }
    }
}

impl Probe for Vehicles {
    fn observe(&mut self, simulation: &Simulation) {
        if self.rows.begin(simulation).is_none() {
            return;
        }
        if self.rows.times().len() == 1 {
            self.groups = Groups::new(simulation);
        }
        self.rows.extend((0..simulation.vehicles()).map(|j| VehicleRow {
            lane: simulation.lane(j) as u64 + 1,
            lane_changes: u64::from(simulation.lane_changes(j)),
            distance: simulation.distance(j),
        }));
    }

    fn table(&self) -> Table {
        let (n, times) = (self.groups.of.len(), self.rows.time_of_rows());
        let rows = 0..self.rows.rows().len();
        let group = |row: usize| self.groups.names[self.groups.of[row % n]].clone();
        let mean_speeds = self.rows.rows().iter().zip(&times).map(|(r, &t)| mean_speed(r.distance, t));
        Table::new(vec![
            self.rows.time_column(),
            Column::whole(
                "vehicle",
                "",
                "number of the vehicle, from 1",
                rows.clone().map(|r| (r % n) as u64 + 1).collect(),
            ),
            Column::text(
                "group",
                "what sets its driver apart from the default one",
                rows.map(group).collect(),
            ),
            Column::whole("lane", "", "its lane", self.rows.each(|r| r.lane)),
            Column::whole("lane_changes", "", "lane changes since t = 0", self.rows.each(|r| r.lane_changes)),
            Column::float("distance_m", "m", "distance driven since t = 0", self.rows.each(|r| r.distance)),
            Column::float("mean_speed_m_per_s", "m/s", "mean speed since t = 0", mean_speeds.collect()),
        ])
    }
}
