//! A sweep over the reaction time, written as a table: three runs with random starts at each value.
//!
//! Run it with `cargo run --release --example sweep > sweep.csv`. The command does the same with
//! `ringroad batch --vary reaction-time=0.55:0.8:0.05 --runs 3`.

use ringroad::batch::{Plan, run_all};
use ringroad::error::Error;
use ringroad::measurement::Measurement;
use ringroad::scenario::{Scenario, Start};
use std::collections::BTreeMap;

/// The plan, and its summary: a row for each reaction time, with means over the runs and their confidence intervals.
pub fn sweep() -> Result<String, Error> {
    let scenario = Scenario { until: 120.0, start: Start::Random, ..Scenario::default() };
    let reaction_times = "reaction-time=0.55:0.8:0.05".parse()?;
    // `outcome` measures a run in one row: how it ended, the largest deviation of a speed, and so on.
    let plan = Plan::new(scenario, vec![reaction_times], 3, Measurement::named("outcome")?)?;

    let numbers: Vec<u64> = (0..plan.runs()).collect();
    let mut runs = BTreeMap::new();
    run_all(&plan, &numbers, None, &|_steps| true, &mut |run| {
        runs.insert(run.number, run);
        Ok::<(), Error>(())
    })?;
    Ok(plan.to_csv(&plan.summary(&runs)?))
}

fn main() -> Result<(), Error> {
    print!("{}", sweep()?);
    Ok(())
}
