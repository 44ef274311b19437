//! The paper's figures, and some beyond the paper: each is made of scenarios and measurements alone, and gives tables,
//! a picture and claims.
//!
//! | file | what it holds |
//! |---|---|
//! | this one | the list of figures |
//! | [`figure`] | what a figure is, and how it comes from its tasks |
//! | [`task`] | the units of work of a figure and their results |
//! | [`claim`] | a claim of the paper beside our value, with a verdict that is computed |
//! | `shared` | what several figures share |
//! | `cyclic`, `wave_analysis` | the cyclic growth rate k under every choice that the paper leaves open; waves in a map of speeds |
//! | the others | one figure each |
//!
//! Run k of a figure with random draws has seed k, counted from 1.
//!
//! ```
//! use ringroad::reproduction::{Figure, Size};
//!
//! let outcome = Figure::named("fundamental-diagram")?.outcome(Size::Small, &|| {});
//! assert!(outcome.plot.to_svg().starts_with("<svg"));
//! assert_eq!(outcome.tables[0].name, "fundamental-diagram-speed");
//! let claim = &outcome.claims[0];
//! assert_eq!((claim.paper(), claim.ours_in_words()), ("2065 ± 0.5 veh/h".into(), "2065 veh/h".into()));
//! assert_eq!(claim.verdict().to_string(), "agrees");
//! # Ok::<(), ringroad::error::Error>(())
//! ```

mod aggressive_driver;
mod aggressive_gain;
pub mod claim;
mod cyclic;
pub mod figure;
mod frustration_flow;
mod fundamental_diagram;
mod load_balance;
mod shared;
mod stability;
pub mod task;
mod wave_analysis;
mod waves;

pub use figure::{Figure, FigureTable, Outcome};
pub use task::{Size, Task, TaskResult};

use crate::error::{Error, quoted};

/// Every figure: first those of the paper in its order, then those beyond it.
pub static FIGURES: [Figure; 7] = [
    fundamental_diagram::FIGURE,
    waves::FIGURE,
    stability::FIGURE,
    load_balance::FIGURE,
    aggressive_driver::FIGURE,
    aggressive_gain::FIGURE,
    frustration_flow::FIGURE,
];

impl Figure {
    /// The figure of that identifier.
    ///
    /// # Errors
    /// If there is none; the error lists the identifiers.
    pub fn named(id: &str) -> Result<&'static Self, Error> {
        FIGURES.iter().find(|f| f.id == id).ok_or_else(|| {
            let ids: Vec<_> = FIGURES.iter().map(|f| f.id).collect();
            Error::unknown("figure", quoted(id), format!("{} or all", ids.join(", ")))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_figure_and_a_missing_result_are_refused_by_name() {
        let message = Figure::named("figure-9").unwrap_err().to_string();
        assert!(message.contains("figure-9") && message.contains("load-balance"), "{message}");
        let message = FIGURES[0].assemble(Size::Small, &[]).unwrap_err().to_string();
        assert!(message.contains("task results") && message.contains("fundamental-diagram"), "{message}");
    }
}
