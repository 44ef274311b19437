//! The equilibrium of each lane: a row for each lane at the start, and again whenever its values have changed.
//!
//! v∞ is the common speed with Σ_j h_j(v∞) = L. c = n·dv∞/dL is the slope of that speed against the mean headway: for
//! homogeneous drivers dv/dh, for heterogeneous ones the harmonic mean of theirs, which determines the speed of long waves. The
//! largest flow is the maximum over all densities, with drivers in the same proportions.

use super::due_rows::DueRows;
use super::probe::Probe;
use crate::format::table::{Column, Table};
use crate::scenario::driver::{Capacity, Driver, equilibrium};
use crate::simulation::Simulation;
use crate::stability::driver_classes::DriverClasses;

/// Values of one lane.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Row {
    vehicles: usize,
    speed: f64,
    density: f64,
    flow: f64,
    slope: f64,
    top: Capacity,
}

/// The probe of the table `equilibrium`.
#[derive(Clone, Debug)]
pub struct Equilibria {
    /// The drivers of each lane when its equilibrium was computed last; `drivers` is those of the lane in work.
    known: Vec<Option<Vec<Driver>>>,
    drivers: Vec<Driver>,
    /// Time (s), lane (from 0), values.
    rows: DueRows<(f64, usize, Row)>,
}

impl Equilibria {
    /// Compares every so many steps.
    pub fn new(every: u64) -> Self {
        Self { known: Vec::new(), drivers: Vec::new(), rows: DueRows::every(every) }
    }
}

fn values(drivers: &[Driver], length: f64) -> Row {
    let n = drivers.len();
    let Some(lane) = equilibrium(drivers, length) else {
        let none = f64::NAN;
        return Row {
            vehicles: 0,
            speed: none,
            density: 0.0,
            flow: 0.0,
            slope: none,
            top: Capacity { density: none, flow: none },
        };
    };
    let equal = drivers.iter().all(|d| d.law() == drivers[0].law());
    let slope = DriverClasses::of(drivers, drivers.iter().map(|d| d.reaction_time), length).mean_slope();
    let top = if equal { drivers[0].capacity() } else { capacity(drivers) };
    Row { vehicles: n, speed: lane.speed, density: lane.density, flow: lane.flow, slope, top }
}

/// The largest flow of heterogeneous drivers over their common speed v: 1/q = Σ h_j(v)/(n·v) has one minimum, since
/// every h_j is convex. Ternary search.
fn capacity(drivers: &[Driver]) -> Capacity {
    let density = |v: f64| drivers.len() as f64 / drivers.iter().map(|d| d.headway(v)).sum::<f64>();
    let (mut low, mut high) = (0.0, drivers.iter().map(|d| d.max_speed).fold(f64::INFINITY, f64::min));
    for _ in 0..100 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if a * density(a) < b * density(b) {
            low = a;
        } else {
            high = b;
        }
    }
    let v = 0.5 * (low + high);
    Capacity { density: density(v), flow: v * density(v) }
}

/// Whether two rows are equal to the last bit; NaN equals NaN.
fn same(a: &Row, b: &Row) -> bool {
    let bits = |r: &Row| [r.speed, r.density, r.flow, r.slope, r.top.density, r.top.flow].map(f64::to_bits);
    a.vehicles == b.vehicles && bits(a) == bits(b)
}

impl Probe for Equilibria {
    fn observe(&mut self, simulation: &Simulation) {
        let Some(replaced) = self.rows.begin(simulation) else { return };
        let time = simulation.time();
        let lanes = simulation.vehicles_per_lane().len();
        self.known.resize(lanes, None);
        if !replaced.is_empty() {
            self.known.fill(None);
        }
        for lane in 0..lanes {
            self.drivers.clear();
            let in_lane = (0..simulation.vehicles()).filter(|&j| simulation.lane(j) == lane);
            self.drivers.extend(in_lane.map(|j| *simulation.driver(j)));
            let is_same = |known: &Vec<Driver>| {
                known.len() == self.drivers.len()
                    && known.iter().zip(&self.drivers).all(|(a, b)| a.law() == b.law())
            };
            if self.known[lane].as_ref().is_some_and(is_same) {
                continue;
            }
            let row = values(&self.drivers, simulation.scenario().length);
            self.known[lane].get_or_insert_default().clone_from(&self.drivers);
            let before = self.rows.rows().iter().rev().find(|r| r.1 == lane);
            if !before.is_some_and(|(_, _, before)| same(before, &row)) {
                self.rows.push((time, lane, row));
            }
        }
    }

    fn table(&self) -> Table {
        let column = |f: fn(&Row) -> f64| self.rows.rows().iter().map(|r| f(&r.2)).collect();
        Table::new(vec![
            Column::float("time_s", "s", "time from which on it holds", self.rows.each(|r| r.0)),
            Column::whole("lane", "", "the lane", self.rows.each(|r| r.1 as u64 + 1)),
            Column::whole("vehicles", "", "vehicles in it", self.rows.each(|r| r.2.vehicles as u64)),
            Column::float("equilibrium_speed_m_per_s", "m/s", "v∞, the common speed", column(|r| r.speed)),
            Column::float("density_veh_per_m", "veh/m", "ρ", column(|r| r.density)),
            Column::float("flow_veh_per_s", "veh/s", "q = ρ·v∞", column(|r| r.flow)),
            Column::float(
                "slope_per_s",
                "1/s",
                "c, slope of v∞ against the mean headway",
                column(|r| r.slope),
            ),
            Column::float(
                "largest_flow_veh_per_s",
                "veh/s",
                "q*, the largest flow over all densities",
                column(|r| r.top.flow),
            ),
            Column::float(
                "critical_density_veh_per_m",
                "veh/m",
                "ρ*, the density where it occurs",
                column(|r| r.top.density),
            ),
        ])
    }
}
