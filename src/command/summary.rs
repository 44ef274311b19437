//! The summary of a run as JSON.

use ringroad::measurement::provenance::VERSION;
use ringroad::scenario::Scenario;
use ringroad::simulation::Simulation;
use serde::Serialize;

/// Vehicles and lanes are numbered from 1.
#[derive(Serialize)]
struct Summary<'a> {
    outcome: &'static str,
    time: f64,
    steps: u64,
    collision: Option<Collision>,
    /// Mean over vehicles and time; none for a run of no length.
    mean_speed_m_per_s: Option<f64>,
    vehicles_per_lane: &'a [usize],
    /// Of all vehicles together.
    lane_changes: u64,
    /// Delays in force at the end: whole steps.
    smallest_delay_s: f64,
    largest_delay_s: f64,
    /// Vehicles whose drivers differ from the default driver at the start.
    exceptions: Vec<OverriddenDriver>,
    version: &'static str,
    scenario: &'a Scenario,
}

#[derive(Serialize)]
struct Collision {
    time: f64,
    behind: usize,
    ahead: usize,
    lane: usize,
}

#[derive(Serialize)]
struct Vehicle {
    #[serde(rename = "vehicle")]
    number: usize,
    /// At the end.
    lane: usize,
    lane_changes: u32,
    distance_m: f64,
}

#[derive(Serialize)]
struct OverriddenDriver {
    #[serde(flatten)]
    vehicle: Vehicle,
    /// Its nearest neighbours in the adjacent lanes at the start, for comparison.
    neighbours: Vec<Neighbour>,
}

#[derive(Serialize)]
struct Neighbour {
    place: &'static str,
    start_lane: usize,
    #[serde(flatten)]
    vehicle: Vehicle,
}

/// Ahead or behind; the lane; the vehicle.
type AdjacentVehicle = (&'static str, usize, usize);

/// Vehicles whose drivers differ at the start, with their nearest neighbours in the adjacent lanes then; indices
/// from 0.
pub(crate) struct Watched(Vec<(usize, Vec<AdjacentVehicle>)>);

impl Watched {
    /// From the state at the start.
    pub(crate) fn new(simulation: &Simulation) -> Self {
        let scenario = simulation.scenario();
        let mut lanes = vec![Vec::new(); scenario.lanes];
        for j in 0..simulation.vehicles() {
            lanes[simulation.lane(j)].push((simulation.position(j), j));
        }
        for lane in &mut lanes {
            lane.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        let neighbours = |j: usize| {
            let (x, own) = (simulation.position(j), simulation.lane(j));
            let adjacent = [own.checked_sub(1), Some(own + 1).filter(|&l| l < lanes.len())];
            let mut found = Vec::new();
            for l in adjacent.into_iter().flatten().filter(|&l| !lanes[l].is_empty()) {
                let lane = &lanes[l];
                // One exactly alongside is not ahead, so it is behind.
                let next = lane.partition_point(|&(other, _)| other <= x);
                found.push(("ahead", l, lane[next % lane.len()].1));
                found.push(("behind", l, lane[(next + lane.len() - 1) % lane.len()].1));
            }
            found
        };
        let drivers = scenario.drivers();
        let differing = (0..drivers.len()).filter(|&j| drivers[j] != scenario.driver);
        Self(differing.map(|j| (j, neighbours(j))).collect())
    }
}

/// The summary, ending in a line break.
pub(crate) fn summary(simulation: &Simulation, watched: &Watched) -> String {
    let n = simulation.vehicles();
    let time = simulation.time();
    let driven: f64 = (0..n).map(|j| simulation.distance(j)).sum();
    let delays = (0..n).map(|j| simulation.delay_steps(j));
    let seconds = |steps: Option<usize>| steps.unwrap_or(0) as f64 * simulation.scenario().time_step;
    let vehicle = |j: usize| Vehicle {
        number: j + 1,
        lane: simulation.lane(j) + 1,
        lane_changes: simulation.lane_changes(j),
        distance_m: simulation.distance(j),
    };
    let overridden = |(j, neighbours): &(usize, Vec<AdjacentVehicle>)| OverriddenDriver {
        vehicle: vehicle(*j),
        neighbours: neighbours
            .iter()
            .map(|&(place, lane, i)| Neighbour { place, start_lane: lane + 1, vehicle: vehicle(i) })
            .collect(),
    };
    let summary = Summary {
        outcome: if simulation.collision().is_some() { "collision" } else { "completed" },
        time,
        steps: simulation.step_index(),
        collision: simulation.collision().map(|c| Collision {
            time: c.time,
            behind: c.behind + 1,
            ahead: c.ahead + 1,
            lane: c.lane + 1,
        }),
        mean_speed_m_per_s: (time > 0.0).then(|| driven / (n as f64 * time)),
        vehicles_per_lane: simulation.vehicles_per_lane(),
        lane_changes: (0..n).map(|j| u64::from(simulation.lane_changes(j))).sum(),
        smallest_delay_s: seconds(delays.clone().min()),
        largest_delay_s: seconds(delays.max()),
        exceptions: watched.0.iter().map(overridden).collect(),
        version: VERSION,
        scenario: simulation.scenario(),
    };
    let mut json = serde_json::to_string_pretty(&summary).expect("plain data");
    json.push('\n');
    json
}
