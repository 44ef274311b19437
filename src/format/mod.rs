//! What files and messages are written in: JSON, and tables as CSV.

pub mod json;
mod json_writer;
pub mod table;
