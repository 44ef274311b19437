//! `ringroad stability`: what linear theory says of a scenario, without running it.

use super::options::{scenario, scenario_options};
use super::output::{self, Output};
use super::{Failure, Subcommand};
use clap::{Arg, ArgAction, ArgMatches, Command};
use ringroad::error::Error;
use ringroad::measurement::provenance::theory_to_csv;
use ringroad::scenario::Scenario;
use ringroad::scenario::parameter_values::ParameterValues;
use ringroad::stability::discrete_roots::DiscreteRoot;
use ringroad::stability::homogeneous::Time;
use ringroad::stability::jacobian::{self, JacobianEigenvalue, numerical_eigenvalues};
use ringroad::stability::lane::lanes_of;
use ringroad::stability::report::Report;
use ringroad::stability::roots::{ModeRoot, leading_factors, leading_roots};
use ringroad::stability::stabilizing_drivers::{StabilizingDrivers, parse_changes, stabilizing_drivers};
use ringroad::stability::stable_ranges::{
    first_jammed, most_vehicles, stable_sensitivities, stable_vehicles,
};
use ringroad::stability::sweep::sweep;
use serde::Serialize;
use std::fmt::Write as _;
use std::process::ExitCode;

/// `ringroad stability`.
pub(crate) const SUBCOMMAND: Subcommand = Subcommand { define, run };

fn define() -> Command {
    let command =
        Command::new("stability")
            .about("Linear stability of a scenario: critical reaction time, growth rates, the fastest wave")
            .after_help(
                "Examples: ringroad stability --reaction-time 0.75 --calm-with reaction-time=0\n          \
             ringroad stability --sweep vehicles=2:133 --out tau.csv",
            )
            .arg(output::option())
            .arg(Arg::new("json").long("json").action(ArgAction::SetTrue).help("As JSON"))
            .arg(
                Arg::new("sweep")
                    .long("sweep")
                    .value_name("PARAMETER=FROM:TO[:STEP]")
                    .conflicts_with_all(["json", "roots", "calm-with"])
                    .help("A table over the values of a parameter as CSV, such as vehicles=2:133"),
            )
            .arg(Arg::new("roots").long("roots").value_name("K").help(
                "Add the K leading characteristic roots of every mode, in continuous time and in steps",
            ))
            .arg(
                Arg::new("eigenvalues")
                    .long("eigenvalues")
                    .action(ArgAction::SetTrue)
                    .conflicts_with("sweep")
                    .help(
                        "Numerical eigenvalues of the Jacobian of the least stable lane beside theory, as CSV, or in the JSON; \
                         up to 200 vehicles",
                    ),
            )
            .arg(
                Arg::new("calm-with")
                    .long("calm-with")
                    .value_name("PARAMETER=VALUE,…")
                    .help("How many drivers, so changed, calm the ring? Such as reaction-time=0"),
            );
    scenario_options(command)
}

/// Everything that was asked for; the fields are keys of the JSON.
#[derive(Serialize)]
struct Answer {
    #[serde(flatten)]
    report: Report,
    /// Numbers of vehicles in one lane of default drivers, intervals with both ends.
    stable_vehicles: Vec<(usize, usize)>,
    /// Sensitivities of homogeneous drivers that have the other parameters of the default one, as many as in the lane of the
    /// report; 1/s.
    stable_sensitivities_per_s: Vec<(f64, f64)>,
    #[serde(flatten)]
    stabilizing: Option<StabilizingDrivers>,
    #[serde(skip_serializing_if = "Option::is_none")]
    roots: Option<Vec<ModeRoot>>,
    /// The same of the simulation, with the growth factors z of a step.
    #[serde(skip_serializing_if = "Option::is_none")]
    roots_discrete: Option<Vec<DiscreteRoot>>,
    /// Numerical eigenvalues of the Jacobian.
    #[serde(skip_serializing_if = "Option::is_none")]
    eigenvalues: Option<Vec<JacobianEigenvalue>>,
}

/// The numerical eigenvalues of the Jacobian of the least stable lane.
fn eigenvalues(scenario: &Scenario, lane: usize) -> Result<Vec<JacobianEigenvalue>, Error> {
    let drivers = lanes_of(scenario).swap_remove(lane - 1).drivers;
    numerical_eigenvalues(&drivers, scenario.length).map_err(|e| e.within("--eigenvalues"))
}

fn answer(
    scenario: &Scenario,
    changes: Option<&String>,
    roots: Option<usize>,
    with_eigenvalues: bool,
) -> Result<Answer, Failure> {
    let report = Report::of(scenario);
    let stabilizing = match changes {
        Some(text) => Some(stabilizing_drivers(scenario, &parse_changes(text)?)?),
        None => None,
    };
    let driver = &scenario.driver;
    let delay = scenario.steps(driver.reaction_time) as f64 * scenario.time_step;
    let time = Time::Steps(scenario.time_step);
    let most = most_vehicles(driver, scenario.length);
    Ok(Answer {
        stable_vehicles: stable_vehicles(driver, scenario.length, delay, time, most),
        stable_sensitivities_per_s: stable_sensitivities(
            driver,
            report.vehicles,
            scenario.length,
            delay,
            time,
        ),
        stabilizing,
        roots: roots.map(|count| leading_roots(scenario, report.lane - 1, count)),
        roots_discrete: roots.map(|count| leading_factors(scenario, report.lane - 1, count)),
        eigenvalues: with_eigenvalues.then(|| eigenvalues(scenario, report.lane)).transpose()?,
        report,
    })
}

fn run(matches: &ArgMatches) -> Result<ExitCode, Failure> {
    let scenario = scenario(matches)?;
    let output = Output::new(matches)?;
    if let Some(text) = matches.get_one::<String>("sweep") {
        let asked = ParameterValues::sweep(text).map_err(|e| e.within("--sweep"))?;
        let table = sweep(&scenario, &asked)?;
        output.write(&theory_to_csv(&table, &scenario, &format!("stability --sweep {text}")))?;
        return Ok(ExitCode::SUCCESS);
    }
    let json = matches.get_flag("json");
    let with_eigenvalues = matches.get_flag("eigenvalues");
    if with_eigenvalues && !json {
        if let Some(other) = ["roots", "calm-with"].into_iter().find(|&name| matches.contains_id(name)) {
            let allowed = "a table by itself, or --json for one answer with everything";
            return Err(Error::conflict("--eigenvalues", format!("with --{other}"), allowed).into());
        }
        let table = jacobian::table(&eigenvalues(&scenario, Report::of(&scenario).lane)?);
        output.write(&theory_to_csv(&table, &scenario, "stability --eigenvalues"))?;
        return Ok(ExitCode::SUCCESS);
    }
    let roots = match matches.get_one::<String>("roots") {
        None => None,
        Some(text) => Some(text.parse().ok().filter(|k| (1..=100).contains(k)).ok_or_else(|| {
            Error::malformed("--roots", format!("“{text}”"), "a whole number from 1 to 100")
        })?),
    };
    let answer = answer(&scenario, matches.get_one("calm-with"), roots, with_eigenvalues)?;
    let text = if json {
        serde_json::to_string_pretty(&answer).expect("plain data") + "\n"
    } else {
        in_words(&scenario, &answer)
    };
    output.write(&text)?;
    Ok(ExitCode::SUCCESS)
}

/// Adds a line: a name, and what belongs to it.
fn line(text: &mut String, name: &str, value: &str) {
    let _ = writeln!(text, "{name:<34}{value}");
}

/// A rate with its sign, in a form that shows digits also where it is small.
fn per_second(x: f64) -> String {
    if x != 0.0 && x.abs() < 1e-4 { format!("{x:+.3e} 1/s") } else { format!("{x:+.6} 1/s") }
}

/// Intervals of numbers of vehicles; those of the jam are marked.
fn numbers(scenario: &Scenario, intervals: &[(usize, usize)]) -> Vec<String> {
    let mut parts = Vec::new();
    for &(a, b) in intervals {
        let jam = first_jammed(&scenario.driver, scenario.length, b).max(a);
        if a < jam {
            parts.push(format!("{a} … {}", jam - 1));
        }
        if jam <= b {
            parts.push(format!("{jam} … {b} (jam)"));
        }
    }
    parts
}

fn in_words(scenario: &Scenario, answer: &Answer) -> String {
    let report = &answer.report;
    let mut text = report.sentence() + "\n\n";
    let seconds = |x: Option<f64>| {
        x.map_or("none".to_owned(), |x| if x < 1e6 { format!("{x:.6} s") } else { format!("{x:.3e} s") })
    };
    let rate = |x: Option<f64>, mode: Option<usize>| match (x, mode) {
        (Some(x), Some(q)) => format!("{}, mode {q}", per_second(x)),
        (Some(x), None) => per_second(x),
        _ => "none".to_owned(),
    };
    if scenario.lanes > 1 {
        line(&mut text, "least stable lane", &report.lane.to_string());
    }
    let which = if report.homogeneous { "equal drivers" } else { "drivers that differ" };
    line(&mut text, "vehicles", &format!("{}, {which}", report.vehicles));
    line(
        &mut text,
        "equilibrium",
        &format!("{:.4} m/s at {:.4} m", report.equilibrium_speed_m_per_s, report.mean_headway_m),
    );
    line(&mut text, "slope of speed against headway", &format!("{:.6} 1/s", report.slope_per_s));
    line(&mut text, "critical reaction time", &seconds(report.critical_reaction_time_s));
    let steps = format!("  in steps of {} s", scenario.time_step);
    line(&mut text, &steps, &seconds(report.critical_reaction_time_discrete_s));
    line(&mut text, "  Newell's limit of long waves", &seconds(report.newell_limit_s));
    line(&mut text, "largest growth rate", &rate(report.max_growth_rate_per_s, report.fastest_mode));
    line(&mut text, &steps, &rate(report.max_growth_rate_discrete_per_s, report.fastest_mode_discrete));
    if let Some(wave) = report.wave {
        let along = if wave.speed_m_per_s < 0.0 { "upstream" } else { "downstream" };
        line(
            &mut text,
            "its wave",
            &format!(
                "{:.2} m ({:.2} vehicles) long, {:.3} m/s {along} on the road, {:.3} m/s upstream past the vehicles",
                wave.wavelength_m,
                wave.wavelength_vehicles,
                wave.speed_m_per_s.abs(),
                -wave.speed_relative_to_vehicles_m_per_s
            ),
        );
    }
    if report.all_roots_found == Some(false) {
        line(&mut text, "note", "the argument principle counts more growing roots than were followed");
    }
    if !report.homogeneous {
        let scale = report.critical_scale_discrete.map_or("none".to_owned(), |x| format!("{x:.6}"));
        line(&mut text, "critical scale of reaction times", &scale);
    }
    let joined = |parts: Vec<String>| if parts.is_empty() { "none".to_owned() } else { parts.join(", ") };
    line(&mut text, "stable numbers of vehicles a lane", &joined(numbers(scenario, &answer.stable_vehicles)));
    let sensitivities = answer.stable_sensitivities_per_s.iter().map(|(a, b)| format!("{a:.4} … {b:.4}"));
    line(&mut text, "stable sensitivities", &format!("{} 1/s", joined(sensitivities.collect())));
    if let Some(stabilizing) = &answer.stabilizing {
        let number = stabilizing.smallest_number;
        let said = number
            .map_or("no number calms the ring".to_owned(), |n| format!("{n} of {}", stabilizing.vehicles));
        line(&mut text, "calming drivers needed", &said);
        let last = number.unwrap_or(stabilizing.vehicles);
        let rates = stabilizing.numbers.iter().zip(&stabilizing.max_growth_rates_discrete_per_s);
        for (n, rate) in rates.filter(|(n, _)| **n <= last) {
            line(&mut text, &format!("  growth rate with {n}"), &per_second(*rate));
        }
    }
    if let Some(roots) = &answer.roots {
        let _ = writeln!(
            text,
            "\ncontinuous time\n{:>6}{:>8}{:>16}{:>16}{:>12}",
            "mode", "branch", "real (1/s)", "imaginary", "residual"
        );
        for root in roots {
            let _ = writeln!(
                text,
                "{:>6}{:>8}{:>16.9}{:>16.9}{:>12.1e}",
                root.mode, root.branch, root.real_per_s, root.imaginary_per_s, root.residual
            );
        }
    }
    if let Some(roots) = &answer.roots_discrete {
        let _ = writeln!(
            text,
            "\nin steps of {} s: factors z of a step, and ln(z)/dt\n{:>6}{:>8}{:>16}{:>16}{:>14}{:>14}{:>12}",
            scenario.time_step, "mode", "branch", "real (1/s)", "imaginary", "Re z", "Im z", "residual"
        );
        for root in roots {
            let _ = writeln!(
                text,
                "{:>6}{:>8}{:>16.9}{:>16.9}{:>14.9}{:>14.9}{:>12.1e}",
                root.mode,
                root.branch,
                root.real_per_s,
                root.imaginary_per_s,
                root.factor_real,
                root.factor_imaginary,
                root.residual
            );
        }
    }
    text
}
