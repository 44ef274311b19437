//! Where a table came from: the lines at the beginning of a CSV file that say what made it, so that it can be made again.
//!
//! Each begins with `#`: the program and its version, then, as one line of JSON each, the scenario and the measurement of a
//! run, or the plan of a batch.

use super::settings::Measurement;
use crate::error::{Error, opening};
use crate::format::table::Table;
use crate::scenario::Scenario;

/// Version that a file names: a run is promised to repeat to the last bit within one.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
const PROGRAM: &str = "# ringroad ";
const SCENARIO: &str = "# scenario ";
/// Of the table of a batch; what follows is its plan.
pub(crate) const PLAN: &str = "# plan ";
const MEASUREMENT: &str = "# measurement ";
const COMPUTED: &str = "# computed ";

/// The table of a run as CSV, with the scenario and the measurement in the header.
pub fn run_to_csv(table: &Table, scenario: &Scenario, measurement: &Measurement) -> String {
    let made_by = format!("{MEASUREMENT}{}", measurement.resolved(scenario).to_json());
    with_header(table, &[&format!("{SCENARIO}{}", scenario.to_json()), &made_by])
}

/// A table that was computed from a scenario without a run, as CSV; `how` says what was asked, in one line.
pub fn theory_to_csv(table: &Table, scenario: &Scenario, how: &str) -> String {
    with_header(table, &[&format!("{SCENARIO}{}", scenario.to_json()), &format!("{COMPUTED}{how}")])
}

/// A table as CSV below the line that names the program and these lines.
pub(crate) fn with_header(table: &Table, lines: &[&str]) -> String {
    let mut out = format!("{PROGRAM}{VERSION}\n");
    for line in lines {
        out.push_str(line);
        out.push('\n');
    }
    table.write_body(&mut out);
    out
}

/// What the header of a CSV file says about its making.
#[derive(Clone, Debug, PartialEq)]
pub struct Provenance {
    /// Version of the program that wrote it.
    pub version: String,
    /// The scenario that was run.
    pub scenario: Scenario,
    /// What was measured.
    pub measurement: Measurement,
}

impl Provenance {
    /// The version that wrote a file, for a reader that may not understand the rest.
    pub fn version_of(text: &str) -> Result<&str, Error> {
        header_line(text, PROGRAM).map(str::trim)
    }

    /// Reads the header of a file that [`run_to_csv`] wrote.
    pub fn from_csv(text: &str) -> Result<Self, Error> {
        let version = Self::version_of(text)?.to_owned();
        if header_line(text, PLAN).is_ok() {
            let allowed =
                "the table of one run; a batch is repeated by `ringroad batch --plan` with this file";
            return Err(Error::not_ours("file", "the table of a batch", allowed));
        }
        if header_line(text, COMPUTED).is_ok() {
            return Err(Error::not_ours("file", "a table that theory computed", "the table of one run"));
        }
        Ok(Self {
            version,
            scenario: Scenario::from_json(header_line(text, SCENARIO)?)
                .map_err(|e| e.within("CSV header, scenario"))?,
            measurement: Measurement::from_json(header_line(text, MEASUREMENT)?)
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

/// The rest of the header line that begins with `prefix`.
pub(crate) fn header_line<'a>(text: &'a str, prefix: &str) -> Result<&'a str, Error> {
    text.lines().take_while(|l| l.starts_with('#')).find_map(|l| l.strip_prefix(prefix)).ok_or_else(|| {
        Error::not_ours("CSV header", opening(text), format!("a file of Ringroad, with a line “{prefix}…”"))
    })
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
        assert_eq!(Provenance::version_of("# ringroad 9.8.7\nwhat nobody knows yet"), Ok("9.8.7"));
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
