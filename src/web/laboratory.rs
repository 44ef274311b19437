//! The door of the laboratory: the watched run and its map, the tables that are exported from it, and runs that
//! only step.

use super::refusal;
use crate::error::{Error, quoted};
use crate::format::json::{self, Json, Object};
use crate::live::{BINS, COLUMNS, Column, Live, opening};
use crate::measurement::Measurement;
use crate::measurement::probe::Probe;
use crate::measurement::provenance::{VERSION, run_to_csv, scenario_of_file};
use crate::plot::colour::{Ground, Quantity, Rgb, Scale};
use crate::scenario::Scenario;
use crate::scenario::action::Action;
use crate::scenario::link;
use crate::scenario::parameters::{Field, PARAMETERS};
use crate::scenario::presets;
use crate::simulation::Simulation;
use crate::stability::summary::StabilitySummary;
use wasm_bindgen::prelude::*;
use wasm_bindgen::{Clamped, JsError};
use web_sys::{ImageData, OffscreenCanvas, OffscreenCanvasRenderingContext2d};

/// The table of parameters, as JSON.
#[wasm_bindgen]
pub fn parameters() -> String {
    json::text(&PARAMETERS.as_slice())
}

/// The presets with their texts, as JSON.
#[wasm_bindgen]
pub fn presets() -> String {
    json::text(&presets::presets())
}

/// Version of the program.
#[wasm_bindgen]
pub fn version() -> String {
    VERSION.into()
}

/// The laboratory behind a page: one watched run and the map that shows it.
#[wasm_bindgen]
pub struct Lab {
    pub(super) live: Live,
    /// Grows with every run that begins.
    epoch: u32,
    map: Painter,
    ring: Quantity,
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
            map: Painter::default(),
            ring: Quantity::Difference,
            ground: Ground::Light,
        })
    }

    // ---- What is open ------------------------------------------------------------------------------------------

    /// Opens the part of a link after `#`; an empty one means the opening scenario. Returns what could not be
    /// used, as a JSON list of sentences.
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

    /// Opens the text of a file: a scenario as JSON, or a table that the program wrote.
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

    /// Opens a preset; its end is open.
    pub fn open_preset(&mut self, name: &str) -> Result<String, JsError> {
        let found = presets::presets().into_iter().find(|p| p.name == name);
        let mut scenario = found
            .ok_or_else(|| refusal(Error::unknown("preset", quoted(name), "a name of the list")))?
            .scenario;
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

    /// Another run: nothing of the old picture stays.
    fn began(&mut self) {
        self.epoch += 1;
        self.map.painted = None;
    }

    // ---- What is done to it ------------------------------------------------------------------------------------

    /// At most so many steps. Returns how many were taken.
    pub fn step(&mut self, steps: u32) -> u32 {
        self.live.step(steps)
    }

    /// Does something now, `WHO:EFFECT` in the grammar of actions: `7:brake=3`.
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

    /// What theory would say after [`Self::set`], as JSON.
    pub fn preview(&self, name: &str, text: &str) -> Result<String, JsError> {
        self.live.preview(name, text).map(|v| verdict(&v).to_string()).map_err(refusal)
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

    /// Back to t = 0 without one action, by its place in the list from 0.
    pub fn remove_action(&mut self, index: usize) -> Result<(), JsError> {
        self.replace(self.live.without(index).map_err(refusal)?);
        Ok(())
    }

    /// Opens the end of the run.
    pub fn extend(&mut self) -> Result<(), JsError> {
        self.live.set_until(link::base().until).map_err(refusal)
    }

    // ---- Reading -----------------------------------------------------------------------------------------------

    /// What changes by actions and settings only, as JSON.
    pub fn snapshot(&mut self) -> String {
        let said = verdict(self.live.stability_summary());
        let live = &self.live;
        let scenario = live.simulation().scenario();
        let now = live.settled().driver;
        let mut driver = Object::default();
        for parameter in &PARAMETERS {
            if let Field::Driver(field) = parameter.field {
                driver.insert(parameter.name, now.value(field));
            }
        }
        let watched: Json = live.watched().iter().map(|j| j + 1).collect();
        Json::object([
            ("scenario", scenario.tree()),
            ("link", link::format(scenario).into()),
            ("driver", driver.into()),
            ("verdict", said),
            ("watched", watched),
            ("interval", live.interval().into()),
            ("flow_window", live.flow_window().into()),
            ("mean_equilibrium_speed", live.equilibrium().speed.into()),
            ("changes", live.changes().into()),
            ("epoch", f64::from(self.epoch).into()),
        ])
        .to_string()
    }

    /// The scenario as JSON, ended now: what a table of the run so far is made from.
    pub fn scenario_so_far(&self) -> String {
        self.live.so_far().to_json()
    }

    /// t, s.
    pub fn time(&self) -> f64 {
        self.live.simulation().time()
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
    /// Whether the run is over.
    pub fn finished(&self) -> bool {
        self.live.simulation().is_finished()
    }
    /// Which run this is; it grows when one begins anew.
    pub fn epoch(&self) -> u32 {
        self.epoch
    }
    /// Grows when the verdict or the drivers have changed.
    pub fn changes(&self) -> f64 {
        self.live.changes() as f64
    }
    /// The collision that ended the run as JSON, or `null`.
    pub fn collision(&self) -> String {
        let one = |c: crate::simulation::Collision| {
            Json::object([
                ("time", c.time.into()),
                ("behind", c.behind.into()),
                ("ahead", c.ahead.into()),
                ("lane", c.lane.into()),
            ])
        };
        Json::from(self.live.simulation().collision().map(one)).to_string()
    }
    /// The growth measured so far as JSON, or `null`.
    pub fn growth(&self) -> String {
        let one = |g: crate::live::MeasuredGrowth| {
            Json::object([
                ("rate", g.rate.into()),
                ("standard_error", g.standard_error.into()),
                ("nonlinear_bound", g.nonlinear_bound.into()),
                ("window", g.window.into()),
                ("mode", g.mode.into()),
            ])
        };
        Json::from(self.live.growth().map(one)).to_string()
    }

    /// Whether waves are too large now for linear theory.
    pub fn large_waves(&self) -> bool {
        self.live.is_large()
    }

    /// A number for each vehicle. (Called through a pointer: one loop for all of them downloads faster.)
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
    /// Headways as the drivers see them, m.
    pub fn perceived_headways(&self) -> Vec<f64> {
        self.each(Simulation::perceived_headway)
    }
    /// φ.
    pub fn frustrations(&self) -> Vec<f64> {
        self.each(Simulation::frustration)
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
    /// Lengths of the vehicles and their minimum headways, m, one pair after another.
    pub fn sizes(&self) -> Vec<f64> {
        let s = self.live.simulation();
        let mut sizes = Vec::with_capacity(2 * s.vehicles());
        for j in 0..s.vehicles() {
            sizes.extend([s.driver(j).vehicle_length, s.driver(j).min_headway]);
        }
        sizes
    }
    /// Red, green, blue of every vehicle.
    pub fn colours(&self) -> Vec<u8> {
        let (s, rest) = (self.live.simulation(), self.live.equilibrium().speed);
        let scale = Scale::new(self.ring, self.ground, rest);
        let value = |j: usize| match self.ring {
            Quantity::Difference => s.speed(j) - rest,
            Quantity::Speed => s.speed(j),
            Quantity::Frustration => s.frustration(j),
        };
        let mut colours = Vec::with_capacity(3 * s.vehicles());
        for j in 0..s.vehicles() {
            colours.extend(scale.colour(value(j)));
        }
        colours
    }
    /// Rows since this was last asked: time (s), mean speed (m/s), flow (veh/s), ΔN, speeds of the watched
    /// vehicles (m/s), row after row.
    pub fn take_rows(&mut self) -> Vec<f64> {
        self.live.take_rows()
    }

    // ---- The map -----------------------------------------------------------------------------------------------

    /// Columns of the map's canvas.
    pub fn map_columns(&self) -> u32 {
        COLUMNS as u32
    }
    /// Rows of the map's canvas.
    pub fn map_bins(&self) -> u32 {
        BINS as u32
    }

    /// Chooses what colours stand for: on the ring (`difference`, `speed`, `frustration`) and in the map
    /// (`difference`, `speed`); the lane of the map from 0, and whether it rides along at the equilibrium speed.
    /// Returns both colour bars as JSON.
    pub fn view(
        &mut self,
        ring: &str,
        map: &str,
        dark: bool,
        lane: usize,
        riding: bool,
    ) -> Result<String, JsError> {
        self.ring = quantity(ring)?;
        self.ground = if dark { Ground::Dark } else { Ground::Light };
        let rest = self.live.equilibrium().speed;
        let map = Settings { quantity: quantity(map)?, ground: self.ground, lane, riding };
        if map != self.map.settings {
            self.map.settings = map;
            self.map.painted = None;
        }
        let bar = |quantity| {
            let scale = Scale::new(quantity, self.ground, rest);
            let tick =
                |value: f64| Json::object([("value", value.into()), ("place", scale.place(value).into())]);
            let ticks: Json = scale.ticks().into_iter().map(tick).collect();
            let colours: Json = scale.colours().iter().step_by(8).flatten().map(|&c| f64::from(c)).collect();
            Json::object([("colours", colours), ("ticks", ticks)])
        };
        Ok(Json::object([("ring", bar(self.ring)), ("map", bar(map.quantity))]).to_string())
    }

    /// Gives the map a canvas of [`Self::map_columns`] by [`Self::map_bins`].
    pub fn attach(&mut self, canvas: OffscreenCanvas) -> Result<(), JsError> {
        let context = canvas.get_context("2d").ok().flatten();
        let context = context.and_then(|c| c.dyn_into::<OffscreenCanvasRenderingContext2d>().ok());
        let context =
            context.ok_or_else(|| JsError::new("this browser cannot draw on an OffscreenCanvas"))?;
        self.map.canvas = Some((canvas, context));
        self.map.painted = None;
        Ok(())
    }

    /// Paints what is new on the map; a new column costs a column.
    pub fn paint(&mut self) -> Result<(), JsError> {
        self.map.paint(&self.live).map_err(|e| JsError::new(&format!("{e:?}")))
    }

    /// What the map shows in a column (from its left edge) and a cell (from x = 0 up), as JSON, or `null`.
    pub fn probe(&self, column: usize, bin: usize) -> String {
        let Some(shown) = self.live.columns().get(column).filter(|_| bin < BINS) else {
            return "null".into();
        };
        let settings = &self.map.settings;
        let cell = (bin + settings.offset(shown, self.live.simulation().scenario().length)) % BINS;
        let speed = shown.speeds.get(settings.lane * BINS + cell).copied().unwrap_or(f32::NAN);
        let width = self.live.simulation().scenario().length / BINS as f64;
        Json::object([
            ("time", shown.time.into()),
            ("position", ((cell as f64 + 0.5) * width).into()),
            ("speed", f64::from(speed).into()),
            ("equilibrium", shown.equilibrium.into()),
        ])
        .to_string()
    }
}

fn quantity(name: &str) -> Result<Quantity, JsError> {
    match name {
        "difference" => Ok(Quantity::Difference),
        "speed" => Ok(Quantity::Speed),
        "frustration" => Ok(Quantity::Frustration),
        other => Err(refusal(Error::unknown("colour", quoted(other), "difference, speed, frustration"))),
    }
}

pub(super) fn verdict(v: &StabilitySummary) -> Json {
    Json::object([
        ("stable", v.stable.into()),
        ("alike", v.homogeneous.into()),
        ("reaction_time", v.reaction_time.into()),
        ("critical", v.critical.into()),
        ("critical_discrete", v.critical_discrete.into()),
        ("scale", v.scale.into()),
        ("rate", v.rate.into()),
        ("mode", v.mode.into()),
        ("equilibrium_speed", v.equilibrium.speed.into()),
        ("flow", v.equilibrium.flow.into()),
        ("density", v.equilibrium.density.into()),
        ("lane", v.lane.into()),
        ("vehicles", v.vehicles.into()),
    ])
}

/// How the map is painted.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Settings {
    quantity: Quantity,
    ground: Ground,
    lane: usize,
    riding: bool,
}

impl Settings {
    /// Cells by which a map that rides along has moved.
    fn offset(&self, column: &Column, length: f64) -> usize {
        if !self.riding {
            return 0;
        }
        let laps = column.equilibrium * column.time / length;
        ((laps - laps.floor()) * BINS as f64) as usize % BINS
    }
}

/// Paints columns of the map on its canvas, the newest at the right edge once the canvas is full.
struct Painter {
    canvas: Option<(OffscreenCanvas, OffscreenCanvasRenderingContext2d)>,
    settings: Settings,
    /// Number of columns made when it was last painted; none if nothing of it can stay.
    painted: Option<u64>,
}

impl Default for Painter {
    fn default() -> Self {
        let settings =
            Settings { quantity: Quantity::Difference, ground: Ground::Light, lane: 0, riding: false };
        Self { canvas: None, settings, painted: None }
    }
}

impl Painter {
    fn paint(&mut self, live: &Live) -> Result<(), JsValue> {
        let Some((canvas, context)) = &self.canvas else { return Ok(()) };
        let (made, kept) = (live.columns_made(), live.columns().len());
        let new = if let Some(painted) = self.painted {
            (made - painted).min(kept as u64) as usize
        } else {
            context.clear_rect(0.0, 0.0, COLUMNS as f64, BINS as f64);
            kept
        };
        if new == 0 {
            return Ok(());
        }
        // What is there moves to the left by as many columns as have left the window.
        let before = kept - new;
        let leaving =
            self.painted.map_or(0, |painted| (painted.min(COLUMNS as u64) as usize).saturating_sub(before));
        if leaving > 0 {
            context.draw_image_with_offscreen_canvas(canvas, -(leaving as f64), 0.0)?;
        }
        let pixels = self.pixels(live, before, new);
        let image = ImageData::new_with_u8_clamped_array_and_sh(Clamped(&pixels), new as u32, BINS as u32)?;
        context.put_image_data(&image, before as f64, 0.0)?;
        self.painted = Some(made);
        Ok(())
    }

    /// Red, green, blue, opacity of `new` columns from `first` on, row by row from the top (x = L).
    fn pixels(&self, live: &Live, first: usize, new: usize) -> Vec<u8> {
        let length = live.simulation().scenario().length;
        let scale = Scale::new(self.settings.quantity, self.settings.ground, live.equilibrium().speed);
        let mut pixels = vec![0; 4 * new * BINS];
        for (k, column) in live.columns().iter().skip(first).enumerate() {
            let Some(cells) = column.speeds.chunks_exact(BINS).nth(self.settings.lane) else { continue };
            let offset = self.settings.offset(column, length);
            for row in 0..BINS {
                let speed = f64::from(cells[(BINS - 1 - row + offset) % BINS]);
                if speed.is_nan() {
                    continue;
                }
                let value = match self.settings.quantity {
                    Quantity::Difference => speed - column.equilibrium,
                    _ => speed,
                };
                let [r, g, b]: Rgb = scale.colour(value);
                pixels[4 * (row * new + k)..][..4].copy_from_slice(&[r, g, b, 255]);
            }
        }
        pixels
    }
}

/// A run that is repeated to be measured, in slices.
#[wasm_bindgen]
pub struct Export {
    simulation: Simulation,
    probe: Box<dyn Probe>,
    measurement: Measurement,
}

#[wasm_bindgen]
impl Export {
    /// A measurement (JSON) that the page offers of a scenario (JSON).
    #[wasm_bindgen(constructor)]
    pub fn new(scenario: &str, measurement: &str) -> Result<Export, JsError> {
        let scenario = Scenario::from_json(scenario).map_err(refusal)?;
        let measurement = Measurement::from_json(measurement).map_err(refusal)?;
        let simulation = Simulation::new(&scenario).map_err(refusal)?;
        let mut probe = measurement.probe_of_page(&scenario).map_err(refusal)?;
        probe.observe(&simulation);
        Ok(Self { simulation, probe, measurement })
    }

    /// At most so many steps. Returns how much is done, 0 … 1.
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

/// A run that nobody watches: it only steps. For many runs, and for measuring what a step costs.
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

    /// At most so many steps. Returns how many were taken.
    pub fn step(&mut self, steps: u32) -> u32 {
        let before = self.simulation.step_index();
        self.simulation.run_to(before + u64::from(steps));
        (self.simulation.step_index() - before) as u32
    }

    /// Whether the run is over.
    pub fn finished(&self) -> bool {
        self.simulation.is_finished()
    }

    /// Distances since t = 0, nudges after it included, m.
    pub fn displacements(&self) -> Vec<f64> {
        self.simulation.displacements().to_vec()
    }
}
