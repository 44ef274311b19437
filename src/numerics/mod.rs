//! Numbers: functions, vectors, random draws, statistics. Nothing here knows of traffic.

pub mod complex;
pub mod exp;
pub mod lambert_w;
pub mod least_squares;
pub mod parallel;
pub mod random;
pub mod simd;
pub mod statistics;
