//! `ringroad stability`, run as a process.
#![cfg(feature = "command")]

use serde_json::Value;
use std::process::{Command, Output};

fn ringroad(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ringroad"));
    command.arg("stability").args(arguments).output().unwrap()
}

fn answer(arguments: &[&str]) -> String {
    let output = ringroad(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&answer(&[arguments, &["--json"]].concat())).unwrap()
}

fn refusal(arguments: &[&str]) -> String {
    let output = ringroad(arguments);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    assert!(output.stdout.is_empty());
    String::from_utf8(output.stderr).unwrap()
}

/// The values of the model's specification.
#[test]
fn json_has_the_thresholds() {
    let report = json(&["--reaction-time", "0.75"]);
    let number = |name: &str| report[name].as_f64().unwrap();
    assert!((number("critical_reaction_time_s") - 0.683_869).abs() < 5e-7);
    assert!((number("critical_reaction_time_discrete_s") - 0.678_869).abs() < 5e-7);
    assert!(number("max_growth_rate_per_s") > 0.0 && number("max_growth_rate_discrete_per_s") > 0.0);
    assert_eq!((&report["stable"], &report["fastest_mode_discrete"]), (&false.into(), &8.into()));
    assert!(report["fastest_mode"].is_u64());
    assert!(report.get("smallest_calming_number").is_none() && report.get("roots").is_none());
    let at = |reaction_time: &str| json(&["--reaction-time", reaction_time])["stable"].clone();
    assert_eq!((at("0.67"), at("0.68")), (true.into(), false.into()));
    let coarse = json(&["--time-step", "0.05"]);
    assert!((coarse["critical_reaction_time_discrete_s"].as_f64().unwrap() - 0.658_868).abs() < 5e-7);
}

#[test]
fn infinite_thresholds_are_null_in_json_and_words_in_text() {
    for arguments in [["--vehicles", "1"], ["--vehicles", "150"]] {
        let report = json(&arguments);
        assert!(report["critical_reaction_time_s"].is_null() && report["stable"] == true, "{report}");
        assert!(report["critical_reaction_time_discrete_s"].is_null());
    }
    assert!(answer(&["--vehicles", "150"]).starts_with("A jam"));
    assert!(answer(&["--vehicles", "1"]).starts_with("One vehicle alone"));
}

#[test]
fn five_drivers_without_delay_stabilize_the_ring() {
    let report = json(&["--reaction-time", "0.75", "--calm-with", "reaction-time=0"]);
    assert_eq!(report["smallest_calming_number"], 5);
    assert_eq!(report["calming_numbers"].as_array().unwrap().len(), 51);
    assert!(report["calming_growth_rates_discrete_per_s"][4].as_f64().unwrap() > 0.0);
    assert!(report["calming_growth_rates_discrete_per_s"][5].as_f64().unwrap() < 0.0);
    let never = json(&["--reaction-time", "0.75", "--calm-with", "reaction-time=0.74"]);
    assert!(never.get("smallest_calming_number").is_some_and(Value::is_null));
    let words = answer(&["--reaction-time", "0.75", "--calm-with", "reaction-time=0"]);
    assert!(words.contains("unstable") && words.contains("5 of 50"), "{words}");
}

#[test]
fn roots_are_listed_mode_by_mode() {
    let report = json(&["--reaction-time", "0.75", "--roots", "4"]);
    let roots = report["roots"].as_array().unwrap();
    assert_eq!(roots.len(), 100);
    assert!(roots.iter().all(|root| root["residual"].as_f64().unwrap() < 1e-10));
    let largest = roots.iter().map(|root| root["real_per_s"].as_f64().unwrap()).fold(f64::MIN, f64::max);
    assert_eq!(report["max_growth_rate_per_s"].as_f64().unwrap(), largest);
    let heterogeneous = json(&["--reaction-time", "0.75", "--driver", "1-9:reaction-time=0", "--roots", "2"]);
    assert!(heterogeneous["roots"].as_array().unwrap().len() >= 25);
}

/// The roots of the simulation stand beside those of continuous time; each solves the difference equation,
/// z^m·(z − 1) = dt·d_q.
#[test]
fn roots_of_the_simulation_are_given_too() {
    let homogeneous: &[&str] = &["--reaction-time", "0.75"];
    let coarse = &["--reaction-time", "0.8", "--time-step", "0.1", "--vehicles", "20"];
    let heterogeneous = &["--reaction-time", "0.75", "--driver", "1-9:reaction-time=0.3,sensitivity=1.2"];
    for (scenario, modes, per_mode) in [(homogeneous, 25, 4), (coarse, 10, 4), (heterogeneous, 25, 4)] {
        let report = json(&[scenario, &["--roots", "4"]].concat());
        let roots = report["roots_discrete"].as_array().unwrap();
        assert_eq!(roots.len(), modes * per_mode, "{scenario:?}");
        let number = |root: &Value, name: &str| root[name].as_f64().unwrap();
        let dt = if modes == 10 { 0.1 } else { 0.01 };
        for root in roots {
            assert!(number(root, "residual") < 1e-10, "{root}");
            let size = libm::hypot(number(root, "factor_real"), number(root, "factor_imaginary"));
            assert!((libm::log(size) / dt - number(root, "real_per_s")).abs() < 1e-9, "{root}");
        }
        let rates: Vec<_> = roots.iter().map(|root| number(root, "real_per_s")).collect();
        assert!(rates.chunks(per_mode).all(|mode| mode.windows(2).all(|w| w[1] <= w[0])), "{scenario:?}");
        let largest = rates.iter().copied().fold(f64::MIN, f64::max);
        assert_eq!(report["max_growth_rate_discrete_per_s"].as_f64().unwrap(), largest);
    }
    let words = answer(&["--reaction-time", "0.75", "--roots", "1"]);
    assert!(words.contains("\ncontinuous time\n") && words.contains("\nin steps of 0.01 s"), "{words}");
}

/// The numerical eigenvalues of the Jacobian are the closed form; those of heterogeneous drivers are the roots without delay.
#[test]
fn eigenvalues_are_a_table_and_part_of_the_json() {
    let csv = answer(&["--reaction-time", "0.75", "--eigenvalues"]);
    assert!(
        csv.starts_with("# ringroad ") && csv.contains("\n# computed stability --eigenvalues\n"),
        "{csv}"
    );
    let rows: Vec<_> = csv.lines().filter(|l| !l.starts_with('#')).collect();
    assert_eq!(
        rows[0],
        "mode,real_per_s,imaginary_per_s,theory_real_per_s,theory_imaginary_per_s,distance_per_s"
    );
    assert_eq!(rows.len(), 50);
    let c = 0.731_616;
    for (k, row) in rows[1..].iter().enumerate() {
        let cells: Vec<f64> = row.split(',').map(|cell| cell.parse().unwrap()).collect();
        let angle = std::f64::consts::TAU * (k + 1) as f64 / 50.0;
        assert_eq!(cells[0], (k + 1) as f64);
        assert!((cells[1] + c * (1.0 - libm::cos(angle))).abs() < 1e-6, "{row}");
        assert!((cells[2] - c * libm::sin(angle)).abs() < 1e-6 && cells[5] < 1e-9, "{row}");
    }
    let heterogeneous = ["--driver", "1-9:sensitivity=1.6", "--eigenvalues", "--roots", "1"];
    let report = json(&heterogeneous);
    let eigenvalues = report["eigenvalues"].as_array().unwrap();
    assert_eq!((eigenvalues.len(), report["roots"].as_array().unwrap().len()), (49, 25));
    assert!(eigenvalues.iter().all(|e| e["distance_per_s"].as_f64().unwrap() < 1e-9));
    assert!(json(&[]).get("eigenvalues").is_none());
    assert_eq!(json(&["--vehicles", "1", "--eigenvalues"])["eigenvalues"], serde_json::json!([]));
}

#[test]
fn a_sweep_is_a_table() {
    let csv = answer(&["--sweep", "vehicles=2:133"]);
    assert!(csv.starts_with("# ringroad ") && csv.contains("\n# scenario {"));
    let rows: Vec<_> = csv.lines().filter(|l| !l.starts_with('#')).collect();
    assert_eq!(rows.len(), 133);
    assert!(rows[0].starts_with("vehicles,critical_reaction_time_s,critical_reaction_time_discrete_s"));
    assert!(rows[49].starts_with("50,0.68386"), "{}", rows[49]);
}

#[test]
fn the_jam_is_marked_among_the_stable_numbers() {
    let numbers = |arguments: &[&str]| {
        let words = answer(arguments);
        let name = "stable numbers of vehicles a lane";
        words.lines().find_map(|l| l.strip_prefix(name)).unwrap().trim().to_owned()
    };
    assert_eq!(numbers(&["--reaction-time", "0.75"]), "1 … 41, 134 … 199 (jam)");
    assert_eq!(numbers(&[]), "1 … 133, 134 … 199 (jam)", "without delay everything is stable");
    assert_eq!(json(&[])["stable_vehicles"], serde_json::json!([[1, 199]]));
}

#[test]
fn bad_input_is_refused_by_name() {
    for (arguments, words) in [
        (&["--sweep", "cars=2:133"][..], "--sweep: parameter: “cars” is not allowed; allowed: vehicles, "),
        (&["--sweep", "vehicles=133:2"], "“133:2” is not allowed; allowed: 2:133, "),
        (&["--sweep", "vehicles=2:5:0.5"], "step: 0.5 is not allowed; allowed: a whole step"),
        (
            &["--calm-with", "foo=2"],
            "calm-with: driver's parameter: “foo” is not allowed; allowed: max-speed, ",
        ),
        (&["--sweep", "vehicles=2:250"], "vehicles=200"),
        (
            &["--vehicles", "201", "--length", "5000", "--eigenvalues"],
            "--eigenvalues: vehicles: 201 is not allowed; allowed: at most 200 vehicles",
        ),
        (&["--eigenvalues", "--roots", "2"], "--eigenvalues: with --roots is not allowed"),
        (&["--roots", "0"], "--roots"),
        (&["--roots", "many"], "many"),
        (&["--calm-with", "reaction-time=-1"], "reaction-time"),
        (&["--calm-with", "vehicles=3"], "vehicles"),
        (&["--vehicles", "0"], "vehicles"),
    ] {
        let message = refusal(arguments);
        assert!(message.contains(words), "{arguments:?}: {message}");
    }
}
