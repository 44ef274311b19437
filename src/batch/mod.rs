//! Batches: many runs of one scenario with different seeds (Monte Carlo) and with parameters varied over a grid.
//!
//! A [`Plan`] is plain data. It numbers its runs, and [`Plan::run`] computes any of them independently. So the runs can be
//! computed in any order, on any number of threads or machines; a table is made from the [`Run`]s sorted by number,
//! and its bytes depend on the plan alone.
//!
//! | term | meaning |
//! |---|---|
//! | cell | one combination of the varied parameters' values; the parameter varied last changes fastest |
//! | run | one seed of one cell: run k = 0, 1, … of every cell has the seed *base seed + k* |
//! | number of a run | cell · runs per cell + k, from 0 |
//! | shard i/n | the runs with number ≡ i − 1 modulo n, so that every shard has its part of every cell |
//!
//! | file | subject |
//! |---|---|
//! | `plan` | which runs there are |
//! | `run` | computing runs, one or all |
//! | `rows` | a table of all runs |
//! | `summary` | statistics over the runs of each cell |
//! | [`record`] | finished runs as text: to continue a batch, and to merge shards |
//!
//! ```
//! use ringroad::batch::{Plan, run_all};
//! use ringroad::error::Error;
//! use ringroad::measurement::Measurement;
//! use ringroad::scenario::Scenario;
//! use std::collections::BTreeMap;
//!
//! let scenario = Scenario { until: 10.0, ..Scenario::default() };
//! let vary = vec!["vehicles=20,40".parse()?];
//! let plan = Plan::new(scenario, vary, 1, Measurement::named("outcome")?)?;
//!
//! let numbers: Vec<u64> = (0..plan.runs()).collect();
//! let mut runs = BTreeMap::new();
//! run_all(&plan, &numbers, None, &|_| true, &mut |run| {
//!     runs.insert(run.number, run);
//!     Ok::<(), Error>(())
//! })?;
//!
//! let table = plan.table(&runs);
//! assert_eq!(table.wholes("vehicles"), Some(&[20, 40][..]));
//! assert_eq!(table.texts("outcome").unwrap(), ["end", "end"]);
//! # Ok::<(), Error>(())
//! ```

mod plan;
pub mod record;
mod rows;
mod run;
mod summary;

pub use crate::scenario::parameter_values::ParameterValues;
pub use plan::{MOST_RUNS, Plan};
pub use record::{Header, Shard};
pub use run::{Run, run_all};
