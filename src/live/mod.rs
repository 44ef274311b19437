//! A run that is watched: the simulation together with what the page shows of it.
//!
//! | file | subject |
//! |---|---|
//! | this one | the run: its steps, and what theory says of the traffic now |
//! | `recorder` | what is recorded on the way: map, time series, growth of waves |
//! | [`traffic`] | the traffic of an instant in a few numbers |
//! | `edits` | changes: actions, parameters, a new start; previews of them |
//!
//! Memory is bounded however long the run. Tables for files come from the probes in [`crate::measurement`].
//!
//! ```
//! use ringroad::live::{Live, opening};
//!
//! let mut live = Live::new(&opening())?;
//! live.step(6000);
//! assert_eq!(live.simulation().time(), 60.0);
//! assert_eq!(live.stability_summary().stable, Some(false));
//! // The fastest wave grows: its rate is measured over the last minute.
//! assert!(live.growth().unwrap().rate > 0.0);
//!
//! // A shorter reaction time for all drivers, from now on, makes the ring stable.
//! let restarted = live.set("reaction-time", "0.5")?;
//! assert!(!restarted);
//! assert_eq!(live.stability_summary().stable, Some(true));
//! # Ok::<(), ringroad::error::Error>(())
//! ```

mod edits;
mod recorder;
pub mod traffic;

pub use recorder::{BINS, COLUMNS, Column, INTERVAL, MeasuredGrowth};

use crate::error::Error;
use crate::measurement::modal_growth::ModeGrowth;
use crate::scenario::Scenario;
use crate::scenario::action::{Action, Effect, VehicleSelector};
use crate::scenario::driver::{Driver, Equilibrium, equilibrium};
use crate::scenario::link;
use crate::simulation::Simulation;
use crate::stability::lane::Lane;
use crate::stability::roots::LaneRoots;
use crate::stability::stability_diagram::StabilityDiagram;
use crate::stability::summary::StabilitySummary;
use recorder::{Recorder, vehicles_of_lanes};
use std::collections::VecDeque;

/// After a change, the growth of all modes is measured once so many of the longest reaction times have passed: what
/// the change has excited besides the leading roots has died away by then.
const SETTLING_DELAYS: f64 = 20.0;

/// What the page opens with: fifty vehicles beyond the critical reaction time, one of them nudged by 1 m.
pub fn opening() -> Scenario {
    let mut scenario = link::base();
    scenario.driver.reaction_time = 0.75;
    scenario.actions =
        vec![Action { at: 0.0, vehicles: VehicleSelector::Vehicle(1), effects: vec![Effect::Nudge(1.0)] }];
    scenario
}

/// A watched run.
#[derive(Clone, Debug)]
pub struct Live {
    simulation: Simulation,
    recorder: Recorder,
    /// Steps of the scenario's actions, ascending.
    action_steps: Vec<u64>,
    /// Place in that list of the first action that has not been applied.
    next_action: usize,
    /// Grows with everything that changes what theory says.
    changes: u64,
    /// Vehicles in each lane when the last change was seen.
    vehicles_per_lane: Vec<usize>,
    equilibrium: Equilibrium,
    summary: StabilitySummary,
    /// Whether the traffic has changed since the summary was computed. With several lanes the summary is computed only
    /// when it is asked for, since every lane change makes it stale.
    summary_is_stale: bool,
}

impl Live {
    /// The run of a scenario, at t = 0.
    ///
    /// # Errors
    /// What is wrong with the scenario.
    pub fn new(scenario: &Scenario) -> Result<Self, Error> {
        let simulation = Simulation::new(scenario)?;
        let mut live = Self {
            recorder: Recorder::new(&simulation),
            action_steps: Vec::new(),
            next_action: 0,
            changes: 0,
            vehicles_per_lane: Vec::new(),
            equilibrium: Equilibrium::default(),
            summary: StabilitySummary::default(),
            summary_is_stale: true,
            simulation,
        };
        live.read_action_steps();
        live.traffic_has_changed();
        live.record();
        Ok(live)
    }

    // ---- Stepping ----------------------------------------------------------------------------------------------

    /// At most so many steps. Returns how many were taken.
    pub fn step(&mut self, steps: u32) -> u32 {
        let begin = self.simulation.step_index();
        let end = begin + u64::from(steps);
        while !self.simulation.is_finished() && self.simulation.step_index() < end {
            // To the next step at which something is recorded or an action is due.
            let step = self.simulation.step_index();
            let every = self.recorder.every;
            let row = step + every - step % every;
            let due = self.action_steps.get(self.next_action).map_or(u64::MAX, |&due| due.max(step + 1));
            self.simulation.run_to(end.min(row).min(due));
            if self.simulation.step_index() > step {
                self.observe();
            }
        }
        (self.simulation.step_index() - begin) as u32
    }

    fn observe(&mut self) {
        let step = self.simulation.step_index();
        if self.action_steps.get(self.next_action).is_some_and(|&due| due <= step) {
            self.traffic_has_changed();
        }
        if step.is_multiple_of(self.recorder.every) {
            if self.simulation.vehicles_per_lane() != self.vehicles_per_lane {
                self.traffic_has_changed();
            }
            self.record();
        }
    }

    fn record(&mut self) {
        if self.simulation.scenario().lanes == 1 {
            self.stability_summary();
        }
        let theory = (!self.summary_is_stale).then_some(&self.summary);
        self.recorder.record(&self.simulation, self.equilibrium.speed, theory);
    }

    fn read_action_steps(&mut self) {
        let scenario = self.simulation.scenario();
        self.action_steps = scenario.actions_in_time().into_iter().map(|(step, _)| step).collect();
    }

    /// Drivers, lanes or positions have changed: the summary is stale, and growth is measured from now on.
    fn traffic_has_changed(&mut self) {
        let step = self.simulation.step_index();
        self.next_action = self.action_steps.partition_point(|&due| due <= step);
        let scenario = self.simulation.scenario();
        let drivers: Vec<Driver> = (0..scenario.vehicles).map(|j| *self.simulation.driver(j)).collect();
        self.vehicles_per_lane = self.simulation.vehicles_per_lane().to_vec();
        // Vehicles spread evenly over the lanes have the headways of one lane that is as long as all of them together.
        if let Some(e) = equilibrium(&drivers, scenario.length * scenario.lanes as f64) {
            self.equilibrium = e;
        }
        self.summary_is_stale = true;
        self.changes += 1;
        let longest = drivers.iter().map(|d| d.reaction_time).fold(0.0, f64::max);
        self.recorder.restart_growth(step + scenario.steps(SETTLING_DELAYS * longest));
    }

    // ---- Reading -----------------------------------------------------------------------------------------------

    /// The simulation.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }
    /// What theory says of the least stable lane now.
    pub fn stability_summary(&mut self) -> &StabilitySummary {
        if std::mem::take(&mut self.summary_is_stale) {
            let scenario = self.simulation.scenario();
            let lanes: Vec<Vec<Driver>> = (vehicles_of_lanes(&self.simulation).iter())
                .map(|lane| lane.iter().map(|&j| *self.simulation.driver(j)).collect())
                .collect();
            self.summary = StabilitySummary::of(&lanes, scenario.length, scenario.time_step);
        }
        &self.summary
    }
    /// The equilibrium with the vehicles spread evenly over all lanes; the density is that of a lane.
    pub fn equilibrium(&self) -> Equilibrium {
        self.equilibrium
    }
    /// A number that grows whenever [`Self::stability_summary`] or the drivers have changed.
    pub fn changes(&self) -> u64 {
        self.changes
    }
    /// Vehicles (indices) whose speeds are in the rows: five spread over the numbers, or all of fewer.
    pub fn watched(&self) -> &[usize] {
        &self.recorder.watched
    }
    /// Seconds between two rows, and two columns of the map: [`INTERVAL`] rounded to whole steps.
    pub fn interval(&self) -> f64 {
        self.recorder.every as f64 * self.simulation.scenario().time_step
    }
    /// Window of the flow in the rows, s.
    pub fn flow_window(&self) -> f64 {
        self.recorder.flow_window(self.simulation.scenario().time_step)
    }
    /// Columns of the map made so far, of which the newest [`COLUMNS`] are kept.
    pub fn columns_made(&self) -> u64 {
        self.recorder.columns_made
    }
    /// The columns kept, the oldest first.
    pub fn columns(&self) -> &VecDeque<Column> {
        &self.recorder.columns
    }
    /// The rows since this was called last (of more than [`COLUMNS`] the newest), one after another: time (s), mean speed
    /// (m/s), flow through L/2 (veh/s; NaN until a window has passed), ΔN, speeds of the watched vehicles (m/s).
    pub fn take_rows(&mut self) -> Vec<f64> {
        self.recorder.take_rows()
    }
    /// Whether waves are too large now for linear theory.
    pub fn is_large(&self) -> bool {
        self.recorder.is_large
    }
    /// Growth of the wave that theory calls the fastest, in the lane of the summary: over the last minute in which all
    /// waves were small, or since the last change. None before ten seconds of that have passed.
    pub fn growth(&self) -> Option<MeasuredGrowth> {
        self.recorder.growth()
    }
    /// Growth of the Fourier modes of that lane since the last change, mode 1 first; empty before the summary was asked
    /// for.
    pub fn modal_growth(&self) -> Vec<ModeGrowth> {
        self.recorder.modal_growth()
    }
    /// Number of those modes, also before they are measured.
    pub fn modes_followed(&self) -> usize {
        recorder::modes_followed(&self.simulation, &self.summary)
    }
    /// The time from which on that growth is measured, s.
    pub fn modal_from(&self) -> f64 {
        self.recorder.modal_from as f64 * self.simulation.scenario().time_step
    }

    /// The characteristic roots of the lane of the summary: of at most about `most` modes, each with `others` roots besides
    /// the dominant one.
    pub fn roots(&mut self, others: usize, most: usize) -> LaneRoots {
        let lane = self.stability_summary().lane - 1;
        let vehicles = &vehicles_of_lanes(&self.simulation)[lane];
        let drivers = vehicles.iter().map(|&j| *self.simulation.driver(j)).collect();
        let scenario = self.simulation.scenario();
        let lane = Lane::new(drivers, scenario.time_step);
        LaneRoots::of(&lane, scenario.length, scenario.time_step, others, most)
    }

    /// The stability diagram of the lane of the summary: of its drivers where they are homogeneous, otherwise of the
    /// default driver. Its driver has the reaction time at which the lane stands in the diagram.
    pub fn stability_diagram(&mut self) -> StabilityDiagram {
        let &StabilitySummary { homogeneous, lane, .. } = self.stability_summary();
        let settled = self.settled();
        let first =
            (0..self.simulation.vehicles()).find(|&j| homogeneous && self.simulation.lane(j) + 1 == lane);
        let driver = first.map_or(settled.driver, |j| *self.simulation.driver(j));
        StabilityDiagram { driver, ..StabilityDiagram::of(&settled) }
    }
}

#[cfg(test)]
mod tests {
    use super::recorder::{FLOW_ROWS, GROWTH_WINDOW};
    use super::*;

    fn run(link: &str, seconds: f64) -> Live {
        let mut live = Live::new(&link::parse(link).scenario).unwrap();
        let steps = live.simulation().scenario().steps(seconds) as u32;
        assert_eq!(live.step(steps), steps);
        live
    }

    /// In the linear regime the amplitude of the fastest mode follows its root.
    #[test]
    fn growth_measured_agrees_with_theory_on_both_sides() {
        for (delta, grows) in [("0.6", false), ("0.72", true)] {
            let mut live = run(&format!("reaction-time={delta}&action=at%3D0%3A1%3Anudge%3D0.1"), 200.0);
            let (summary, growth) = (*live.stability_summary(), live.growth().unwrap());
            assert_eq!((summary.stable, growth.rate > 0.0), (Some(!grows), grows));
            let predicted = summary.rate.unwrap();
            assert!(
                (growth.rate - predicted).abs() < 0.01 * predicted.abs(),
                "{growth:?}, predicted {predicted}"
            );
            assert_eq!(growth.window, GROWTH_WINDOW);
            assert!((growth.rate - predicted).abs() < growth.nonlinear_bound + 3.0 * growth.standard_error);
            assert!(growth.nonlinear_bound > 0.0 && growth.nonlinear_bound < 0.1 * predicted.abs());
        }
    }

    /// With several lanes the stability diagram is of the lane of the summary, and a point of it says what a run
    /// does that is started there.
    #[test]
    fn stability_diagram_and_summary_are_of_the_same_lane() {
        let mut live = run("vehicles=50&lanes=2&reaction-time=0.75", 0.0);
        let summary = *live.stability_summary();
        let tau = live.stability_diagram().curves([summary.vehicles]).discrete_s[0];
        assert_eq!((summary.lane, summary.vehicles, summary.critical_discrete), (1, 25, tau));
        let previewed = live.preview_point(Some("80"), "0.9").unwrap();
        assert_eq!((previewed.vehicles, previewed.stable), (40, Some(false)));
        live.set("reaction-time", "0.9").unwrap();
        live.set("vehicles", "80").unwrap();
        assert_eq!(previewed, *live.stability_summary());

        // A lane in which all drivers are overridden homogeneous has a diagram of its own; a heterogeneous lane has that of the
        // default driver.
        let mut live = run("vehicles=50&lanes=2&driver=1-25:sensitivity=2,reaction-time=0.4", 0.0);
        let (summary, driver) = (*live.stability_summary(), live.stability_diagram().driver);
        assert_eq!((summary.lane, summary.homogeneous), (1, true));
        assert_eq!((driver.sensitivity, driver.reaction_time), (2.0, 0.4));
        let mut live = run("reaction-time=0.7&driver=1-25:sensitivity=2,reaction-time=0.4", 0.0);
        assert!(!live.stability_summary().homogeneous);
        assert_eq!(
            (live.stability_diagram().driver.sensitivity, live.stability_diagram().driver.reaction_time),
            (1.0, 0.7)
        );
    }

    #[test]
    fn the_map_holds_the_speed_of_every_vehicle_at_its_position_in_a_bounded_number_of_columns() {
        let live = run("vehicles=20&reaction-time=0.3&lanes=2&action=at%3D0%3A1%3Anudge%3D5", 400.0);
        assert_eq!((live.columns().len(), live.columns_made()), (COLUMNS, 801));
        let (s, newest) = (live.simulation(), live.columns().back().unwrap());
        assert_eq!(newest.time, s.time());
        assert!(newest.speeds.iter().all(|v| v.is_finite()));
        let width = s.scenario().length / BINS as f64;
        for j in 0..s.vehicles() {
            // Speed falls or rises by less than 0.1 m/s within a cell here.
            let cell = (s.position(j) / width) as usize % BINS;
            let shown = f64::from(newest.speeds[s.lane(j) * BINS + cell]);
            assert!((shown - s.speed(j)).abs() < 0.1, "vehicle {}: {shown} for {}", j + 1, s.speed(j));
        }
    }

    /// Uniform traffic passes every place at the equilibrium flow, up to one vehicle a window.
    #[test]
    fn flow_is_the_equilibrium_flow() {
        let mut live = run("", 60.0);
        let width = 4 + live.watched().len();
        let rows = live.take_rows();
        assert_eq!(rows.len(), 121 * width);
        let flow = 50.0 / 1000.0 * live.equilibrium().speed;
        let flows: Vec<_> = rows.chunks(width).map(|row| row[2]).filter(|q| !q.is_nan()).collect();
        assert_eq!(flows.len(), 121 - FLOW_ROWS);
        assert!(flows.iter().all(|q| (q - flow).abs() <= 1.0 / live.flow_window()), "{flow}");
        assert!(live.take_rows().is_empty());
    }

    /// Nudged by more than its headway, a vehicle stands beyond its leader: its headway is negative, and it fills no cell of
    /// the map. (A loop over the cells towards the leader never ended there.)
    #[test]
    fn the_map_is_filled_where_a_headway_is_negative() {
        let mut live = run("action=at%3D0%3A1%3Anudge%3D30", 0.0);
        assert_eq!(live.simulation().headway(0), -10.0);
        assert!(live.columns()[0].speeds.iter().all(|v| v.is_finite()));
        live.step(1000);
        assert!(live.simulation().collision().is_some());
        assert_eq!(live.columns().len(), 1, "the run has ended at once");
    }

    /// Long steps and delays, and a nudge over a fifth of the ring, among lane changes.
    #[test]
    fn the_map_is_filled_where_vehicles_change_lanes_after_a_large_nudge() {
        let text = "vehicles=7&lanes=6&length=154.4&time-step=0.3405&reaction-time=2.708&action=at%3D0%3A1%3Anudge%3D30";
        let mut live = run(text, 0.0);
        assert_eq!(live.simulation().scenario().lanes, 6);
        live.step(2000);
        let (simulation, newest) = (live.simulation(), live.columns().back().unwrap());
        for (lane, cells) in newest.speeds.chunks(BINS).enumerate() {
            let is_empty = simulation.vehicles_per_lane()[lane] == 0;
            assert!(cells.iter().all(|v| v.is_nan() == is_empty), "lane {}", lane + 1);
        }
    }
}
