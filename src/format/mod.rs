//! What files and messages are written in: JSON, and tables as CSV.

pub mod json;
pub mod table;
