//! Runs beside the watched one: a run that is repeated to be measured, and a run that only steps.

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
    /// Of a scenario (JSON) with a measurement (JSON) that the page offers.
    #[wasm_bindgen(constructor)]
    pub fn new(scenario: &str, measurement: &str) -> Result<Export, JsError> {
        let scenario = Scenario::from_json(scenario).map_err(refusal)?;
        let measurement = Measurement::from_json(measurement).map_err(refusal)?;
        let simulation = Simulation::new(&scenario).map_err(refusal)?;
        let mut probe = measurement.probe_of_page(&scenario).map_err(refusal)?;
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
