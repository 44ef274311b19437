//! Linear theory against simulation: growth rates mode by mode, homogeneous and heterogeneous drivers.

use nalgebra::{DMatrix, DVector};
use ringroad::measurement::modal_growth::{Linear, ModalGrowth};
use ringroad::measurement::probe::{Probe, measure};
use ringroad::numerics::least_squares;
use ringroad::scenario::Scenario;
use ringroad::scenario::driver::{Driver, equilibrium};
use ringroad::simulation::Simulation;
use ringroad::stability::Complex64;
use ringroad::stability::driver_classes::DriverClasses;
use ringroad::stability::homogeneous::{HomogeneousRing, Mode, Time};
use ringroad::stability::lane::Lane;
use ringroad::stability::report::Report;
use ringroad::stability::stabilizing_drivers::{parse_changes, stabilizing_drivers};

/// Within 1 % or three standard errors.
fn agrees(measured: f64, error: f64, predicted: f64) -> bool {
    let difference = (measured - predicted).abs();
    difference <= 0.01 * predicted.abs() || difference <= 3.0 * error
}

/// Growth rates of modes 1 … `modes` with standard errors and numbers of points, after a nudge of vehicle 1. The start also
/// excites other roots than the leading ones; their part fades within ten delays.
fn measured(
    reaction_time: f64,
    modes: usize,
    nudge: f64,
    until: f64,
    linear: Linear,
) -> Vec<(f64, f64, u64)> {
    let mut scenario = Scenario { until, ..Scenario::default() };
    scenario.driver.reaction_time = reaction_time;
    scenario.actions.push(format!("at=0:1:nudge={nudge}").parse().unwrap());
    let from = scenario.steps(1.0 + 10.0 * reaction_time);
    let mut probes: [Box<dyn Probe>; 1] = [Box::new(ModalGrowth::new(10, modes, 0, from, linear))];
    measure(&mut Simulation::new(&scenario).unwrap(), &mut probes, &mut |_| true);
    let table = probes[0].table();
    let rates = table.floats("growth_rate_per_s").unwrap();
    let errors = table.floats("standard_error_per_s").unwrap();
    let points = table.wholes("points").unwrap();
    // The table carries the theory beside the measurement.
    let ring = HomogeneousRing { vehicles: 50, slope: Driver::default().slope(20.0) };
    for (k, &predicted) in table.floats("predicted_per_s").unwrap().iter().enumerate() {
        let root = ring.root(k + 1, reaction_time, Time::Steps(0.01));
        assert!(points[k] == 0 || (predicted - root.re).abs() < 1e-12);
    }
    (0..modes).map(|k| (rates[k], errors[k], points[k])).collect()
}

/// N = 50, Δ from 0 to 0.8 s: modes 1–10 where the ring is stable, all growing modes where it is not.
#[test]
fn every_mode_grows_as_the_difference_equation_says() {
    let ring = HomogeneousRing { vehicles: 50, slope: Driver::default().slope(20.0) };
    let (mut compared, mut left_out) = (0, 0);
    for k in 0..=16 {
        let reaction_time = f64::from(k) * 0.05;
        let predicted: Vec<_> =
            ring.modes().map(|q| ring.root(q, reaction_time, Time::Steps(0.01)).re).collect();
        let stable = predicted.iter().all(|rate| *rate < 0.0);
        // Weak nudges for modes that change slowly: nonlinear terms stay small. Strong nudges for modes that fade
        // fast and would sink into rounding.
        let (weak, strong) = if stable {
            (
                measured(reaction_time, 10, 2e-5, 600.0, Linear { smallest: 1e-10, nonlinearity: 1e-5 }),
                measured(reaction_time, 10, 1e-3, 200.0, Linear { smallest: 1e-10, nonlinearity: 1e-3 }),
            )
        } else {
            let linear = Linear { smallest: 1e-10, nonlinearity: 3e-6 };
            (measured(reaction_time, 25, 1e-6, 300.0, linear), Vec::new())
        };
        for (k, &predicted) in predicted.iter().enumerate() {
            if (stable && k >= 10) || (!stable && predicted <= 0.0) {
                continue;
            }
            let (rate, error, points) = if stable && predicted < -0.03 { strong[k] } else { weak[k] };
            if points < 20 {
                println!("Δ = {reaction_time:.2} s, mode {}: left out, {points} points", k + 1);
                left_out += 1;
                continue;
            }
            compared += 1;
            assert!(
                agrees(rate, error, predicted),
                "Δ = {reaction_time:.2} s, mode {}: measured {rate} ± {error} ({points} points), theory {predicted}",
                k + 1
            );
        }
    }
    println!("{compared} growth rates compared, {left_out} left out");
    assert!(compared > 150 && left_out * 5 < compared + left_out);
}

/// Where waves are not tiny, the bound in the table of growth holds: nudges up to 1 m on both sides of the threshold, also
/// near it.
#[test]
fn the_size_of_the_waves_changes_a_growth_rate_by_less_than_its_bound() {
    let linear = Linear { smallest: 1e-8, nonlinearity: 0.01 };
    let (mut compared, mut significant) = (0, 0);
    for reaction_time in [0.5, 0.6, 0.66, 0.7, 0.75, 0.8] {
        for nudge in [0.1, 0.3, 1.0] {
            let mut scenario = Scenario { until: 200.0, ..Scenario::default() };
            scenario.driver.reaction_time = reaction_time;
            scenario.actions.push(format!("at=0:1:nudge={nudge}").parse().unwrap());
            let from = scenario.steps(20.0 * reaction_time);
            let mut probes: [Box<dyn Probe>; 1] = [Box::new(ModalGrowth::new(50, 10, 0, from, linear))];
            measure(&mut Simulation::new(&scenario).unwrap(), &mut probes, &mut |_| true);
            let t = probes[0].table();
            let column = |name: &str| t.floats(name).unwrap();
            for k in 0..10 {
                let (rate, predicted) = (column("growth_rate_per_s")[k], column("predicted_per_s")[k]);
                let (error, bound) = (column("standard_error_per_s")[k], column("nonlinear_bound_per_s")[k]);
                if rate.is_nan() || error.is_nan() {
                    continue;
                }
                compared += 1;
                let difference = (rate - predicted).abs();
                significant += usize::from(difference > 3.0 * error);
                assert!(
                    difference <= bound + 3.0 * error,
                    "Δ = {reaction_time} s, nudge {nudge} m, mode {}: {rate} ± {error}, theory {predicted}, bound {bound}",
                    k + 1
                );
            }
        }
    }
    println!("{compared} growth rates compared; {significant} differ by more than three standard errors");
    assert!(compared > 120 && significant > 40);
}

/// A ring with driver overrides that starts in equilibrium (the nudges lead there from equal headways), except for
/// displacements of some micrometres. These differ from vehicle to vehicle, so that every mode is excited.
fn heterogeneous(vehicles: usize, reaction_time: f64, exceptions: &[String]) -> Scenario {
    let mut scenario =
        Scenario { vehicles, length: 20.0 * vehicles as f64, until: 400.0, ..Scenario::default() };
    scenario.driver.reaction_time = reaction_time;
    scenario.overrides = exceptions.iter().map(|text| text.parse().unwrap()).collect();
    let drivers = scenario.drivers();
    let speed = equilibrium(&drivers, scenario.length).unwrap().speed;
    let mut displacement = 0.0;
    for (j, driver) in drivers.iter().enumerate() {
        let metres = displacement + 1e-6 * libm::sin((j * j) as f64);
        scenario.actions.push(format!("at=0:{}:nudge={metres}", j + 1).parse().unwrap());
        displacement += driver.headway(speed) - 20.0;
    }
    scenario
}

/// The dominant mode by theory; and its growth measured, with the standard error.
///
/// The pattern of mode q is v_{j+1} = u_j·v_j. The headways are written as a sum of the patterns of all modes (after the
/// other roots, which the start excites too, have faded), and the slope of ln|amplitude| of the dominant mode is
/// fitted. If theory had the pattern wrong, that amplitude would not be an exponential.
fn dominant(scenario: &Scenario) -> (Mode, f64, f64) {
    let (n, time) = (scenario.vehicles, Time::Steps(scenario.time_step));
    let drivers = scenario.drivers();
    let equilibrium = equilibrium(&drivers, scenario.length).unwrap();
    let slopes: Vec<_> = drivers.iter().map(|d| equilibrium.slope(&d.law())).collect();
    let delays: Vec<_> =
        drivers.iter().map(|d| scenario.steps(d.reaction_time) as f64 * scenario.time_step).collect();
    let ring = DriverClasses::new(slopes.iter().copied().zip(delays.iter().copied()));
    let mut modes = ring.followed(time).modes;
    modes.dedup_by_key(|m| m.mode);
    assert_eq!(modes.len(), n / 2);
    let mut patterns = DMatrix::<Complex64>::zeros(n, n - 1);
    let mut column = 0;
    for mode in &modes {
        let s = mode.root;
        let conjugates = if 2 * mode.mode == n { 1 } else { 2 };
        let mut v = Complex64::ONE;
        for j in 0..n {
            let turn = Complex64::new(libm::cos(s.im * delays[j]), libm::sin(s.im * delays[j]));
            let power = turn * ringroad::numerics::exp::exp(s.re * delays[j]);
            let step =
                Complex64::new(libm::cos(s.im * scenario.time_step), libm::sin(s.im * scenario.time_step))
                    * ringroad::numerics::exp::exp(s.re * scenario.time_step);
            let u = 1.0 + (step - 1.0) / scenario.time_step * power / slopes[j];
            patterns[(j, column)] = (u - 1.0) * v;
            if conjugates == 2 {
                patterns[(j, column + 1)] = patterns[(j, column)].conj();
            }
            v *= u;
        }
        // Once round the ring, the pattern repeats.
        assert!((v - 1.0).norm_sqr() < 1e-12, "{mode:?}: {v}");
        column += conjugates;
    }
    assert_eq!(column, n - 1);
    // The sum of all headway deviations is 0, so one equation follows from the others.
    let solver = patterns.rows(0, n - 1).into_owned().lu();
    let fastest = ring.fastest(time).unwrap();
    let place = 2 * (fastest.mode - 1);

    let speed = equilibrium.speed;
    let mut simulation = Simulation::new(scenario).unwrap();
    let mut points = Vec::new();
    simulation.run_to(scenario.steps(60.0));
    while !simulation.is_finished() {
        let deviations = DVector::from_fn(n - 1, |j, _| {
            Complex64::new(simulation.headway(j) - drivers[j].headway(speed), 0.0)
        });
        let amplitude = solver.solve(&deviations).unwrap()[place];
        points.push((simulation.time(), libm::log(libm::hypot(amplitude.re, amplitude.im))));
        simulation.run_to(simulation.step_index() + scenario.steps(1.0));
    }
    let line = least_squares::line(&points).unwrap();
    (fastest, line.slope, line.slope_error)
}

/// Vehicles, reaction time (s) of most of them, and how many have which values instead.
const CASES: [(usize, f64, usize, &str); 7] = [
    (50, 0.75, 4, "reaction-time=0"),
    (51, 0.75, 10, "reaction-time=0.2"),
    (50, 0.6, 25, "reaction-time=0.9"),
    (51, 0.6, 10, "sensitivity=2"),
    (50, 0.8, 15, "sensitivity=0.5"),
    (33, 0.7, 8, "sensitivity=1.5,reaction-time=0.5"),
    (50, 0.65, 12, "sensitivity=1.6,reaction-time=0.8,max-speed=35,min-headway=9"),
];

/// Overrides for `count` vehicles among `vehicles`: next to one another, or spread over the ring.
fn overrides(count: usize, vehicles: usize, in_a_block: bool, values: &str) -> Vec<String> {
    if in_a_block {
        return vec![format!("1-{count}:{values}")];
    }
    (0..count).map(|k| format!("{}:{values}", 1 + k * vehicles / count)).collect()
}

#[test]
fn the_dominant_mode_of_heterogeneous_rings_grows_as_the_product_equation_says() {
    for (vehicles, reaction_time, count, values) in CASES {
        for in_a_block in [true, false] {
            let scenario =
                heterogeneous(vehicles, reaction_time, &overrides(count, vehicles, in_a_block, values));
            let (mode, rate, error) = dominant(&scenario);
            println!(
                "{values}, {count} of {vehicles}, block {in_a_block}: {mode:?}, {rate:+.6} ± {error:.1e}"
            );
            assert!(
                agrees(rate, error, mode.root.re),
                "{values}, {count} of {vehicles}, block {in_a_block}: measured {rate} ± {error}, theory {mode:?}"
            );
        }
    }
}

/// Beside Fourier mode q the table of growth has the root that is followed from mode q of homogeneous drivers. With the other
/// drivers spread over the ring it is right for the dominant mode and for all that grow. With them in one block it is right for
/// the dominant mode, with a large standard error; the amplitude of a mode that grows slowly is then mostly that of the fast
/// modes, as a ring shows where half of the drivers are slow.
#[test]
fn fourier_modes_of_heterogeneous_rings_follow_the_roots_of_their_own_number() {
    let linear = Linear { smallest: 1e-10, nonlinearity: 1e-2 };
    let table = |scenario: &Scenario| {
        let from = scenario.steps(60.0);
        let mut probes: [Box<dyn Probe>; 1] = [Box::new(ModalGrowth::new(50, 16, 0, from, linear))];
        measure(&mut Simulation::new(scenario).unwrap(), &mut probes, &mut |_| true);
        probes[0].table()
    };
    let (mut compared, mut sharp) = (0, 0);
    for (vehicles, reaction_time, count, values) in CASES {
        for in_a_block in [true, false] {
            let scenario =
                heterogeneous(vehicles, reaction_time, &overrides(count, vehicles, in_a_block, values));
            let t = table(&scenario);
            let column = |name: &str| t.floats(name).unwrap();
            let (rates, errors) = (column("growth_rate_per_s"), column("standard_error_per_s"));
            let predicted = column("predicted_per_s");
            let report = Report::of(&scenario);
            let fastest = report.fastest_mode_discrete.unwrap();
            let largest = report.max_growth_rate_discrete_per_s.unwrap();
            assert!((predicted[fastest - 1] - largest).abs() < 1e-12);
            for q in 1..=16 {
                let (rate, error, theory) = (rates[q - 1], errors[q - 1], predicted[q - 1]);
                if q != fastest && (in_a_block || theory < 0.0) {
                    continue;
                }
                compared += 1;
                sharp += usize::from(error < 0.1 * theory.abs());
                assert!(
                    agrees(rate, error, theory),
                    "{values}, {count} of {vehicles}, block {in_a_block}, mode {q}: {rate} ± {error}, theory {theory}"
                );
            }
        }
    }
    println!("{compared} growth rates compared, {sharp} of them to better than a tenth");
    assert!(compared > 40 && 2 * sharp > compared);
    let covered = table(&heterogeneous(50, 0.6, &overrides(25, 50, true, "reaction-time=0.9")));
    let first = |name: &str| covered.floats(name).unwrap()[0];
    assert!(first("growth_rate_per_s") > 10.0 * first("predicted_per_s"));
}

/// At N = 50, Δ = 0.75 s five drivers without delay stabilize the ring and four do not, wherever they are on it: in theory
/// and in the simulation.
#[test]
fn five_drivers_without_delay_stabilize_the_ring_wherever_they_are() {
    let mut scenario = Scenario::default();
    scenario.driver.reaction_time = 0.75;
    let answer = stabilizing_drivers(&scenario, &parse_changes("reaction-time=0").unwrap()).unwrap();
    assert_eq!(answer.smallest_number, Some(5));
    for in_a_block in [true, false] {
        for (count, stable) in [(4, false), (5, true)] {
            let scenario = heterogeneous(50, 0.75, &overrides(count, 50, in_a_block, "reaction-time=0"));
            assert_eq!(Report::of(&scenario).stable, stable);
            let (_, rate, _) = dominant(&scenario);
            assert_eq!(rate < 0.0, stable, "{count} drivers without delay, block {in_a_block}: {rate}");
        }
    }
}

/// The report on the lanes of a simulation as they are now, with the delays in force.
fn report_now(simulation: &Simulation) -> Report {
    let scenario = simulation.scenario();
    let mut lanes = vec![Lane::default(); scenario.lanes];
    for j in 0..simulation.vehicles() {
        let lane = &mut lanes[simulation.lane(j)];
        lane.drivers.push(*simulation.driver(j));
        lane.delay_steps.push(simulation.delay_steps(j) as u64);
    }
    Report::of_lanes(&lanes, scenario.length, scenario.time_step)
}

#[test]
fn a_run_reaches_the_delays_that_the_theory_of_its_scenario_assumes() {
    let mut scenario = Scenario::default();
    scenario.driver.reaction_time = 0.75;
    let mut simulation = Simulation::new(&scenario).unwrap();
    simulation.run_to(60);
    let early = report_now(&simulation);
    simulation.run_to(80);
    assert!(early.stable && early.delay_in_force_s < 0.61);
    assert_eq!(report_now(&simulation), Report::of(&scenario));
}
