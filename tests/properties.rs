//! What holds in every run, over random scenarios.
#![cfg(not(target_arch = "wasm32"))] // proptest is native

mod common;

use common::scenarios::{self, scenarios};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};
use ringroad::scenario::action::Action;
use ringroad::scenario::{Scenario, Start};
use ringroad::simulation::Side;
use ringroad::simulation::frustration::{attempt_probability, attempt_probability_in_step};
use ringroad::simulation::{Event, Simulation};

fn config(cases: u32, seed: u64) -> Config {
    Config { cases, rng_seed: RngSeed::Fixed(seed), failure_persistence: None, ..Config::default() }
}

/// Everything that can be read, as bits.
fn bits(simulation: &Simulation) -> Vec<u64> {
    let mut all = vec![simulation.step_index(), simulation.time().to_bits(), simulation.is_finished().into()];
    all.extend(simulation.vehicles_per_lane().iter().map(|&n| n as u64));
    if let Some(c) = simulation.collision() {
        all.extend([c.time.to_bits(), c.behind as u64, c.ahead as u64, c.lane as u64]);
    }
    for j in 0..simulation.vehicles() {
        all.extend([simulation.lane(j), simulation.leader(j), simulation.follower(j)].map(|n| n as u64));
        all.extend(Side::BOTH.map(|side| simulation.adjacent(j, side).map_or(u64::MAX, |i| i as u64)));
        all.extend([simulation.delay_steps(j) as u64, u64::from(simulation.lane_changes(j))]);
        let numbers = [
            simulation.unwrapped_position(j),
            simulation.position(j),
            simulation.displacements()[j],
            simulation.distance(j),
            simulation.speed(j),
            simulation.headway(j),
            simulation.perceived_headway(j),
            simulation.frustration(j),
        ];
        all.extend(numbers.map(f64::to_bits));
        let d = simulation.driver(j);
        let driver = [
            d.max_speed,
            d.sensitivity,
            d.min_headway,
            d.vehicle_length,
            d.reaction_time,
            d.frustration_rate,
            d.pass_frustration,
        ];
        all.extend(driver.map(f64::to_bits));
    }
    all
}

/// Distance between two vehicles round the ring, the shorter way.
fn apart(a: f64, b: f64, length: f64) -> f64 {
    let d = (a - b).rem_euclid(length);
    d.min(length - d)
}

/// One step, with all that must hold before, in and after it.
fn checked_step(simulation: &mut Simulation) {
    let n = simulation.vehicles();
    let length = simulation.scenario().length;
    let lost = (0..n).any(|j| simulation.headway(j) <= 0.0);
    let mut lane: Vec<usize> = (0..n).map(|j| simulation.lane(j)).collect();
    let positions: Vec<f64> = (0..n).map(|j| simulation.position(j)).collect();
    let min_headways: Vec<f64> = (0..n).map(|j| simulation.driver(j).min_headway).collect();
    simulation.step();
    assert!(!lost || simulation.collision().is_some(), "an order lost without a collision");
    let mut changed = vec![false; n];
    for event in simulation.events() {
        match *event {
            Event::LaneChange { vehicle, from, to, frustration } => {
                assert!(!lost && frustration > 0.0 && lane[vehicle] == from && from.abs_diff(to) == 1);
                for i in (0..n).filter(|&i| lane[i] == to) {
                    assert!(
                        apart(positions[i], positions[vehicle], length)
                            > min_headways[vehicle] - 1e-9 * length
                    );
                }
                lane[vehicle] = to;
                changed[vehicle] = true;
            }
            Event::Pass { passer, passed } => assert!(passer != passed && !lost),
            Event::Refused { vehicle, from, to, .. } => {
                assert!(lane[vehicle] == from && to < simulation.scenario().lanes && from.abs_diff(to) == 1);
            }
            Event::Collision { behind, ahead, lane: place } => {
                assert_eq!((lane[behind], lane[ahead]), (place, place));
                assert!(simulation.is_finished());
            }
        }
    }
    for j in 0..n {
        assert_eq!(simulation.lane(j), lane[j], "lanes change by lane changes only");
        assert!(simulation.frustration(j) >= 0.0 && (!changed[j] || simulation.frustration(j) == 0.0));
    }
    assert_eq!(simulation.vehicles_per_lane().iter().sum::<usize>(), n);
    check_order(simulation);
}

/// Following the leaders from any vehicle leads back to it after one lap, past every vehicle of the lane.
fn check_order(simulation: &Simulation) {
    let n = simulation.vehicles();
    for (lane, &count) in simulation.vehicles_per_lane().iter().enumerate() {
        let in_lane: Vec<usize> = (0..n).filter(|&j| simulation.lane(j) == lane).collect();
        assert_eq!(in_lane.len(), count);
        let Some(&first) = in_lane.first() else { continue };
        let (mut j, mut round, mut met) = (first, 0.0, 0);
        loop {
            assert_eq!(simulation.follower(simulation.leader(j)), j);
            round += simulation.headway(j);
            met += 1;
            j = simulation.leader(j);
            if j == first || met > n {
                break;
            }
        }
        assert_eq!(met, count);
        assert!((round - simulation.scenario().length).abs() < 1e-6, "{round} m round lane {lane}");
    }
}

proptest! {
    #![proptest_config(config(150, 11))]
    #[test]
    fn every_step_keeps_the_rules(scenario in scenarios(1..=5)) {
        let mut simulation = Simulation::new(&scenario).unwrap();
        check_order(&simulation);
        while !simulation.is_finished() {
            checked_step(&mut simulation);
        }
        let last = bits(&simulation);
        simulation.step();
        prop_assert_eq!(bits(&simulation), last, "further steps do nothing");
    }

    #[test]
    fn a_clone_has_the_same_future(scenario in scenarios(1..=5), share in 0.0..1.0) {
        let mut original = Simulation::new(&scenario).unwrap();
        original.run_to((scenario.last_step() as f64 * share) as u64);
        let mut clone = original.clone();
        while !original.is_finished() {
            original.step();
            clone.step();
            prop_assert_eq!(original.events(), clone.events());
        }
        prop_assert_eq!(bits(&original), bits(&clone));
    }

    #[test]
    fn what_was_done_live_is_replayed_to_the_last_bit(
        (scenario, live) in scenarios(1..=5).prop_flat_map(|scenario| {
            let action = || scenarios::action(scenario.vehicles, scenario.length, scenario.until);
            let live = prop::collection::vec((action(), prop::option::of(action())), 1..6);
            (Just(scenario), live)
        })
    ) {
        let mut simulation = Simulation::new(&scenario).unwrap();
        let mut states = Vec::new();
        loop {
            let step = simulation.step_index();
            for (action, other) in live.iter().filter(|(a, _): &&(Action, _)| scenario.steps(a.at) == step) {
                // Some are done again, with something else done to the same vehicles in between.
                let again = other.iter().flat_map(|o| [Action { vehicles: action.vehicles, ..o.clone() }, action.clone()]);
                for action in [action.clone()].into_iter().chain(again) {
                    let before = bits(&simulation);
                    let refused = simulation.act(action).is_err();
                    prop_assert!(refused || simulation.collision().is_none(), "nothing can be done after a collision");
                    if refused {
                        prop_assert_eq!(&bits(&simulation), &before, "a refused action changes nothing");
                    }
                    simulation.forget_replaced();
                }
            }
            states.push(bits(&simulation));
            if simulation.is_finished() {
                break;
            }
            simulation.step();
        }
        // Through JSON, as a link or a file would carry it.
        let replayed = Scenario::from_json(&simulation.scenario().to_json()).unwrap();
        prop_assert_eq!(&replayed, simulation.scenario());
        let mut replay = Simulation::new(&replayed).unwrap();
        for state in &states {
            // What a live action showed after the last step is not a state of its own.
            prop_assert_eq!(&bits(&replay), state);
            replay.step();
        }
    }

    #[test]
    fn steps_compose_to_a_second(phi in 0.0..50.0, steps in 1..1000_u32) {
        let per_step = attempt_probability_in_step(phi, 1.0 / f64::from(steps));
        let none = (0..steps).fold(1.0, |none, _| none * (1.0 - per_step));
        prop_assert!((1.0 - none - attempt_probability(phi)).abs() < 1e-12);
    }
}

fn all_events(seed: u64) -> Vec<Event> {
    let mut scenario =
        Scenario { vehicles: 50, lanes: 3, time_step: 0.05, until: 60.0, seed, ..Scenario::default() };
    scenario.start = Start::OneLane(2);
    let mut simulation = Simulation::new(&scenario).unwrap();
    let mut events = Vec::new();
    while !simulation.is_finished() {
        simulation.step();
        events.extend_from_slice(simulation.events());
    }
    assert!(events.iter().any(|e| matches!(e, Event::LaneChange { .. })));
    events
}

proptest! {
    #![proptest_config(config(300, 14))]
    /// Where nothing but driving happens, many steps of homogeneous drivers are computed at once. Computed one by one they are the same: with
    /// actions in between, with pauses, up to the step of a collision.
    #[test]
    fn steps_at_once_are_the_same_steps(
        mut scenario in scenarios(1..=1),
        vehicles in prop_oneof![Just(None), (2..1500_usize).prop_map(Some)],
        delay in prop_oneof![Just(None), (0.05..1.2).prop_map(Some)],
        homogeneous in prop::bool::weighted(0.8),
        pauses in prop::collection::vec(0.0..1.0, 0..6),
    ) {
        if homogeneous {
            scenario.overrides.clear();
        }
        if let Some(vehicles) = vehicles {
            scenario.length *= vehicles as f64 / scenario.vehicles as f64;
            scenario.vehicles = vehicles;
            scenario.actions.truncate(2);
        }
        if let Some(delay) = delay {
            scenario.driver.reaction_time = delay;
            scenario.time_step = 0.01;
            scenario.until = scenario.until.min(8.0);
        }
        prop_assume!(scenario.validate().is_ok());
        let mut pauses: Vec<_> = pauses.iter().map(|share| (scenario.last_step() as f64 * share) as u64).collect();
        pauses.push(scenario.last_step());
        pauses.sort_unstable();
        let (mut once, mut single) = (Simulation::new(&scenario).unwrap(), Simulation::new(&scenario).unwrap());
        for pause in pauses {
            once.run_to(pause);
            while single.step_index() < pause && !single.is_finished() {
                single.step();
            }
            prop_assert_eq!(bits(&once), bits(&single));
            prop_assert_eq!(once.events(), single.events());
        }
    }
}

#[test]
fn equal_seeds_give_equal_events_and_different_seeds_different_ones() {
    let events: Vec<_> = (0..8).map(all_events).collect();
    for (seed, one) in events.iter().enumerate() {
        assert_eq!(*one, all_events(seed as u64));
        assert!(events[..seed].iter().all(|other| other != one));
    }
}

#[test]
fn staggered_homogeneous_drivers_never_change_lane() {
    for lanes in 2..=5 {
        for per_lane in [1, 7, 10, 12] {
            for reaction_time in [0.0, 0.5] {
                let vehicles = lanes * per_lane;
                let mut scenario =
                    Scenario { vehicles, lanes, time_step: 0.05, until: 600.0, ..Scenario::default() };
                scenario.start = Start::Staggered;
                scenario.driver.frustration_rate = 1.0;
                scenario.driver.reaction_time = reaction_time;
                let mut simulation = Simulation::new(&scenario).unwrap();
                while !simulation.is_finished() {
                    simulation.step();
                    assert_eq!(simulation.events(), [], "{lanes} lanes of {per_lane}");
                }
                for j in 0..vehicles {
                    assert_eq!((simulation.lane_changes(j), simulation.frustration(j)), (0, 0.0));
                }
            }
        }
    }
}

#[test]
fn homogeneous_drivers_exactly_alongside_are_never_frustrated() {
    for lanes in 2..=4 {
        for per_lane in [3, 7, 25, 30] {
            let vehicles = lanes * per_lane;
            let scenario = Scenario { vehicles, lanes, time_step: 0.05, until: 60.0, ..Scenario::default() };
            let mut simulation = Simulation::new(&scenario).unwrap();
            simulation.run_to(u64::MAX);
            for j in 0..vehicles {
                assert_eq!(simulation.frustration(j), 0.0, "equal headways, {lanes} lanes of {per_lane}");
            }
        }
    }
}
