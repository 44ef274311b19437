//! The laboratory of the page: the watched run, what is done to it, what is read from it, and its map.
//!
//! Methods that say "as JSON" return a value of that name of [`crate::web::types`].

use super::map_painter::{MapPainter, MapSettings};
use super::refusal;
use crate::format::json;
use crate::live::{BINS, COLUMNS, Live, opening};
use crate::measurement::provenance::{VERSION, scenario_of_file};
use crate::plot::colour::{Ground, Quantity, Scale};
use crate::scenario::Scenario;
use crate::scenario::action::Action;
use crate::scenario::link;
use crate::scenario::presets;
use crate::simulation::Simulation;
use crate::simulation::frustration::attempt_probability;
use crate::web::types::{ColourBar, ColourBars, FrameState, Snapshot, StabilitySummary, Start, quantity};
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::*;
use web_sys::{OffscreenCanvas, OffscreenCanvasRenderingContext2d};

/// What the page needs once: `Start` as JSON.
#[wasm_bindgen]
pub fn start() -> String {
    json::text(&Start::new(COLUMNS, BINS))
}

/// One watched run and the map that shows it.
#[wasm_bindgen]
pub struct Lab {
    pub(super) live: Live,
    /// Grows with every run that begins.
    epoch: u64,
    map: MapPainter,
    /// What the colour of the vehicles stands for.
    quantity: Quantity,
    /// Background of the page.
    ground: Ground,
}

#[wasm_bindgen]
impl Lab {
    /// A laboratory with the opening scenario.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Result<Lab, JsError> {
        let live = Live::new(&opening()).map_err(refusal)?;
        Ok(Self {
            live,
            epoch: 0,
            map: MapPainter::default(),
            quantity: Quantity::Difference,
            ground: Ground::Light,
        })
    }

    // ---- What is open ------------------------------------------------------------------------------------------

    /// Opens the part of a link after `#`; an empty one means the opening scenario. Returns the errors of the entries
    /// that could not be used: a JSON list of sentences.
    pub fn open_link(&mut self, text: &str) -> Result<String, JsError> {
        if text.trim_start_matches('#').is_empty() {
            self.open(&opening())?;
            return Ok("[]".into());
        }
        let reading = link::parse(text);
        self.open(&reading.scenario)?;
        let messages: Vec<_> = reading.refused.iter().map(|(_, e)| e.to_string()).collect();
        Ok(json::text(&messages))
    }

    /// Opens the text of a file: a scenario as JSON, or a table that the program wrote. Returns warnings: a JSON list
    /// of sentences.
    pub fn open_file(&mut self, text: &str) -> Result<String, JsError> {
        let (scenario, version) = scenario_of_file(text).map_err(refusal)?;
        self.open(&scenario)?;
        let message = version.filter(|version| version != VERSION).map(|version| {
            format!(
                "The file was written by version {version}; this is {VERSION}, and runs are promised to repeat within a version only."
            )
        });
        Ok(json::text(&message.as_slice()))
    }

    /// Opens a preset with the end of the run put off as far as in a link without an end.
    pub fn open_preset(&mut self, name: &str) -> Result<String, JsError> {
        let mut scenario = presets::preset(name).map_err(refusal)?.scenario;
        scenario.until = link::base().until;
        self.open(&scenario)?;
        Ok("[]".into())
    }

    fn open(&mut self, scenario: &Scenario) -> Result<(), JsError> {
        self.replace(Live::new(scenario).map_err(refusal)?);
        Ok(())
    }

    fn replace(&mut self, live: Live) {
        self.live = live;
        self.began();
    }

    /// Another run has begun.
    fn began(&mut self) {
        self.epoch += 1;
        self.map.clear();
    }

    // ---- What is done to it ------------------------------------------------------------------------------------

    /// Takes at most so many steps. Returns how many were taken.
    pub fn step(&mut self, steps: u32) -> u32 {
        self.live.step(steps)
    }

    /// An action now, `VEHICLES:EFFECT` in the grammar of actions: `7:brake=3`.
    pub fn act(&mut self, text: &str) -> Result<(), JsError> {
        self.live.act(Action::at(0.0, text).map_err(refusal)?).map_err(refusal)
    }

    /// Sets a parameter by name: a driver's from now on, any other by starting again.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), JsError> {
        if self.live.set(name, text).map_err(refusal)? {
            self.began();
        }
        Ok(())
    }

    /// What theory would say after [`Self::set`]: `StabilitySummary` as JSON.
    pub fn preview(&self, name: &str, text: &str) -> Result<String, JsError> {
        let summary = self.live.preview(name, text).map_err(refusal)?;
        Ok(json::text(&StabilitySummary::from(&summary)))
    }

    /// Back to t = 0 with all actions.
    pub fn rewind(&mut self) -> Result<(), JsError> {
        self.restart(true)
    }

    /// Back to t = 0, with all actions or with those at t = 0 only.
    pub fn restart(&mut self, keep_actions: bool) -> Result<(), JsError> {
        self.replace(self.live.restarted(keep_actions).map_err(refusal)?);
        Ok(())
    }

    /// Back to t = 0 without one action; `index` is its place in the list, from 0.
    pub fn remove_action(&mut self, index: usize) -> Result<(), JsError> {
        self.replace(self.live.without(index).map_err(refusal)?);
        Ok(())
    }

    /// Puts the end of the run off as far as in a link without an end.
    pub fn extend(&mut self) -> Result<(), JsError> {
        self.live.set_until(link::base().until).map_err(refusal)
    }

    // ---- Reading -----------------------------------------------------------------------------------------------

    /// What changes by actions and settings only: `Snapshot` as JSON.
    pub fn snapshot(&mut self) -> String {
        json::text(&Snapshot::of(&mut self.live, COLUMNS))
    }

    /// The state of the run apart from the values for every vehicle: `FrameState` as JSON. It holds what was recorded
    /// since this was last asked.
    pub fn take_state(&mut self) -> String {
        json::text(&FrameState::take(&mut self.live, self.epoch))
    }

    /// The scenario as JSON with the end of the run at the present time, to repeat the run so far.
    pub fn scenario_so_far(&self) -> String {
        self.live.so_far().to_json()
    }

    /// Steps taken. (Exact: a run has fewer than 2^53.)
    pub fn step_index(&self) -> f64 {
        self.live.simulation().step_index() as f64
    }
    /// The step of a time in seconds.
    pub fn step_at(&self, time: f64) -> f64 {
        let scenario = self.live.simulation().scenario();
        scenario.steps(time.max(0.0)).min(scenario.last_step()) as f64
    }

    /// A number for each vehicle. (A function pointer instead of a generic function: one loop makes a smaller module.)
    fn each(&self, value: fn(&Simulation, usize) -> f64) -> Vec<f64> {
        let simulation = self.live.simulation();
        (0..simulation.vehicles()).map(|j| value(simulation, j)).collect()
    }
    /// Positions, m.
    pub fn positions(&self) -> Vec<f64> {
        self.each(Simulation::position)
    }
    /// Speeds, m/s.
    pub fn speeds(&self) -> Vec<f64> {
        self.live.simulation().speeds().to_vec()
    }
    /// True headways, m.
    pub fn headways(&self) -> Vec<f64> {
        self.each(Simulation::headway)
    }
    /// Perceived headways, m.
    pub fn perceived_headways(&self) -> Vec<f64> {
        self.each(Simulation::perceived_headway)
    }
    /// Frustrations φ.
    pub fn frustrations(&self) -> Vec<f64> {
        self.each(Simulation::frustration)
    }
    /// P(φ), the probability of an attempt to change lanes within one second.
    pub fn attempt_probabilities(&self) -> Vec<f64> {
        self.each(|s, j| attempt_probability(s.frustration(j)))
    }
    /// Distances driven, m.
    pub fn distances(&self) -> Vec<f64> {
        self.each(Simulation::distance)
    }
    /// Lanes, from 0.
    pub fn lanes(&self) -> Vec<f64> {
        self.each(|s, j| s.lane(j) as f64)
    }
    /// Lane changes since the start.
    pub fn lane_changes(&self) -> Vec<f64> {
        self.each(|s, j| f64::from(s.lane_changes(j)))
    }
    /// Lengths of the vehicles, m.
    pub fn lengths(&self) -> Vec<f64> {
        self.each(|s, j| s.driver(j).vehicle_length)
    }
    /// Minimum headways, m.
    pub fn min_headways(&self) -> Vec<f64> {
        self.each(|s, j| s.driver(j).min_headway)
    }
    /// Red, green, blue of every vehicle.
    pub fn colours(&self) -> Vec<u8> {
        let (s, equilibrium) = (self.live.simulation(), self.live.equilibrium().speed);
        let scale = Scale::new(self.quantity, self.ground, equilibrium);
        let value = |j: usize| match self.quantity {
            Quantity::Difference => s.speed(j) - equilibrium,
            Quantity::Speed => s.speed(j),
            Quantity::Frustration => s.frustration(j),
        };
        let mut colours = Vec::with_capacity(3 * s.vehicles());
        for j in 0..s.vehicles() {
            colours.extend(scale.colour(value(j)));
        }
        colours
    }

    // ---- Colours and the map -----------------------------------------------------------------------------------

    /// Chooses what colour stands for: on the ring (`difference`, `speed`, `frustration`) and in the map
    /// (`difference`, `speed`); the lane of the map, from 0, and whether it is drawn in the co-moving frame.
    /// Returns `ColourBars` as JSON.
    pub fn view(
        &mut self,
        ring: &str,
        map: &str,
        dark: bool,
        lane: usize,
        co_moving: bool,
    ) -> Result<String, JsError> {
        let (ring, map) = (quantity(ring).map_err(refusal)?, quantity(map).map_err(refusal)?);
        let ground = if dark { Ground::Dark } else { Ground::Light };
        (self.quantity, self.ground) = (ring, ground);
        self.map.set(MapSettings { quantity: map, ground, lane, co_moving });
        let bar = |quantity| ColourBar::new(quantity, ground, self.live.equilibrium().speed);
        Ok(json::text(&ColourBars { ring: bar(ring), map: bar(map) }))
    }

    /// Draws the map on a canvas, which must have the size that [`start`] says.
    pub fn attach(&mut self, canvas: OffscreenCanvas) -> Result<(), JsError> {
        let context = canvas.get_context("2d").ok().flatten();
        let context = context.and_then(|c| c.dyn_into::<OffscreenCanvasRenderingContext2d>().ok());
        let context =
            context.ok_or_else(|| JsError::new("this browser cannot draw on an OffscreenCanvas"))?;
        self.map.attach(canvas, context);
        Ok(())
    }

    /// Draws the columns of the map that are new.
    pub fn paint(&mut self) -> Result<(), JsError> {
        self.map.paint(&self.live).map_err(|e| JsError::new(&format!("{e:?}")))
    }

    /// What the map shows in a column (from its left edge) and a cell (from x = 0 up): `MapReading` as JSON, or `null`.
    pub fn reading(&self, column: usize, bin: usize) -> String {
        json::text(&self.map.reading(&self.live, column, bin))
    }
}
