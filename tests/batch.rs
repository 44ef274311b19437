//! Batches: the bytes of the table depend on the plan alone, not on threads, order, interruptions or shards; and plans that
//! are not valid are refused before anything runs.

use ringroad::batch::record::{self, Record};
use ringroad::batch::{Header, ParameterValues, Plan, Run, Shard, run_all};
use ringroad::error::Error;
use ringroad::measurement::Measurement;
use ringroad::scenario::Scenario;
use ringroad::scenario::presets::preset;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};

/// Two lanes, 20 vehicles, lane changes from the first seconds on; with long reaction times there are collisions.
fn scenario() -> Scenario {
    Scenario { vehicles: 20, length: 400.0, until: 60.0, ..preset("load-balance").unwrap().scenario }
}

fn varied(texts: &[&str]) -> Vec<ParameterValues> {
    texts.iter().map(|text| text.parse().unwrap()).collect()
}

fn plan(measurement: &str, vary: &[&str], runs: u64) -> Plan {
    Plan::new(scenario(), varied(vary), runs, Measurement::named(measurement).unwrap()).unwrap()
}

/// A plan of 24 runs that differ in length and outcome.
fn small() -> Plan {
    plan("outcome", &["reaction-time=0:1.5:0.5", "vehicles=10,20"], 3)
}

fn runs(plan: &Plan, numbers: &[u64], threads: usize) -> BTreeMap<u64, Run> {
    let mut runs = BTreeMap::new();
    let finished = run_all(plan, numbers, Some(threads), &|_| true, &mut |run: Run| {
        assert!(runs.insert(run.number, run).is_none());
        Ok::<(), Error>(())
    });
    assert_eq!(finished, Ok(true));
    runs
}

fn all(plan: &Plan) -> BTreeMap<u64, Run> {
    runs(plan, &(0..plan.runs()).collect::<Vec<_>>(), 2)
}

fn csv(plan: &Plan, runs: &BTreeMap<u64, Run>) -> String {
    plan.to_csv(&plan.table(runs))
}

fn message<T: std::fmt::Debug>(result: Result<T, Error>) -> String {
    result.unwrap_err().to_string()
}

#[test]
fn a_grid_is_run_in_order_with_consecutive_seeds() {
    let plan = small();
    assert_eq!((plan.cells(), plan.runs()), (8, 24));
    let table = plan.table(&all(&plan));
    assert_eq!(table.wholes("run").unwrap(), (1..=24).collect::<Vec<_>>());
    let base = scenario().seed;
    let seeds: Vec<_> = (0..24).map(|k| base + k % 3).collect();
    assert_eq!(table.wholes("seed").unwrap(), seeds);
    let vehicles: Vec<_> = (0..24).map(|k| if k / 3 % 2 == 0 { 10 } else { 20 }).collect();
    assert_eq!(table.wholes("vehicles").unwrap(), vehicles);
    let delays: Vec<_> = (0..24).map(|k| f64::from(k / 6) * 0.5).collect();
    assert_eq!(table.floats("reaction_time_s").unwrap(), delays);
}

/// Each run gives the same numbers as its scenario run and measured separately.
#[test]
fn a_run_of_a_batch_is_the_run_of_its_scenario() {
    let plan = small();
    let table = plan.table(&all(&plan));
    let ends = table.floats("end_time_s").unwrap();
    let speeds = table.floats("mean_speed_m_per_s").unwrap();
    let flows = table.floats("mean_flow_veh_per_s").unwrap();
    let mut collisions = 0;
    for number in [0, 4, 13, 22] {
        let run = plan.scenario(number);
        let mut simulation = ringroad::simulation::Simulation::new(&run).unwrap();
        simulation.run_to(u64::MAX);
        let k = number as usize;
        assert_eq!(ends[k], simulation.time());
        let distance: f64 = (0..run.vehicles).map(|j| simulation.distance(j)).sum();
        assert_eq!(speeds[k], distance / simulation.time() / run.vehicles as f64);
        assert_eq!(flows[k], distance / simulation.time() / run.length);
        collisions += u32::from(simulation.collision().is_some());
    }
    // Among these runs both outcomes occur.
    assert!((1..4).contains(&collisions), "{collisions}");
}

#[test]
fn the_table_does_not_depend_on_threads_order_or_the_text_form() {
    for measurement in ["outcome", "overview", "drivers", "events"] {
        let plan = plan(measurement, &["reaction-time=0,1.5", "sensitivity=1,2"], 3);
        let numbers: Vec<u64> = (0..plan.runs()).collect();
        let backwards: Vec<u64> = (0..plan.runs()).rev().collect();
        let one = runs(&plan, &numbers, 1);
        let expected = csv(&plan, &one);
        assert_eq!(csv(&plan, &runs(&plan, &numbers, 2)), expected);
        assert_eq!(csv(&plan, &runs(&plan, &backwards, 2)), expected);
        // Written as text and read back.
        let text = record::write(&Header::new(plan.clone(), Shard::default(), false), &one);
        let back = Record::read(&text).unwrap();
        assert_eq!(csv(&back.header.plan, &back.runs), expected);
        if plan.check_summary().is_ok() {
            let summary = |runs| plan.to_csv(&plan.summary(runs).unwrap());
            assert_eq!(summary(&back.runs), summary(&one));
        }
    }
}

#[test]
fn merged_shards_give_the_table_of_one_batch() {
    let plan = plan("overview", &["reaction-time=0,1.5"], 4);
    let expected = csv(&plan, &all(&plan));
    for count in [1, 2, 3, 7, 11] {
        let mut shards = Vec::new();
        for index in (1..=count).rev() {
            let shard: Shard = format!("{index}/{count}").parse().unwrap();
            let numbers: Vec<u64> = shard.numbers(&plan).collect();
            let header = Header::new(plan.clone(), shard, false);
            let text = record::write(&header, &runs(&plan, &numbers, 2));
            shards.push((format!("part {index}"), Record::read(&text).unwrap()));
        }
        let (header, runs) = record::merge(shards).unwrap();
        assert_eq!(csv(&header.plan, &runs), expected, "{count} shards");
    }
}

#[test]
fn shards_that_do_not_fit_together_are_refused() {
    let plan = small();
    let everything = all(&plan);
    let part = |name: &str, plan: &Plan, shard: &str, summary| {
        let shard: Shard = shard.parse().unwrap();
        let runs = shard.numbers(plan).map(|n| (n, everything[&n].clone())).collect();
        let text = record::write(&Header::new(plan.clone(), shard, summary), &runs);
        (name.to_owned(), Record::read(&text).unwrap())
    };
    let merged = |parts: Vec<(String, Record)>| message(record::merge(parts));

    let overlap = merged(vec![part("a", &plan, "1/2", false), part("b", &plan, "1/2", false)]);
    assert!(
        overlap.starts_with("b:") && overlap.contains("overlap") && overlap.contains("in a, too"),
        "{overlap}"
    );
    let overlap = merged(vec![part("a", &plan, "1/2", false), part("b", &plan, "1/3", false)]);
    assert!(overlap.contains("overlap"), "{overlap}");
    let missing = merged(vec![part("a", &plan, "1/3", false), part("b", &plan, "3/3", false)]);
    assert!(
        missing.contains("16 of 24") && missing.contains("run 2 ") && missing.contains("2/3"),
        "{missing}"
    );
    let form = merged(vec![part("a", &plan, "1/2", false), part("b", &plan, "2/2", true)]);
    assert!(form.contains("--summary"), "{form}");
    assert!(merged(Vec::new()).contains("all shards"));

    let other = Plan::new(
        Scenario { seed: 7, ..scenario() },
        plan.vary().to_vec(),
        3,
        Measurement::named("outcome").unwrap(),
    );
    let foreign = merged(vec![part("a", &plan, "1/2", false), part("b", &other.unwrap(), "2/2", false)]);
    assert!(foreign.contains("seed is 7 and not 1"), "{foreign}");
    let mut old = part("b", &plan, "2/2", false);
    old.1.header.ringroad = "0.0.9".into();
    let foreign = merged(vec![part("a", &plan, "1/2", false), old]);
    assert!(foreign.contains("0.0.9"), "{foreign}");
    // Shards of different counts may still complement each other.
    let parts = [("a", "1/2"), ("b", "2/4"), ("c", "4/4")];
    assert!(record::merge(parts.map(|(n, s)| part(n, &plan, s, false)).to_vec()).is_ok());
}

#[test]
fn a_record_may_end_in_an_incomplete_line_but_not_contain_a_wrong_one() {
    let plan = plan("overview", &[], 3);
    let runs = all(&plan);
    let text = record::write(&Header::new(plan.clone(), Shard::default(), false), &runs);
    let first = text.find('\n').unwrap() + 1;
    for end in first..=text.len() {
        if !text.is_char_boundary(end) {
            continue;
        }
        let record = Record::read(&text[..end]).unwrap();
        assert_eq!(record.runs.len(), text[first..end].matches('\n').count());
        assert_eq!(record.whole, text[..end].rfind('\n').unwrap() + 1);
    }
    for (broken, named) in [
        (text[..first - 1].to_owned(), "ringroad"),
        ("time,speed\n1,2\n".to_owned(), "time,speed"),
        (text.replacen("\n[1,", "\n[9,", 1), "line 3"),
        (text.replacen("\n[1,", "\n[1,,", 1), "line 3"),
        (text.replacen("\"runs\":3", "\"runs\":0", 1), "runs"),
    ] {
        assert_ne!(broken, text);
        let message = message(Record::read(&broken));
        assert!(message.contains(named), "{message}");
    }
}

#[test]
fn plans_that_are_not_valid_are_refused_before_anything_runs() {
    let outcome = || Measurement::named("outcome").unwrap();
    let make = |vary: &[&str], runs| message(Plan::new(scenario(), varied(vary), runs, outcome()));
    let holds = |message: String, words: &[&str]| {
        assert!(words.iter().all(|w| message.contains(w)), "{message} lacks one of {words:?}");
    };
    // 400 m hold 79 vehicles of 5 m in one lane.
    holds(make(&["lanes=1,2", "vehicles=70:100:10"], 1), &["cell lanes=1, vehicles=80", "79"]);
    holds(make(&["min-headway=7.5,5"], 1), &["cell min-headway=5", "vehicle length"]);
    holds(make(&["lanes=1,2", "lanes=4"], 1), &["“lanes”", "once"]);
    holds(make(&[], 0), &["runs", "at least one"]);
    holds(make(&["vehicles=1:40:1", "sensitivity=1:2:0.01"], 1000), &["4040", "4040000", "1000000"]);
    let last = Scenario { seed: (1 << 53) - 3, ..scenario() };
    holds(message(Plan::new(last, vec![], 10, outcome())), &["seed", "9007199254740991"]);
    // The vehicles of a share depend on the seed; a vehicle of 45 m does not fit behind any other.
    let long = Scenario { overrides: vec!["50%:vehicle-length=45".parse().unwrap()], ..scenario() };
    holds(message(Plan::new(long, vec![], 2, outcome())), &["length"]);

    let lanes = Measurement::named("lanes").unwrap();
    let other_columns = Plan::new(scenario(), varied(&["lanes=2,3"]), 1, lanes.clone());
    holds(message(other_columns), &["cell lanes=3", "lanes", "same columns"]);
    assert!(Plan::new(scenario(), varied(&["lanes=3", "until=1,2"]), 1, lanes).is_ok());
    let beyond = Measurement::CyclicGrowth { vehicle: 15, periods: 3 };
    let message_of_cell = message(Plan::new(scenario(), varied(&["vehicles=20,10"]), 1, beyond));
    holds(message_of_cell, &["cell vehicles=10", "15", "at most 10"]);
    let often = Measurement::Trajectories { every: 0.05 };
    let far = Scenario { until: 1e6, ..scenario() };
    holds(message(Plan::new(far, vec![], 10, often)), &["GiB", "less often"]);
    let events = plan("events", &[], 2);
    holds(message(events.check_summary()), &["events", "outcome"]);
}

/// The value that the scenario has for a varied parameter does not matter, even where it is not valid.
#[test]
fn the_values_that_are_varied_replace_those_of_the_scenario() {
    let outcome = || Measurement::named("outcome").unwrap();
    let vary = varied(&["vehicles=10,20"]);
    let crowded = Scenario { vehicles: 1000, ..scenario() };
    let a = Plan::new(crowded, vary.clone(), 1, outcome()).unwrap();
    assert_eq!(a, Plan::new(scenario(), vary, 1, outcome()).unwrap());
    assert_eq!(Plan::from_json(&a.to_json()).unwrap(), a);
}

#[test]
fn a_plan_in_json_says_what_is_wrong_with_it() {
    let json = small().to_json();
    for (from, to, named) in [
        ("\"runs\":3", "\"runs\":3,\"colour\":1", "colour"),
        ("\"vehicles=10,20\"", "\"vehicles=10,20000\"", "cell"),
        ("{\"version\":1", "{\"version\":2", "version"),
        ("\"table\":\"outcome\"", "\"table\":\"nothing\"", "nothing"),
    ] {
        let changed = json.replacen(from, to, 1);
        assert_ne!(changed, json, "{from}");
        let message = message(Plan::from_json(&changed));
        assert!(message.contains(named), "{message}");
    }
}

#[test]
fn a_summary_holds_the_statistics_of_the_runs() {
    let plan = small();
    let runs = all(&plan);
    let (table, summary) = (plan.table(&runs), plan.summary(&runs).unwrap());
    let speeds = table.floats("mean_speed_m_per_s").unwrap();
    let quantities = match &summary.columns().iter().find(|c| c.name == "quantity").unwrap().values {
        ringroad::format::table::Values::Text(v) => v.clone(),
        _ => unreachable!(),
    };
    let places: Vec<_> = (0..summary.rows()).filter(|&k| quantities[k] == "mean_speed_m_per_s").collect();
    assert_eq!(places.len(), 8);
    for (cell, &k) in places.iter().enumerate() {
        let sample = &speeds[3 * cell..3 * cell + 3];
        let mean = (sample[0] + sample[1] + sample[2]) / 3.0;
        let variance = sample.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / 2.0;
        let of = |name: &str| summary.floats(name).unwrap()[k];
        let mut sorted = sample.to_vec();
        sorted.sort_by(f64::total_cmp);
        assert!((of("mean") - mean).abs() < 1e-12 && (of("sd") - variance.sqrt()).abs() < 1e-12);
        assert_eq!(of("q50"), sorted[1]);
        // Student's t for two degrees of freedom.
        let half = 4.302_652_73 * (variance / 3.0).sqrt();
        assert!((of("ci95_high") - mean - half).abs() < 1e-7 * (1.0 + half));
        assert_eq!(summary.wholes("runs").unwrap()[k], 3);
    }
    let outcomes: Vec<_> = runs.values().map(|r| r.collided).collect();
    for (cell, k) in (0..summary.rows()).filter(|&k| quantities[k] == "collided").enumerate() {
        let share = outcomes[3 * cell..3 * cell + 3].iter().filter(|&&c| c).count() as f64 / 3.0;
        assert_eq!(summary.floats("mean").unwrap()[k], share);
    }
}

/// Each row of a summary over time is at a regular time of the measurement, and runs that have ended do not count.
#[test]
fn a_summary_over_time_counts_the_runs_that_have_not_ended() {
    for measurement in ["overview", "lanes", "drivers"] {
        let plan = plan(measurement, &["reaction-time=0,1.5"], 5);
        let runs = all(&plan);
        let ends: Vec<_> = runs.values().skip(5).map(|r| r.end).collect();
        assert!(runs.values().skip(5).any(|r| r.collided), "{ends:?}");
        let summary = plan.summary(&runs).unwrap();
        let [times, delays] = ["time_s", "reaction_time_s"].map(|name| summary.floats(name).unwrap());
        let counts = summary.wholes("runs").unwrap();
        let quantities = match &summary.columns().iter().find(|c| c.name == "quantity").unwrap().values {
            ringroad::format::table::Values::Text(v) => v.clone(),
            _ => unreachable!(),
        };
        for k in 0..summary.rows() {
            assert_eq!((times[k] / plan.scenario(0).time_step).round() as u64 % 20, 0, "{}", times[k]);
            if quantities[k] == "collided" {
                assert_eq!(counts[k], 5);
            } else if times[k] > 0.0 && delays[k] == 1.5 {
                let going_on = ends.iter().filter(|&&end| end >= times[k]).count();
                assert_eq!(counts[k], going_on as u64, "{} at {}", quantities[k], times[k]);
            }
        }
    }
}

/// The columns of every table are known before anything has run.
#[test]
fn every_measurement_has_the_columns_that_were_announced() {
    let scenario = Scenario { until: 2.0, ..scenario() };
    for measurement in Measurement::all() {
        let plan = Plan::new(scenario.clone(), vec![], 2, measurement.clone()).unwrap();
        let mut probes = [measurement.probe(&scenario).unwrap()];
        let mut simulation = ringroad::simulation::Simulation::new(&scenario).unwrap();
        ringroad::measurement::probe::measure(&mut simulation, &mut probes, &mut |_| true);
        let names = |columns: &[ringroad::format::table::Column]| -> Vec<String> {
            columns.iter().map(|c| c.name.clone()).collect()
        };
        assert_eq!(names(&plan.columns()), names(probes[0].table().columns()), "{}", measurement.name());
        let (runs, header) = (all(&plan), Header::new(plan.clone(), Shard::default(), false));
        let back = Record::read(&record::write(&header, &runs)).unwrap();
        assert_eq!(csv(&plan, &back.runs), csv(&plan, &runs), "{}", measurement.name());
        if plan.check_summary().is_ok() {
            plan.summary(&runs).unwrap();
        }
    }
}

/// Homogeneous drivers that start in equilibrium stay there, so runs from a uniform start give the fundamental diagram.
#[test]
fn a_grid_over_density_is_the_fundamental_diagram() {
    let scenario = Scenario { until: 20.0, ..Scenario::default() };
    let vary = varied(&["vehicles=10:130:20", "sensitivity=0.5,1,2"]);
    let plan = Plan::new(scenario, vary, 1, Measurement::named("outcome").unwrap()).unwrap();
    let table = plan.table(&all(&plan));
    let flows = table.floats("mean_flow_veh_per_s").unwrap();
    assert_eq!(flows.len(), 21);
    for (number, flow) in flows.iter().enumerate() {
        let run = plan.scenario(number as u64);
        let theory = run.driver.flow(run.vehicles as f64 / run.length);
        assert!((flow - theory).abs() < 1e-12, "{number}: {flow} {theory}");
    }
    assert_eq!(table.floats("speed_deviation_m_per_s").unwrap(), [0.0; 21]);
}

#[test]
fn a_batch_can_be_cancelled_within_a_run_and_between_runs() {
    let plan = small();
    let numbers: Vec<u64> = (0..plan.runs()).collect();
    let total: u64 = numbers.iter().map(|&n| plan.work(n)).sum();
    let done = AtomicU64::new(0);
    let mut finished = 0;
    let went_on = run_all(
        &plan,
        &numbers,
        Some(2),
        &|work| done.fetch_add(work, Ordering::Relaxed) + work < total / 2,
        &mut |_| {
            finished += 1;
            Ok::<(), Error>(())
        },
    );
    assert_eq!(went_on, Ok(false));
    assert!(finished < numbers.len());
    // Without cancellation, the work reported adds up to the work announced, also where runs collide.
    done.store(0, Ordering::Relaxed);
    let count = |work| {
        done.fetch_add(work, Ordering::Relaxed);
        true
    };
    run_all(&plan, &numbers, None, &count, &mut |_| Ok::<(), Error>(())).unwrap();
    assert_eq!(done.into_inner(), total);
    // Cancelled within a run that would take a day.
    let long = Scenario { vehicles: 10_000, length: 1e6, until: 1e7, ..Scenario::default() };
    let long = Plan::new(long, vec![], 1, Measurement::named("outcome").unwrap()).unwrap();
    assert_eq!(long.run(0, &mut |_| false).unwrap(), None);
    // An error of the function that takes the runs stops the batch, too.
    let refusal = || Error::conflict("disk", "full", "room");
    assert_eq!(run_all(&plan, &numbers, Some(1), &|_| true, &mut |_| Err(refusal())), Err(refusal()));
}
