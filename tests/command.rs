//! The command, run as a person runs it.
#![cfg(feature = "command")]

use serde_json::Value;
use std::fs;
use std::io::{Read, Write};
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

fn ringroad(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ringroad")).args(arguments).output().unwrap()
}

/// Standard output of a call that succeeds.
fn answer(arguments: &[&str]) -> String {
    let output = ringroad(arguments);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    assert!(output.stderr.is_empty(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Message of a call that is refused.
fn refusal(arguments: &[&str]) -> String {
    let output = ringroad(arguments);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    assert!(output.stdout.is_empty(), "{arguments:?} wrote before it refused");
    String::from_utf8(output.stderr).unwrap()
}

fn summary(arguments: &[&str]) -> Value {
    serde_json::from_str(&answer(&[&["run", "--json"], arguments].concat())).unwrap()
}

/// An empty folder for one test.
fn folder(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

/// Column names and rows of a CSV without quoted fields.
fn rows(csv: &str) -> (Vec<&str>, Vec<Vec<&str>>) {
    let mut lines = csv.lines().filter(|l| !l.starts_with('#')).map(|l| l.split(',').collect());
    (lines.next().unwrap(), lines.collect())
}

fn column<'a>(csv: &'a str, name: &str) -> Vec<&'a str> {
    let (names, rows) = rows(csv);
    let k = names.iter().position(|n| *n == name).unwrap_or_else(|| panic!("no column {name} in {names:?}"));
    rows.iter().map(|row| row[k]).collect()
}

const TRAJECTORIES: &str = "time_s,vehicle,lane,position_m,speed_m_per_s,headway_m,perceived_headway_m,frustration,\
                            distance_m,lane_changes";

#[test]
fn a_run_writes_trajectories_with_what_made_them() {
    let csv = answer(&["run", "--vehicles", "3", "--until", "2"]);
    let lines: Vec<_> = csv.lines().collect();
    assert_eq!(lines[0], format!("# ringroad {}", env!("CARGO_PKG_VERSION")));
    assert!(lines[1].starts_with("# scenario {") && lines[1].contains(r#""vehicles":3"#));
    assert_eq!(lines[2], r#"# measurement {"every":1,"table":"trajectories"}"#);
    let (names, rows) = rows(&csv);
    assert_eq!(names.join(","), TRAJECTORIES);
    assert_eq!(rows.len(), 9);
    assert_eq!(column(&csv, "time_s"), ["0", "0", "0", "1", "1", "1", "2", "2", "2"]);
    assert_eq!(lines.iter().filter(|l| l.starts_with("# column ")).count(), 10);
}

#[test]
fn numbers_read_back_to_the_same_bits() {
    use ringroad::scenario::Scenario;
    use ringroad::simulation::Simulation;
    let csv = answer(&[
        "run",
        "--until",
        "30",
        "--action",
        "at=0:1:nudge=1",
        "--reaction-time",
        "0.5",
        "--every",
        "30",
    ]);
    let scenario = Scenario {
        until: 30.0,
        driver: ringroad::scenario::driver::Driver { reaction_time: 0.5, ..Default::default() },
        actions: vec!["at=0:1:nudge=1".parse().unwrap()],
        ..Scenario::default()
    };
    let mut simulation = Simulation::new(&scenario).unwrap();
    simulation.run_to(u64::MAX);
    for (j, text) in column(&csv, "position_m")[50..].iter().enumerate() {
        assert_eq!(text.parse::<f64>().unwrap().to_bits(), simulation.position(j).to_bits());
    }
}

/// Every parameter of the table is an option, lands in the scenario, and is refused out of its range.
#[test]
fn every_parameter_is_an_option() {
    let parameters: Value = serde_json::from_str(&answer(&["parameters", "--json"])).unwrap();
    let parameters = parameters.as_array().unwrap();
    assert_eq!(parameters.len(), ringroad::scenario::parameters::PARAMETERS.len());
    let text = answer(&["parameters"]);
    for parameter in parameters {
        let name = parameter["name"].as_str().unwrap();
        let option = format!("--{}", name.replace('_', "-"));
        assert!(text.contains(&option[2..]), "{name} is missing from the list");
        // A value that is not the default and allowed beside the other defaults.
        let value = match name {
            "vehicles" => "40",
            "length" => "1200",
            "lanes" => "2",
            "time_step" => "0.02",
            "until" => "0.5",
            "min_headway" => "8",
            "vehicle_length" => "4",
            "seed" => "9007199254740991",
            _ => "0.75",
        };
        let scenario = &summary(
            &["--until", "0.1", &option, value].as_slice()[if name == "until" { 2 } else { 0 }..],
        )["scenario"];
        let place = if parameter["of"] == "driver" { &scenario["driver"] } else { scenario };
        assert_eq!(place[name].as_f64().unwrap(), value.parse::<f64>().unwrap(), "{name}");
        let above = (parameter["max"].as_f64().unwrap() * 2.0 + 1.0).to_string();
        for bad in ["-1", "many", "nan", &above] {
            let message = refusal(&["run", &option, bad]);
            assert!(message.contains(&option[2..]) && message.to_lowercase().contains(bad), "{message}");
            assert!(message.contains("allowed: a"), "{message}");
        }
    }
}

#[test]
fn start_drivers_and_actions_are_options() {
    let s = summary(&[
        "--lanes",
        "2",
        "--until",
        "1",
        "--start",
        "staggered",
        "--driver",
        "12:sensitivity=2",
        "--driver",
        "10%:reaction-time=0.1",
        "--action",
        "at=0.5:all:reaction-time=0.2",
        "--action",
        "at=0:7:brake=3",
    ]);
    let scenario = &s["scenario"];
    assert_eq!(scenario["start"], "staggered");
    assert_eq!(scenario["exceptions"], serde_json::json!(["12:sensitivity=2", "10%:reaction-time=0.1"]));
    assert_eq!(scenario["actions"], serde_json::json!(["at=0.5:all:reaction-time=0.2", "at=0:7:brake=3"]));
    let braked = answer(&[
        "run",
        "--until",
        "2",
        "--table",
        "speeds",
        "--vehicle",
        "7",
        "--action",
        "at=0:7:brake=1.5",
    ]);
    let speeds = column(&braked, "v_7_m_per_s");
    assert_eq!(speeds[..2], ["0", "0"]);
    assert!(speeds[2].parse::<f64>().unwrap() > 5.0);
}

#[test]
fn rows_come_at_the_interval_and_at_a_collision() {
    let output = ringroad(&["run", "--preset", "phantom-jam", "--every", "50"]);
    let [csv, note] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
    let collision = summary(&["--preset", "phantom-jam"])["collision"].clone();
    let [behind, ahead] = ["behind", "ahead"].map(|who| &collision[who]);
    let collision = collision["time"].as_f64().unwrap();
    assert_eq!(note, format!("note: the run ended at {collision} s: vehicle {behind} ran into {ahead}\n"));
    let mut times: Vec<f64> = column(&csv, "time_s").iter().map(|t| t.parse().unwrap()).collect();
    times.dedup();
    let whole = (collision / 50.0).floor() as u32;
    let mut expected: Vec<f64> = (0..=whole).map(|k| f64::from(k) * 50.0).collect();
    expected.push(collision);
    assert_eq!(times, expected);
}

#[test]
fn a_summary_tells_of_a_collision_and_exits_with_success() {
    let s = summary(&["--preset", "phantom-jam"]);
    assert_eq!(s["outcome"], "collision");
    let c = &s["collision"];
    assert_eq!((c["time"].as_f64(), c["lane"].as_u64()), (s["time"].as_f64(), Some(1)));
    let (behind, ahead) = (c["behind"].as_u64().unwrap(), c["ahead"].as_u64().unwrap());
    assert!((1..=50).contains(&behind) && ahead == behind % 50 + 1, "{c}");
    assert_eq!(s["largest_delay_s"], 0.75);

    let s = summary(&["--preset", "stable"]);
    assert_eq!((s["outcome"].as_str(), s["time"].as_f64()), (Some("completed"), Some(600.0)));
    assert!(s["collision"].is_null());
    assert!((s["mean_speed_m_per_s"].as_f64().unwrap() - 10.7354).abs() < 1e-3);
    assert_eq!(s["vehicles_per_lane"], serde_json::json!([50]));
    assert_eq!(s["lane_changes"], 0);
    assert!(summary(&["--until", "0"])["mean_speed_m_per_s"].is_null());
}

/// Staggered lanes of 25: vehicle 1 is half a headway behind its neighbour ahead in lane 2, and before the one behind.
#[test]
fn the_aggressive_driver_stands_beside_its_control_neighbours() {
    let s = summary(&["--preset", "aggressive"]);
    let exceptions = s["exceptions"].as_array().unwrap();
    assert_eq!(exceptions.len(), 1);
    assert_eq!(exceptions[0]["vehicle"], 1);
    let csv = answer(&["run", "--preset", "aggressive", "--table", "vehicles", "--every", "600"]);
    let changes = column(&csv, "lane_changes");
    let of = |v: &Value| changes[50 + v["vehicle"].as_u64().unwrap() as usize - 1].parse::<u64>().unwrap();
    assert_eq!(exceptions[0]["lane_changes"].as_u64().unwrap(), of(&exceptions[0]));
    let start = answer(&["run", "--preset", "aggressive", "--until", "0"]);
    let (x, lane) = (column(&start, "position_m"), column(&start, "lane"));
    let position = |v: &Value| x[v["vehicle"].as_u64().unwrap() as usize - 1].parse::<f64>().unwrap();
    let neighbours = exceptions[0]["neighbours"].as_array().unwrap();
    assert_eq!(
        neighbours.iter().map(|n| n["place"].as_str().unwrap()).collect::<Vec<_>>(),
        ["ahead", "behind"]
    );
    for (neighbour, distance) in neighbours.iter().zip([20.0, -20.0]) {
        assert_eq!(lane[neighbour["vehicle"].as_u64().unwrap() as usize - 1], "2");
        let gap = (position(neighbour) - position(&exceptions[0])).rem_euclid(1000.0);
        assert_eq!(gap, f64::rem_euclid(distance, 1000.0), "{neighbour}");
        assert_eq!(neighbour["lane_changes"].as_u64().unwrap(), of(neighbour));
    }
}

#[test]
fn every_table_can_be_asked_for_and_has_its_options() {
    use ringroad::measurement::{Measurement, SETTINGS};
    for measurement in Measurement::all() {
        let table = measurement.name();
        let run = format!("run --lanes 2 --time-step 0.1 --until 5 --table {table}");
        let run: Vec<_> = run.split(' ').collect();
        assert!(answer(&run).contains(&format!(r#""table":"{table}""#)));
        for setting in &SETTINGS {
            let option = format!("--{}", setting.option);
            let with = |value| [&run[..], &[&option, value]].concat();
            if let Some(setting) = measurement.settings().iter().find(|s| s.option == setting.option) {
                let value = if setting.list { "[2]" } else { "2" };
                assert!(
                    answer(&with("2")).contains(&format!(r#""{}":{value}"#, setting.name)),
                    "{table} {option}"
                );
                let message = refusal(&with("-5"));
                assert!(message.contains(setting.name) && message.contains("-5"), "{message}");
            } else {
                let message = refusal(&with("2"));
                assert!(message.contains(&option) && message.contains(table), "{message}");
            }
        }
    }
    let csv = answer(&["run", "--until", "1", "--table", "speeds", "--vehicle", "7,3", "--vehicle", "9"]);
    assert_eq!(rows(&csv).0, ["time_s", "v_7_m_per_s", "v_3_m_per_s", "v_9_m_per_s"]);
}

#[test]
fn a_scenario_comes_from_a_preset_json_standard_input_or_a_table() {
    let folder = folder("scenario");
    let file = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    fs::write(file("a.json"), r#"{"vehicles":20,"until":3,"driver":{"reaction_time":0.25}}"#).unwrap();
    let from_json = answer(&["run", "--scenario", &file("a.json"), "--seed", "7"]);
    assert!(from_json.contains(r#""reaction_time":0.25"#) && from_json.contains(r#""seed":7"#));
    assert_eq!(rows(&from_json).1.len(), 4 * 20);

    fs::write(file("a.csv"), &from_json).unwrap();
    assert_eq!(answer(&["run", "--scenario", &file("a.csv")]), from_json);

    let mut child = Command::new(env!("CARGO_BIN_EXE_ringroad"))
        .args(["run", "--scenario", "-", "--seed", "7"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(&fs::read(file("a.json")).unwrap()).unwrap();
    assert_eq!(String::from_utf8(child.wait_with_output().unwrap().stdout).unwrap(), from_json);

    let preset = answer(&["run", "--preset", "stable", "--until", "1"]);
    assert!(preset.contains(r#""reaction_time":0.5"#) && preset.contains("at=0:1:nudge=1"));

    for (name, text, words) in [
        ("b.json", r#"{"vehicles":0}"#, ["b.json", "vehicles", "from 1 to 1000000"]),
        ("c.json", r#"{"cars":5}"#, ["c.json", "cars", "vehicles"]),
        ("d.json", "{", ["d.json", "scenario", "JSON"]),
        ("e.csv", "# a comment\n1,2\n", ["e.csv", "CSV header", "a file of Ringroad"]),
        ("f.txt", "hello\nworld", ["f.txt", "“hello” is not allowed", "JSON or a table of Ringroad"]),
    ] {
        fs::write(file(name), text).unwrap();
        let message = refusal(&["run", "--scenario", &file(name)]);
        assert!(words.iter().all(|w| message.contains(w)), "{message}");
    }
    assert!(refusal(&["run", "--scenario", &file("none.json")]).contains("none.json"));
}

#[test]
fn an_action_after_the_end_is_told_of_and_no_other() {
    let told = |at: &str| {
        let action = format!("at={at}:1:brake=1");
        let output = ringroad(&["run", "--until", "2", "--action", &action]);
        assert_eq!(output.status.code(), Some(0));
        assert!(output.stdout.starts_with(b"# ringroad"));
        String::from_utf8(output.stderr).unwrap()
    };
    assert_eq!(told("2"), "");
    assert_eq!(told("1000"), "note: action at=1000:1:brake=1 is after the end of the run at 2 s\n");
}

#[test]
fn bad_usage_is_refused_by_name() {
    for (arguments, words) in [
        (&["run", "--preset", "jam"][..], &["preset", "“jam”", "phantom-jam"][..]),
        (&["run", "--start", "spiral"], &["start", "spiral", "staggered"]),
        (&["run", "--start", "one-lane=3"], &["start", "one-lane=3", "1 to 1"]),
        (&["run", "--driver", "60:sensitivity=2"], &["60", "1 to 50"]),
        (&["run", "--driver", "sensitivity=2"], &["--driver", "WHO:PARAMETER=VALUE"]),
        (&["run", "--action", "at=1:60:brake=2"], &["60", "1 to 50"]),
        (&["run", "--driver", "1:foo=2"], &["--driver", "driver's parameter: “foo”", "allowed: max-speed, "]),
        (&["run", "--vehicle", "3"], &["table trajectories: --vehicle is not allowed; allowed: --every"]),
        (&["run", "--action", "at=1:1:jump=2"], &["--action", "“jump”", "brake"]),
        (&["run", "--table", "speed"], &["table", "“speed”", "speed-map"]),
        (&["run", "--every", "0"], &["every", "0", "0.001"]),
        (&["run", "--every", "0.001"], &["every", "0.001", "one step, 0.01 s"]),
        (&["run", "--table", "speeds", "--vehicle", "51"], &["vehicles", "51", "at most 50"]),
        (&["run", "--table", "speed-map", "--lane", "2"], &["lane", "2", "at most 1"]),
        (&["run", "--table", "flow", "--at", "1000"], &["at", "1000", "less than 1000 m"]),
        (&["run", "--vehicles", "200"], &["vehicles", "200", "5 m"]),
        (&["run", "--vehicles", "3", "--lanes", "4"], &["lanes", "4", "more lanes than vehicles"]),
        (&["run", "--min-headway", "4"], &["min-headway", "4 m", "vehicle length"]),
        (&["run", "--vehicles", "100000", "--length", "1e7", "--until", "1e6"], &["rows", "GiB", "--every"]),
        (&["run", "--preset", "stable", "--scenario", "x.json"], &["--preset", "--scenario"]),
        (&["run", "--json", "--table", "lanes"], &["--json", "--table"]),
        (&["run", "--speed", "3"], &["--speed"]),
        (&["drive"], &["drive"]),
        (&[], &["Usage"]),
    ] {
        let message = refusal(arguments);
        for word in words {
            assert!(message.contains(word), "{arguments:?}: {message} lacks {word}");
        }
    }
}

#[test]
fn a_file_is_replaced_when_the_new_one_is_whole_and_only_then() {
    let folder = folder("out");
    let out = folder.join("run.csv");
    let name = out.to_str().unwrap();
    let listing = || fs::read_dir(&folder).unwrap().count();
    assert_eq!(answer(&["run", "--until", "3", "--out", name]), "");
    let first = fs::read_to_string(&out).unwrap();
    assert_eq!(first, answer(&["run", "--until", "3"]));

    // Refused: the old file stays, and nothing lies beside it.
    refusal(&["run", "--vehicles", "0", "--out", name]);
    refusal(&["run", "--table", "speeds", "--vehicle", "99", "--out", name]);
    assert_eq!(fs::read_to_string(&out).unwrap(), first);
    assert_eq!(listing(), 1);

    answer(&["run", "--until", "4", "--json", "--out", name]);
    let summary: Value = serde_json::from_str(&fs::read_to_string(&out).unwrap()).unwrap();
    assert_eq!(summary["time"], 4.0);
    assert_eq!(listing(), 1);

    for bad in [folder.join("none").join("run.csv"), folder.clone()] {
        let message = refusal(&["run", "--until", "1", "--out", bad.to_str().unwrap()]);
        assert!(message.contains("--out"), "{message}");
    }
    assert_eq!(listing(), 1);
}

#[cfg(unix)]
#[test]
fn a_link_is_followed_and_a_device_is_not_replaced() {
    use std::os::unix::fs::{FileTypeExt, symlink};
    let folder = folder("links");
    fs::write(folder.join("real.csv"), "old").unwrap();
    symlink("real.csv", folder.join("link.csv")).unwrap();
    answer(&["run", "--until", "1", "--out", folder.join("link.csv").to_str().unwrap()]);
    assert!(fs::symlink_metadata(folder.join("link.csv")).unwrap().is_symlink());
    assert!(fs::read_to_string(folder.join("real.csv")).unwrap().starts_with("# ringroad"));
    answer(&["run", "--until", "1", "--out", "/dev/null"]);
    assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());
}

#[test]
fn a_replay_agrees_or_says_where_it_differs() {
    let folder = folder("replay");
    let file = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    let cases: [&[&str]; 5] = [
        &["--preset", "phantom-jam", "--every", "10"],
        &["--preset", "load-balance", "--table", "events", "--until", "60"],
        &["--preset", "mixed-traffic", "--table", "flow-map", "--every", "5", "--until", "60"],
        &["--preset", "stable", "--table", "growth", "--until", "60"],
        &["--until", "50", "--action", "at=30:all:reaction-time=0.75", "--action", "at=40:7:brake=3"],
    ];
    for (k, case) in cases.iter().enumerate() {
        let name = file(&format!("{k}.csv"));
        assert!(ringroad(&[&["run", "--out", &name], *case].concat()).status.success());
        assert!(answer(&["replay", &name]).contains("every byte agrees"));
    }

    let replay = |name: &str, text: &str| {
        fs::write(file(name), text).unwrap();
        let output = ringroad(&["replay", &file(name)]);
        (output.status.code(), String::from_utf8(output.stdout).unwrap())
    };
    let csv = fs::read_to_string(file("4.csv")).unwrap();
    // One digit, a row missing, a row too many, another seed of no effect on the rows, a header without its rows.
    let number = csv.lines().nth(600).unwrap();
    let tampered = csv.replace(number, &format!("{number}1"));
    let (code, words) = replay("digit.csv", &tampered);
    assert_eq!(code, Some(1));
    assert!(words.contains("differs from line 601 on") && words.contains(number), "{words}");
    let without_last = csv.trim_end().rsplit_once('\n').unwrap().0.to_owned() + "\n";
    let (code, words) = replay("short.csv", &without_last);
    assert_eq!(code, Some(1));
    assert!(words.contains("on: the file has ended, “") && words.contains("” in the simulation."), "{words}");
    let (code, words) = replay("long.csv", &format!("{csv}1,2,3\n"));
    assert_eq!(code, Some(1));
    assert!(words.contains("on: “1,2,3” in the file, the simulation has ended."), "{words}");
    let (code, words) = replay("unended.csv", csv.trim_end());
    assert_eq!(code, Some(1));
    assert!(words.contains("on: how the line “"), "{words}");
    assert_eq!(replay("units.csv", &csv.replace("headway, from centre", "headway, from front")).0, Some(1));

    let version = format!("# ringroad {}", env!("CARGO_PKG_VERSION"));
    let (code, words) = replay("other.csv", &csv.replace(&version, "# ringroad 99.0.0"));
    assert_eq!(code, Some(1));
    assert!(
        words.contains("99.0.0") && words.contains(env!("CARGO_PKG_VERSION")) && !words.contains("differs"),
        "{words}"
    );

    let broken = format!("{version}\n# scenario {{\n");
    for (name, text) in [("plain.csv", "a,b\n1,2\n"), ("broken.csv", &broken)] {
        fs::write(file(name), text).unwrap();
        let message = refusal(&["replay", &file(name)]);
        assert!(message.contains(name) && message.contains("CSV header"), "{message}");
    }
    assert!(refusal(&["replay", &file("none.csv")]).contains("none.csv"));
    // Tables of Ringroad that are not of one run say what they are.
    let batch = file("batch.csv");
    answer(&["batch", "--until", "5", "--vary", "reaction-time=0:0.2:0.1", "--out", &batch]);
    let message = refusal(&["replay", &batch]);
    assert!(
        message.contains("the table of a batch") && message.contains("`ringroad batch --plan`"),
        "{message}"
    );
}

#[test]
fn presets_are_listed() {
    let text = answer(&["presets"]);
    let json: Value = serde_json::from_str(&answer(&["presets", "--json"])).unwrap();
    let names: Vec<_> = json.as_array().unwrap().iter().map(|p| p["name"].as_str().unwrap()).collect();
    let expected = [
        "instant",
        "stable",
        "marginal",
        "phantom-jam",
        "load-balance",
        "aggressive",
        "three-lanes",
        "mixed-traffic",
    ];
    assert_eq!(names, expected);
    assert!(names.iter().all(|name| text.contains(name)));
    assert!(text.contains("20 hours"));
    assert_eq!(json[3]["scenario"]["driver"]["reaction_time"], 0.75);
}

#[test]
fn the_version_names_the_commit_where_there_is_one() {
    let text = answer(&["--version"]);
    assert!(text.starts_with(&format!("ringroad {}", env!("CARGO_PKG_VERSION"))), "{text}");
    let git =
        Command::new("git").args(["rev-parse", "HEAD"]).current_dir(env!("CARGO_MANIFEST_DIR")).output();
    if let Some(head) = git.ok().filter(|o| o.status.success()) {
        let head = String::from_utf8(head.stdout).unwrap();
        if let Some((_, commit)) = text.split_once("(commit ") {
            assert!(head.starts_with(commit.trim_end().trim_end_matches(')')), "{text} is not of {head}");
        }
    }
}

#[test]
fn a_reader_who_leaves_ends_it_quietly() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_ringroad"))
        .args(["run", "--until", "300"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut start = [0; 10];
    let mut stdout = child.stdout.take().unwrap();
    stdout.read_exact(&mut start).unwrap();
    assert_eq!(&start, b"# ringroad");
    drop(stdout);
    let mut message = String::new();
    child.stderr.take().unwrap().read_to_string(&mut message).unwrap();
    assert_eq!((child.wait().unwrap().code(), message.as_str()), (Some(0), ""));
}

#[test]
fn a_pipe_shows_no_progress_bar() {
    let output = ringroad(&["run", "--preset", "stable", "--every", "100"]);
    assert!(output.status.success() && output.stderr.is_empty());
}
