//! `ringroad run`: one scenario, one measurement, as CSV; or a summary as JSON.

use super::options::{scenario, scenario_options, tell_of_late_actions};
use super::output::{self, Output};
use super::summary::{Watched, summary};
use super::{Failure, Subcommand, progress};
use clap::{Arg, ArgAction, ArgMatches, Command};
use ringroad::error::Error;
use ringroad::format::table::Table;
use ringroad::measurement::probe::measure;
use ringroad::measurement::provenance::run_to_csv;
use ringroad::measurement::{Measurement, SETTINGS};
use ringroad::scenario::Scenario;
use ringroad::simulation::{Collision, Simulation};
use std::process::ExitCode;

/// `ringroad run`.
pub(crate) const SUBCOMMAND: Subcommand = Subcommand { define, run };

/// The most memory that the rows of a run may take, GiB; writing them takes about three times as much.
const MEMORY: f64 = 4.0;

fn define() -> Command {
    let command = Command::new("run")
        .about("Run a scenario and write a table of what was measured as CSV")
        .after_help("Exit status: 0 for a result, a collision included; 2 for bad usage.")
        .arg(output::option())
        .arg(
            Arg::new("json")
                .long("json")
                .action(ArgAction::SetTrue)
                .conflicts_with("table")
                .help("Write a summary of the run as JSON instead of a table"),
        );
    measurement_options(scenario_options(command), "trajectories")
}

/// `--table` and the settings of the measurements; `default` is the table where none is named.
pub(crate) fn measurement_options(command: Command, default: &str) -> Command {
    let names: Vec<_> = Measurement::all().iter().map(Measurement::name).collect();
    let mut command = command.next_help_heading("Measurement").arg(
        Arg::new("table")
            .long("table")
            .value_name("NAME")
            .help(format!("What to measure: {} [default: {default}]", names.join(", "))),
    );
    for (k, setting) in SETTINGS.iter().enumerate() {
        if SETTINGS[..k].iter().any(|s| s.option == setting.option) {
            continue;
        }
        let tables: Vec<_> = Measurement::all()
            .iter()
            .filter(|m| m.settings().iter().any(|s| s.option == setting.option))
            .map(Measurement::name)
            .collect();
        let unit = if setting.unit.is_empty() { String::new() } else { format!(" ({})", setting.unit) };
        command = command.arg(
            Arg::new(setting.option)
                .long(setting.option)
                .value_name("VALUE")
                .action(ArgAction::Append)
                .allow_negative_numbers(true)
                .help(format!("{}{unit}; for {}", setting.meaning, tables.join(", "))),
        );
    }
    command.next_help_heading(None::<&str>)
}

/// The measurement that the options describe.
pub(crate) fn measurement(matches: &ArgMatches, default: &str) -> Result<Measurement, Failure> {
    let name = matches.get_one::<String>("table").map_or(default, String::as_str);
    let mut given = Vec::new();
    for (k, setting) in SETTINGS.iter().enumerate() {
        let first = !SETTINGS[..k].iter().any(|s| s.option == setting.option);
        if first && let Some(values) = matches.get_many::<String>(setting.option) {
            given.push((setting.option, values.map(String::as_str).collect::<Vec<_>>().join(",")));
        }
    }
    let given = given.iter().map(|(option, text)| (*option, text.as_str()));
    Ok(Measurement::named(name)?.with_options(given)?)
}

/// Runs the scenario to its end and gives the table, and the collision that ended it, with a progress bar on a terminal.
pub(crate) fn tabulate(
    scenario: &Scenario,
    measurement: &Measurement,
) -> Result<(Table, Option<Collision>), Failure> {
    let gib = measurement.bytes(scenario) / (1024.0 * 1024.0 * 1024.0);
    if gib > MEMORY {
        let allowed =
            format!("at most {MEMORY} GiB: measure less often with --every, or fewer vehicles or bins");
        return Err(Error::too_large("rows of the table", format!("{gib:.1} GiB"), allowed).into());
    }
    let mut probes = [measurement.probe(scenario)?];
    let mut simulation = Simulation::new(scenario)?;
    let bar = progress::bar(scenario.last_step());
    measure(&mut simulation, &mut probes, &mut |step| {
        bar.set_position(step);
        true
    });
    bar.finish_and_clear();
    Ok((probes[0].table(), simulation.collision()))
}

fn run(matches: &ArgMatches) -> Result<ExitCode, Failure> {
    let scenario = scenario(matches)?;
    let output = Output::new(matches)?;
    tell_of_late_actions(&scenario);
    if matches.get_flag("json") {
        let mut simulation = Simulation::new(&scenario)?;
        let watched = Watched::new(&simulation);
        let bar = progress::bar(scenario.last_step());
        measure(&mut simulation, &mut [], &mut |step| {
            bar.set_position(step);
            true
        });
        bar.finish_and_clear();
        output.write(&summary(&simulation, &watched))?;
    } else {
        let measurement = measurement(matches, "trajectories")?;
        let (table, collision) = tabulate(&scenario, &measurement)?;
        output.write(&run_to_csv(&table, &scenario, &measurement))?;
        if let Some(Collision { time, behind, ahead, .. }) = collision {
            eprintln!(
                "note: the run ended at {} s: vehicle {} ran into {}",
                (time * 1e6).round() / 1e6,
                behind + 1,
                ahead + 1
            );
        }
    }
    Ok(ExitCode::SUCCESS)
}
