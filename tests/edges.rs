//! Lane changing at the edges of its rules, in scenarios where every sum is exact: ties, vehicles exactly alongside,
//! headways of exactly d, whole laps.

use ringroad::numerics::random::Generator;
use ringroad::scenario::{Scenario, Start};
use ringroad::simulation::Side;
use ringroad::simulation::attempt_sampler::Sampler;
use ringroad::simulation::{Event, Simulation};

/// Attempts a change in every step in which there is frustration; the coin always falls on the same side.
#[derive(Clone)]
struct Eager<const HEADS: bool>;

impl<const HEADS: bool> Sampler for Eager<HEADS> {
    fn new(_: usize, _: f64, _: Generator) -> Self {
        Self
    }
    fn attempts(&mut self, _: usize, frustration: f64) -> bool {
        frustration > 0.0
    }
    fn coin(&mut self) -> bool {
        HEADS
    }
}

/// 64 m, steps of 1/16 s, d = 8 m, r = 1 per second, p = 1: so that all sums are exact. All vehicles are braked.
fn standing(vehicles: usize, lanes: usize, start: Start) -> Scenario {
    let mut scenario =
        Scenario { vehicles, lanes, start, length: 64.0, time_step: 0.0625, ..Scenario::default() };
    scenario.driver.min_headway = 8.0;
    scenario.driver.frustration_rate = 1.0;
    scenario.driver.pass_frustration = 1.0;
    scenario.actions.push("at=0:all:brake=1000".parse().unwrap());
    scenario
}

fn with(mut scenario: Scenario, actions: &[&str]) -> Scenario {
    scenario.actions.extend(actions.iter().map(|a| a.parse().unwrap()));
    scenario
}

fn run<S: Sampler>(scenario: &Scenario, steps: u64) -> (Simulation<S>, Vec<Event>) {
    let mut simulation = Simulation::<S>::with_sampler(scenario).unwrap();
    let mut events = Vec::new();
    for _ in 0..steps {
        simulation.step();
        events.extend_from_slice(simulation.events());
    }
    (simulation, events)
}

#[test]
fn exactly_alongside_is_not_ahead_and_equal_headways_change_nothing() {
    let (simulation, events) = run::<Eager<true>>(&standing(8, 2, Start::Uniform), 50);
    assert_eq!(events, []);
    for j in 0..4 {
        assert_eq!(simulation.adjacent(j, Side::Inner), Some(4 + (j + 1) % 4));
        assert_eq!(simulation.adjacent(4 + j, Side::Outer), Some((j + 1) % 4));
    }
    for j in 0..8 {
        assert_eq!(simulation.frustration(j), 0.0);
        assert_eq!((simulation.headway(j), simulation.adjacent(j, Side::Outer).is_some()), (16.0, j >= 4));
    }
}

#[test]
fn a_distance_of_exactly_d_is_refused_ahead_and_behind() {
    // Vehicle 1 follows 2 at 12 m; vehicle 3 is alone in lane 2, where vehicle 1 wants to go.
    for (nudge, enters) in
        [(8.0, false), (8.0 + 1e-9, true), (-8.0, false), (-8.0 - 1e-9, true), (0.0, false), (30.0, true)]
    {
        let scenario = with(
            standing(3, 2, Start::Uniform),
            &[
                "at=0:2:nudge=-20",
                &format!("at=0:3:nudge={nudge}"),
                "at=0:3:frustration-rate=0",
                "at=0:2:frustration-rate=0",
            ],
        );
        let (_, events) = run::<Eager<true>>(&scenario, 1);
        let (vehicle, from, to) = (0, 0, 1);
        let frustration = 0.0625;
        let expected = if enters {
            Event::LaneChange { vehicle, from, to, frustration }
        } else {
            Event::Refused { vehicle, from, to, frustration }
        };
        // Own headway 12 m; that in lane 2 is larger unless vehicle 3 is ahead by less.
        let adjacent = if nudge > 0.0 { nudge } else { 64.0 + nudge };
        let attempts = adjacent > 12.0;
        assert_eq!(events, if attempts { vec![expected] } else { vec![] }, "nudge {nudge}");
    }
    // Ahead by d, and the own headway smaller still: vehicles 5 m long at 7 m.
    for (nudge, enters) in [(8.0, false), (8.0 + 1e-9, true)] {
        let scenario = with(
            standing(3, 2, Start::Uniform),
            &["at=0:2:nudge=-25", &format!("at=0:3:nudge={nudge}"), "at=0:2-3:frustration-rate=0"],
        );
        let (simulation, events) = run::<Eager<true>>(&scenario, 1);
        assert_eq!(events.len(), 1);
        assert_eq!(matches!(events[0], Event::LaneChange { .. }), enters, "nudge {nudge}: {events:?}");
        assert_eq!(simulation.lane(0), usize::from(enters));
        assert_eq!(simulation.frustration(0), if enters { 0.0 } else { 0.0625 });
    }
}

#[test]
fn an_empty_lane_is_infinitely_better_and_a_vehicle_alone_follows_itself() {
    let scenario = with(standing(2, 2, Start::OneLane(1)), &["at=0:2:frustration-rate=0"]);
    let (simulation, events) = run::<Eager<true>>(&scenario, 1);
    assert_eq!(events, [Event::LaneChange { vehicle: 0, from: 0, to: 1, frustration: 0.0625 }]);
    for j in 0..2 {
        assert_eq!((simulation.leader(j), simulation.follower(j)), (j, j));
        assert_eq!((simulation.headway(j), simulation.perceived_headway(j)), (64.0, 64.0));
    }
    assert_eq!(simulation.vehicles_per_lane(), [1, 1]);
    assert_eq!(simulation.frustration(0), 0.0);
    // Each is alone in its lane, half a lap from the other: 64 m in its own lane, 32 m in the other. No attempts.
    let (_, events) = run::<Eager<true>>(&scenario, 100);
    assert_eq!(events.len(), 1);
}

/// Two lanes, one standing vehicle each; the second one is moved from one place to another at t = 1 s.
fn moved(from: f64, to: f64) -> Vec<Event> {
    let scenario = with(
        standing(2, 2, Start::Uniform),
        &[
            "at=0:all:frustration-rate=0,pass-frustration=0",
            &format!("at=0:2:nudge={from}"),
            &format!("at=1:2:nudge={}", to - from),
        ],
    );
    run::<Eager<true>>(&scenario, 40).1
}

#[test]
fn the_far_side_of_the_ring_is_no_pass() {
    let pass = |passer, passed| Event::Pass { passer, passed };
    assert_eq!(moved(24.0, 40.0), [], "past half a lap");
    assert_eq!(moved(31.0, 33.0), []);
    assert_eq!(moved(-4.0, 0.0), [], "alongside is not yet past");
    assert_eq!(moved(-4.0, 0.5), [pass(1, 0)]);
    assert_eq!(moved(0.0, 0.5), [pass(1, 0)]);
    assert_eq!(moved(60.0, 64.0), [], "a lap: alongside again");
    assert_eq!(moved(60.0, 66.0), [pass(1, 0)], "a lap more is a pass");
    assert_eq!(moved(4.0, -4.0), [pass(0, 1)], "backwards, it is passed");
    assert_eq!(moved(4.0, 0.0), [], "alongside, the other one is not past it");
    assert_eq!(moved(0.0, -0.5), [pass(0, 1)]);
}

/// Never attempts a lane change.
#[derive(Clone)]
struct Never;

impl Sampler for Never {
    fn new(_: usize, _: f64, _: Generator) -> Self {
        Self
    }
    fn attempts(&mut self, _: usize, _: f64) -> bool {
        false
    }
    fn coin(&mut self) -> bool {
        unreachable!("no attempt, no coin")
    }
}

#[test]
fn several_laps_of_lead_are_a_pass_each() {
    // The first vehicle stands at 0, the second one starts alongside and drives ten laps and a half.
    let mut scenario = standing(2, 2, Start::Uniform);
    scenario.actions = vec!["at=0:1:brake=1000,frustration-rate=0,pass-frustration=0.25".parse().unwrap()];
    let mut simulation = Simulation::<Never>::with_sampler(&scenario).unwrap();
    let mut passes = 0;
    while simulation.distance(1) < 10.5 * 64.0 {
        let lead = (simulation.displacements()[1] / 64.0).ceil();
        simulation.step();
        passes += simulation.events().len();
        assert!(simulation.events().iter().all(|e| *e == Event::Pass { passer: 1, passed: 0 }));
        assert_eq!(passes as f64, lead, "⌈lead/L⌉ passes");
        assert_eq!(simulation.frustration(0), 0.25 * passes as f64);
    }
    assert_eq!(passes, 11);
}

#[test]
fn a_tie_between_two_adjacent_lanes_is_broken_by_the_coin() {
    // Lane 2: vehicles 3 and 4 at 0 and 32 m, of which 4 is moved to 8 m; lanes 1 and 3: equal, all vehicles far from vehicle 3.
    let scenario = with(
        standing(6, 3, Start::Uniform),
        &[
            "at=0:4:nudge=-24",
            "at=0:1-2:nudge=12",
            "at=0:5-6:nudge=12",
            "at=0:1-2:frustration-rate=0",
            "at=0:4-6:frustration-rate=0",
        ],
    );
    let (heads, heads_events) = run::<Eager<true>>(&scenario, 1);
    let (tails, tails_events) = run::<Eager<false>>(&scenario, 1);
    assert_eq!(heads_events, [Event::LaneChange { vehicle: 2, from: 1, to: 0, frustration: 0.0625 }]);
    assert_eq!(tails_events, [Event::LaneChange { vehicle: 2, from: 1, to: 2, frustration: 0.0625 }]);
    assert_eq!((heads.leader(2), heads.headway(2)), (0, 12.0));
    assert_eq!((tails.leader(2), tails.headway(2)), (4, 12.0));
    // One of them better by a little: no coin.
    let better = with(scenario, &["at=0:5-6:nudge=0.5"]);
    let (_, events) = run::<Eager<true>>(&better, 1);
    assert_eq!(events, [Event::LaneChange { vehicle: 2, from: 1, to: 2, frustration: 0.0625 }]);
}
