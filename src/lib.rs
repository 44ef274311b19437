//! **Ringroad**, a traffic-instability laboratory: Newell's delayed car-following model on a ring road with several
//! lanes, lane changes driven by frustration, its exact stability theory, and the measurements that hold one
//! against the other.
//!
//! # The house
//!
//! A [`scenario`] is the only input: plain data that determines a run to the last bit. A [`simulation`] is the only
//! state. A [`probe`] is the only way to measure. A [`table`] is the only way out to a file.
//!
//! | room | what lives there |
//! |---|---|
//! | [`parameters`] | the one table of parameters: names, units, ranges, meanings |
//! | [`scenario`] | the input: road, start, drivers, validation, JSON |
//! | [`action`] | the grammar of timed actions and of drivers who differ |
//! | [`link`] | a scenario as the readable part of a link |
//! | [`preset`] | scenarios with names |
//! | [`error`] | what a refusal says |
//! | [`json`] | JSON, read and written |
//! | [`random`] | the one source of randomness |
//! | [`exp`] | the exponential, the same bits everywhere |
//! | [`driver`] | speed against headway, equilibrium, fundamental diagram |
//! | [`stability`] | linear theory: eigenvalues, characteristic roots, critical reaction times |
//! | [`simulation`] | the state and its step |
//! | [`following`] | perceived headways to speeds, all vehicles at once |
//! | [`history`], [`reaction`] | what was Δ ago, and how long ago that is for whom |
//! | [`vector`] | vectors as wide as the machine has them |
//! | [`ring`], `watch` | who is ahead, who passed, and who has to be looked at for that |
//! | [`frustration`] | the rules of frustration, and when a lane change is attempted |
//! | [`measurement`] | what to measure, plain data |
//! | [`probe`] | one file a measurement, and `spectrum`, which two of them share |
//! | [`fit`] | straight lines and exponentials through points |
//! | [`table`] | columns, units, CSV |
//! | [`batch`] | grids and Monte Carlo over scenarios: plan, runs, summary |
//! | [`figure`], [`claim`] | the paper's figures, and what it claims beside what is measured |
//! | [`plot`], [`colour`] | tables to pictures |
//! | [`live`], [`verdict`] | a run that somebody watches, and what theory says of it |
//! | `web` | the façade for the page, on WebAssembly only |
//! | `main.rs`, `command/` | the command, native only |
//!
//! Cargo features: `command` (by default) builds the command and brings `parallel`, batches and figures on all cores.
//! `laboratory` and `figures` choose what a WebAssembly module has of `web`.

pub mod action;
pub mod batch;
pub mod claim;
pub mod colour;
pub mod driver;
pub mod error;
pub mod exp;
pub mod figure;
pub mod fit;
pub mod following;
pub mod frustration;
pub mod history;
pub mod json;
pub mod link;
pub mod live;
pub mod measurement;
pub mod parameters;
pub mod plot;
pub mod preset;
pub mod probe;
pub mod random;
pub mod reaction;
pub mod ring;
pub mod scenario;
pub mod simulation;
pub mod stability;
pub mod table;
pub mod vector;
pub mod verdict;
mod watch;
#[cfg(target_arch = "wasm32")]
pub mod web;

/// The README's example runs with the tests in the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
