//! **Ringroad**, a traffic-instability laboratory: Newell's delayed car-following model on a ring road with several
//! lanes, lane changes driven by frustration, its exact stability theory, and the measurements that hold one
//! against the other.
//!
//! # The house
//!
//! A [`scenario`] is the only input: plain data that determines a run to the last bit. A simulation is the only
//! state. A probe is the only way to measure. A [`table`] is the only way out to a file.
//!
//! | room | what lives there |
//! |---|---|
//! | [`parameters`] | the one table of parameters: names, units, ranges, meanings |
//! | [`scenario`] | the input: road, start, drivers, validation, JSON |
//! | [`action`] | the grammar of timed actions and of drivers who differ |
//! | [`error`] | what a refusal says |
//! | [`random`] | the one source of randomness |
//! | [`exp`] | the exponential, the same bits everywhere |
//! | [`link`] | a scenario as the readable part of a link |
//! | [`colour`] | colour of speed and frustration, for ring and maps |
//! | [`driver`] | speed against headway, equilibrium, fundamental diagram |

pub mod action;
pub mod colour;
pub mod driver;
pub mod error;
pub mod exp;
pub mod link;
pub mod parameters;
pub mod random;
pub mod scenario;
