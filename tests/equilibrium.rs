//! A uniform ring that nobody disturbs stays as it is, to the last bit, also where it is unstable.

use ringroad::scenario::Scenario;
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
