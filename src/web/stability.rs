//! What the page's stability tab asks for: the stability diagram, the characteristic roots, and the growth of every
//! mode, measured and predicted.

use super::laboratory::Lab;
use super::refusal;
use crate::format::json;
use crate::stability::stability_diagram;
use crate::web::types::{ModalGrowth, StabilityDiagram, StabilitySummary};
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::*;

/// Points of a curve, more than a picture of it has pixels.
const POINTS: usize = 400;
/// Modes whose roots are shown.
const MODES: usize = 200;
/// Modes with a curve in the stability diagram, more than can be told apart there.
const CURVES: usize = 100;

#[wasm_bindgen]
impl Lab {
    /// The diagram of the lane that the stability summary speaks of, and the numbers of vehicles of its curves.
    fn diagram_and_numbers(&mut self) -> (stability_diagram::StabilityDiagram, Vec<usize>) {
        let diagram = self.live.stability_diagram();
        (diagram, diagram.numbers(self.live.stability_summary().vehicles, POINTS))
    }

    /// The stability diagram of that lane: a `StabilityDiagram` as JSON.
    pub fn diagram(&mut self) -> String {
        let (diagram, numbers) = self.diagram_and_numbers();
        json::text(&StabilityDiagram::new(&diagram, numbers))
    }

    /// Critical reaction times of single modes (s), mode after mode, over the numbers of vehicles of the diagram:
    /// infinite beyond the jam, NaN where there is no such mode. Where there are very many modes, some of them,
    /// evenly spread.
    pub fn diagram_modes(&mut self, in_steps: bool) -> Vec<f64> {
        let (diagram, numbers) = self.diagram_and_numbers();
        let most = numbers.last().map_or(0, |n| n / 2);
        let modes = (1..=most).step_by(most.div_ceil(CURVES).max(1));
        modes.flat_map(|q| diagram.critical_of_mode(q, &numbers, diagram.time(in_steps))).collect()
    }

    /// The largest growth rate (1/s) with so many vehicles at `count` reaction times from 0 to `highest` s.
    pub fn growth_rates(&mut self, vehicles: usize, highest: f64, count: u32, in_steps: bool) -> Vec<f64> {
        let diagram = self.live.stability_diagram();
        let delays = (0..count).map(|k| highest * f64::from(k) / f64::from((count - 1).max(1)));
        diagram.growth_rates(vehicles, delays, diagram.time(in_steps))
    }

    /// The characteristic roots of that lane: `LaneRoots` as JSON.
    pub fn roots(&mut self) -> String {
        json::text(&self.live.roots(1, MODES))
    }

    /// Growth of each of its modes since the last change, measured and predicted: a `ModalGrowth` as JSON.
    pub fn modal_growth(&self) -> String {
        json::text(&ModalGrowth::of(&self.live))
    }

    /// What theory would say at that reaction time with so many vehicles on all lanes, or (`undefined`) with the
    /// vehicles where they are now: a `StabilitySummary` as JSON.
    pub fn preview_point(&self, vehicles: Option<String>, reaction_time: &str) -> Result<String, JsError> {
        let summary = self.live.preview_point(vehicles.as_deref(), reaction_time).map_err(refusal)?;
        Ok(json::text(&StabilitySummary::from(&summary)))
    }
}
