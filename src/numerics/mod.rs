//! Numbers: functions, vectors, random draws, statistics. Nothing here knows of traffic.
//!
//! All results have the same bits on every target: transcendental functions come from [`exp`](mod@exp) and the crate `libm`, random
//! numbers from [`random`], and vectors of every width give what one number at a time gives.

pub mod bisection;
pub(crate) mod complex;
pub mod exp;
pub(crate) mod lambert_w;
pub mod least_squares;
pub mod parallel;
pub mod random;
pub mod simd;
pub mod statistics;
