//! Measurements: what to read off a run, and the probes that read it.
//!
//! | file | measurement |
//! |---|---|
//! | [`overview`] | the whole ring, over time or at the end |
//! | [`trajectories`] | every vehicle's state |
//! | [`speeds`] | speeds of some vehicles |
//! | [`speed_map`] | space-time map of speed |
//! | [`flow`] | flow past a place, and its space-time map |
//! | [`modes`], [`modal_growth`] | Fourier modes of the headways and how fast they grow |
//! | [`cyclic_growth`] | growth from period to period of one vehicle's speed |
//! | [`equilibrium`] | equilibrium of each lane |
//! | [`events`], [`lanes`], [`driver_groups`] | lane changes and what they lead to |
//! | [`settings`] | what to measure, as plain data |
//! | [`probe`] | what every probe has in common |
//! | [`provenance`] | what the header of a file says of its making |

pub mod cyclic_growth;
pub mod driver_groups;
mod due_rows;
pub mod equilibrium;
pub mod events;
pub mod flow;
pub mod lanes;
pub mod modal_growth;
pub mod modes;
pub mod overview;
pub mod probe;
pub mod provenance;
pub mod settings;
pub(crate) mod spectrum;
pub mod speed_map;
pub mod speeds;
pub mod trajectories;

pub use probe::{Probe, act, measure};
pub use provenance::{Provenance, VERSION};
pub use settings::{Measurement, SETTINGS, Setting};
