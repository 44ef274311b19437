//! What the page's stability tab asks for: curves, roots, and the growth of every mode.

use super::laboratory::{Lab, verdict};
use super::refusal;
use crate::stability::plane::{curves, numbers};
use serde_json::json;
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::*;

/// Points of a curve, more than a picture of it has pixels.
const POINTS: usize = 400;
/// Modes whose roots are shown.
const MODES: usize = 200;

#[wasm_bindgen]
impl Lab {
    /// Critical reaction times over the number of vehicles, for drivers like those without an exception now, as JSON.
    pub fn plane(&self) -> String {
        let scenario = self.live.settled();
        serde_json::to_string(&curves(&scenario, numbers(&scenario, POINTS))).unwrap_or_default()
    }

    /// The characteristic roots of the lane that the verdict speaks of, as JSON.
    pub fn roots(&mut self) -> String {
        serde_json::to_string(&self.live.roots(1, MODES)).unwrap_or_default()
    }

    /// Growth of each of its modes since the last change, measured and predicted, as JSON.
    pub fn modal_growth(&self) -> String {
        let starts = self.live.modal_from();
        let Some(table) = self.live.modal_growth() else {
            return json!({ "starts": starts, "modes": [] }).to_string();
        };
        let column = |name: &str| table.floats(name).unwrap_or_default();
        let (rate, error) = (column("growth_rate_per_s"), column("standard_error_per_s"));
        let (predicted, from, to) = (column("predicted_per_s"), column("from_s"), column("to_s"));
        let ended_by = table.texts("ended_by").unwrap_or_default();
        let one = |k: usize| {
            json!({
                "mode": k + 1,
                "rate": rate[k],
                "standard_error": error[k],
                "predicted": predicted[k],
                "from": from[k],
                "to": to[k],
                "ended_by": ended_by[k],
            })
        };
        let modes: Vec<_> = (0..table.rows()).map(one).collect();
        json!({ "starts": starts, "modes": modes }).to_string()
    }

    /// What theory would say with so many vehicles at that reaction time, as JSON.
    pub fn preview_point(&self, vehicles: &str, reaction_time: &str) -> Result<String, JsError> {
        self.live.preview_point(vehicles, reaction_time).map(|v| verdict(&v).to_string()).map_err(refusal)
    }
}
