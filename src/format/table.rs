//! A table: the only way out to a file. Named columns with units, written as CSV.
//!
//! The file begins with lines that start with `#`: the program and its version, the scenario and the
//! measurement as one line of JSON each, and what every column means; then one row of column names, then the
//! rows. A number is written with the fewest digits that read back to the same bits; what does not exist
//! (no headway measured yet, say) is an empty field. Text is quoted after RFC 4180.

use crate::batch::Plan;
use crate::error::Invalid;
use crate::measurement::Measurement;
use crate::scenario::Scenario;
use crate::scenario::parameters::opening;
use std::fmt::Write as _;

/// The values of a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Numbers; NaN stands for "none" and is written as an empty field.
    Float(Vec<f64>),
    /// Whole numbers.
    Whole(Vec<u64>),
    /// Text.
    Text(Vec<String>),
}

/// One named column.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name, with the unit at its end: `speed_m_per_s`.
    pub name: String,
    /// Unit, empty for a pure number or text.
    pub unit: &'static str,
    /// What it holds, in one line.
    pub meaning: String,
    /// The values, one a row.
    pub values: Values,
}

impl Column {
    /// A column of numbers.
    pub fn float(
        name: impl Into<String>,
        unit: &'static str,
        meaning: impl Into<String>,
        values: Vec<f64>,
    ) -> Self {
        Self { name: name.into(), unit, meaning: meaning.into(), values: Values::Float(values) }
    }
    /// A column of whole numbers.
    pub fn whole(
        name: impl Into<String>,
        unit: &'static str,
        meaning: impl Into<String>,
        values: Vec<u64>,
    ) -> Self {
        Self { name: name.into(), unit, meaning: meaning.into(), values: Values::Whole(values) }
    }
    /// A column of text.
    pub fn text(name: impl Into<String>, meaning: impl Into<String>, values: Vec<String>) -> Self {
        Self { name: name.into(), unit: "", meaning: meaning.into(), values: Values::Text(values) }
    }
    /// Number of values.
    pub fn len(&self) -> usize {
        match &self.values {
            Values::Float(v) => v.len(),
            Values::Whole(v) => v.len(),
            Values::Text(v) => v.len(),
        }
    }
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Columns of equal length.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    columns: Vec<Column>,
}

impl Table {
    /// A table of these columns.
    ///
    /// # Panics
    /// If the columns differ in length: a mistake in a probe.
    pub fn new(columns: Vec<Column>) -> Self {
        assert!(columns.windows(2).all(|w| w[0].len() == w[1].len()), "columns of a table differ in length");
        Self { columns }
    }

    /// The columns.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, Column::len)
    }

    /// The numbers of the column of that name.
    pub fn floats(&self, name: &str) -> Option<&[f64]> {
        self.columns.iter().find(|c| c.name == name).and_then(|c| match &c.values {
            Values::Float(v) => Some(v.as_slice()),
            _ => None,
        })
    }

    /// The whole numbers of the column of that name.
    pub fn wholes(&self, name: &str) -> Option<&[u64]> {
        self.columns.iter().find(|c| c.name == name).and_then(|c| match &c.values {
            Values::Whole(v) => Some(v.as_slice()),
            _ => None,
        })
    }

    /// The words of the column of that name.
    pub fn texts(&self, name: &str) -> Option<&[String]> {
        self.columns.iter().find(|c| c.name == name).and_then(|c| match &c.values {
            Values::Text(v) => Some(v.as_slice()),
            _ => None,
        })
    }

    /// The table as CSV, with what made it in the header.
    pub fn to_csv(&self, scenario: &Scenario, measurement: &Measurement) -> String {
        let mut out = String::new();
        let _ = writeln!(out, "{PROGRAM}{VERSION}");
        let _ = writeln!(out, "{SCENARIO}{}", scenario.to_json());
        let _ = writeln!(out, "{MEASUREMENT}{}", measurement.resolved(scenario).to_json());
        self.write_body(&mut out);
        out
    }

    /// The same for a table that was computed from a scenario without a run; `how` says what was asked, in one line.
    pub fn to_csv_computed(&self, scenario: &Scenario, how: &str) -> String {
        let mut out = String::new();
        let _ = writeln!(out, "{PROGRAM}{VERSION}");
        let _ = writeln!(out, "{SCENARIO}{}", scenario.to_json());
        let _ = writeln!(out, "{COMPUTED}{how}");
        self.write_body(&mut out);
        out
    }

    /// The table of a batch as CSV, with its plan in the header.
    pub fn to_csv_of_batch(&self, plan: &Plan) -> String {
        let mut out = format!("{PROGRAM}{VERSION}\n{PLAN}{}\n", plan.to_json());
        self.write_body(&mut out);
        out
    }

    /// Column meanings, column names and rows: all of the CSV below the lines that say what made it.
    pub fn write_body(&self, out: &mut String) {
        for column in &self.columns {
            let unit = if column.unit.is_empty() { String::new() } else { format!(" ({})", column.unit) };
            let _ = writeln!(out, "# column {}: {}{unit}", column.name, column.meaning);
        }
        for (i, column) in self.columns.iter().enumerate() {
            out.push_str(if i == 0 { "" } else { "," });
            write_text(out, &column.name);
        }
        out.push('\n');
        for row in 0..self.rows() {
            for (i, column) in self.columns.iter().enumerate() {
                out.push_str(if i == 0 { "" } else { "," });
                match &column.values {
                    Values::Float(v) => write_number(out, v[row]),
                    Values::Whole(v) => {
                        let _ = write!(out, "{}", v[row]);
                    }
                    Values::Text(v) => write_text(out, &v[row]),
                }
            }
            out.push('\n');
        }
    }
}

/// Version that a file names: a run is promised to repeat to the last bit within one.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
const PROGRAM: &str = "# ringroad ";
const SCENARIO: &str = "# scenario ";
const PLAN: &str = "# plan ";
const MEASUREMENT: &str = "# measurement ";
const COMPUTED: &str = "# computed ";

/// The plan in the header of a file that [`Table::to_csv_of_batch`] wrote.
pub fn plan_from_csv(text: &str) -> Result<Plan, Invalid> {
    Plan::from_json(header_line(text, PLAN)?).map_err(|e| e.within("CSV header"))
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
    pub fn version_of(text: &str) -> Result<&str, Invalid> {
        header_line(text, PROGRAM).map(str::trim)
    }

    /// Reads the header of a file that [`Table::to_csv`] wrote.
    pub fn from_csv(text: &str) -> Result<Self, Invalid> {
        let version = Self::version_of(text)?.to_owned();
        if header_line(text, PLAN).is_ok() {
            let allowed =
                "the table of one run; a batch is repeated by `ringroad batch --plan` with this file";
            return Err(Invalid::new("file", "the table of a batch", allowed));
        }
        if header_line(text, COMPUTED).is_ok() {
            return Err(Invalid::new("file", "a table that theory computed", "the table of one run"));
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
pub fn scenario_of_file(text: &str) -> Result<(Scenario, Option<String>), Invalid> {
    if text.starts_with('#') {
        Provenance::from_csv(text).map(|made_by| (made_by.scenario, Some(made_by.version)))
    } else if text.trim_start().starts_with('{') {
        Scenario::from_json(text).map(|scenario| (scenario, None))
    } else {
        Err(Invalid::new("file", opening(text), "a scenario in JSON or a table of Ringroad; it is neither"))
    }
}

/// The rest of the header line that begins with `prefix`.
fn header_line<'a>(text: &'a str, prefix: &str) -> Result<&'a str, Invalid> {
    text.lines().take_while(|l| l.starts_with('#')).find_map(|l| l.strip_prefix(prefix)).ok_or_else(|| {
        Invalid::new("CSV header", opening(text), format!("a file of Ringroad, with a line “{prefix}…”"))
    })
}

/// The fewest digits that read back to the same bits; exponents where plain digits would be long.
fn write_number(out: &mut String, value: f64) {
    if value.is_nan() {
        return;
    }
    let _ = write!(out, "{value:?}");
    if out.ends_with(".0") {
        out.truncate(out.len() - 2);
    }
}

fn write_text(out: &mut String, text: &str) {
    if text.contains(['"', ',', '\n', '\r']) {
        let _ = write!(out, "\"{}\"", text.replace('"', "\"\""));
    } else {
        out.push_str(text);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn body(table: &Table) -> String {
        let mut out = String::new();
        table.write_body(&mut out);
        out
    }

    #[test]
    fn numbers_read_back_to_the_same_bits() {
        let values = vec![0.1, -0.0, 1.0, 1e22, 1e-7, 5e-324, f64::MAX, 1.0 / 3.0, 123_456_789.25];
        let csv = body(&Table::new(vec![Column::float("x_m", "m", "a length", values.clone())]));
        let read: Vec<f64> = csv.lines().skip(2).map(|l| l.parse().unwrap()).collect();
        for (a, b) in values.iter().zip(&read) {
            assert_eq!(a.to_bits(), b.to_bits());
        }
        assert!(csv.starts_with("# column x_m: a length (m)\nx_m\n0.1\n-0\n1\n"), "{csv}");
    }

    #[test]
    fn text_is_quoted_and_what_does_not_exist_is_empty() {
        let csv = body(&Table::new(vec![
            Column::text("note", "a, b", vec!["plain".into(), "say \"a,b\"".into()]),
            Column::float("x", "", "x", vec![f64::NAN, 2.0]),
        ]));
        assert!(csv.ends_with("note,x\nplain,\n\"say \"\"a,b\"\"\",2\n"), "{csv}");
    }

    #[test]
    fn the_header_says_what_made_the_file() {
        let scenario = Scenario { vehicles: 20, seed: 7, ..Scenario::default() };
        let measurement = Measurement::named("flow").unwrap();
        let csv =
            Table::new(vec![Column::whole("n", "", "a count", vec![1])]).to_csv(&scenario, &measurement);
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
