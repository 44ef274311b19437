//! How many quick drivers stabilize a ring: what linear theory says, and what a run does with one driver fewer and
//! with exactly so many.
//!
//! Run it with `cargo run --release --example stabilizing_drivers`.

use ringroad::error::Error;
use ringroad::scenario::Scenario;
use ringroad::simulation::Simulation;
use ringroad::stability::stabilizing_drivers::{parse_changes, stabilizing_drivers};

/// The smallest number of drivers that must react without delay so that every wave fades, by theory; `None` where
/// even all of them do not suffice.
pub fn by_theory(scenario: &Scenario) -> Result<Option<usize>, Error> {
    let answer = stabilizing_drivers(scenario, &parse_changes("reaction-time=0")?)?;
    Ok(answer.smallest_number)
}

/// The range of the speeds (m/s) at the end of a run whose first `quick` drivers react without delay. The start is
/// uniform, so the range is 0 but for the wave that a nudge of 1 cm has left.
pub fn by_run(scenario: &Scenario, quick: usize) -> Result<f64, Error> {
    let mut scenario = scenario.clone();
    if quick > 0 {
        scenario.overrides.push(format!("1-{quick}:reaction-time=0").parse()?);
    }
    let last = scenario.vehicles;
    scenario.actions.push(format!("at=0:{last}:nudge=0.01").parse()?);
    let mut simulation = Simulation::new(&scenario)?;
    while !simulation.is_finished() {
        simulation.step();
    }
    let speeds = simulation.speeds();
    let fastest = speeds.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let slowest = speeds.iter().copied().fold(f64::INFINITY, f64::min);
    Ok(fastest - slowest)
}

/// 50 vehicles on 1000 m, as by default; at this reaction time the ring is unstable.
pub fn ring() -> Scenario {
    let mut scenario = Scenario { until: 2000.0, ..Scenario::default() };
    scenario.driver.reaction_time = 0.75;
    scenario
}

fn main() -> Result<(), Error> {
    let ring = ring();
    let Some(number) = by_theory(&ring)? else {
        println!("no number of quick drivers stabilizes this ring");
        return Ok(());
    };
    println!("theory: {number} quick drivers of {} stabilize the ring", ring.vehicles);
    for quick in [0, number.saturating_sub(1), number] {
        println!("run with {quick}: speeds differ by {:.6} m/s at the end", by_run(&ring, quick)?);
    }
    Ok(())
}
