//! Perceived headways, held against a history of all positions since t = 0, with reaction times that change on the way.

use ringroad::scenario::Scenario;
use ringroad::scenario::action::Action;
use ringroad::simulation::Simulation;

/// Reaction times (s) of one vehicle and the time from which they hold.
type Plan = &'static [(f64, f64)];

fn target(plan: Plan, time: f64) -> f64 {
    plan.iter().rev().find(|(from, _)| *from <= time).unwrap().1
}

/// Runs to 60 s in steps of 0.05 s with the plan for the vehicles of `selector`, which are `members`; the other vehicles have
/// 0.2 s. The longest delay that comes into force is `most` steps.
fn hold(selector: &str, members: std::ops::Range<usize>, plan: Plan, most: usize) {
    let mut scenario =
        Scenario { vehicles: 12, length: 300.0, time_step: 0.05, until: 60.0, ..Scenario::default() };
    scenario.driver.reaction_time = 0.2;
    scenario.actions.push("at=0:3:nudge=2".parse().unwrap());
    scenario.actions.push("at=25:5:nudge=1.5,brake=1".parse().unwrap());
    for (at, value) in plan {
        scenario.actions.push(format!("at={at}:{selector}:reaction-time={value}").parse::<Action>().unwrap());
    }
    let mut simulation = Simulation::new(&scenario).unwrap();
    let start: Vec<f64> = (0..12).map(|j| simulation.headway(j)).collect();
    let mut past: Vec<Vec<f64>> = Vec::new();
    let mut delay = [0_usize; 12];
    let mut longest = 0;
    loop {
        past.push(simulation.displacements().to_vec());
        let step = past.len() - 1;
        for j in 0..12 {
            let seconds = if members.contains(&j) { target(plan, simulation.time() + 1e-9) } else { 0.2 };
            let steps = (seconds / 0.05).round() as usize;
            delay[j] = if step == 0 { 0 } else { steps.min(delay[j] + 1) };
            assert!(delay[j] <= step, "no driver perceives positions from before the start");
            assert_eq!(simulation.delay_steps(j), delay[j], "vehicle {j} at {} s", simulation.time());
            let (then, leader) = (&past[step - delay[j]], (j + 1) % 12);
            let perceived = start[j] + (then[leader] - then[j]);
            assert_eq!(simulation.perceived_headway(j), perceived, "vehicle {j} at {} s", simulation.time());
            let now = &past[step];
            let formula = simulation.headway(j) - (now[leader] - then[leader]) + (now[j] - then[j]);
            assert!((perceived - formula).abs() < 1e-9, "the formula of the model");
            longest = longest.max(delay[j]);
        }
        if simulation.is_finished() {
            break;
        }
        simulation.step();
    }
    assert!(simulation.collision().is_none());
    assert_eq!(longest, most);
}

#[test]
fn reaction_times_go_up_and_down() {
    hold("all", 0..12, &[(0.0, 0.2), (10.0, 0.4), (20.0, 0.1), (30.0, 0.5), (40.0, 0.0), (50.0, 0.3)], 10);
}

#[test]
fn one_driver_differs() {
    hold("4", 3..4, &[(0.0, 0.0), (7.0, 1.0), (7.5, 0.1), (20.0, 1.3), (22.0, 1.0), (40.0, 0.4)], 26);
}

#[test]
fn a_second_action_of_the_same_step_can_restore_a_long_delay() {
    hold("2-3", 1..3, &[(0.0, 0.9), (10.0, 0.0), (10.0, 0.9), (20.0, 0.1), (20.0, 1.1)], 22);
}

#[test]
fn memory_is_that_of_the_longest_delay_in_use() {
    let rows = |simulation: &Simulation| simulation.history_bytes() / (8 * (16 + 8));
    let mut scenario = Scenario { vehicles: 16, until: 60.0, ..Scenario::default() };
    scenario.driver.reaction_time = 0.75;
    let mut simulation = Simulation::new(&scenario).unwrap();
    // The present, 75 steps, and one to spare.
    assert_eq!(rows(&simulation), 77);
    simulation.run_to(100);
    for (action, expected) in
        [("at=0:4:reaction-time=2", 202), ("at=0:4:reaction-time=0.1", 77), ("at=0:all:reaction-time=0", 2)]
    {
        simulation.act(action.parse().unwrap()).unwrap();
        simulation.step();
        assert_eq!(rows(&simulation), expected, "{action}");
    }
}
