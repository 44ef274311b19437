//! What the page's stability tab asks for: curves, roots, and the growth of every mode.

use super::laboratory::{Lab, verdict};
use super::refusal;
use crate::format::json::{self, Json};
use crate::measurement::modal_growth::ModeGrowth;
use crate::stability::stability_diagram::StabilityDiagram;
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::*;

/// Points of a curve, more than a picture of it has pixels.
const POINTS: usize = 400;
/// Modes whose roots are shown.
const MODES: usize = 200;
/// Modes with a curve in the plane, more than can be told apart there.
const CURVES: usize = 100;

#[wasm_bindgen]
impl Lab {
    fn numbers(&mut self) -> (StabilityDiagram, Vec<usize>) {
        let plane = self.live.stability_diagram();
        (plane, plane.numbers(self.live.stability_summary().vehicles, POINTS))
    }

    /// The plane of the lane that the verdict speaks of: the number of vehicles beyond which it is a jam; the reaction
    /// time of its drivers, or of those without an exception; then numbers of vehicles, and as many critical reaction
    /// times (s) in continuous time, in steps, and by Newell's limit. What is not finite: every one is stable.
    pub fn plane(&mut self) -> Vec<f64> {
        let (plane, numbers) = self.numbers();
        let curves = plane.curves(numbers.iter().copied());
        let mut all = vec![plane.jam(), plane.driver.reaction_time];
        all.extend(numbers.iter().map(|&n| n as f64));
        for column in [curves.continuous_s, curves.discrete_s, curves.newell_s] {
            all.extend(column.into_iter().map(|tau| tau.unwrap_or(f64::INFINITY)));
        }
        all
    }

    /// Critical reaction times of single modes (s), mode after mode, over the same numbers of vehicles: infinite in
    /// the jam, NaN where there is no such mode. Of very many modes a choice, evenly spread.
    pub fn plane_modes(&mut self, in_steps: bool) -> Vec<f64> {
        let (plane, numbers) = self.numbers();
        let most = numbers.last().map_or(0, |n| n / 2);
        let modes = (1..=most).step_by(most.div_ceil(CURVES).max(1));
        modes.flat_map(|q| plane.critical_of_mode(q, &numbers, plane.time(in_steps))).collect()
    }

    /// The largest growth rate (1/s) with so many vehicles at `count` reaction times from 0 to `highest` s.
    pub fn growth_rates(&mut self, vehicles: usize, highest: f64, count: u32, in_steps: bool) -> Vec<f64> {
        let plane = self.live.stability_diagram();
        let delays = (0..count).map(|k| highest * f64::from(k) / f64::from((count - 1).max(1)));
        plane.growth_rates(vehicles, delays, plane.time(in_steps))
    }

    /// The characteristic roots of the lane that the verdict speaks of, as JSON.
    pub fn roots(&mut self) -> String {
        json::text(&self.live.roots(1, MODES))
    }

    /// Growth of each of its modes since the last change, measured and predicted, as JSON.
    pub fn modal_growth(&self) -> String {
        let starts = self.live.modal_from();
        let modes: Json = self.live.modal_growth().iter().map(mode).collect();
        Json::object([("starts", starts.into()), ("modes", modes)]).to_string()
    }

    /// What theory would say at that reaction time with so many vehicles on all lanes (none: where they are now), as JSON.
    pub fn preview_point(&self, vehicles: Option<String>, reaction_time: &str) -> Result<String, JsError> {
        self.live
            .preview_point(vehicles.as_deref(), reaction_time)
            .map(|v| verdict(&v).to_string())
            .map_err(refusal)
    }
}

/// Growth of one mode.
fn mode(growth: &ModeGrowth) -> Json {
    Json::object([
        ("mode", growth.mode.into()),
        ("rate", growth.rate.into()),
        ("standard_error", growth.standard_error.into()),
        ("predicted", growth.predicted.into()),
        ("nonlinear_bound", growth.nonlinear_bound.into()),
        ("from", growth.from.into()),
        ("to", growth.to.into()),
        ("ended_by", growth.ended_by.text().into()),
    ])
}
