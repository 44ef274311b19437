//! The options that make a scenario, the same for every subcommand that takes one. They are made from the table of
//! parameters.

use super::Failure;
use clap::{Arg, ArgAction, ArgMatches, Command};
use ringroad::error::Error;
use ringroad::measurement::provenance::scenario_of_file;
use ringroad::scenario::Scenario;
use ringroad::scenario::parameters::PARAMETERS;
use ringroad::scenario::presets::{preset, presets};
use std::fs;
use std::io::{self, Read};

/// Adds them to a command.
pub(crate) fn scenario_options(command: Command) -> Command {
    let names: Vec<_> = presets().iter().map(|p| p.name).collect();
    let mut command = command
        .next_help_heading("Scenario")
        .arg(
            Arg::new("preset")
                .long("preset")
                .value_name("NAME")
                .help(format!("Start from a preset: {}", names.join(", "))),
        )
        .arg(
            Arg::new("scenario")
                .long("scenario")
                .value_name("FILE")
                .conflicts_with("preset")
                .help("Start from a scenario in JSON, or from the one in the header of a CSV file; - reads the standard input"),
        );
    for parameter in &PARAMETERS {
        let unit = if parameter.unit.is_empty() { String::new() } else { format!(" ({})", parameter.unit) };
        let symbol =
            if parameter.symbol.is_empty() { String::new() } else { format!("{}, ", parameter.symbol) };
        command = command.arg(
            Arg::new(parameter.name)
                .long(parameter.hyphenated())
                .value_name("VALUE")
                .allow_negative_numbers(true)
                .help(format!("{symbol}{}{unit} [default: {}]", parameter.meaning, parameter.default)),
        );
    }
    command
        .arg(
            Arg::new("start")
                .long("start")
                .value_name("START")
                .help("Where the vehicles are at t = 0: uniform, one-lane, one-lane=LANE, staggered or random"),
        )
        .arg(
            Arg::new("driver")
                .long("driver")
                .value_name("WHO:PARAMETER=VALUE,…")
                .action(ArgAction::Append)
                .help("Drivers who differ: 12:sensitivity=2, 3-7:reaction-time=0, 10%:sensitivity=2; may be repeated"),
        )
        .arg(
            Arg::new("action")
                .long("action")
                .value_name("at=SECONDS:WHO:EFFECT,…")
                .action(ArgAction::Append)
                .help(
                    "Something that happens on the way: at=30:all:reaction-time=0.75, at=40:7:brake=3, \
                     at=0:1:nudge=1; may be repeated",
                ),
        )
        .next_help_heading(None::<&str>)
}

/// The scenario that the options describe.
pub(crate) fn scenario(matches: &ArgMatches) -> Result<Scenario, Failure> {
    let scenario = unchecked_scenario(matches)?;
    scenario.validate()?;
    Ok(scenario)
}

/// The same where some of its values are still to be replaced: each value is allowed, combinations may not be.
pub(crate) fn unchecked_scenario(matches: &ArgMatches) -> Result<Scenario, Failure> {
    let text = |name: &str| matches.get_one::<String>(name);
    let mut scenario = match (text("preset"), text("scenario")) {
        (Some(name), _) => preset(name)?.scenario,
        (None, Some(file)) => read_scenario(file)?,
        (None, None) => Scenario::default(),
    };
    for parameter in &PARAMETERS {
        if let Some(text) = text(parameter.name) {
            scenario.set(parameter, parameter.parse(text)?)?;
        }
    }
    if let Some(start) = text("start") {
        scenario.start = start.parse()?;
    }
    for exception in matches.get_many::<String>("driver").into_iter().flatten() {
        scenario.overrides.push(exception.parse().map_err(|e: Error| e.within("--driver"))?);
    }
    for action in matches.get_many::<String>("action").into_iter().flatten() {
        scenario.actions.push(action.parse().map_err(|e: Error| e.within("--action"))?);
    }
    Ok(scenario)
}

/// Says on the standard error stream which actions never happen, the run being over before.
pub(crate) fn tell_of_late_actions(scenario: &Scenario) {
    for action in &scenario.actions {
        if scenario.steps(action.at) > scenario.last_step() {
            eprintln!("note: action {action} is after the end of the run at {} s", scenario.until);
        }
    }
}

/// The text of a file, `-` being the standard input.
pub(crate) fn read(file: &str) -> Result<String, Failure> {
    let mut text = String::new();
    let result = if file == "-" {
        io::stdin().read_to_string(&mut text).map(|_| text)
    } else {
        fs::read_to_string(file)
    };
    result.map_err(|error| Failure::File { name: file.to_owned(), error })
}

fn read_scenario(file: &str) -> Result<Scenario, Failure> {
    Ok(scenario_of_file(&read(file)?).map_err(|e| e.within(file))?.0)
}
