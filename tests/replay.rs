//! A session with actions made by hand is replayed to the last bit from its scenario.
#![cfg(not(target_arch = "wasm32"))]

use proptest::prelude::*;
use ringroad::measurement::Measurement;
use ringroad::measurement::probe::{Probe, act, measure};
use ringroad::measurement::provenance::{Provenance, run_to_csv};
use ringroad::scenario::Scenario;
use ringroad::scenario::action::Action;
use ringroad::simulation::Simulation;

/// The text of an action on one or several of `vehicles`.
fn effect(vehicles: usize) -> impl Strategy<Value = String> {
    let who = prop_oneof![
        Just("all".to_owned()),
        (1..=vehicles).prop_map(|n| n.to_string()),
        (1..=vehicles, 1..=vehicles).prop_map(|(a, b)| format!("{}-{}", a.min(b), a.max(b))),
        (0..=100u32).prop_map(|percent| format!("{percent}%")),
    ];
    let what = prop_oneof![
        (0.0..1.5).prop_map(|v| format!("reaction-time={v}")),
        (0.2..4.0).prop_map(|v| format!("sensitivity={v}")),
        (10.0..50.0).prop_map(|v| format!("max-speed={v}")),
        (5.5..12.0).prop_map(|v| format!("min-headway={v}")),
        (0.0..2.0).prop_map(|v| format!("frustration-rate={v}")),
        (0.0..2.0).prop_map(|v| format!("pass-frustration={v}")),
        (0.0..3.0).prop_map(|v| format!("brake={v}")),
        (-0.5..0.5).prop_map(|v| format!("nudge={v}")),
    ];
    (who, prop::collection::vec(what, 1..3)).prop_map(|(who, what)| format!("{who}:{}", what.join(",")))
}

/// A valid scenario and actions made by hand: (step, text).
fn session() -> impl Strategy<Value = (Scenario, Vec<(u64, String)>)> {
    (1..=4usize, 1..=40usize, 0..4usize, prop::sample::select(vec![0.01, 0.05, 0.1, 0.3]), 0..1000u64)
        .prop_flat_map(|(lanes, vehicles, start, time_step, seed)| {
            let vehicles = if start == 2 { lanes * vehicles.div_ceil(lanes) } else { vehicles.max(lanes) };
            let scenario = Scenario {
                vehicles,
                lanes,
                time_step,
                seed,
                until: 400.0 * time_step,
                start: ["uniform", "one-lane", "staggered", "random"][start].parse().unwrap(),
                ..Scenario::default()
            };
            let exceptions = prop::collection::vec(
                (1..=vehicles, 0.2..4.0, 0.0..1.0)
                    .prop_map(|(n, s, r)| format!("{n}:sensitivity={s},reaction-time={r}").parse().unwrap()),
                0..3,
            );
            let planned = prop::collection::vec((0.0..400.0 * time_step, effect(vehicles)), 0..3);
            let by_hand = prop::collection::vec((0..400u64, effect(vehicles)), 0..6);
            (Just(scenario), exceptions, planned, by_hand, 0.0..0.8)
        })
        .prop_map(|(mut scenario, exceptions, planned, mut by_hand, reaction_time)| {
            scenario.driver.reaction_time = reaction_time;
            scenario.overrides = exceptions;
            scenario.actions =
                planned.iter().map(|(at, what)| format!("at={at}:{what}").parse().unwrap()).collect();
            by_hand.sort_by_key(|&(step, _)| step);
            (scenario, by_hand)
        })
}

fn probes(scenario: &Scenario) -> Vec<(Measurement, Box<dyn Probe>)> {
    ["trajectories", "events", "flow-map", "lanes"]
        .iter()
        .map(|name| {
            let measurement = Measurement::named(name).unwrap();
            let probe = measurement.probe(scenario).unwrap();
            (measurement, probe)
        })
        .collect()
}

fn action(text: &str) -> Action {
    format!("at=0:{text}").parse().unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 192, ..ProptestConfig::default() })]

    #[test]
    fn a_live_run_and_its_replay_agree_to_the_last_bit((scenario, by_hand) in session()) {
        let mut live = Simulation::new(&scenario).unwrap();
        let (measurements, mut watching): (Vec<_>, Vec<_>) = probes(&scenario).into_iter().unzip();
        for probe in &mut watching {
            probe.observe(&live);
        }
        for (step, what) in &by_hand {
            while live.step_index() < *step && !live.is_finished() {
                live.step();
                for probe in &mut watching {
                    probe.observe(&live);
                }
            }
            if live.is_finished() {
                break;
            }
            act(&mut live, &mut watching, action(what)).unwrap();
        }
        while !live.is_finished() {
            live.step();
            for probe in &mut watching {
                probe.observe(&live);
            }
        }
        let recorded = Scenario::from_json(&live.scenario().to_json()).unwrap();
        prop_assert_eq!(&recorded, live.scenario());
        for (measurement, probe) in measurements.iter().zip(&watching) {
            let csv = run_to_csv(&probe.table(), &recorded, measurement);
            let Provenance { scenario, measurement, .. } = Provenance::from_csv(&csv).unwrap();
            let mut again = [measurement.probe(&scenario).unwrap()];
            let mut replay = Simulation::new(&scenario).unwrap();
            measure(&mut replay, &mut again, &mut |_| true);
            prop_assert_eq!(replay.step_index(), live.step_index());
            prop_assert_eq!(replay.collision(), live.collision());
            for j in 0..live.vehicles() {
                let state = |s: &Simulation| {
                    [s.position(j), s.speed(j), s.headway(j), s.perceived_headway(j), s.frustration(j), s.distance(j)]
                        .map(f64::to_bits)
                };
                prop_assert_eq!(state(&replay), state(&live), "vehicle {}", j + 1);
            }
            let again = run_to_csv(&again[0].table(), &scenario, &measurement);
            let different = csv.lines().zip(again.lines()).find(|(a, b)| a != b);
            prop_assert!(csv == again, "{}: {:?}", measurement.name(), different);
        }
    }

    #[test]
    fn a_clone_runs_on_as_the_original((scenario, _) in session()) {
        let mut original = Simulation::new(&scenario).unwrap();
        original.run_to(150);
        let mut copy = original.clone();
        original.run_to(u64::MAX);
        copy.run_to(u64::MAX);
        prop_assert_eq!(original.step_index(), copy.step_index());
        let bits = |s: &Simulation| (0..s.vehicles()).map(|j| s.unwrapped_position(j).to_bits()).collect::<Vec<_>>();
        prop_assert_eq!(bits(&original), bits(&copy));
    }
}
