//! `ringroad reproduce`: the paper's figures and its claims beside what is measured.

use super::output::Output;
use super::{Failure, Subcommand, progress};
use clap::{Arg, ArgAction, ArgMatches, Command};
use ringroad::reproduction::claim::{Claim, to_markdown, to_text};
use ringroad::reproduction::{FIGURES, Figure, Outcome, Size};
use std::fs;
use std::path::Path;
use std::process::ExitCode;

/// `ringroad reproduce`.
pub(crate) const SUBCOMMAND: Subcommand = Subcommand { define, run };

fn define() -> Command {
    let flag = |name, help| Arg::new(name).long(name).action(ArgAction::SetTrue).help(help);
    let ids: Vec<_> = FIGURES.iter().map(|f| f.id).collect();
    Command::new("reproduce")
        .about("Make the figures of the paper, and hold each of its claims against what is measured")
        .after_help(
            "A claim differs or agrees by what is computed; a difference is a result, and the exit status stays 0.",
        )
        .arg(
            Arg::new("figure")
                .value_name("FIGURE")
                .action(ArgAction::Append)
                .help(format!("Which: all, or some of {}; by default all", ids.join(", "))),
        )
        .arg(
            Arg::new("out")
                .long("out")
                .value_name("DIR")
                .help("Write each table as CSV, each picture as SVG, and claims.json into this folder"),
        )
        .arg(flag("json", "Write the claims as JSON instead of text").conflicts_with("markdown"))
        .arg(flag("markdown", "Write the claims as a table in Markdown instead of text"))
        .arg(flag("small", "Fewer and shorter runs, for a first look: claims about numbers of runs do not hold"))
}

fn run(matches: &ArgMatches) -> Result<ExitCode, Failure> {
    let figures = figures(matches)?;
    let folder = matches.get_one::<String>("out");
    if let Some(name) = folder {
        fs::create_dir_all(name).map_err(|error| Failure::File { name: name.clone(), error })?;
    }
    let size = if matches.get_flag("small") { Size::Small } else { Size::Full };
    let bar = progress::bar(figures.iter().map(|f| f.tasks(size).len() as u64).sum());
    let mut claims: Vec<Claim> = Vec::new();
    for figure in figures {
        let outcome = figure.outcome(size, &|| bar.inc(1));
        if let Some(folder) = folder {
            write(Path::new(folder), figure, &outcome)?;
        }
        claims.extend(outcome.claims);
    }
    bar.finish_and_clear();
    let json = || serde_json::to_string_pretty(&claims).expect("plain data") + "\n";
    if let Some(folder) = folder {
        write_file(&Path::new(folder).join("claims.json"), &json())?;
    }
    Output::Standard.write(&if matches.get_flag("json") {
        json()
    } else if matches.get_flag("markdown") {
        to_markdown(&claims)
    } else {
        to_text(&claims)
    })?;
    Ok(ExitCode::SUCCESS)
}

/// Those named, each once, in the order of the paper.
fn figures(matches: &ArgMatches) -> Result<Vec<&'static Figure>, Failure> {
    let names: Vec<&str> =
        matches.get_many::<String>("figure").into_iter().flatten().map(String::as_str).collect();
    let all = names.is_empty() || names.contains(&"all");
    for name in names.iter().filter(|name| **name != "all") {
        Figure::named(name)?;
    }
    Ok(FIGURES.iter().filter(|f| all || names.contains(&f.id)).collect())
}

fn write(folder: &Path, figure: &Figure, outcome: &Outcome) -> Result<(), Failure> {
    for table in &outcome.tables {
        write_file(&folder.join(format!("{}.csv", table.name)), &table.to_csv())?;
    }
    write_file(&folder.join(format!("{}.svg", figure.id)), &outcome.plot.to_svg())
}

fn write_file(path: &Path, text: &str) -> Result<(), Failure> {
    Output::File(path.to_string_lossy().into_owned()).write(text)
}
