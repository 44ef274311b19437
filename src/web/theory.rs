//! What the page's stability tab asks for: curves, roots, and the growth of every mode.

use super::laboratory::{Lab, verdict};
use super::refusal;
use crate::json::{self, Json};
use crate::stability::plane::{curves, numbers};
use crate::table::Table;
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
        json::text(&curves(&scenario, numbers(&scenario, POINTS)))
    }

    /// The characteristic roots of the lane that the verdict speaks of, as JSON.
    pub fn roots(&mut self) -> String {
        json::text(&self.live.roots(1, MODES))
    }

    /// Growth of each of its modes since the last change, measured and predicted, as JSON.
    pub fn modal_growth(&self) -> String {
        let starts = self.live.modal_from();
        let modes: Json = match self.live.modal_growth() {
            Some(table) => modes(&table),
            None => Json::List(Vec::new()),
        };
        Json::object([("starts", starts.into()), ("modes", modes)]).to_string()
    }

    /// What theory would say with so many vehicles at that reaction time, as JSON.
    pub fn preview_point(&self, vehicles: &str, reaction_time: &str) -> Result<String, JsError> {
        self.live.preview_point(vehicles, reaction_time).map(|v| verdict(&v).to_string()).map_err(refusal)
    }
}

/// The rows of the table `growth`.
fn modes(table: &Table) -> Json {
    let column = |name: &str| table.floats(name).unwrap_or_default();
    let (rate, error) = (column("growth_rate_per_s"), column("standard_error_per_s"));
    let (predicted, from, to) = (column("predicted_per_s"), column("from_s"), column("to_s"));
    let ended_by = table.texts("ended_by").unwrap_or_default();
    let one = |k: usize| {
        Json::object([
            ("mode", (k + 1).into()),
            ("rate", rate[k].into()),
            ("standard_error", error[k].into()),
            ("predicted", predicted[k].into()),
            ("from", from[k].into()),
            ("to", to[k].into()),
            ("ended_by", ended_by[k].as_str().into()),
        ])
    };
    (0..table.rows()).map(one).collect()
}
