//! A run that is repeated to be measured, for a table as CSV. It is in the second module, which is loaded when a table is
//! first exported, since all probes belong to it.

use super::refusal;
use crate::measurement::Measurement;
use crate::measurement::probe::Probe;
use crate::measurement::provenance::run_to_csv;
use crate::scenario::Scenario;
use crate::simulation::Simulation;
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::*;

/// A run that is repeated from t = 0 to be measured, some steps at a time.
#[wasm_bindgen]
pub struct Export {
    simulation: Simulation,
    probe: Box<dyn Probe>,
    measurement: Measurement,
}

#[wasm_bindgen]
impl Export {
    /// Of a scenario (JSON) with a measurement (JSON).
    #[wasm_bindgen(constructor)]
    pub fn new(scenario: &str, measurement: &str) -> Result<Export, JsError> {
        let scenario = Scenario::from_json(scenario).map_err(refusal)?;
        let measurement = Measurement::from_json(measurement).map_err(refusal)?;
        let simulation = Simulation::new(&scenario).map_err(refusal)?;
        let mut probe = measurement.probe(&scenario).map_err(refusal)?;
        probe.observe(&simulation);
        Ok(Self { simulation, probe, measurement })
    }

    /// Takes at most so many steps. Returns the part that is done, 0 … 1.
    pub fn step(&mut self, steps: u32) -> f64 {
        for _ in 0..steps {
            if self.simulation.is_finished() {
                return 1.0;
            }
            self.simulation.step();
            self.probe.observe(&self.simulation);
        }
        let last = self.simulation.scenario().last_step().max(1);
        if self.simulation.is_finished() { 1.0 } else { self.simulation.step_index() as f64 / last as f64 }
    }

    /// The table as CSV, the same bytes as the command writes.
    pub fn csv(&self) -> String {
        run_to_csv(&self.probe.table(), self.simulation.scenario(), &self.measurement)
    }
}
