//! `ringroad replay`: repeats the run that made a CSV file, and compares every byte.

use super::options::read;
use super::output::Output;
use super::run::tabulate;
use super::{Failure, Subcommand};
use clap::{Arg, ArgMatches, Command};
use ringroad::measurement::provenance::{Provenance, VERSION, run_to_csv};
use std::process::ExitCode;

/// `ringroad replay`.
pub(crate) const SUBCOMMAND: Subcommand = Subcommand { define, run };

fn define() -> Command {
    Command::new("replay")
        .about("Simulate a CSV file of Ringroad again and say whether every byte agrees")
        .after_help("Exit status: 0 if every byte agrees, 1 if not, 2 if the file cannot be read.")
        .arg(
            Arg::new("file")
                .value_name("FILE.csv")
                .required(true)
                .help("The file; - reads the standard input"),
        )
}

fn run(matches: &ArgMatches) -> Result<ExitCode, Failure> {
    let file = matches.get_one::<String>("file").expect("required");
    let text = read(file)?;
    let version = Provenance::version_of(&text).map_err(|e| e.within(file))?;
    if version != VERSION {
        let message = format!(
            "{file}: written by Ringroad {version}, and this is {VERSION}. A run repeats to the last bit within one \
             version only; nothing is wrong with the file as far as can be told here.\n"
        );
        Output::Standard.write(&message)?;
        return Ok(ExitCode::FAILURE);
    }
    let Provenance { scenario, measurement, .. } = Provenance::from_csv(&text).map_err(|e| e.within(file))?;
    let again = run_to_csv(&tabulate(&scenario, &measurement)?.0, &scenario, &measurement);
    if again == text {
        Output::Standard.write(&format!("{file}: every byte agrees.\n"))?;
        return Ok(ExitCode::SUCCESS);
    }
    Output::Standard.write(&format!("{file}: {}\n", first_difference(&text, &again)))?;
    Ok(ExitCode::FAILURE)
}

fn first_difference(given: &str, again: &str) -> String {
    let mut given = given.split_inclusive('\n');
    let mut again = again.split_inclusive('\n');
    for line in 1.. {
        let plain = |text: &str| text.trim_end_matches(['\r', '\n']).chars().take(200).collect::<String>();
        let (a, b) = (given.next(), again.next());
        let how = match (a, b) {
            (Some(a), Some(b)) if a == b => continue,
            (Some(a), Some(b)) if plain(a) == plain(b) => format!("how the line “{}” ends", plain(a)),
            (Some(a), Some(b)) => format!("“{}” in the file, “{}” in the simulation", plain(a), plain(b)),
            (None, Some(b)) => format!("the file has ended, “{}” in the simulation", plain(b)),
            (Some(a), None) => format!("“{}” in the file, the simulation has ended", plain(a)),
            (None, None) => break,
        };
        return format!("differs from line {line} on: {how}.");
    }
    "differs.".to_owned()
}
