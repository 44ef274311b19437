//! Equilibrium in the simulation: an undisturbed uniform ring keeps it to the last bit, also where it is unstable; and the
//! speeds of the simulation are those of the speed law.

use ringroad::scenario::{Scenario, Start};
use ringroad::simulation::Simulation;

#[test]
fn an_undisturbed_ring_stays_equal_to_the_last_bit() {
    for vehicles in [30, 50, 133] {
        for reaction_time in [0.0, 0.75, 1.0] {
            let mut scenario = Scenario { vehicles, until: 600.0, ..Scenario::default() };
            scenario.driver.reaction_time = reaction_time;
            let mut simulation = Simulation::new(&scenario).unwrap();
            let speed = simulation.speed(0);
            assert!((speed - scenario.driver.speed(1000.0 / vehicles as f64)).abs() < 1e-12);
            simulation.run_to(u64::MAX);
            assert!(simulation.collision().is_none() && simulation.time() == 600.0);
            for j in 0..vehicles {
                assert_eq!(
                    simulation.headway(j),
                    1000.0 / vehicles as f64,
                    "N = {vehicles}, Δ = {reaction_time}"
                );
                assert_eq!(simulation.speed(j), speed);
                assert_eq!(simulation.distance(j), simulation.distance(0));
            }
            assert!((simulation.distance(0) - 600.0 * speed).abs() < 1e-6);
        }
    }
}

/// The simulation has a fast form of the speed law, which changes the speeds of many vehicles at a time; it gives the
/// speeds of the law itself at every headway, for drivers that differ.
#[test]
fn the_fast_form_of_the_speed_law_gives_the_law() {
    let mut scenario = Scenario { vehicles: 40, start: Start::Random, seed: 3, ..Scenario::default() };
    scenario.driver.reaction_time = 0.3;
    scenario.overrides =
        vec!["1-9:sensitivity=1.7,max-speed=33".parse().unwrap(), "20:min-headway=9".parse().unwrap()];
    let mut simulation = Simulation::new(&scenario).unwrap();
    let (mut moving, mut compared) = (0, 0);
    while simulation.time() < 60.0 && simulation.collision().is_none() {
        simulation.run_to(simulation.step_index() + 17);
        for j in 0..scenario.vehicles {
            let law = simulation.driver(j).law();
            let speed = law.speed(simulation.perceived_headway(j));
            assert!(
                (simulation.speed(j) - speed).abs() < 1e-11,
                "vehicle {j}: {} {speed}",
                simulation.speed(j)
            );
            moving += usize::from(speed > 0.0);
            compared += 1;
        }
    }
    assert!(compared > 10_000 && moving > compared / 2);
}
