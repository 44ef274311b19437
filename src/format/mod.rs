//! The formats of files and messages: [`json`], and [`table`] for tables as CSV.

pub mod json;
pub mod table;
