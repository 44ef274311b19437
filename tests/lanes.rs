//! Lane changing, held against a slow twin that is written from the sentences of the model.
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

/// How often something happened over all scenarios: a comparison of nothing with nothing would pass too.
#[derive(Debug, Default)]
struct Seen {
    scenarios: usize,
    steps: usize,
    changes: usize,
    refused: usize,
    passes: usize,
    collisions: usize,
    coins: usize,
    live: usize,
}

/// Everything that can be read, the same for both.
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
    // Vehicles in one place have an order by rounding only; they have touched anyway.
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

/// Runs both to the end; `live` are actions made at their time instead of known beforehand.
fn run<S: Sampler>(scenario: &Scenario, live: &[Action], seen: &mut Seen) {
    let mut fast = Simulation::<S>::with_sampler(scenario).unwrap();
    let mut twin = Twin::<S>::new(scenario);
    seen.scenarios += 1;
    loop {
        for action in live {
            if scenario.steps(action.at) == fast.step_index() && fast.act(action.clone()).is_ok() {
                twin.act_live(action.clone(), fast.displacements());
                seen.live += 1;
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
        seen.steps += 1;
        for event in &twin.events {
            match event {
                Event::LaneChange { .. } => seen.changes += 1,
                Event::Refused { .. } => seen.refused += 1,
                Event::Pass { .. } => seen.passes += 1,
                Event::Collision { .. } => seen.collisions += 1,
            }
        }
        if twin.collided {
            break;
        }
        twin.forward_all(fast.displacements());
    }
    seen.coins += twin.coins;
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

/// A scenario and actions to be made live.
fn with_live_actions() -> impl Strategy<Value = (Scenario, Vec<Action>)> {
    scenarios(2..=5).prop_flat_map(|scenario| {
        let action = scenarios::action(scenario.vehicles, scenario.length, scenario.until);
        (Just(scenario), prop::collection::vec(action, 0..4))
    })
}

fn twins_agree<S: Sampler>(cases: u32, seed: u64) {
    let seen = std::cell::RefCell::new(Seen::default());
    runner(cases, seed)
        .run(&with_live_actions(), |(scenario, live)| {
            run::<S>(&scenario, &live, &mut seen.borrow_mut());
            Ok(())
        })
        .unwrap();
    let seen = seen.into_inner();
    println!("{seen:?}");
    assert!(seen.scenarios >= 200);
    assert!(seen.changes > 1000 && seen.refused > 1000 && seen.passes > 1000, "{seen:?}");
    assert!(seen.collisions > 20 && seen.coins > 100 && seen.live > 100, "{seen:?}");
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
            run::<ExponentialClock>(&scenario, &[], &mut Seen::default());
            Ok(())
        })
        .unwrap();
}
