//! **Ringroad**, a traffic-instability laboratory: Newell's delayed car-following model on a ring road with several
//! lanes, lane changes driven by frustration, its exact stability theory, and the measurements that hold one
//! against the other.
//!
//! # Architecture
//!
//! A [`Scenario`](scenario::Scenario) is the only input: plain data that determines a run to the last bit. A
//! [`Simulation`](simulation::Simulation) is the only state. A [`Probe`](measurement::Probe) is the only way to
//! measure. A [`Table`](format::table::Table) is the only way out to a file.
//!
//! Every folder is a layer. A file imports from its own folder and from the lines below, never from a line above,
//! never from another folder of the same line, and never in a circle; `tests/layers.rs` holds this list.
//!
//! | layer | what is in it |
//! |---|---|
//! | `command` (native), `web` (WebAssembly) | the command `ringroad`; the façade for the page |
//! | [`batch`], [`live`], [`reproduction`] | many runs; a run that is watched; the paper's figures and claims |
//! | [`measurement`] | what to measure, the probes, and what the header of a file says of its making |
//! | [`stability`], [`simulation`] | linear theory; the state and its step. Neither knows the other |
//! | [`scenario`] | parameters, drivers, actions, presets, links, validation |
//! | [`mod@format`], [`plot`] | JSON and tables; tables to pictures |
//! | [`numerics`], [`error`] | exponential, complex functions, vectors, random numbers, statistics; what a refusal says |
//!
//! Cargo features: `command` (by default) builds the command and brings `parallel`, batches and figures on all cores.
//! `laboratory` and `figures` choose what a WebAssembly module has of `web`.

pub mod batch;
pub mod error;
pub mod format;
pub mod live;
pub mod measurement;
pub mod numerics;
pub mod plot;
pub mod reproduction;
pub mod scenario;
pub mod simulation;
pub mod stability;
#[cfg(any(target_arch = "wasm32", test))]
pub mod web;

/// The README's example runs with the tests in the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
