//! Where a table came from: the lines at the beginning of a CSV file that say what made it, so that it can be made again.
//!
//! Each begins with `#`: the program and its version, then, as one line of JSON each, the scenario and the measurement of a
//! run, or the plan of a batch.
//!
//! ```
//! use ringroad::measurement::provenance::{Provenance, VERSION, run_to_csv};
//! use ringroad::measurement::{Measurement, measure};
//! use ringroad::scenario::Scenario;
//! use ringroad::simulation::Simulation;
//!
//! let scenario = Scenario { until: 10.0, ..Scenario::default() };
//! let measurement = Measurement::named("overview")?;
//! let mut probes = [measurement.probe(&scenario)?];
//! measure(&mut Simulation::new(&scenario)?, &mut probes, &mut |_| true);
//!
//! let csv = run_to_csv(&probes[0].table(), &scenario, &measurement);
//! let made_by = Provenance::from_csv(&csv)?;
//! assert_eq!((made_by.version.as_str(), made_by.scenario), (VERSION, scenario));
//! assert_eq!(made_by.measurement, measurement);
//! # Ok::<(), ringroad::error::Error>(())
//! ```

use super::definition::Measurement;
use super::header::{Word, with_header};
use crate::error::{Error, opening};
use crate::format::table::Table;
use crate::scenario::Scenario;

pub use super::header::VERSION;

/// The table of a run as CSV, with the scenario and the measurement in the header.
pub fn run_to_csv(table: &Table, scenario: &Scenario, measurement: &Measurement) -> String {
    let measurement = measurement.resolved(scenario).to_json();
    with_header(table, &[(Word::Scenario, &scenario.to_json()), (Word::Measurement, &measurement)])
}

/// A table that was computed from a scenario without a run, as CSV; `how` says in one line what was computed.
pub fn theory_to_csv(table: &Table, scenario: &Scenario, how: &str) -> String {
    with_header(table, &[(Word::Scenario, &scenario.to_json()), (Word::Computed, how)])
}

/// A table of a figure that was made from many runs or theory, as CSV; `how` says in one line what was varied from the
/// scenario and how often it was run.
pub(crate) fn figure_to_csv(table: &Table, name: &str, scenario: &Scenario, how: &str) -> String {
    let scenario = scenario.to_json();
    with_header(table, &[(Word::FigureTable, name), (Word::Scenario, &scenario), (Word::MadeFrom, how)])
}

/// What the header of a CSV file says about its making.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Provenance {
    /// Version of the program that wrote it.
    pub version: String,
    /// The scenario that was run.
    pub scenario: Scenario,
    /// What was measured.
    pub measurement: Measurement,
}

impl Provenance {
    /// The version that wrote a file. It can be read even where another version has changed the lines below.
    pub fn version_of(text: &str) -> Result<&str, Error> {
        Word::Program.read(text).map(str::trim)
    }

    /// Reads the header of a file that [`run_to_csv`] wrote.
    pub fn from_csv(text: &str) -> Result<Self, Error> {
        let version = Self::version_of(text)?.to_owned();
        if Word::Plan.read(text).is_ok() {
            let allowed =
                "the table of one run; a batch is repeated by `ringroad batch --plan` with this file";
            return Err(Error::not_ours("file", "the table of a batch", allowed));
        }
        if Word::Computed.read(text).is_ok() {
            return Err(Error::not_ours("file", "a table that theory computed", "the table of one run"));
        }
        Ok(Self {
            version,
            scenario: Scenario::from_json(Word::Scenario.read(text)?)
                .map_err(|e| e.within("CSV header, scenario"))?,
            measurement: Measurement::from_json(Word::Measurement.read(text)?)
                .map_err(|e| e.within("CSV header, measurement"))?,
        })
    }
}

/// The scenario in the text of a file, JSON or a table, and the version that wrote the table.
pub fn scenario_of_file(text: &str) -> Result<(Scenario, Option<String>), Error> {
    if text.starts_with('#') {
        Provenance::from_csv(text).map(|made_by| (made_by.scenario, Some(made_by.version)))
    } else if text.trim_start().starts_with('{') {
        Scenario::from_json(text).map(|scenario| (scenario, None))
    } else {
        Err(Error::not_ours(
            "file",
            opening(text),
            "a scenario in JSON or a table of Ringroad; it is neither",
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::table::Column;

    #[test]
    fn the_header_says_what_made_the_file() {
        let scenario = Scenario { vehicles: 20, seed: 7, ..Scenario::default() };
        let measurement = Measurement::named("flow").unwrap();
        let csv = run_to_csv(
            &Table::new(vec![Column::whole("n", "", "a count", vec![1])]),
            &scenario,
            &measurement,
        );
        assert!(csv.ends_with("# column n: a count\nn\n1\n"), "{csv}");
        let read = Provenance::from_csv(&csv).unwrap();
        assert_eq!((read.version.as_str(), &read.scenario), (VERSION, &scenario));
        // Defaults that follow from the scenario are written out.
        assert_eq!(read.measurement, Measurement::Flow { every: 1.0, window: 5.0, at: Some(500.0) });
        assert_eq!(Provenance::version_of("# ringroad 9.8.7\na line of a later version"), Ok("9.8.7"));
        assert_eq!(scenario_of_file(&csv), Ok((scenario.clone(), Some(VERSION.to_owned()))));
        assert_eq!(scenario_of_file(&format!(" {}", scenario.to_json())), Ok((scenario, None)));
        for (text, opening) in [("hello\nyou", "“hello”"), ("", "“”"), ("\u{1b}[2J", "“ [2J”")] {
            let message = scenario_of_file(text).unwrap_err().to_string();
            assert!(message.contains(opening) && message.contains("neither"), "{message}");
        }
        let long = "é".repeat(50);
        assert!(scenario_of_file(&long).unwrap_err().to_string().contains(&format!("“{}…”", "é".repeat(40))));
        for (text, named) in [
            ("", "“”"),
            ("time_s,vehicle", "time_s,vehicle"),
            ("# ringroad 0.1.0\na,b", "# scenario"),
            ("# ringroad 0.1.0\n# scenario {\"vehicles\":0}\n# measurement {}", "vehicles"),
            ("# ringroad 0.1.0\n# scenario {}\n# measurement {\"table\":\"x\"}", "measurement: table"),
            ("# ringroad 0.1.0\nx\n# scenario {}\n# measurement {}", "# scenario"),
        ] {
            let message = Provenance::from_csv(text).unwrap_err().to_string();
            assert!(message.starts_with("CSV header") && message.contains(named), "{message}");
        }
    }
}
