//! Scenarios whose tables must have the same bits everywhere, and the hash that is compared.

use ringroad::batch::{Plan, Run, run_all};
use ringroad::error::Error;
use ringroad::measurement::Measurement;
use ringroad::measurement::probe::measure;
use ringroad::measurement::provenance::run_to_csv;
use ringroad::scenario::Scenario;
use ringroad::scenario::presets::preset;
use ringroad::simulation::Simulation;
use std::collections::BTreeMap;

/// What is run and measured: a name, a scenario, a measurement.
pub fn cases() -> Vec<(&'static str, Scenario, Measurement)> {
    let table = |json: &str| Measurement::from_json(json).unwrap();
    let trajectories = || table(r#"{"table":"trajectories","every":1}"#);
    let scenario = |json: &str| Scenario::from_json(json).unwrap();
    let named = |name: &str, until| {
        let scenario = preset(name).unwrap().scenario;
        Scenario { until, ..scenario }
    };
    vec![
        ("phantom jam to the collision", named("phantom-jam", 600.0), trajectories()),
        ("instant", named("instant", 100.0), table(r#"{"table":"speed-map"}"#)),
        ("flow", named("stable", 100.0), table(r#"{"table":"flow-map","window":5}"#)),
        ("modes", named("phantom-jam", 100.0), table(r#"{"table":"modes"}"#)),
        (
            "drivers that differ, actions",
            scenario(
                r#"{"until":60,"driver":{"reaction_time":0.4},
                "exceptions":["20%:sensitivity=1.7,reaction-time=0.2","3:max-speed=25"],
                "actions":["at=0:1:nudge=1","at=10:7:brake=3","at=20:all:reaction-time=0.6","at=25:5-9:nudge=-0.5",
                "at=30:10%:sensitivity=3","at=40:all:reaction-time=0.1"]}"#,
            ),
            trajectories(),
        ),
        (
            "random start, long step",
            scenario(r#"{"until":200,"vehicles":40,"start":"random","seed":7,"time_step":0.1,"lanes":2}"#),
            trajectories(),
        ),
        ("load balance", named("load-balance", 100.0), trajectories()),
        ("aggressive", named("aggressive", 200.0), table(r#"{"table":"events"}"#)),
        ("three lanes", named("three-lanes", 60.0), trajectories()),
        ("mixed traffic", named("mixed-traffic", 60.0), table(r#"{"table":"events"}"#)),
    ]
}

/// FNV-1a (64 bits) of the CSV of the table, as hexadecimal digits.
pub fn hash(mut simulation: Simulation, measurement: &Measurement) -> String {
    let scenario = simulation.scenario().clone();
    let mut probes = [measurement.probe(&scenario).unwrap()];
    measure(&mut simulation, &mut probes, &mut |_| true);
    digest(&run_to_csv(&probes[0].table(), &scenario, measurement))
}

/// The same of the summary of a small batch, lane changes, collisions and confidence intervals included.
pub fn batch() -> String {
    let scenario =
        Scenario { vehicles: 20, length: 400.0, until: 60.0, ..preset("load-balance").unwrap().scenario };
    let vary = vec!["reaction-time=0,1.5".parse().unwrap()];
    let plan = Plan::new(scenario, vary, 5, Measurement::named("overview").unwrap()).unwrap();
    let numbers: Vec<u64> = (0..plan.runs()).collect();
    let mut runs = BTreeMap::new();
    let finished = run_all(&plan, &numbers, None, &|_| true, &mut |run: Run| {
        runs.insert(run.number, run);
        Ok::<(), Error>(())
    });
    assert_eq!(finished, Ok(true));
    digest(&plan.to_csv(&plan.summary(&runs).unwrap()))
}

/// Holds what is computed here against what the native test wrote just before.
#[cfg(target_arch = "wasm32")]
pub fn are_native() {
    let native: BTreeMap<String, String> =
        serde_json::from_str(include_str!(env!("RINGROAD_HASHES"))).unwrap();
    let cases = cases();
    assert_eq!(cases.len() + 1, native.len());
    assert_eq!(batch(), native["batch"]);
    for (name, scenario, measurement) in cases {
        assert_eq!(hash(Simulation::new(&scenario).unwrap(), &measurement), native[name], "{name}");
    }
}

fn digest(csv: &str) -> String {
    let hash = csv.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    format!("{hash:016x}")
}
