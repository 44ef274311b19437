//! Random scenarios: crowded and sparse rings, tiny and long ones, few vehicles over many lanes, heterogeneous drivers,
//! delays of any length, steps up to half a second, and all sorts of actions at any time.

use proptest::prelude::*;
use proptest::sample::select;
use ringroad::scenario::action::{Action, DriverOverride, Effect, VehicleSelector};
use ringroad::scenario::parameters::DriverField;
use ringroad::scenario::value::Value;
use ringroad::scenario::{Scenario, Start};
use std::ops::RangeInclusive;

/// A field of drivers with a value that goes with every other one here.
fn setting() -> impl Strategy<Value = (DriverField, Value)> {
    let field = prop_oneof![
        (5.0..40.0).prop_map(|v| (DriverField::MaxSpeed, v)),
        (0.3..3.0).prop_map(|v| (DriverField::Sensitivity, v)),
        (7.0..15.0).prop_map(|v| (DriverField::MinHeadway, v)),
        (2.0..6.5).prop_map(|v| (DriverField::VehicleLength, v)),
        (0.0..1.0).prop_map(|v| (DriverField::ReactionTime, v)),
        select(vec![0.0, 0.1, 1.0, 4.0]).prop_map(|v| (DriverField::FrustrationRate, v)),
        select(vec![0.0, 0.1, 0.5, 2.0]).prop_map(|v| (DriverField::PassFrustration, v)),
    ];
    field.prop_map(|(field, value)| (field, Value::Number(value)))
}

fn selector(vehicles: usize) -> impl Strategy<Value = VehicleSelector> {
    prop_oneof![
        1 => Just(VehicleSelector::All),
        6 => (1..=vehicles).prop_map(VehicleSelector::Vehicle),
        2 => (1..=vehicles, 1..=vehicles).prop_map(|(a, b)| VehicleSelector::Range(a.min(b), a.max(b))),
        1 => (0.0..60.0).prop_map(VehicleSelector::Share),
    ]
}

fn effect(length: f64) -> impl Strategy<Value = Effect> {
    prop_oneof![
        4 => setting().prop_map(|(p, v)| Effect::Set(p, v)),
        2 => (0.0..5.0).prop_map(Effect::Brake),
        2 => (-1.0..1.0).prop_map(Effect::Nudge),
        // Past several vehicles of the adjacent lanes.
        1 => (-1.0..1.0).prop_map(move |share| Effect::Nudge(share * length)),
        // Exactly alongside, or a whole lap.
        1 => select(vec![-1.0, -0.5, 0.25, 0.5, 1.0]).prop_map(move |share| Effect::Nudge(share * length)),
    ]
}

/// An action at a time from 0 to `until`; often at a time that others share.
pub fn action(vehicles: usize, length: f64, until: f64) -> impl Strategy<Value = Action> {
    let at = prop_oneof![
        1 => Just(0.0),
        3 => 0.0..until,
        1 => Just(0.5 * until),
    ];
    (at, selector(vehicles), prop::collection::vec(effect(length), 1..3))
        .prop_map(|(at, vehicles, effects)| Action { at, vehicles, effects })
}

/// Number of vehicles and length of the ring.
fn road(lanes: usize) -> impl Strategy<Value = (usize, f64)> {
    prop_oneof![
        // Crowded, lane by lane.
        3 => (1..12_usize, 7.6..14.0).prop_map(move |(n, h)| (n * lanes, n as f64 * h)),
        // At ordinary density.
        4 => (2..40_usize, 15.0..60.0).prop_map(move |(n, h)| (n, f64::max(n as f64 * h / lanes as f64, 20.0))),
        // Few vehicles, sparse.
        2 => (1..7_usize, 60.0..400.0).prop_map(move |(n, h)| (n, n as f64 * h / lanes as f64)),
        // Many laps.
        2 => (1..4_usize, 11.0..60.0),
        // Lengths that are exact in every sum, so that vehicles do come to be exactly alongside.
        2 => (select(vec![1_usize, 2, 4, 8]), select(vec![16.0, 32.0, 64.0]))
            .prop_map(move |(n, h)| (n * lanes, n as f64 * h)),
    ]
}

fn start(lanes: usize) -> impl Strategy<Value = Start> {
    prop_oneof![
        3 => Just(Start::Uniform),
        3 => (1..=lanes).prop_map(Start::OneLane),
        2 => Just(Start::Staggered),
        4 => Just(Start::Random),
    ]
}

fn base(lanes: usize) -> impl Strategy<Value = Scenario> {
    let driver = (
        select(vec![10.0, 25.0, 40.0, 90.0]),
        select(vec![0.5, 1.0, 2.0]),
        select(vec![0.0, 0.0, 0.01, 0.2, 0.5, 0.9, 3.0]),
        select(vec![0.0, 0.1, 0.5, 3.0]),
        select(vec![0.0, 0.1, 0.2, 1.0]),
    );
    let step = (select(vec![0.01, 0.05, 0.1, 0.5]), 1..900_u32);
    (road(lanes), start(lanes), driver, step, 0..1_u64 << 53).prop_map(
        move |((vehicles, length), start, (v, lambda, delta, r, p), (time_step, steps), seed)| {
            let mut scenario =
                Scenario { vehicles, length, lanes, time_step, seed, start, ..Scenario::default() };
            scenario.until = f64::from(steps) * time_step;
            let driver = &mut scenario.driver;
            (driver.max_speed, driver.sensitivity, driver.reaction_time) = (v, lambda, delta);
            (driver.frustration_rate, driver.pass_frustration) = (r, p);
            scenario
        },
    )
}

/// Valid scenarios of so many lanes.
pub fn scenarios(lanes: RangeInclusive<usize>) -> impl Strategy<Value = Scenario> {
    lanes
        .prop_flat_map(base)
        .prop_flat_map(|scenario| {
            let differing = (selector(scenario.vehicles), prop::collection::vec(setting(), 1..3))
                .prop_map(|(vehicles, values)| DriverOverride { vehicles, values });
            let action = || action(scenario.vehicles, scenario.length, scenario.until);
            let actions = prop_oneof![
                Just(Vec::new()),
                prop::collection::vec(action(), 1..3),
                prop::collection::vec(action(), 3..8),
            ];
            (Just(scenario), prop::collection::vec(differing, 0..4), actions)
        })
        .prop_filter_map("a scenario that is refused", |(mut scenario, overrides, actions)| {
            (scenario.overrides, scenario.actions) = (overrides, actions);
            scenario.validate().is_ok().then_some(scenario)
        })
}
