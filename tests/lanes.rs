//! Lane changing, held against the slow second implementation in `common/twin.rs`.
#![cfg(not(target_arch = "wasm32"))] // proptest is not there

mod common;

use common::scenarios::{self, scenarios};
use common::twin::{Twin, canonical};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed, TestRunner};
use ringroad::scenario::Scenario;
use ringroad::scenario::action::Action;
use ringroad::simulation::attempt_sampler::{ExponentialClock, Literal, Sampler};

use ringroad::simulation::Side;
use ringroad::simulation::{Event, Simulation};

/// How often each event happened over all scenarios, so that the test can require that it did happen.
#[derive(Debug, Default)]
struct Counts {
    scenarios: usize,
    steps: usize,
    changes: usize,
    refused: usize,
    passes: usize,
    collisions: usize,
    coins: usize,
    live: usize,
}

/// Compares everything that can be read.
fn compare<S: Sampler>(fast: &Simulation<S>, twin: &Twin<S>) {
    let n = fast.vehicles();
    for j in 0..n {
        assert_eq!(fast.lane(j), twin.lane[j], "lane of {j}");
        assert_eq!(fast.leader(j), twin.leader[j].vehicle, "leader of {j}");
        assert_eq!(fast.leader(fast.follower(j)), j, "follower of {j}");
        assert_eq!(fast.headway(j).to_bits(), twin.headway(j).to_bits(), "headway of {j}");
        assert_eq!(fast.delay_steps(j), twin.delay[j], "delay of {j}");
        assert_eq!(
            fast.perceived_headway(j).to_bits(),
            twin.perceived_headway(j).to_bits(),
            "perceived headway of {j}"
        );
        assert!((fast.speed(j) - twin.speed(j)).abs() < 1e-9, "speed of {j}");
        assert_eq!(fast.frustration(j).to_bits(), twin.frustration[j].to_bits(), "frustration of {j}");
        assert_eq!(fast.lane_changes(j), twin.lane_changes[j], "lane changes of {j}");
        assert_eq!(fast.driver(j), &twin.drivers[j], "driver of {j}");
        assert!(
            (fast.displacements()[j] - twin.nudged(j) - fast.distance(j)).abs() < 1e-9,
            "distance of {j}"
        );
    }
    for (lane, &count) in fast.vehicles_per_lane().iter().enumerate() {
        assert_eq!(twin.lane.iter().filter(|&&l| l == lane).count(), count, "vehicles in lane {lane}");
    }
    // Vehicles in the same place have an order by rounding only, and have touched already.
    if (0..n).all(|j| twin.headway(j) > 1e-6) {
        for j in 0..n {
            assert_eq!(
                fast.leader(j),
                twin.search_leader(j).vehicle,
                "the search finds another leader of {j}"
            );
            for side in Side::BOTH {
                assert_eq!(fast.adjacent(j, side), twin.adjacent(j, side), "adjacent to {j}, {side:?}");
            }
        }
    }
}

/// Runs both to the end; `live` are actions that are made while running.
fn run<S: Sampler>(scenario: &Scenario, live: &[Action], counts: &mut Counts) {
    let mut fast = Simulation::<S>::with_sampler(scenario).unwrap();
    let mut twin = Twin::<S>::new(scenario);
    counts.scenarios += 1;
    loop {
        for action in live {
            if scenario.steps(action.at) == fast.step_index() && fast.act(action.clone()).is_ok() {
                twin.act_live(action.clone(), fast.displacements());
                counts.live += 1;
            }
        }
        compare(&fast, &twin);
        if fast.is_finished() {
            break;
        }
        twin.change_lanes_and_collide();
        fast.step();
        assert_eq!(canonical(fast.events()), canonical(&twin.events), "in step {}", twin.step);
        assert_eq!(fast.collision().is_some(), twin.collided);
        counts.steps += 1;
        for event in &twin.events {
            match event {
                Event::LaneChange { .. } => counts.changes += 1,
                Event::Refused { .. } => counts.refused += 1,
                Event::Pass { .. } => counts.passes += 1,
                Event::Collision { .. } => counts.collisions += 1,
            }
        }
        if twin.collided {
            break;
        }
        twin.forward_all(fast.displacements());
    }
    counts.coins += twin.coins;
}

fn runner(cases: u32, seed: u64) -> TestRunner {
    TestRunner::new(Config {
        cases,
        rng_seed: RngSeed::Fixed(seed),
        failure_persistence: None,
        max_shrink_iters: 1000,
        ..Config::default()
    })
}

/// A scenario, and actions to be made while running.
fn with_live_actions() -> impl Strategy<Value = (Scenario, Vec<Action>)> {
    scenarios(2..=5).prop_flat_map(|scenario| {
        let action = scenarios::action(scenario.vehicles, scenario.length, scenario.until);
        (Just(scenario), prop::collection::vec(action, 0..4))
    })
}

fn twins_agree<S: Sampler>(cases: u32, seed: u64) {
    let counts = std::cell::RefCell::new(Counts::default());
    runner(cases, seed)
        .run(&with_live_actions(), |(scenario, live)| {
            run::<S>(&scenario, &live, &mut counts.borrow_mut());
            Ok(())
        })
        .unwrap();
    let counts = counts.into_inner();
    println!("{counts:?}");
    assert!(counts.scenarios >= 200);
    assert!(counts.changes > 1000 && counts.refused > 1000 && counts.passes > 1000, "{counts:?}");
    assert!(counts.collisions > 20 && counts.coins > 100 && counts.live > 100, "{counts:?}");
}

#[test]
fn the_twin_has_the_same_events_by_the_literal_sampler() {
    twins_agree::<Literal>(250, 1);
}

#[test]
fn the_twin_has_the_same_events_by_the_exponential_clock() {
    twins_agree::<ExponentialClock>(250, 2);
}

#[test]
fn a_single_lane_is_the_same_to_the_last_bit() {
    runner(100, 3)
        .run(&scenarios(1..=1), |scenario| {
            run::<ExponentialClock>(&scenario, &[], &mut Counts::default());
            Ok(())
        })
        .unwrap();
}
