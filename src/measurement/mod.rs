//! Measurements: what is measured in a run, and the probes that do it.
//!
//! A [`Measurement`] is plain data; [`Measurement::probe`] makes the [`Probe`] for it. A run is measured with [`measure`],
//! and the table of a probe is written with [`provenance::run_to_csv`].
//!
//! | file | subject |
//! |---|---|
//! | `definition` | [`Measurement`]: what to measure, as plain data |
//! | [`settings`] | the table of all settings of measurements |
//! | [`probe`] | what every probe has in common |
//! | `due_rows` | which states give rows, and where a probe keeps them |
//! | [`provenance`], `header` | what the header of a file says of its making |
//!
//! | probes in | measure |
//! |---|---|
//! | `overview` | the whole ring, over time or at the end |
//! | `trajectories` | the state of every vehicle |
//! | `speeds` | speeds of some vehicles |
//! | `speed_map` | space-time map of speed |
//! | `flow` | flow past a position, and its space-time map |
//! | `modes`, [`modal_growth`], `spectrum` | Fourier modes of the headways and how fast they grow |
//! | `cyclic_growth` | growth of the oscillation of one vehicle's speed from period to period |
//! | `equilibrium` | equilibrium of each lane |
//! | `events`, `lanes`, `driver_groups` | lane changes, and what they lead to |
//!
//! # Example: a measurement
//!
//! ```
//! use ringroad::measurement::{Measurement, measure};
//! use ringroad::scenario::Scenario;
//! use ringroad::simulation::Simulation;
//!
//! let scenario = Scenario { vehicles: 20, until: 60.0, ..Scenario::default() };
//! let measurement = Measurement::named("flow")?.with_options([("every", "10")])?;
//! let mut probes = [measurement.probe(&scenario)?];
//! let mut simulation = Simulation::new(&scenario)?;
//! assert!(measure(&mut simulation, &mut probes, &mut |_| true));
//! let table = probes[0].table();
//! assert_eq!(table.floats("time_s").unwrap(), [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0]);
//! # Ok::<(), ringroad::error::Error>(())
//! ```
//!
//! # Example: a probe of one's own
//!
//! ```
//! use ringroad::format::table::{Column, Table};
//! use ringroad::measurement::{Probe, measure};
//! use ringroad::scenario::Scenario;
//! use ringroad::simulation::Simulation;
//!
//! /// The smallest headway of the whole run.
//! struct SmallestHeadway(f64);
//!
//! impl Probe for SmallestHeadway {
//!     fn observe(&mut self, simulation: &Simulation) {
//!         for j in 0..simulation.vehicles() {
//!             self.0 = self.0.min(simulation.headway(j));
//!         }
//!     }
//!     fn table(&self) -> Table {
//!         Table::new(vec![Column::float("smallest_headway_m", "m", "smallest headway of the run", vec![self.0])])
//!     }
//! }
//!
//! let scenario = Scenario { until: 10.0, ..Scenario::default() };
//! let mut probes: [Box<dyn Probe>; 1] = [Box::new(SmallestHeadway(f64::INFINITY))];
//! measure(&mut Simulation::new(&scenario)?, &mut probes, &mut |_| true);
//! assert_eq!(probes[0].table().floats("smallest_headway_m"), Some(&[20.0][..]));
//! # Ok::<(), ringroad::error::Error>(())
//! ```

mod cyclic_growth;
mod definition;
mod driver_groups;
pub(crate) mod due_rows;
mod equilibrium;
mod events;
mod flow;
pub(crate) mod header;
pub(crate) mod lanes;
pub mod modal_growth;
mod modes;
mod overview;
pub mod probe;
pub mod provenance;
pub mod settings;
pub(crate) mod spectrum;
mod speed_map;
mod speeds;
mod trajectories;

pub use definition::Measurement;
pub use probe::{Probe, act, measure};
pub use provenance::{Provenance, VERSION};
pub use settings::{SETTINGS, Setting};
