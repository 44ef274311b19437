//! The growth rate of the longest wave on the ring, by linear theory and as measured in a run.
//!
//! Run it with `cargo run --release --example theory_beside_run`.

use ringroad::error::Error;
use ringroad::measurement::{Measurement, measure};
use ringroad::scenario::Scenario;
use ringroad::simulation::Simulation;
use ringroad::stability::homogeneous::{HomogeneousRing, Time};

/// Growth rates of mode 1, in 1/s.
pub struct GrowthRates {
    /// Reaction time of all drivers, s.
    pub reaction_time: f64,
    /// Real part of the characteristic root of the difference equation that the simulation solves.
    pub theory: f64,
    /// Slope of the logarithm of the amplitude over time.
    pub measured: f64,
}

/// Both rates for the default ring, 50 vehicles on 1000 m, at a reaction time in seconds.
pub fn growth_rates(reaction_time: f64) -> Result<GrowthRates, Error> {
    let mut scenario = Scenario { until: 300.0, ..Scenario::default() };
    scenario.driver.reaction_time = reaction_time;
    // A small nudge, so that the wave stays small and the theory, which is linear, holds for the whole run.
    scenario.actions.push("at=0:1:nudge=0.001".parse()?);

    let headway = scenario.length / scenario.vehicles as f64;
    let ring = HomogeneousRing { vehicles: scenario.vehicles, slope: scenario.driver.slope(headway) };
    let root = ring.root(1, reaction_time, Time::Steps(scenario.time_step));

    let growth = Measurement::named("growth")?;
    let mut probes = [growth.probe(&scenario)?];
    measure(&mut Simulation::new(&scenario)?, &mut probes, &mut |_step| true);
    // A row for each mode; the first is mode 1.
    let table = probes[0].table();
    let measured = table.floats("growth_rate_per_s").expect("a column of the table `growth`")[0];
    Ok(GrowthRates { reaction_time, theory: root.re, measured })
}

fn main() -> Result<(), Error> {
    println!("reaction time (s)  theory (1/s)  run (1/s)");
    for reaction_time in [0.5, 0.6, 0.65, 0.7] {
        let rates = growth_rates(reaction_time)?;
        println!("{:17.2} {:+13.6} {:+10.6}", rates.reaction_time, rates.theory, rates.measured);
    }
    Ok(())
}
