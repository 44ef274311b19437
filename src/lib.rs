//! **Ringroad**, a traffic-instability laboratory: Newell's delayed car-following model on a ring road with several
//! lanes, lane changes driven by frustration, its exact linear stability theory, and measurements that compare the two.
//!
//! ```
//! use ringroad::measurement::measure;
//! use ringroad::stability::report::Report;
//! use ringroad::{Error, Measurement, Scenario, Simulation, Table};
//!
//! # fn main() -> Result<(), Error> {
//! // Fifty vehicles on one kilometre; vehicle 1 is displaced by 1 m at the start.
//! let mut scenario = Scenario { until: 60.0, ..Scenario::default() };
//! scenario.driver.reaction_time = 0.75; // s
//! scenario.actions.push("at=0:1:nudge=1".parse()?);
//!
//! // Linear theory: the ring is unstable, because the reaction time is above the critical one.
//! let report = Report::of(&scenario);
//! assert!(!report.stable && report.critical_reaction_time_s.unwrap() < 0.75);
//!
//! // A run, measured: the spread of speeds grows.
//! let measurement = Measurement::named("overview")?.with_options([("every", "10")])?;
//! let mut probes = [measurement.probe(&scenario)?];
//! measure(&mut Simulation::new(&scenario)?, &mut probes, &mut |_| true);
//! let table: Table = probes[0].table();
//! assert_eq!(table.rows(), 7);
//! # Ok(())
//! # }
//! ```
//!
//! # Architecture
//!
//! A [`Scenario`] is the only input: plain data that determines a run to the last bit. A [`Simulation`] is the only state.
//! A [`Probe`](measurement::Probe) is the only way to measure; a [`Measurement`] says what to measure. A [`Table`] is the
//! only way out to a file. A refused input is an [`Error`].
//!
//! Every folder is a layer. A file imports from its own folder and from the lines below, never from a line above,
//! never from another folder of the same line, and never in a circle; `tests/layers.rs` holds this list.
//!
//! | layer | what is in it |
//! |---|---|
//! | `command` (native), `web` (WebAssembly) | the command `ringroad`; what the page calls |
//! | [`batch`], [`live`], [`reproduction`] | many runs; a run that is watched; the paper's figures and claims |
//! | [`measurement`] | what to measure, the probes, and what the header of a file says of its making |
//! | [`stability`], [`simulation`] | linear theory; the state and its step. Neither knows the other |
//! | [`scenario`] | parameters, drivers, actions, presets, links, JSON form, validation |
//! | [`mod@format`], [`plot`] | JSON and tables; tables to pictures, colours |
//! | [`numerics`], [`error`] | exponential, complex functions, vectors, random numbers, statistics; refusals of inputs |
//!
//! # Where to look
//!
//! | question | place |
//! |---|---|
//! | Which parameters are there, with which ranges? | the table in [`scenario::parameters`] |
//! | Where is an input checked and refused? | `scenario/validation.rs`; what a refusal says: [`error`] |
//! | Where is the law of speed against headway? | [`scenario::driver`]; vectorized for a step: `simulation/car_following.rs` |
//! | Where is the delay applied? | `simulation/delays.rs` holds the delay in force of every driver, `simulation/history.rs` gives the displacements of so many steps ago, `simulation/perception.rs`, `simulation/step.rs` (one lane, all at once) and `simulation/car_following.rs` turn them into perceived headways and speeds, `simulation/lane_changing.rs` compares lanes by them |
//! | Where is a lane change decided? | frustration: [`simulation::frustration`]; whether it leads to an attempt: [`simulation::attempt_sampler`]; whether the attempt succeeds: `simulation/lane_changing.rs`, with the order of the vehicles in `simulation/lane_order.rs` |
//! | Where is a collision found? | `simulation/collision.rs` |
//! | Where do random numbers come from? | [`numerics::random`], one stream for each use |
//! | Where would a new probe go? | a file in [`measurement`] that implements [`measurement::Probe`], and a variant of [`Measurement`] in `measurement/definition.rs` |
//! | What turns a table into CSV? | [`format::table`]; the header lines above it: `measurement/header.rs` and [`measurement::provenance`] |
//! | Where is a scenario read from JSON, a link, a preset? | `scenario/json.rs`, [`scenario::link`], [`scenario::presets`] |
//! | Where is the critical reaction time computed? | homogeneous drivers: [`stability::homogeneous`]; heterogeneous ones: [`stability::heterogeneous`] |
//! | What says "stable" or "unstable" on the page? | [`stability::summary`]; in the command: [`stability::report`] |
//! | Where are parameters varied over a grid? | the values: [`scenario::parameter_values`]; the runs: [`batch`]; theory only: [`stability::sweep`] |
//! | Where is the colour of the map made? | [`plot::colour`]; `web/map_painter.rs` paints the space-time map with it; of growth rates: `www/src/views/stability/growth_map.ts` |
//! | What does the page ask when the slider of Δ is dragged? | `preview` of `web`'s laboratory, which asks [`live::Live::preview`]: the stability summary of the changed scenario, without a run. When the slider is let go, [`live::Live::set`] appends an action; at t = 0 and after a collision it starts the run again |
//! | Where is a figure of the paper computed? | a file of its own in [`reproduction`] |
//!
//! # Glossary
//!
//! | word | meaning |
//! |---|---|
//! | vehicles N, length L, density ρ, flow q | number of vehicles on the ring; m; vehicles per m; vehicles per s |
//! | headway h | distance from the centre of a vehicle to the centre of the next one ahead in its lane, m |
//! | gap | distance from bumper to bumper, m |
//! | speed v, maximum speed V | m/s; V is approached at large headways |
//! | sensitivity λ | slope of speed against headway at the minimum headway, 1/s |
//! | minimum headway d, vehicle length C | m; at h ≤ d the speed is 0; a headway of C is a collision |
//! | reaction time Δ | time between what a driver sees and the response, s; in a run a whole number of steps |
//! | delay in force | the delay that a driver has now, in steps: it grows by at most one step per step towards Δ, and falls at once |
//! | perceived headway | headway to the vehicle that is ahead now, with both positions as they were Δ ago, m |
//! | displacement | distance that a vehicle has moved since t = 0, nudges included, m |
//! | speed deficit | V − v(h), before speeds below 0 are replaced by 0, m/s |
//! | adjacent leader, adjacent follower | the next vehicle ahead or behind in the lane beside a vehicle's own |
//! | lane order | which vehicle is ahead of which in every lane |
//! | frustration φ | number ≥ 0 that grows while the adjacent lane looks better and when vehicles pass; it sets how likely an attempt to change lanes is |
//! | action | something that happens at a given time: a brake, a nudge, a changed parameter |
//! | driver override | drivers that differ from the default driver; `exceptions` in JSON, `driver` in links and options |
//! | vehicle selector | which vehicles an action or override is for: `all`, `7`, `3-7`, `10%` |
//! | homogeneous, heterogeneous | all drivers equal; drivers that differ |
//! | driver class | drivers that are the same to the theory: equal slope and delay |
//! | equilibrium, v∞ | the state in which all vehicles of a lane keep one speed, v∞ |
//! | slope c | dv/dh at the equilibrium, 1/s |
//! | mode q | sine wave with q periods round the ring, as a disturbance of the equilibrium |
//! | growth rate σ | rate of the exponential growth of a mode, 1/s; negative where it decays |
//! | critical reaction time τ | reaction time, s, below which a ring is stable |
//! | stability diagram | number of vehicles against reaction time; its boundary is the neutral stability curve |
//! | stability summary | the few numbers that say whether a ring is stable and how fast its fastest mode grows |
//! | stabilizing drivers | drivers that make an unstable ring stable, and how many are needed |
//! | co-moving frame | frame of reference that moves at v∞ |
//! | task, task result | unit of work of a figure, and what it gives |
//! | claim verdict | whether a claim of the paper agrees with the value found here |
//!
//! # Features
//!
//! `command` (by default) builds the command and brings `parallel`, which computes batches and figures on all cores.
//! `laboratory` and `figures` choose which entry points a WebAssembly module has, and with them its size.

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

pub use error::Error;
pub use format::table::Table;
pub use measurement::Measurement;
pub use scenario::Scenario;
pub use simulation::Simulation;

/// The README's example runs with the tests in the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
