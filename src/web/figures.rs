//! The door of the WebAssembly module for the paper's figures: what there is, one piece of work at a time, and what
//! all pieces together give. Workers each do some pieces; any of them can put them together.

use super::refusal;
use crate::error::Error;
use crate::reproduction::claim::{Claim, ClaimVerdict};
use crate::reproduction::{FIGURES, Figure, Outcome, Size, Task, TaskResult};
use js_sys::Float64Array;
use serde_json::{Value, json};
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::*;

/// Every figure as JSON: identifier, title, caption, whether it goes beyond the paper, number of pieces.
#[wasm_bindgen]
pub fn figures() -> String {
    let one = |f: &Figure| {
        json!({
            "id": f.id,
            "title": f.title,
            "caption": f.caption,
            "beyond": f.beyond,
            "pieces": f.tasks(Size::Full).len(),
        })
    };
    Value::from(FIGURES.iter().map(one).collect::<Vec<_>>()).to_string()
}

/// One piece of a figure's work, counted from 0, in slices.
#[wasm_bindgen]
pub struct FigureWork(Box<dyn Task>);

#[wasm_bindgen]
impl FigureWork {
    /// Begins it.
    #[wasm_bindgen(constructor)]
    pub fn new(id: &str, piece: usize) -> Result<FigureWork, JsError> {
        let figure = Figure::named(id).map_err(refusal)?;
        let count = figure.tasks(Size::Full).len();
        if piece >= count {
            let allowed = format!("0 to {} for {id}", count - 1);
            return Err(refusal(Error::out_of_range("piece", piece, allowed)));
        }
        Ok(Self(figure.start(Size::Full, piece)))
    }

    /// Goes on for about so many updates of a vehicle; gives what came out when it is done.
    pub fn advance(&mut self, updates: u32) -> Option<Vec<f64>> {
        self.0.advance(updates.into()).map(|piece| piece.flat())
    }
}

/// A figure put together from all its pieces.
#[wasm_bindgen]
pub struct FigureOutcome(Outcome);

#[wasm_bindgen]
impl FigureOutcome {
    /// From the pieces in their order.
    #[wasm_bindgen(constructor)]
    pub fn new(id: &str, pieces: Vec<Float64Array>) -> Result<FigureOutcome, JsError> {
        let pieces: Result<Vec<_>, _> = pieces.iter().map(|p| TaskResult::from_flat(&p.to_vec())).collect();
        let figure = Figure::named(id).map_err(refusal)?;
        figure.assemble(Size::Full, &pieces.map_err(refusal)?).map(Self).map_err(refusal)
    }

    /// The picture, the same bytes as the command writes.
    pub fn svg(&self) -> String {
        self.0.plot.to_svg()
    }

    /// Where the axes of its panels lie and what they span, as JSON.
    pub fn fields(&self) -> String {
        serde_json::to_string(&self.0.plot.fields()).unwrap_or_default()
    }

    /// Number of tables.
    pub fn tables(&self) -> usize {
        self.0.tables.len()
    }

    /// Name of a table, which is that of its file without the ending.
    pub fn table_name(&self, table: usize) -> String {
        self.0.tables[table].name.clone()
    }

    /// A table as CSV, the same bytes as the command writes.
    pub fn csv(&self, table: usize) -> String {
        self.0.tables[table].to_csv()
    }

    /// The claims as JSON: claim, paper, ours, verdict (`agrees`, `differs`, `open`), method; numbers with units.
    pub fn claims(&self) -> String {
        let one = |c: &Claim| {
            let verdict = match c.verdict() {
                ClaimVerdict::Agrees => "agrees",
                ClaimVerdict::Differs => "differs",
                ClaimVerdict::NotDetermined => "open",
            };
            json!({
                "claim": c.claim,
                "paper": c.paper(),
                "ours": c.ours_in_words(),
                "verdict": verdict,
                "method": c.method_in_words(),
            })
        };
        Value::from(self.0.claims.iter().map(one).collect::<Vec<_>>()).to_string()
    }
}
