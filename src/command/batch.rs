//! `ringroad batch`: many runs with different seeds and varied parameters, in one table.
//!
//! With `--out FILE`, every finished run is appended to `FILE.part` at once; the same call again continues there. The
//! part file is removed when FILE has been written.

use super::options::{read, scenario_options, tell_of_late_actions, unchecked_scenario};
use super::output::{self, Output};
use super::run::{measurement, measurement_options};
use super::{Failure, Subcommand, progress};
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command};
use ringroad::batch::record::{self, Record};
use ringroad::batch::{Header, ParameterValues, Plan, Run, Shard, run_all};
use ringroad::error::Error;
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::Path;
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// `ringroad batch`.
pub(crate) const SUBCOMMAND: Subcommand = Subcommand { define, run };

/// Finished runs are synced to the disk at least this often, so that a power cut loses no more; a crash of the program loses none.
const SYNC: Duration = Duration::from_secs(2);

fn define() -> Command {
    let command = Command::new("batch")
        .about("Run many seeds and combinations of parameters on all cores; one table")
        .after_help(
            "Examples:\n  \
             ringroad batch --preset phantom-jam --vary reaction-time=0:0.8:0.05 --out sweep.csv\n  \
             ringroad batch --preset load-balance --runs 20 --every 1 --summary --out balance.csv\n  \
             ringroad batch --preset load-balance --runs 1000 --shard 3/8 --out part3   (on machine 3 of 8)\n  \
             ringroad batch --merge part1 part2 … part8 --out all.csv\n\n\
             The bytes written depend on neither the number of threads nor on interruptions or shards.",
        )
        .arg(output::option().help(
            "Write to a file instead of the standard output. Finished runs are kept in FILE.part on the way; \
             after an interruption the same call continues there",
        ))
        .next_help_heading("Batch")
        .arg(
            Arg::new("vary")
                .long("vary")
                .value_name("NAME=VALUES")
                .action(ArgAction::Append)
                .help(
                    "Vary a parameter: reaction-time=0:0.8:0.05 (from:to:by), lanes=1,2,4; may be repeated, \
                     for all combinations",
                ),
        )
        .arg(
            Arg::new("runs")
                .long("runs")
                .value_name("COUNT")
                .value_parser(clap::value_parser!(u64))
                .help("Runs of every combination; run k = 0, 1, … has the seed --seed + k [default: 1]"),
        )
        .arg(
            Arg::new("summary")
                .long("summary")
                .action(ArgAction::SetTrue)
                .help(
                    "Mean, standard deviation, quantiles and a 95 % confidence interval of every combination \
                     instead of every run",
                ),
        )
        .arg(
            Arg::new("plan")
                .long("plan")
                .value_name("FILE")
                .help("Repeat the plan in the header of a batch's CSV or shard, or in JSON; - reads the standard input"),
        )
        .arg(
            Arg::new("shard")
                .long("shard")
                .value_name("i/n")
                .help("Only every n-th run, from the i-th on; writes a file for --merge"),
        )
        .arg(
            Arg::new("merge")
                .long("merge")
                .value_name("FILE")
                .num_args(1..)
                .help("Put the files of all shards together, to the table that one call would have written"),
        )
        .arg(
            Arg::new("threads")
                .long("threads")
                .value_name("COUNT")
                .value_parser(clap::value_parser!(u16).range(1..=1024))
                .help("Number of threads [default: one for each core]"),
        )
        .next_help_heading(None::<&str>);
    measurement_options(scenario_options(command), "outcome, or overview with --every")
}

fn run(matches: &ArgMatches) -> Result<ExitCode, Failure> {
    let output = Output::new(matches)?;
    let summary = matches.get_flag("summary");
    if let Some(files) = matches.get_many::<String>("merge") {
        stands_alone(matches, "merge", &["merge", "summary", "out"])?;
        let one = |file: &String| {
            let record = Record::read(&read(file)?).map_err(|e| e.within(file))?;
            Ok((file.clone(), record))
        };
        let (header, runs) = record::merge(files.map(one).collect::<Result<_, Failure>>()?)?;
        output.write(&csv(&header.plan, &runs, header.summary || summary)?)?;
        return Ok(ExitCode::SUCCESS);
    }
    let plan = plan(matches)?;
    if summary {
        plan.check_summary()?;
    }
    let shard = matches.get_one::<String>("shard").map(|text| text.parse::<Shard>()).transpose()?;
    let header = Header::new(plan, shard.unwrap_or_default(), summary);
    let mut part = match &output {
        Output::File(name) if !Path::new(name).exists() || Path::new(name).is_file() => {
            Some(Part::open(format!("{name}.part"), &header)?)
        }
        _ => None,
    };
    let threads = matches.get_one::<u16>("threads").map(|&n| usize::from(n));
    let runs = compute(&header, part.as_mut(), threads)?;
    if shard.is_some() {
        output.write(&record::write(&header, &runs))?;
    } else {
        output.write(&csv(&header.plan, &runs, summary)?)?;
    }
    if let Some(part) = part {
        part.remove()?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Refuses options for what the file of another option already determines.
fn stands_alone(matches: &ArgMatches, option: &str, beside: &[&str]) -> Result<(), Error> {
    let given = |id: &&str| matches.value_source(id) == Some(ValueSource::CommandLine);
    match matches.ids().map(clap::Id::as_str).filter(given).find(|id| !beside.contains(id)) {
        Some(other) => {
            let allowed = format!("only {} beside --{option}", listed(&beside[1..]));
            Err(Error::conflict(format!("--{}", other.replace('_', "-")), "an option", allowed))
        }
        None => Ok(()),
    }
}

fn listed(options: &[&str]) -> String {
    options.iter().map(|o| format!("--{o}")).collect::<Vec<_>>().join(", ")
}

/// The plan that the options describe.
fn plan(matches: &ArgMatches) -> Result<Plan, Failure> {
    if let Some(file) = matches.get_one::<String>("plan") {
        stands_alone(matches, "plan", &["plan", "summary", "shard", "threads", "out"])?;
        let text = read(file)?;
        let plan = if text.starts_with('#') {
            Plan::from_csv(&text)
        } else if Record::is_record(&text) {
            Record::read(&text).map(|record| record.header.plan)
        } else {
            Plan::from_json(&text)
        };
        return Ok(plan.map_err(|e| e.within(file))?);
    }
    let table = if matches.contains_id("every") { "overview" } else { "outcome" };
    let vary = matches.get_many::<String>("vary").into_iter().flatten();
    let vary: Vec<ParameterValues> = vary.map(|text| text.parse()).collect::<Result<_, _>>()?;
    let runs = matches.get_one("runs").copied().unwrap_or(1);
    let scenario = unchecked_scenario(matches)?;
    let plan = Plan::new(scenario.clone(), vary, runs, measurement(matches, table)?)?;
    // Where ends or steps are varied, what is late in one run may not be in another.
    if !plan.vary().iter().any(|v| ["until", "time_step"].contains(&v.parameter().name)) {
        tell_of_late_actions(&scenario);
    }
    Ok(plan)
}

fn csv(plan: &Plan, runs: &BTreeMap<u64, Run>, summary: bool) -> Result<String, Error> {
    let table = if summary { plan.summary(runs)? } else { plan.table(runs) };
    Ok(plan.to_csv(&table))
}

/// Computes the runs that are not in the part file yet.
fn compute(
    header: &Header,
    mut part: Option<&mut Part>,
    threads: Option<usize>,
) -> Result<BTreeMap<u64, Run>, Failure> {
    let plan = &header.plan;
    let mut runs = part.as_mut().map(|part| std::mem::take(&mut part.runs)).unwrap_or_default();
    let all: Vec<u64> = header.shard.numbers(plan).collect();
    let (done, open): (Vec<u64>, Vec<u64>) = all.iter().partition(|n| runs.contains_key(n));
    let work = |numbers: &[u64]| numbers.iter().map(|&n| plan.work(n)).fold(0, u64::saturating_add);
    let bar = progress::bar(work(&all));
    bar.set_position(work(&done));
    bar.reset_eta();
    if let Some(part) = part.as_ref().filter(|_| !done.is_empty()) {
        eprintln!("{} of {} runs are in {} already", done.len(), all.len(), part.name);
    }
    let progress = |work| {
        bar.inc(work);
        true
    };
    run_all(plan, &open, threads, &progress, &mut |run: Run| {
        if let Some(part) = &mut part {
            part.append(&run)?;
        }
        runs.insert(run.number, run);
        Ok::<(), Failure>(())
    })?;
    bar.finish_and_clear();
    Ok(runs)
}

/// The file of finished runs next to the final file, which is written when all are finished.
struct Part {
    name: String,
    file: File,
    /// The runs that were in it.
    runs: BTreeMap<u64, Run>,
    synced: Instant,
}

impl Part {
    /// Opens the file, or creates it with its header. Runs of another plan and a file in use are refused; an incomplete last
    /// line is cut off.
    fn open(name: String, header: &Header) -> Result<Self, Failure> {
        let failed = |error| Failure::File { name: name.clone(), error };
        let mut file = OpenOptions::new().read(true).append(true).create(true).open(&name).map_err(failed)?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let allowed = "one batch at a time, or another --out";
                return Err(Error::conflict(
                    "--out",
                    format!("{name}, which another batch is writing,"),
                    allowed,
                )
                .into());
            }
            // A file system without locks.
            Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => {}
            Err(TryLockError::Error(error)) => return Err(failed(error)),
        }
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(failed)?;
        let whole = bytes.iter().rposition(|&b| b == b'\n').map_or(0, |last| last + 1);
        // Without a complete line the header itself was not written completely.
        let (runs, text) = if whole == 0 && header.line().as_bytes().starts_with(&bytes) {
            (BTreeMap::new(), header.line())
        } else {
            let text = String::from_utf8_lossy(if whole == 0 { &bytes } else { &bytes[..whole] });
            let record = Record::read(&text).and_then(|record| {
                record.check(&header.plan, header.shard)?;
                Ok(record)
            });
            let advice = |e: Error| e.with_advice("; or remove the file to start afresh").within(&name);
            (record.map_err(advice)?.runs, String::new())
        };
        file.set_len(whole as u64).and_then(|()| file.write_all(text.as_bytes())).map_err(failed)?;
        Ok(Self { name, file, runs, synced: Instant::now() })
    }

    /// Adds a finished run, in one write.
    fn append(&mut self, run: &Run) -> Result<(), Failure> {
        let mut written = self.file.write_all(record::line(run).as_bytes());
        if self.synced.elapsed() > SYNC {
            written = written.and_then(|()| self.file.sync_data());
            self.synced = Instant::now();
        }
        written.map_err(|error| Failure::File { name: self.name.clone(), error })
    }

    /// Removes the part file, after the final file has been written.
    fn remove(self) -> Result<(), Failure> {
        std::fs::remove_file(&self.name).map_err(|error| Failure::File { name: self.name.clone(), error })
    }
}
