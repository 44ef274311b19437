//! A table: the only way out to a file. Named columns with units, written as CSV.
//!
//! A file begins with lines that start with `#`: what made it (see [`crate::measurement`]), then what every column means;
//! then one row of column names, then the rows. A number is written with the fewest digits that read back to the same
//! bits; a value that does not exist (a headway that was not measured yet, say) is an empty field. Text is quoted as RFC 4180
//! says.
//!
//! ```
//! use ringroad::format::table::{Column, Table};
//!
//! let table = Table::new(vec![
//!     Column::whole("vehicle", "", "number of the vehicle", vec![1, 2]),
//!     Column::float("speed_m_per_s", "m/s", "its speed", vec![12.5, f64::NAN]),
//! ]);
//! let mut csv = String::new();
//! table.write_body(&mut csv);
//! assert!(csv.ends_with("vehicle,speed_m_per_s\n1,12.5\n2,\n"));
//! ```

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
    /// Number of values: the rows of its table.
    pub fn len(&self) -> usize {
        match &self.values {
            Values::Float(v) => v.len(),
            Values::Whole(v) => v.len(),
            Values::Text(v) => v.len(),
        }
    }
    /// Whether it has no values.
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
    /// If the columns differ in length, which is a mistake of the caller.
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

    /// The values of the column of that name; `None` if it does not exist or does not hold such numbers.
    pub fn floats(&self, name: &str) -> Option<&[f64]> {
        self.columns.iter().find(|c| c.name == name).and_then(|c| match &c.values {
            Values::Float(v) => Some(v.as_slice()),
            _ => None,
        })
    }

    /// The values of the column of that name; `None` if it does not exist or does not hold whole numbers.
    pub fn wholes(&self, name: &str) -> Option<&[u64]> {
        self.columns.iter().find(|c| c.name == name).and_then(|c| match &c.values {
            Values::Whole(v) => Some(v.as_slice()),
            _ => None,
        })
    }

    /// The values of the column of that name; `None` if it does not exist or does not hold text.
    pub fn texts(&self, name: &str) -> Option<&[String]> {
        self.columns.iter().find(|c| c.name == name).and_then(|c| match &c.values {
            Values::Text(v) => Some(v.as_slice()),
            _ => None,
        })
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
    fn text_is_quoted_and_missing_values_are_empty() {
        let csv = body(&Table::new(vec![
            Column::text("note", "a, b", vec!["plain".into(), "say \"a,b\"".into()]),
            Column::float("x", "", "x", vec![f64::NAN, 2.0]),
        ]));
        assert!(csv.ends_with("note,x\nplain,\n\"say \"\"a,b\"\"\",2\n"), "{csv}");
    }
}
