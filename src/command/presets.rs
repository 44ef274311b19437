//! `ringroad presets`: scenarios with names.

use super::output::Output;
use super::{Failure, Subcommand};
use clap::{Arg, ArgAction, ArgMatches, Command};
use ringroad::scenario::presets::presets;
use std::fmt::Write as _;
use std::process::ExitCode;

/// `ringroad presets`.
pub(crate) const SUBCOMMAND: Subcommand = Subcommand { define, run };

fn define() -> Command {
    Command::new("presets")
        .about("List the presets: what to notice and what to try next")
        .arg(Arg::new("json").long("json").action(ArgAction::SetTrue).help("As JSON, with the scenarios"))
}

fn run(matches: &ArgMatches) -> Result<ExitCode, Failure> {
    let mut text = String::new();
    if matches.get_flag("json") {
        text = serde_json::to_string_pretty(&presets()).expect("plain data") + "\n";
    } else {
        for preset in presets() {
            let _ = writeln!(text, "{:<14}{}", preset.name, preset.title);
            let _ = writeln!(text, "{:<14}Notice: {}", "", preset.notice);
            let _ = writeln!(text, "{:<14}Try: {}\n", "", preset.next);
        }
    }
    Output::Standard.write(&text)?;
    Ok(ExitCode::SUCCESS)
}
