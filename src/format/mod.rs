//! The formats of files and messages: [`json`], and [`table`] for tables as CSV.
//!
//! ```
//! use ringroad::format::table::{Column, Table};
//!
//! let table = Table::new(vec![Column::float("time_s", "s", "time", vec![0.0, 0.5])]);
//! let mut csv = String::new();
//! table.write_body(&mut csv);
//! assert_eq!(csv, "# column time_s: time (s)\ntime_s\n0\n0.5\n");
//! ```

pub mod json;
mod json_writer;
pub mod table;
