//! Events: lane changes, refused attempts, passes, and the collision.

use super::probe::Probe;
use crate::format::table::{Column, Table};
use crate::simulation::{Event, Simulation};

/// The probe of the table `events`.
#[derive(Clone, Debug, Default)]
pub struct Events {
    /// Step of the last state, and whether it has collided. An action made by hand shows the same state twice; its events are
    /// taken once.
    last_state: Option<(u64, bool)>,
    events: Vec<(f64, Event)>,
}

impl Probe for Events {
    fn observe(&mut self, simulation: &Simulation) {
        let state = (simulation.step_index(), simulation.collision().is_some());
        if self.last_state.replace(state) == Some(state) {
            return;
        }
        let time = simulation.events_time();
        self.events.extend(simulation.events().iter().map(|&event| (time, event)));
    }

    fn table(&self) -> Table {
        let rows = self.events.len();
        let (mut names, mut vehicles) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
        let mut rest = [const { Vec::new() }; 4];
        for (_, event) in &self.events {
            let none = f64::NAN;
            let number = |index: usize| index as f64 + 1.0;
            let (name, vehicle, values) = match *event {
                Event::LaneChange { vehicle, from, to, frustration } => {
                    ("lane-change", vehicle, [none, number(from), number(to), frustration])
                }
                Event::Refused { vehicle, from, to, frustration } => {
                    ("refused", vehicle, [none, number(from), number(to), frustration])
                }
                Event::Pass { passer, passed } => ("pass", passer, [number(passed), none, none, none]),
                Event::Collision { behind, ahead, lane } => {
                    ("collision", behind, [number(ahead), number(lane), none, none])
                }
            };
            names.push(name.to_owned());
            vehicles.push(vehicle as u64 + 1);
            for (column, value) in rest.iter_mut().zip(values) {
                column.push(value);
            }
        }
        let [others, from, to, frustration] = rest;
        Table::new(vec![
            Column::float("time_s", "s", "time", self.events.iter().map(|e| e.0).collect()),
            Column::text("event", "lane-change, refused (an attempt), pass or collision", names),
            Column::whole(
                "vehicle",
                "",
                "the vehicle that changes lanes, that passes, or that is behind in the collision",
                vehicles,
            ),
            Column::float(
                "other",
                "",
                "the vehicle that is passed, or that is ahead in the collision",
                others,
            ),
            Column::float("from_lane", "", "its lane before", from),
            Column::float("to_lane", "", "the lane aimed at", to),
            Column::float("frustration", "", "frustration φ before", frustration),
        ])
    }
}
