//! The WebAssembly module of the paper's figures: the list of figures, one task of a figure at a time, and a figure
//! assembled from the results of all its tasks. Several workers may each do some tasks; any of them can assemble.

use super::refusal;
use crate::error::Error;
use crate::format::json;
use crate::reproduction::{FIGURES, Figure, Outcome, Size, Task, TaskResult};
use crate::web::types::{Claim, FigureInfo};
use js_sys::Float64Array;
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::*;

/// Every figure: a list of `FigureInfo` as JSON.
#[wasm_bindgen]
pub fn figures() -> String {
    json::text(&FIGURES.iter().map(FigureInfo::from).collect::<Vec<_>>())
}

/// One task of a figure, done in slices.
#[wasm_bindgen]
pub struct FigureTask(Box<dyn Task>);

#[wasm_bindgen]
impl FigureTask {
    /// Begins task number `task`, counted from 0, of a figure.
    #[wasm_bindgen(constructor)]
    pub fn new(id: &str, task: usize) -> Result<FigureTask, JsError> {
        let figure = Figure::named(id).map_err(refusal)?;
        let count = figure.tasks(Size::Full).len();
        if task >= count {
            let allowed = format!("0 to {} for {id}", count - 1);
            return Err(refusal(Error::out_of_range("task", task, allowed)));
        }
        Ok(Self(figure.start(Size::Full, task)))
    }

    /// Continues for about so many updates of a vehicle. Returns the result when the task is done.
    pub fn advance(&mut self, updates: u32) -> Option<Vec<f64>> {
        self.0.advance(updates.into()).map(|result| result.flat())
    }
}

/// A figure assembled from the results of all its tasks.
#[wasm_bindgen]
pub struct FigureOutcome(Outcome);

#[wasm_bindgen]
impl FigureOutcome {
    /// From the results in the order of the tasks.
    #[wasm_bindgen(constructor)]
    pub fn new(id: &str, results: Vec<Float64Array>) -> Result<FigureOutcome, JsError> {
        let results: Result<Vec<_>, _> = results.iter().map(|r| TaskResult::from_flat(&r.to_vec())).collect();
        let figure = Figure::named(id).map_err(refusal)?;
        figure.assemble(Size::Full, &results.map_err(refusal)?).map(Self).map_err(refusal)
    }

    /// The picture, the same bytes as the command writes.
    pub fn svg(&self) -> String {
        self.0.plot.to_svg()
    }

    /// The axes of its panels and what can be read there: a list of `Field` as JSON.
    pub fn fields(&self) -> String {
        json::text(&self.0.plot.fields())
    }

    /// Number of tables.
    pub fn tables(&self) -> usize {
        self.0.tables.len()
    }

    /// Name of a table: that of its file without the ending.
    pub fn table_name(&self, table: usize) -> String {
        self.0.tables[table].name.clone()
    }

    /// A table as CSV, the same bytes as the command writes.
    pub fn csv(&self, table: usize) -> String {
        self.0.tables[table].to_csv()
    }

    /// The claims of the paper beside what was measured: a list of `Claim` as JSON.
    pub fn claims(&self) -> String {
        json::text(&self.0.claims.iter().map(Claim::from).collect::<Vec<_>>())
    }
}
