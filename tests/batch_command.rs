//! `ringroad batch` as a process: any number of threads, interruptions and merged shards give the same bytes, and what is not
//! valid is refused with status 2 and a message.
#![cfg(feature = "command")]

use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// Runs that differ in length and outcome; about a second of work.
const SWEEP: [&str; 9] = [
    "--preset",
    "load-balance",
    "--vary",
    "reaction-time=0:1.5:0.5",
    "--vary",
    "vehicles=20,40",
    "--runs",
    "8",
    "--until=300",
];

fn ringroad(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ringroad"));
    command.arg("batch").args(arguments);
    command
}

fn output(arguments: &[&str]) -> Output {
    ringroad(arguments).output().unwrap()
}

/// What the command writes to the standard output.
fn written(arguments: &[&str]) -> String {
    let output = output(arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// The message of a command that is refused.
fn refused(arguments: &[&str]) -> String {
    let output = output(arguments);
    assert_eq!(output.status.code(), Some(2), "{}", String::from_utf8_lossy(&output.stdout));
    assert!(output.stdout.is_empty());
    String::from_utf8(output.stderr).unwrap()
}

/// An empty folder for a test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn with<'a>(arguments: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
    [arguments, more].concat()
}

#[test]
fn the_number_of_threads_does_not_matter() {
    let one = written(&with(&SWEEP, &["--threads", "1"]));
    assert_eq!(one.lines().filter(|l| !l.starts_with('#')).count(), 1 + 64);
    assert!(one.contains("collision") && one.contains(",end,"));
    assert_eq!(written(&with(&SWEEP, &["--threads", "2"])), one);
    assert_eq!(written(&SWEEP), one);
}

#[test]
fn a_killed_batch_is_continued_and_ends_with_the_same_bytes() {
    let folder = folder("killed");
    let expected = written(&SWEEP);
    let out = folder.join("sweep.csv").display().to_string();
    let part = format!("{out}.part");
    let call = with(&SWEEP, &["--out", &out]);
    let lines = || fs::read_to_string(&part).map_or(0, |text| text.matches('\n').count());

    // Killed when the file holds the header and three runs.
    let mut child = ringroad(&call).stderr(Stdio::null()).spawn().unwrap();
    while lines() < 4 {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it could be killed");
        std::thread::yield_now();
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let kept = lines() - 1;
    assert!((3..64).contains(&kept), "{kept}");
    assert!(!Path::new(&out).exists());
    // The last line is cut in the middle.
    let mut file = OpenOptions::new().append(true).open(&part).unwrap();
    file.write_all(b"[63,300.0,fal").unwrap();
    drop(file);

    // Another plan does not continue it, nor does a shard of the plan.
    let other = refused(&with(&call, &["--seed", "5"]));
    assert!(other.contains(&part) && other.contains("seed is 1 and not 5"), "{other}");
    let other = refused(&with(&call, &["--shard", "1/2"]));
    assert!(other.contains("shard 1/1 and not 1/2"), "{other}");
    // Nor does any batch while another process writes the file.
    let lock = File::open(&part).unwrap();
    lock.lock().unwrap();
    let busy = refused(&call);
    assert!(busy.contains("another batch is writing"), "{busy}");
    drop(lock);

    let continued = output(&call);
    assert!(continued.status.success());
    let told = String::from_utf8(continued.stderr).unwrap();
    assert!(told.contains(&format!("{kept} of 64 runs")), "{told}");
    assert_eq!(fs::read_to_string(&out).unwrap(), expected);
    assert!(!Path::new(&part).exists());
    // An incomplete header is written again; a file of another kind is not touched.
    fs::write(&part, "{\"ringroad\":\"").unwrap();
    assert!(output(&call).status.success());
    assert_eq!(fs::read_to_string(&out).unwrap(), expected);
    fs::write(&part, "my notes").unwrap();
    assert!(refused(&call).contains("my notes"));
    assert_eq!(fs::read_to_string(&part).unwrap(), "my notes");
}

#[test]
fn merged_shards_are_the_bytes_of_one_call() {
    for (name, more) in [("shards", &[][..]), ("summary-shards", &["--summary", "--every", "50"])] {
        let folder = folder(name);
        let sweep = with(&SWEEP, more);
        let expected = written(&sweep);
        let files: Vec<_> = (1..=3).map(|k| folder.join(format!("part{k}")).display().to_string()).collect();
        for (k, file) in files.iter().enumerate() {
            written(&with(&sweep, &["--out", file, "--shard", &format!("{}/3", k + 1)]));
        }
        assert_eq!(written(&with(&["--merge"], &[&files[2], &files[0], &files[1]])), expected);
        let missing = refused(&with(&["--merge"], &[&files[0], &files[2]]));
        assert!(missing.contains("run 2 is missing, a run of shard 2/3"), "{missing}");
        let twice = refused(&with(&["--merge"], &[&files[0], &files[1], &files[1], &files[2]]));
        assert!(twice.contains("overlap") && twice.contains(&files[1]), "{twice}");
        let table = folder.join("table.csv").display().to_string();
        fs::write(&table, &expected).unwrap();
        let refusal = refused(&with(&["--merge"], &[&table]));
        assert!(refusal.contains("“# ringroad ") && refusal.contains("finished runs"), "{refusal}");
        assert_eq!(refusal.lines().count(), 1, "{refusal}");
        // The plan of a table or a shard can be repeated.
        assert_eq!(written(&with(&["--plan", &table], &more[..more.len().min(1)])), expected);
        assert_eq!(written(&with(&["--plan", &files[1]], &more[..more.len().min(1)])), expected);
    }
}

#[test]
fn an_action_after_the_end_gives_a_note_unless_the_end_is_varied() {
    let run = ["--until", "2", "--action", "at=3:1:brake=1"];
    let told = |more: &[&str]| String::from_utf8(output(&with(&run, more)).stderr).unwrap();
    assert_eq!(told(&["--runs", "2"]), "note: action at=3:1:brake=1 is after the end of the run at 2 s\n");
    assert_eq!(told(&["--vary", "until=2,4"]), "");
}

#[test]
fn invalid_options_are_refused_before_a_file_is_made() {
    let folder = folder("refused");
    let out = folder.join("table.csv").display().to_string();
    for (arguments, words) in [
        (&["--vary", "vehicles=100,300"][..], &["cell vehicles=300", "199"][..]),
        (&["--vary", "colour=1"], &["“colour”", "reaction-time"]),
        (&["--vary", "reaction-time=0:20:1"], &["reaction-time", "from 0 to 10 s"]),
        (&["--shard", "5/4"], &["“5/4”", "1/4"]),
        (&["--runs", "2000000"], &["2000000", "1000000"]),
        (&["--table", "events", "--summary"], &["“events”"]),
        (&["--plan", "-", "--vary", "lanes=1,2"], &["--vary", "--plan"]),
        (&["--merge", "a", "b", "--runs", "3"], &["--runs", "--merge"]),
        (&["--merge", "there-is-no-such-file"], &["there-is-no-such-file"]),
    ] {
        let message = refused(&with(arguments, &["--out", &out]));
        assert!(words.iter().all(|w| message.contains(w)), "{arguments:?}: {message}");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 0, "{arguments:?}");
    }
}
