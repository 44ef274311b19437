//! The whole ring in a few numbers: over time, or at the end of the run.
//!
//! Mean speed and mean flow are those of all vehicles over a span of time, after Edie (1963): with the distance s
//! that all vehicles together have driven in the time T, the mean speed is s/(N·T) and the mean flow, all lanes
//! together, s/(L·T).

use super::due_rows::DueRows;
use super::lanes::{imbalance, lane_changes};
use super::probe::Probe;
use crate::format::table::{Column, Table};
use crate::scenario::Scenario;
use crate::simulation::Simulation;

/// The whole ring at a time.
#[derive(Clone, Copy, Debug)]
struct RingState {
    time: f64,
    /// Distance driven by all vehicles together since t = 0, m.
    distance: f64,
    speed_deviation: f64,
    lane_changes: f64,
    imbalance: u64,
}

impl RingState {
    fn at(simulation: &Simulation) -> Self {
        let n = simulation.vehicles();
        let speeds = simulation.speeds();
        // The mean is taken relative to one of the speeds, so that equal speeds have a deviation of exactly 0.
        let mean = speeds[0] + speeds.iter().map(|v| v - speeds[0]).sum::<f64>() / n as f64;
        let squares: f64 = speeds.iter().map(|v| (v - mean) * (v - mean)).sum();
        Self {
            time: simulation.time(),
            distance: (0..n).map(|j| simulation.distance(j)).sum(),
            speed_deviation: (squares / n as f64).sqrt(),
            lane_changes: lane_changes(simulation) as f64 / n as f64,
            imbalance: imbalance(simulation.vehicles_per_lane()) as u64,
        }
    }
}

/// The columns that both tables have; `span` says over which time means are taken.
fn columns(scenario: (f64, f64), span: &str, states: &[RingState]) -> Vec<Column> {
    let (vehicles, length) = scenario;
    // Distance per time since the row before, or since t = 0.
    let rate = |k: usize| {
        let (before, driven) = k.checked_sub(1).map_or((0.0, 0.0), |k| (states[k].time, states[k].distance));
        let time = states[k].time - before;
        if time > 0.0 { (states[k].distance - driven) / time } else { f64::NAN }
    };
    let speeds = (0..states.len()).map(|k| rate(k) / vehicles).collect();
    let flows = (0..states.len()).map(|k| rate(k) / length).collect();
    vec![
        Column::float("mean_speed_m_per_s", "m/s", format!("mean speed of all vehicles {span}"), speeds),
        Column::float(
            "mean_flow_veh_per_s",
            "veh/s",
            format!("mean flow, all lanes together, {span}"),
            flows,
        ),
        Column::float(
            "speed_deviation_m_per_s",
            "m/s",
            "standard deviation of the vehicles' speeds at that time",
            states.iter().map(|l| l.speed_deviation).collect(),
        ),
        Column::float(
            "lane_changes_per_vehicle",
            "",
            "lane changes since t = 0, mean of all vehicles",
            states.iter().map(|l| l.lane_changes).collect(),
        ),
        Column::whole(
            "imbalance",
            "",
            "ΔN, largest minus smallest number of vehicles in a lane",
            states.iter().map(|l| l.imbalance).collect(),
        ),
    ]
}

/// The probe of the table `overview`.
#[derive(Clone, Debug)]
pub struct Overview {
    /// N and L.
    ring: (f64, f64),
    states: DueRows<RingState>,
}

impl Overview {
    /// Rows every so many steps.
    pub fn new(scenario: &Scenario, every: u64) -> Self {
        let ring = (scenario.vehicles as f64, scenario.length);
        Self { ring, states: DueRows::every(every) }
    }
}

impl Probe for Overview {
    fn observe(&mut self, simulation: &Simulation) {
        self.states.record(simulation, || RingState::at(simulation));
    }

    fn table(&self) -> Table {
        let mut all = vec![self.states.time_column()];
        all.extend(columns(self.ring, "since the row before", self.states.rows()));
        Table::new(all)
    }
}

/// The probe of the table `outcome`. It has no row before the run has ended: evaluating every step would take longer than the
/// step itself.
#[derive(Clone, Debug)]
pub struct Outcome {
    ring: (f64, f64),
    collided: bool,
    end: Option<RingState>,
}

impl Outcome {
    /// Of a run of that scenario.
    pub fn new(scenario: &Scenario) -> Self {
        Self { ring: (scenario.vehicles as f64, scenario.length), collided: false, end: None }
    }
}

impl Probe for Outcome {
    fn observe(&mut self, simulation: &Simulation) {
        if simulation.is_finished() {
            self.collided = simulation.collision().is_some();
            self.end = Some(RingState::at(simulation));
        }
    }

    fn table(&self) -> Table {
        let states: Vec<RingState> = self.end.into_iter().collect();
        let outcome = if self.collided { "collision" } else { "end" };
        let mut all = vec![
            Column::text(
                "outcome",
                "collision, or the end asked for",
                states.iter().map(|_| outcome.to_owned()).collect(),
            ),
            Column::float(
                "end_time_s",
                "s",
                "time at which the run ended",
                states.iter().map(|l| l.time).collect(),
            ),
        ];
        all.extend(columns(self.ring, "since t = 0", &states));
        Table::new(all)
    }
}
