//! What the presets' texts say, held against theory and simulation.

mod common;

use common::theory;
use ringroad::scenario::Scenario;
use ringroad::scenario::presets::{preset, presets};
use ringroad::simulation::Simulation;

fn end(name: &str) -> Simulation {
    let mut simulation = Simulation::new(&preset(name).unwrap().scenario).unwrap();
    simulation.run_to(u64::MAX);
    simulation
}

#[test]
fn every_preset_runs_and_only_phantom_jam_ends_in_a_collision() {
    for preset in presets() {
        let simulation = end(preset.name);
        assert_eq!(simulation.collision().is_some(), preset.name == "phantom-jam", "{}", preset.name);
        assert!(!preset.title.is_empty() && !preset.notice.is_empty() && !preset.next.is_empty());
    }
    let message = preset("jam").unwrap_err().to_string();
    assert!(message.contains("“jam”") && message.contains("phantom-jam"), "{message}");
}

#[test]
fn single_lane_presets_are_the_papers_case() {
    for (name, reaction_time) in
        [("instant", 0.0), ("stable", 0.5), ("marginal", 0.68), ("phantom-jam", 0.75)]
    {
        let scenario = preset(name).unwrap().scenario;
        assert_eq!((scenario.vehicles, scenario.time_step, scenario.lanes), (50, 0.01, 1));
        assert_eq!(scenario.driver.reaction_time, reaction_time);
        assert_eq!(scenario.actions.iter().map(ToString::to_string).collect::<Vec<_>>(), ["at=0:1:nudge=1"]);
    }
}

/// "At 68 steps of delay … it doubles in 20 hours. At 67 steps it fades."
#[test]
fn the_marginal_ring_doubles_in_twenty_hours() {
    let doubling = std::f64::consts::LN_2 / theory::growth(50, 1, 68, 0.01) / 3600.0;
    println!("doubling time {doubling:.2} h");
    assert_eq!(doubling.round(), 20.0);
    assert!(theory::growth(50, 1, 67, 0.01) < 0.0);
    // Newton's start in `theory` is sound for long waves; τ_q = a/(2c·sin a), a = πq/N, grows with q anyway.
    for q in 2..=10 {
        assert!(theory::growth(50, q, 68, 0.01) < 0.0, "only the longest wave grows, not mode {q}");
    }
}

/// "With 126 the ring is still stable, with 127 it is not": 50 steps of delay.
#[test]
fn the_stable_ring_holds_126_vehicles() {
    assert_eq!(preset("stable").unwrap().scenario.driver.reaction_time, 0.5);
    assert!(theory::critical_steps(126, 0.01) > 50.0);
    assert!(theory::critical_steps(127, 0.01) < 50.0);
}

/// "Lower r and p: the lanes balance later, and with fewer lane changes", in the mean over ten seeds.
#[test]
fn smaller_frustration_parameters_balance_later_with_fewer_changes() {
    let mean = |frustration: Option<f64>| {
        let (mut time, mut changes) = (0.0, 0.0);
        for seed in 1..=10 {
            let mut scenario = Scenario { seed, ..preset("load-balance").unwrap().scenario };
            if let Some(value) = frustration {
                scenario.driver.frustration_rate = value;
                scenario.driver.pass_frustration = value;
            }
            let mut simulation = Simulation::new(&scenario).unwrap();
            let imbalance = |s: &Simulation| s.vehicles_per_lane()[0].abs_diff(s.vehicles_per_lane()[1]);
            while imbalance(&simulation) > 10 && !simulation.is_finished() {
                simulation.step();
            }
            time += simulation.time() / 10.0;
            simulation.run_to(u64::MAX);
            changes += (0..50).map(|j| f64::from(simulation.lane_changes(j))).sum::<f64>() / 10.0;
        }
        (time, changes)
    };
    let (preset_values, smaller) = (mean(None), mean(Some(0.02)));
    println!("time to balance (s), lane changes: {preset_values:?}, with smaller r and p {smaller:?}");
    assert!(
        smaller.0 > 1.5 * preset_values.0 && smaller.1 < 0.75 * preset_values.1,
        "{preset_values:?} {smaller:?}"
    );
}

#[test]
fn lanes_share_the_load() {
    let simulation = end("load-balance");
    let counts = simulation.vehicles_per_lane();
    assert!(counts[0].abs_diff(counts[1]) <= 10, "{counts:?}");
    let simulation = end("three-lanes");
    assert!(simulation.vehicles_per_lane().iter().all(|&n| n >= 14), "{:?}", simulation.vehicles_per_lane());
}

#[test]
fn the_aggressive_driver_changes_lanes_more_often_than_the_rest() {
    let simulation = end("aggressive");
    let others: u32 = (1..50).map(|j| simulation.lane_changes(j)).sum();
    assert!(f64::from(simulation.lane_changes(0)) > 3.0 * f64::from(others) / 49.0);
}
