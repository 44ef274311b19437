//! Computing runs: a single one, or many on all cores.

use super::plan::Plan;
use crate::error::Error;
use crate::format::table::{Column, Values};
use crate::measurement::probe::measure;
use crate::numerics::parallel;
use crate::simulation::Simulation;
use std::sync::Mutex;

/// The result of one run.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Number in the plan, from 0.
    pub number: u64,
    /// Time of the end, s: of the collision, or `until` of the scenario.
    pub end: f64,
    /// Whether a collision ended the run.
    pub collided: bool,
    /// What was measured: the values of the columns in [`Plan::columns`].
    pub values: Vec<Values>,
}

impl Plan {
    /// Computes one run. At its start and about every 10 ms of computing time, `progress` gets the vehicle updates (vehicles
    /// times steps) done since its last call, and returns whether to go on; if not, the result is `None`. When a collision
    /// ends a run early, the updates left over are reported as done.
    pub fn run(&self, number: u64, progress: &mut dyn FnMut(u64) -> bool) -> Result<Option<Run>, Error> {
        if !progress(0) {
            return Ok(None);
        }
        let scenario = self.scenario(number);
        let mut probes = [self.measurement().probe(&scenario)?];
        let mut simulation = Simulation::new(&scenario)?;
        let vehicles = scenario.vehicles as u64;
        let mut reported = 0;
        let finished = measure(&mut simulation, &mut probes, &mut |step| {
            let more = (step - reported) * vehicles;
            reported = step;
            progress(more)
        });
        if !finished {
            return Ok(None);
        }
        progress((scenario.last_step() - reported) * vehicles);
        let values = probes[0].table().columns().iter().map(|c| c.values.clone()).collect();
        let collision = simulation.collision();
        Ok(Some(Run { number, end: simulation.time(), collided: collision.is_some(), values }))
    }

    /// Vehicle updates (vehicles times steps) of a run without a collision.
    pub fn work(&self, number: u64) -> u64 {
        let scenario = self.scenario(number);
        scenario.last_step() * scenario.vehicles as u64
    }

    /// The columns measured in every run, without values.
    pub fn columns(&self) -> Vec<Column> {
        let scenario = self.scenario(0);
        let checked = "checked when the plan was made";
        let mut probe = self.measurement().probe(&scenario).expect(checked);
        probe.observe(&Simulation::new(&scenario).expect(checked));
        let mut columns = probe.table().columns().to_vec();
        for column in &mut columns {
            match &mut column.values {
                Values::Float(v) => v.clear(),
                Values::Whole(v) => v.clear(),
                Values::Text(v) => v.clear(),
            }
        }
        columns
    }
}

/// Why not every run was computed.
enum Stop<E> {
    Cancelled,
    Failed(E),
}

/// Computes these runs of the plan and gives each to `finished` when it ends: in any order, but never two at once.
///
/// `threads` is as in [`parallel::try_map`]: by default one for each core. `progress` is as in [`Plan::run`]; it is
/// called from all threads. Returns whether all runs were computed (`false` where `progress` cancelled).
///
/// # Errors
/// The first error of a run or of `finished`; no further run begins after it.
pub fn run_all<E: From<Error> + Send>(
    plan: &Plan,
    numbers: &[u64],
    threads: Option<usize>,
    progress: &(dyn Fn(u64) -> bool + Sync),
    finished: &mut (dyn FnMut(Run) -> Result<(), E> + Send),
) -> Result<bool, E> {
    let finished = Mutex::new(finished);
    let one = |k: usize| {
        let run = plan.run(numbers[k], &mut |work| progress(work)).map_err(|e| Stop::Failed(e.into()))?;
        let run = run.ok_or(Stop::Cancelled)?;
        let mut finished = finished.lock().map_err(|_| Stop::Cancelled)?;
        finished(run).map_err(Stop::Failed)
    };
    match parallel::try_map(numbers.len(), threads, one) {
        Ok(_) => Ok(true),
        Err(Stop::Cancelled) => Ok(false),
        Err(Stop::Failed(error)) => Err(error),
    }
}
