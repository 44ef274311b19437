//! Numbers: functions, vectors, random draws, statistics. No file here imports anything about traffic.
//!
//! All results have the same bits on every target: transcendental functions come from [`exp`](mod@exp) and the crate `libm`, random
//! numbers from [`random`], and vectors of every width give what one number at a time gives.
//!
//! ```
//! use ringroad::numerics::{exp::exp, least_squares};
//!
//! let points: Vec<_> = (0..10).map(|i| (f64::from(i), exp(-0.5 * f64::from(i)))).collect();
//! let fit = least_squares::log_linear(&points).unwrap();
//! assert!((fit.rate + 0.5).abs() < 1e-12);
//! ```

pub mod bisection;
pub(crate) mod complex;
pub mod exp;
pub(crate) mod lambert_w;
pub mod least_squares;
pub mod parallel;
pub mod random;
pub mod simd;
pub mod statistics;
