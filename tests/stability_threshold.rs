//! The threshold of the paper, found by simulation and held against the exact theory of the difference equation
//! `z^{m+1} = z^m + dt·d_1`, d_1 = −c(1 − e^{2πi/N}).

mod common;

use common::{growth_of_mode, theory};
use ringroad::scenario::Scenario;
use ringroad::simulation::Simulation;

/// N drivers, `steps` steps of 0.01 s of delay, vehicle 1 nudged by a tiny bit at t = 0.
fn nudged(vehicles: usize, steps: u32, metres: f64, until: f64) -> Scenario {
    let mut scenario = Scenario { vehicles, until, ..Scenario::default() };
    scenario.driver.reaction_time = f64::from(steps) * 0.01;
    scenario.actions.push(format!("at=0:1:nudge={metres}").parse().unwrap());
    scenario
}

#[test]
fn at_50_vehicles_67_steps_are_stable_and_68_are_not() {
    for steps in [67, 68] {
        let predicted = theory::growth(50, 1, steps, 0.01);
        let measured = growth_of_mode(&nudged(50, steps, 1e-3, 3000.0), 1, 500.0, 3000.0);
        assert_eq!(predicted > 0.0, steps == 68);
        assert!(
            (measured / predicted - 1.0).abs() < 0.02,
            "{steps} steps: measured {measured}, theory {predicted}"
        );
    }
}

#[test]
fn the_simulated_threshold_is_the_discrete_one_to_the_step() {
    for vehicles in [20, 100, 133] {
        let critical = theory::critical_steps(vehicles, 0.01);
        let (below, above) = (critical.floor() as u32, critical.floor() as u32 + 1);
        for (steps, grows) in [(below, false), (above, true)] {
            let measured = growth_of_mode(&nudged(vehicles, steps, 1e-3, 3000.0), 1, 500.0, 3000.0);
            assert_eq!(measured > 0.0, grows, "N = {vehicles}, {steps} steps: {measured}");
        }
    }
}

#[test]
fn long_delays_end_in_a_collision_and_short_ones_do_not() {
    for (reaction_time, collides) in [(0.65, false), (0.75, true), (0.8, true)] {
        let mut scenario = nudged(50, 0, 1.0, 600.0);
        scenario.driver.reaction_time = reaction_time;
        let mut simulation = Simulation::new(&scenario).unwrap();
        simulation.run_to(u64::MAX);
        assert_eq!(simulation.collision().is_some(), collides, "Δ = {reaction_time} s");
        if let Some(collision) = simulation.collision() {
            println!("Δ = {reaction_time} s: collision at {} s", collision.time);
            assert!(simulation.headway(collision.behind) <= 5.0);
            let before = simulation.step_index();
            simulation.step();
            assert_eq!(simulation.step_index(), before, "further steps do nothing");
        } else {
            assert_eq!(simulation.time(), 600.0);
        }
    }
}
