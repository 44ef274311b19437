//! Each measurement, compared with the values that follow from theory or from a direct computation.

mod common;

use common::theory;
use ringroad::format::table::{Table, Values};
use ringroad::measurement::Measurement;
use ringroad::measurement::probe::{Probe, act, measure};
use ringroad::measurement::provenance::{Provenance, run_to_csv};
use ringroad::scenario::driver::Driver;
use ringroad::scenario::{Scenario, Start};
use ringroad::simulation::Simulation;

/// The table of a whole run.
fn table(scenario: &Scenario, measurement: &str) -> Table {
    let measurement = Measurement::from_json(measurement).unwrap();
    let mut probes = [measurement.probe(scenario).unwrap()];
    assert!(measure(&mut Simulation::new(scenario).unwrap(), &mut probes, &mut |_| true));
    probes[0].table()
}

fn with_actions(scenario: Scenario, actions: &[&str]) -> Scenario {
    Scenario { actions: actions.iter().map(|a| a.parse().unwrap()).collect(), ..scenario }
}

fn delayed(reaction_time: f64, until: f64) -> Scenario {
    let mut scenario = Scenario { until, ..Scenario::default() };
    scenario.driver.reaction_time = reaction_time;
    scenario
}

#[test]
fn trajectories_have_a_row_for_each_vehicle_and_time() {
    let scenario = Scenario { vehicles: 3, until: 2.5, ..Scenario::default() };
    let t = table(&scenario, r#"{"table":"trajectories"}"#);
    let names: Vec<_> = t.columns().iter().map(|c| c.name.as_str()).collect();
    assert_eq!(
        names.join(","),
        "time_s,vehicle,lane,position_m,speed_m_per_s,headway_m,perceived_headway_m,frustration,distance_m,lane_changes"
    );
    assert_eq!(t.floats("time_s").unwrap(), [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0]);
    assert_eq!(t.wholes("vehicle").unwrap(), [1, 2, 3, 1, 2, 3, 1, 2, 3]);
    assert!(t.wholes("lane").unwrap().iter().all(|&l| l == 1));
    // On an undisturbed ring the speed is v(L/N) at all times, and the distance v·t.
    let v = Driver::default().speed(1000.0 / 3.0);
    assert!(t.floats("speed_m_per_s").unwrap().iter().all(|&s| (s - v).abs() < 1e-12));
    for (distance, time) in t.floats("distance_m").unwrap().iter().zip(t.floats("time_s").unwrap()) {
        assert!((distance - v * time).abs() < 1e-9);
    }
}

#[test]
fn a_collision_gives_one_additional_row() {
    let scenario = with_actions(delayed(0.8, 600.0), &["at=0:1:nudge=1"]);
    let mut simulation = Simulation::new(&scenario).unwrap();
    simulation.run_to(u64::MAX);
    let time = simulation.collision().expect("Δ = 0.8 s collides").time;
    let t = table(&scenario, r#"{"table":"speeds","every":10,"vehicles":[1]}"#);
    let times = t.floats("time_s").unwrap();
    assert_eq!(times.last(), Some(&time));
    assert!(times.windows(2).all(|w| w[0] < w[1]), "{times:?}");
    assert_eq!(times.len(), (time / 10.0).floor() as usize + 2);

    // Vehicles that touch from the start collide at t = 0: one row, not two.
    let touching = with_actions(Scenario::default(), &["at=0:1:nudge=16"]);
    assert_eq!(table(&touching, r#"{"table":"speeds"}"#).floats("time_s").unwrap(), [0.0]);
    let events = table(&touching, r#"{"table":"events"}"#);
    assert_eq!(events.columns()[1].values, Values::Text(vec!["collision".into()]));
    assert_eq!((events.wholes("vehicle").unwrap(), events.floats("other").unwrap()), (&[1][..], &[2.0][..]));
}

#[test]
fn wide_speeds_are_those_of_the_trajectories() {
    let scenario = with_actions(delayed(0.5, 30.0), &["at=0:1:nudge=1"]);
    let wide = table(&scenario, r#"{"table":"speeds","every":2,"vehicles":[7,1]}"#);
    let long = table(&scenario, r#"{"table":"trajectories","every":2}"#);
    for (name, n) in [("v_7_m_per_s", 7), ("v_1_m_per_s", 1)] {
        let expected: Vec<_> =
            long.floats("speed_m_per_s").unwrap().iter().skip(n - 1).step_by(50).copied().collect();
        assert_eq!(wide.floats(name).unwrap(), expected);
    }
    assert_eq!(wide.columns()[1].name, "v_7_m_per_s");
}

/// Each cell is compared with the nearest vehicle upstream of its centre, found by a search over all vehicles.
#[test]
fn a_cell_of_the_speed_map_is_the_next_vehicle_upstream() {
    let scenario = with_actions(
        Scenario {
            vehicles: 24,
            lanes: 2,
            time_step: 0.05,
            until: 60.0,
            start: Start::Random,
            ..Scenario::default()
        },
        &["at=0:1:nudge=0.5", "at=10:2:brake=5"],
    );
    let bins = 37;
    for lane in [1, 2] {
        let map =
            table(&scenario, &format!(r#"{{"table":"speed-map","every":3,"bins":{bins},"lane":{lane}}}"#));
        let long = table(&scenario, r#"{"table":"trajectories","every":3}"#);
        let (x, v, l) = (
            long.floats("position_m").unwrap(),
            long.floats("speed_m_per_s").unwrap(),
            long.wholes("lane").unwrap(),
        );
        assert_eq!(map.rows(), 21 * bins);
        let places = map.floats("position_m").unwrap();
        for (row, &speed) in map.floats("speed_m_per_s").unwrap().iter().enumerate() {
            let vehicles = (row / bins) * 24..(row / bins + 1) * 24;
            let upstream = |j: &usize| (places[row] - x[*j]).rem_euclid(1000.0);
            let next = vehicles.filter(|&j| l[j] == lane).min_by(|a, b| upstream(a).total_cmp(&upstream(b)));
            assert_eq!(speed, v[next.unwrap()], "row {row}");
        }
    }
}

#[test]
fn an_empty_lane_has_no_speed_and_a_single_vehicle_gives_its_speed_to_the_whole_lane() {
    let mut scenario =
        Scenario { vehicles: 1, lanes: 2, until: 0.0, start: Start::OneLane(2), ..Scenario::default() };
    scenario.driver.frustration_rate = 0.0;
    let speeds = |lane| {
        let t = table(&scenario, &format!(r#"{{"table":"speed-map","bins":5,"lane":{lane}}}"#));
        t.floats("speed_m_per_s").unwrap().to_vec()
    };
    assert!(speeds(1).iter().all(|v| v.is_nan()));
    assert_eq!(speeds(2), [Driver::default().speed(1000.0); 5]);
}

/// In equilibrium q·δ vehicles pass a position in a window, up to the one that is passing at its end.
#[test]
fn the_flow_of_the_equilibrium_ring_is_q() {
    let scenario = Scenario { until: 120.0, ..Scenario::default() };
    let q = Driver::default().flow(0.05);
    for window in [5.0, 18.63, 60.0] {
        let t = table(&scenario, &format!(r#"{{"table":"flow","every":0.5,"window":{window},"at":333}}"#));
        let (times, flows) = (t.floats("time_s").unwrap(), t.floats("flow_veh_per_s").unwrap());
        for (time, flow) in times.iter().zip(flows) {
            if *time < window {
                assert!(flow.is_nan(), "t = {time}");
            } else {
                assert!((flow - q).abs() < 1.0 / window, "t = {time}: {flow}, q = {q}");
                let count = flow * window;
                assert!((count - count.round()).abs() < 1e-9, "whole vehicles: {count}");
            }
        }
    }
    // The mean of the map over the ring is q almost exactly, since every vehicle drives v·δ in a window.
    let map = table(&scenario, r#"{"table":"flow-map","every":20,"bins":1000,"window":20}"#);
    for row in map.floats("flow_veh_per_s").unwrap().chunks(1000).skip(1) {
        assert!((row.iter().sum::<f64>() / 1000.0 - q).abs() < 5e-3);
    }
}

/// Q(t, x) is compared with its definition, computed from the trajectories: unwrapped positions, and a Heaviside function for
/// each lap.
#[test]
fn every_cell_of_the_flow_map_counts_exactly() {
    let scenario = with_actions(
        Scenario {
            vehicles: 30,
            lanes: 3,
            time_step: 0.05,
            until: 90.0,
            start: Start::OneLane(2),
            ..Scenario::default()
        },
        &["at=20:5:nudge=-3", "at=40:6:brake=4"],
    );
    let (bins, every, window) = (40, 1.0, 4.5);
    let map = table(&scenario, r#"{"table":"flow-map","every":1,"bins":40,"window":4.5}"#);
    let (places, flows) = (map.floats("position_m").unwrap(), map.floats("flow_veh_per_s").unwrap());
    let mut simulation = Simulation::new(&scenario).unwrap();
    let mut unwrapped = Vec::new();
    loop {
        unwrapped.push((0..30).map(|j| simulation.unwrapped_position(j)).collect::<Vec<_>>());
        if simulation.is_finished() {
            break;
        }
        simulation.step();
    }
    assert!(simulation.collision().is_none());
    assert_eq!(map.rows(), 91 * bins);
    let (row_steps, window_steps) = (20, 90);
    let passings = |step: usize, x: f64| -> f64 {
        unwrapped[step].iter().map(|position| ((position - x) / 1000.0).floor()).sum()
    };
    for (k, &flow) in flows.iter().enumerate() {
        let step = k / bins * row_steps;
        if step < window_steps {
            assert!(flow.is_nan());
        } else {
            let expected = (passings(step, places[k]) - passings(step - window_steps, places[k])) / window;
            assert!(
                (flow - expected).abs() < 1e-12,
                "t = {}: {flow}, {expected}",
                step as f64 / 20.0 * every
            );
        }
    }
    // The flow past one position is that of the map.
    let one = table(&scenario, &format!(r#"{{"table":"flow","window":4.5,"at":{}}}"#, places[11]));
    let column: Vec<_> = flows.iter().skip(11).step_by(bins).map(|f| f.to_bits()).collect();
    assert_eq!(one.floats("flow_veh_per_s").unwrap().iter().map(|f| f.to_bits()).collect::<Vec<_>>(), column);
}

#[test]
fn equilibrium_has_the_values_of_the_model() {
    let t = table(&Scenario::default(), r#"{"table":"equilibrium"}"#);
    assert_eq!(t.rows(), 1, "nothing changes on an undisturbed ring");
    let value = |name| t.floats(name).unwrap()[0];
    assert!((value("slope_per_s") - 0.731_616).abs() < 1e-6);
    assert!((value("flow_veh_per_s") - 0.5368).abs() < 5e-5);
    assert!((value("largest_flow_veh_per_s") * 3600.0 - 2065.0).abs() < 1.0);
    assert!((value("critical_density_veh_per_m") * 1000.0 - 34.0).abs() < 0.5);
    assert_eq!(value("density_veh_per_m"), 0.05);

    // A lane change changes two lanes; an action on all drivers changes every lane.
    let scenario = with_actions(
        Scenario { vehicles: 20, lanes: 2, time_step: 0.05, until: 5.0, ..Scenario::default() },
        &["at=3:all:max-speed=30"],
    );
    let t = table(&scenario, r#"{"table":"equilibrium","every":1}"#);
    assert_eq!(t.floats("time_s").unwrap(), [0.0, 0.0, 3.0, 3.0]);
    assert_eq!(t.wholes("lane").unwrap(), [1, 2, 1, 2]);
    assert_eq!(t.wholes("vehicles").unwrap(), [10, 10, 10, 10]);
}

/// For heterogeneous drivers c = n·dv∞/dL is compared with a difference quotient, and the largest flow with a search.
#[test]
fn heterogeneous_drivers_have_one_equilibrium_speed() {
    let at = |length: f64| {
        let scenario = Scenario {
            length,
            until: 0.0,
            overrides: vec!["1-10:sensitivity=2".parse().unwrap(), "5-20:max-speed=25".parse().unwrap()],
            ..Scenario::default()
        };
        let t = table(&scenario, r#"{"table":"equilibrium"}"#);
        move |name: &str| t.floats(name).unwrap()[0]
    };
    let (here, shorter, longer) = (at(1000.0), at(999.0), at(1001.0));
    let v = "equilibrium_speed_m_per_s";
    let slope = 50.0 * (longer(v) - shorter(v)) / 2.0;
    assert!((here("slope_per_s") / slope - 1.0).abs() < 1e-4, "{} {slope}", here("slope_per_s"));
    let flow = |density: f64| at(50.0 / density)("flow_veh_per_s");
    let (top, density) = (here("largest_flow_veh_per_s"), here("critical_density_veh_per_m"));
    assert!((flow(density) - top).abs() < 1e-9);
    assert!(flow(density * 1.02) < top && flow(density * 0.98) < top);
}

/// A nudge of ε changes two neighbouring headways by −ε and +ε: A_q = (2/N)·ε·|1 − e^{2πiq/N}|.
#[test]
fn modes_have_the_amplitudes_of_a_nudge() {
    let scenario = with_actions(Scenario { until: 0.0, ..Scenario::default() }, &["at=0:1:nudge=0.5"]);
    let t = table(&scenario, r#"{"table":"modes","modes":25}"#);
    for q in 1..=25 {
        let half = if q == 25 { 0.5 } else { 1.0 };
        let expected =
            half * (2.0 / 50.0) * 0.5 * 2.0 * libm::sin(std::f64::consts::PI * f64::from(q) / 50.0);
        let amplitude = t.floats(&format!("amplitude_{q}_m")).unwrap()[0];
        assert!((amplitude - expected).abs() < 1e-14, "mode {q}: {amplitude}, {expected}");
    }
    assert!((t.floats("largest_deviation_m").unwrap()[0] - 0.5).abs() < 1e-14);
    let quiet = table(&delayed(0.75, 100.0), r#"{"table":"modes"}"#);
    assert!(quiet.floats("largest_deviation_m").unwrap().iter().all(|&x| x < 1e-14));
}

/// The growth rate of each mode, growing or decaying, is that of z^{m+1} = z^m + dt·d_q within 1 % or three standard errors.
#[test]
fn growth_rates_are_those_of_the_difference_equation() {
    for k in 0..=16 {
        let (reaction_time, m) = (0.05 * f64::from(k), 5 * k);
        let scenario = with_actions(delayed(reaction_time, 1000.0), &["at=0:1:nudge=0.0001"]);
        let t = table(&scenario, r#"{"table":"growth","nonlinearity":1e-4}"#);
        let (rates, errors) =
            (t.floats("growth_rate_per_s").unwrap(), t.floats("standard_error_per_s").unwrap());
        for q in 1..=10 {
            let predicted = theory::growth(50, q, m, 0.01);
            let (rate, error) = (rates[q - 1], errors[q - 1]);
            let close = (rate / predicted - 1.0).abs() < 0.01 || (rate - predicted).abs() < 3.0 * error;
            assert!(close, "Δ = {reaction_time} s, mode {q}: {rate} ± {error}, theory {predicted}");
            assert!(error < 0.1 * rate.abs(), "Δ = {reaction_time} s, mode {q}: {rate} ± {error}");
        }
    }
}

#[test]
fn a_disturbed_lane_ends_the_linear_window() {
    let quiet = with_actions(delayed(0.0, 60.0), &["at=0:1:nudge=0.0001"]);
    let ends = |t: &Table| match &t.columns().last().unwrap().values {
        Values::Text(words) => words[0].clone(),
        other => panic!("{other:?}"),
    };
    let undisturbed = table(&quiet, r#"{"table":"growth","modes":1}"#);
    assert_eq!(
        (undisturbed.floats("to_s").unwrap()[0], ends(&undisturbed).as_str()),
        (60.0, "end of the run")
    );
    for action in ["at=30:7:nudge=0.0001", "at=30:7:brake=0.1", "at=30:all:reaction-time=0.5"] {
        let mut disturbed = quiet.clone();
        disturbed.actions.push(action.parse().unwrap());
        let t = table(&disturbed, r#"{"table":"growth","modes":1}"#);
        assert_eq!((t.floats("to_s").unwrap()[0], ends(&t).as_str()), (29.5, "disturbed"), "{action}");
    }
    // Close to the density of a jam even a small nudge makes a vehicle stand, where the speed law has a kink.
    let dense = Scenario { vehicles: 133, ..delayed(0.0, 60.0) };
    for (nudge, stands) in [("0.01", false), ("0.1", true)] {
        let t = table(
            &with_actions(dense.clone(), &[&format!("at=0:1:nudge={nudge}")]),
            r#"{"table":"growth","modes":1}"#,
        );
        let begins = t.floats("from_s").unwrap()[0];
        assert_eq!(begins > 0.0, stands, "{nudge} m: linear from {begins} s");
    }
    let large = with_actions(delayed(0.75, 60.0), &["at=0:1:nudge=10"]);
    assert_eq!(ends(&table(&large, r#"{"table":"growth"}"#)), "never in the linear regime");
}

/// Periods and depths are compared with those found directly in the speeds at every step.
#[test]
fn cyclic_growth_agrees_with_the_speeds_at_every_step() {
    let scenario = with_actions(delayed(0.5, 400.0), &["at=0:1:nudge=1"]);
    let t = table(&scenario, r#"{"table":"cyclic-growth","vehicle":11,"periods":4}"#);
    let speeds = table(&scenario, r#"{"table":"speeds","every":0.01,"vehicles":[11]}"#);
    let v = speeds.floats("v_11_m_per_s").unwrap();
    let equilibrium = Driver::default().speed(20.0);
    let crossings: Vec<_> = (1..v.len()).filter(|&i| v[i - 1] < equilibrium && v[i] >= equilibrium).collect();
    assert!(crossings.len() > 4);
    assert_eq!(t.rows(), 4);
    let mut points = Vec::new();
    for n in 0..4 {
        assert!((t.floats("from_s").unwrap()[n] - crossings[n] as f64 * 0.01).abs() < 1e-9);
        let smallest = v[crossings[n]..=crossings[n + 1]].iter().copied().fold(f64::INFINITY, f64::min);
        assert_eq!(t.floats("f_m_per_s").unwrap()[n], equilibrium - smallest);
        points.push((n as f64 + 1.0, equilibrium - smallest));
    }
    let fit = ringroad::numerics::least_squares::exponential(&points).unwrap();
    assert_eq!(t.floats("growth_rate_per_period").unwrap()[0], fit.rate);
    assert!(fit.rate < 0.0, "stable: {fit:?}");
    assert_eq!((t.wholes("vehicle").unwrap()[0], t.wholes("periods").unwrap()[0]), (11, 4));
}

#[test]
fn lanes_and_drivers_add_up() {
    let scenario = Scenario {
        lanes: 2,
        time_step: 0.05,
        until: 60.0,
        start: Start::OneLane(1),
        overrides: vec!["1-5:sensitivity=2".parse().unwrap()],
        ..Scenario::default()
    };
    let lanes = table(&scenario, r#"{"table":"lanes"}"#);
    let (one, two) = (lanes.wholes("lane_1").unwrap(), lanes.wholes("lane_2").unwrap());
    assert_eq!((one[0], two[0], lanes.wholes("imbalance").unwrap()[0]), (50, 0, 50));
    for (row, &imbalance) in lanes.wholes("imbalance").unwrap().iter().enumerate() {
        assert_eq!(one[row] + two[row], 50);
        assert_eq!(imbalance, one[row].abs_diff(two[row]));
    }
    let vehicles = table(&scenario, r#"{"table":"vehicles","every":60}"#);
    let drivers = table(&scenario, r#"{"table":"drivers","every":60}"#);
    let events = table(&scenario, r#"{"table":"events"}"#);
    let Values::Text(kinds) = &events.columns()[1].values else { panic!() };
    let changes: u64 = vehicles.wholes("lane_changes").unwrap()[50..].iter().sum();
    assert!(changes > 20);
    assert_eq!(kinds.iter().filter(|k| *k == "lane-change").count() as u64, changes);
    assert_eq!(lanes.wholes("lane_changes").unwrap().last(), Some(&changes));
    assert_eq!(drivers.wholes("vehicles").unwrap(), [5, 45, 5, 45]);
    let distance = vehicles.floats("distance_m").unwrap();
    let mean = distance[50..55].iter().sum::<f64>() / 5.0;
    assert!((drivers.floats("distance_per_vehicle_m").unwrap()[2] - mean).abs() < 1e-9);
    assert!((drivers.floats("mean_speed_m_per_s").unwrap()[2] - mean / 60.0).abs() < 1e-9);
    let Values::Text(groups) = &drivers.columns()[1].values else { panic!() };
    assert_eq!(groups[..2], ["sensitivity=2", "default"]);
}

/// A table taken in mid-run, after actions made by hand, has the same bytes as that of a run that ends there. Only the
/// table `outcome` has no row before the end.
#[test]
fn a_table_in_mid_run_is_that_of_a_run_until_then() {
    let scenario = with_actions(
        Scenario { vehicles: 30, lanes: 2, time_step: 0.05, until: 100.0, ..Scenario::default() },
        &["at=0:1:nudge=1", "at=7:3:brake=2"],
    );
    let waits = |m: &Measurement| matches!(m, Measurement::Outcome {});
    let measurements: Vec<_> = Measurement::all().into_iter().filter(|m| !waits(m)).collect();
    let mut probes: Vec<_> = measurements.iter().map(|m| m.probe(&scenario).unwrap()).collect();
    let mut simulation = Simulation::new(&scenario).unwrap();
    let observe =
        |s: &Simulation, probes: &mut [Box<dyn Probe>]| probes.iter_mut().for_each(|p| p.observe(s));
    observe(&simulation, &mut probes);
    // At t = 0, at a time with rows and at one without.
    for (until, action) in [
        (0, "at=0:4:nudge=0.5"),
        (200, "at=0:all:reaction-time=0.3"),
        (200, "at=0:5:nudge=2"),
        (333, "at=0:9:sensitivity=2,brake=1"),
        (505, "at=0:all:max-speed=35"),
    ] {
        while simulation.step_index() < until {
            simulation.step();
            observe(&simulation, &mut probes);
        }
        act(&mut simulation, &mut probes, action.parse().unwrap()).unwrap();
        let reached = Scenario { until: simulation.time(), ..simulation.scenario().clone() };
        for (measurement, probe) in measurements.iter().zip(&probes) {
            let csv = run_to_csv(&probe.table(), &reached, measurement);
            let provenance = Provenance::from_csv(&csv).unwrap();
            let again = table(&provenance.scenario, &provenance.measurement.to_json());
            let name = measurement.name();
            if csv != run_to_csv(&again, &provenance.scenario, &provenance.measurement) {
                let again = run_to_csv(&again, &provenance.scenario, &provenance.measurement);
                let line = csv.lines().zip(again.lines()).find(|(a, b)| a != b);
                panic!("{name} after step {until}: {line:?}");
            }
        }
    }
}

#[test]
fn an_outcome_has_its_row_when_the_run_has_ended() {
    let scenario = Scenario { until: 3.0, ..Scenario::default() };
    let mut probe = Measurement::Outcome {}.probe(&scenario).unwrap();
    let mut simulation = Simulation::new(&scenario).unwrap();
    while !simulation.is_finished() {
        probe.observe(&simulation);
        assert_eq!(probe.table().rows(), 0);
        simulation.step();
    }
    probe.observe(&simulation);
    assert_eq!(probe.table().floats("end_time_s").unwrap(), [3.0]);
    // On a uniform ring the speed stays that of the equilibrium.
    let speed = scenario.driver.speed(20.0);
    assert!((probe.table().floats("mean_speed_m_per_s").unwrap()[0] - speed).abs() < 1e-12);
}

/// The means in an overview are over the time between its rows, so their mean over the run is that of the outcome.
#[test]
fn an_overview_adds_up_to_the_outcome() {
    let scenario =
        Scenario { until: 60.0, ..ringroad::scenario::presets::preset("load-balance").unwrap().scenario };
    let overview = table(&scenario, r#"{"table":"overview","every":5}"#);
    let outcome = table(&scenario, r#"{"table":"outcome"}"#);
    for name in ["mean_speed_m_per_s", "mean_flow_veh_per_s"] {
        let rows = overview.floats(name).unwrap();
        assert!(rows[0].is_nan() && rows.len() == 13, "{rows:?}");
        let mean = rows[1..].iter().sum::<f64>() / 12.0;
        assert!((mean - outcome.floats(name).unwrap()[0]).abs() < 1e-12, "{name}");
    }
    for name in ["speed_deviation_m_per_s", "lane_changes_per_vehicle"] {
        assert_eq!(overview.floats(name).unwrap().last(), outcome.floats(name).unwrap().last());
    }
    assert_eq!(overview.wholes("imbalance").unwrap().last(), outcome.wholes("imbalance").unwrap().last());
    assert!(outcome.floats("lane_changes_per_vehicle").unwrap()[0] > 0.0);
}

#[test]
fn a_cancelled_run_keeps_what_was_measured() {
    let scenario = Scenario::default();
    let mut probes = [Measurement::named("speeds").unwrap().probe(&scenario).unwrap()];
    let mut simulation = Simulation::new(&scenario).unwrap();
    let mut reached = 0;
    let finished = measure(&mut simulation, &mut probes, &mut |step| {
        reached = step;
        step < 20_000
    });
    assert!(!finished && reached == 20_000);
    assert_eq!(probes[0].table().rows(), 201);
}
