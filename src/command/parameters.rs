//! `ringroad parameters`: the one table of parameters.

use super::output::Output;
use super::{Failure, Subcommand};
use clap::{Arg, ArgAction, ArgMatches, Command};
use ringroad::scenario::parameters::PARAMETERS;
use std::fmt::Write as _;
use std::process::ExitCode;

/// `ringroad parameters`.
pub(crate) const SUBCOMMAND: Subcommand = Subcommand { define, run };

fn define() -> Command {
    Command::new("parameters")
        .about("List the parameters: symbols, units, defaults, ranges, meanings")
        .arg(Arg::new("json").long("json").action(ArgAction::SetTrue).help("As JSON"))
}

fn run(matches: &ArgMatches) -> Result<ExitCode, Failure> {
    let mut text = String::new();
    if matches.get_flag("json") {
        text = serde_json::to_string_pretty(PARAMETERS.as_slice()).expect("plain data") + "\n";
    } else {
        let _ = writeln!(
            text,
            "{:<18}{:<8}{:<6}{:>8}  {:<24}{:<8}meaning",
            "name", "symbol", "unit", "default", "allowed", "of"
        );
        for p in &PARAMETERS {
            let range = p.kind.range();
            let allowed = range.map_or_else(|| p.kind.words(), |r| format!("{} … {}", r.min, r.max));
            let of = if p.is_of_driver() { "driver" } else { "road" };
            let name = p.hyphenated();
            let _ = writeln!(
                text,
                "{name:<18}{:<8}{:<6}{:>8}  {allowed:<24}{of:<8}{}",
                p.symbol, p.unit, p.default, p.meaning
            );
        }
    }
    Output::Standard.write(&text)?;
    Ok(ExitCode::SUCCESS)
}
