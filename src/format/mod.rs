//! The formats of files and messages: [`json`], and [`table`] for tables as CSV.

pub mod json;
mod json_writer;
pub mod table;
