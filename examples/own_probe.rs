//! A probe of one's own: the smallest headway on the ring over time, and the vehicle that has it.
//!
//! Run it with `cargo run --release --example own_probe`.

use ringroad::error::Error;
use ringroad::format::table::{Column, Table};
use ringroad::measurement::{Probe, measure};
use ringroad::scenario::Scenario;
use ringroad::simulation::Simulation;
use std::collections::BTreeMap;

/// The smallest headway at every step that was observed, by the number of the step.
#[derive(Default)]
struct SmallestHeadway {
    rows: BTreeMap<u64, (f64, usize, f64)>,
}

impl Probe for SmallestHeadway {
    fn observe(&mut self, simulation: &Simulation) {
        let smallest = (0..simulation.vehicles())
            .map(|j| (j, simulation.headway(j)))
            .min_by(|(_, a), (_, b)| a.total_cmp(b));
        if let Some((vehicle, headway)) = smallest {
            // A step that is observed twice replaces its row.
            self.rows.insert(simulation.step_index(), (simulation.time(), vehicle + 1, headway));
        }
    }

    fn table(&self) -> Table {
        let rows = || self.rows.values();
        Table::new(vec![
            Column::float("time_s", "s", "time", rows().map(|row| row.0).collect()),
            Column::whole("vehicle", "", "its number, from 1", rows().map(|row| row.1 as u64).collect()),
            Column::float("headway_m", "m", "smallest headway", rows().map(|row| row.2).collect()),
        ])
    }
}

/// The table of this probe for 60 s of the default ring, whose vehicle 1 is moved by 1 m at the start.
pub fn smallest_headways() -> Result<Table, Error> {
    let mut scenario = Scenario { until: 60.0, ..Scenario::default() };
    scenario.driver.reaction_time = 0.75;
    scenario.actions.push("at=0:1:nudge=1".parse()?);
    let mut simulation = Simulation::new(&scenario)?;
    let mut probes: Vec<Box<dyn Probe>> = vec![Box::new(SmallestHeadway::default())];
    measure(&mut simulation, &mut probes, &mut |_step| true);
    Ok(probes[0].table())
}

fn main() -> Result<(), Error> {
    let mut csv = String::new();
    smallest_headways()?.write_body(&mut csv);
    print!("{csv}");
    Ok(())
}
