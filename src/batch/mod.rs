//! Batches: many runs of one scenario with different seeds (Monte Carlo) and with parameters varied over a grid.
//!
//! A [`Plan`] is plain data; it numbers its runs, and [`Plan::run`] gives any of them by itself. So the runs can be
//! computed in any order, on any number of threads, workers or machines; a table is made from the [`Run`]s sorted by
//! number, and its bytes depend on the plan alone.
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
//! | [`plan`] | which runs there are |
//! | [`run`] | computing them, one or all |
//! | [`rows`] | a row a run |
//! | [`summary`] | what the runs of a cell say together |
//! | [`record`] | finished runs as text: to continue, to spread and to merge |

pub mod plan;
pub mod record;
pub mod rows;
pub mod run;
pub mod summary;

pub use crate::scenario::parameter_values::ParameterValues;
pub use plan::Plan;
pub use record::{Header, Shard};
pub use run::{Run, run_all};
