//! The command line. Each subcommand is a file here and a line in [`SUBCOMMANDS`].
//!
//! Exit status: 0 for a result (a collision is one), 1 where a replay differs, 2 where there is no result: bad
//! usage or a file that cannot be read or written, with a message on the standard error stream.

mod batch;
mod options;
mod output;
mod parameters;
mod presets;
mod progress;
mod replay;
mod reproduce;
mod run;
mod stability;
mod summary;

use clap::ArgMatches;
use ringroad::error::Error;
use std::fmt;
use std::io;
use std::process::ExitCode;

/// One subcommand: its options, and what it does.
pub(crate) struct Subcommand {
    /// Name, help and options.
    pub(crate) define: fn() -> clap::Command,
    /// Does it.
    pub(crate) run: fn(&ArgMatches) -> Result<ExitCode, Failure>,
}

/// Every subcommand, in the order in which the help shows them.
const SUBCOMMANDS: &[Subcommand] = &[
    run::SUBCOMMAND,
    batch::SUBCOMMAND,
    stability::SUBCOMMAND,
    reproduce::SUBCOMMAND,
    presets::SUBCOMMAND,
    parameters::SUBCOMMAND,
    replay::SUBCOMMAND,
];

/// Why there is no result.
#[derive(Debug)]
pub(crate) enum Failure {
    /// An input that is not allowed.
    Error(Error),
    /// A file that cannot be read or written.
    File {
        /// The file, as it was named.
        name: String,
        /// What the system says.
        error: io::Error,
    },
    /// The program that reads the standard output has closed it: no message is written.
    ReaderGone,
}

impl From<Error> for Failure {
    fn from(invalid: Error) -> Self {
        Self::Error(invalid)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Error(invalid) => write!(f, "{invalid}"),
            Self::File { name, error } => write!(f, "{name}: {error}"),
            Self::ReaderGone => write!(f, "the reader of the output has gone"),
        }
    }
}

fn version() -> &'static str {
    const COMMIT: &str = env!("RINGROAD_COMMIT");
    if COMMIT.is_empty() {
        env!("CARGO_PKG_VERSION")
    } else {
        concat!(env!("CARGO_PKG_VERSION"), " (commit ", env!("RINGROAD_COMMIT"), ")")
    }
}

/// Reads the arguments and runs the subcommand.
pub(crate) fn main() -> ExitCode {
    let mut command = clap::Command::new("ringroad")
        .version(version())
        .about("A traffic-instability laboratory: delayed car following on a ring road")
        .after_help("Example: ringroad run --preset phantom-jam --every 1 --out jam.csv")
        .arg_required_else_help(true)
        .subcommand_required(true);
    for subcommand in SUBCOMMANDS {
        command = command.subcommand((subcommand.define)());
    }
    let matches = command.get_matches();
    let (name, arguments) = matches.subcommand().expect("clap requires one");
    let subcommand =
        SUBCOMMANDS.iter().find(|s| (s.define)().get_name() == name).expect("clap knows no other");
    match (subcommand.run)(arguments) {
        Ok(code) => code,
        Err(Failure::ReaderGone) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::from(2)
        }
    }
}
