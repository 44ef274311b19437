//! A run that only steps, beside the watched one.

use super::refusal;
use crate::scenario::Scenario;
use crate::simulation::Simulation;
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::*;

/// A run that only steps: for many runs, and for measuring the time that a step takes.
#[wasm_bindgen]
pub struct Run {
    simulation: Simulation,
}

#[wasm_bindgen]
impl Run {
    /// A scenario (JSON) at t = 0.
    #[wasm_bindgen(constructor)]
    pub fn new(scenario: &str) -> Result<Run, JsError> {
        let scenario = Scenario::from_json(scenario).map_err(refusal)?;
        Ok(Self { simulation: Simulation::new(&scenario).map_err(refusal)? })
    }

    /// The same scenario with another seed, at t = 0.
    pub fn with_seed(&self, seed: u32) -> Result<Run, JsError> {
        let scenario = Scenario { seed: seed.into(), ..self.simulation.scenario().clone() };
        Ok(Self { simulation: Simulation::new(&scenario).map_err(refusal)? })
    }

    /// Takes at most so many steps. Returns how many were taken.
    pub fn step(&mut self, steps: u32) -> u32 {
        let before = self.simulation.step_index();
        self.simulation.run_to(before + u64::from(steps));
        (self.simulation.step_index() - before) as u32
    }

    /// Whether the run is over.
    pub fn finished(&self) -> bool {
        self.simulation.is_finished()
    }

    /// Displacements of all vehicles since t = 0, nudges after t = 0 included, m.
    pub fn displacements(&self) -> Vec<f64> {
        self.simulation.displacements().to_vec()
    }
}
