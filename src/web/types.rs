//! What crosses from the core to the page, as plain data.
//!
//! Each type here is written once: `serde` writes its values as JSON, and the TypeScript declarations in
//! `www/src/core/generated.ts` are made from the same fields by a test of this file. The test fails when that file is
//! out of date; `WRITE_TYPES=1 cargo test --lib web::types` writes it anew. Types of lower layers that cross unchanged
//! (roots, traffic, the marks of a picture) are declared where they are.
//!
//! A number that may be missing is an `Option` or NaN; both become `null`. Arrays with a value for every vehicle do
//! not pass through here: they cross as typed arrays (see `laboratory`).

use crate::error::{Error, quoted};
use crate::format::json::Json;
use crate::live::traffic::Traffic;
use crate::live::{Live, MeasuredGrowth};
use crate::measurement::modal_growth::{self, WindowEnd};
use crate::measurement::provenance::VERSION;
use crate::plot::colour::{Ground, Quantity, Scale};
use crate::reproduction::claim;
use crate::reproduction::{self, Size};
use crate::scenario::parameters::{self, Field, PARAMETERS};
use crate::scenario::{link, presets};
use crate::stability::{stability_diagram, summary};
use serde::Serialize;

// ---- The start ---------------------------------------------------------------------------------------------------

/// What the page gets once, when the core has started.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Start {
    /// The core's table of parameters.
    pub parameters: Vec<Parameter>,
    /// Scenarios with names.
    pub presets: Vec<Preset>,
    /// Size of the space-time map.
    pub map: MapShape,
    /// Version of the program.
    pub version: &'static str,
}

/// Size of the space-time map.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct MapShape {
    /// Columns, one an interval of time.
    pub columns: usize,
    /// Cells of a column, from x = 0 to x = L.
    pub bins: usize,
}

impl Start {
    /// For a map of that size.
    pub fn new(columns: usize, bins: usize) -> Self {
        Self {
            parameters: PARAMETERS.iter().map(Parameter::from).collect(),
            presets: presets::presets().into_iter().map(Preset::from).collect(),
            map: MapShape { columns, bins },
            version: VERSION,
        }
    }
}

/// One row of the core's table of parameters.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Parameter {
    /// Name, with underscores.
    pub name: &'static str,
    /// Symbol in formulas; empty where there is none.
    pub symbol: &'static str,
    /// Unit; empty for a pure number.
    pub unit: &'static str,
    /// Default value.
    pub default: f64,
    /// Smallest allowed value.
    pub min: f64,
    /// Largest allowed value.
    pub max: f64,
    /// Range of the slider, if it has one.
    pub slider: Option<Slider>,
    /// Whether only whole numbers are allowed.
    pub whole: bool,
    /// What it means, in one line.
    pub meaning: &'static str,
    /// What it belongs to.
    pub of: Owner,
}

/// Range of a slider.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Slider {
    /// Smallest value.
    pub min: f64,
    /// Largest value.
    pub max: f64,
    /// Distance between neighbouring values.
    pub step: f64,
}

/// What a parameter belongs to.
#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(test, derive(ts_rs::TS))]
pub enum Owner {
    /// The road and the run: a new value starts the run again.
    Road,
    /// A driver: a new value holds from now on.
    Driver,
}

impl From<&parameters::Parameter> for Parameter {
    fn from(p: &parameters::Parameter) -> Self {
        let range = p.kind.range();
        Self {
            name: p.name,
            symbol: p.symbol,
            unit: p.unit,
            default: p.default.number().unwrap_or(f64::NAN),
            min: range.map_or(f64::NEG_INFINITY, |range| range.min),
            max: range.map_or(f64::INFINITY, |range| range.max),
            slider: p.slider.map(|s| Slider { min: s.min, max: s.max, step: s.step }),
            whole: p.kind.is_whole(),
            meaning: p.meaning,
            of: if p.is_of_driver() { Owner::Driver } else { Owner::Road },
        }
    }
}

/// A scenario with a name.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Preset {
    /// Name, as a link writes it.
    pub name: &'static str,
    /// Title.
    pub title: &'static str,
    /// What to notice.
    pub notice: &'static str,
    /// What to try next.
    pub next: &'static str,
    /// The scenario.
    #[cfg_attr(test, ts(type = "Scenario"))]
    pub scenario: Json,
}

impl From<presets::Preset> for Preset {
    fn from(p: presets::Preset) -> Self {
        Self { name: p.name, title: p.title, notice: p.notice, next: p.next, scenario: p.scenario.tree() }
    }
}

// ---- The watched run ---------------------------------------------------------------------------------------------

/// What changes by actions and settings only.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Snapshot {
    /// The scenario with all actions made so far.
    #[cfg_attr(test, ts(type = "Scenario"))]
    pub scenario: Json,
    /// The part of a link after the #.
    pub link: String,
    /// Parameters, by name, that now hold for every driver without an override.
    #[cfg_attr(test, ts(type = "Record<string, number>"))]
    pub driver: Json,
    /// What theory says of the ring as it is now.
    pub stability: StabilitySummary,
    /// Numbers (from 1) of the vehicles whose speeds are in the rows.
    pub watched: Vec<usize>,
    /// Seconds between two rows, and between two columns of the map.
    pub interval: f64,
    /// Seconds that the whole map holds.
    pub map_window: f64,
    /// Window of the flow in the rows, s.
    pub flow_window: f64,
    /// Equilibrium speed with the vehicles spread evenly over all lanes, m/s.
    pub mean_equilibrium_speed: f64,
    /// Counts what changed the stability summary or the drivers; differs from a frame's when this snapshot is out of date.
    pub changes: u64,
}

impl Snapshot {
    /// Of a run whose map has `columns` columns.
    pub fn of(live: &mut Live, columns: usize) -> Self {
        let stability = StabilitySummary::from(live.stability_summary());
        let scenario = live.simulation().scenario();
        let settled = live.settled().driver;
        let mut driver = crate::format::json::Object::default();
        for parameter in &PARAMETERS {
            if let Field::Driver(field) = parameter.field {
                driver.insert(parameter.name, settled.value(field));
            }
        }
        Self {
            scenario: scenario.tree(),
            link: link::format(scenario),
            driver: driver.into(),
            stability,
            watched: live.watched().iter().map(|j| j + 1).collect(),
            interval: live.interval(),
            map_window: columns as f64 * live.interval(),
            flow_window: live.flow_window(),
            mean_equilibrium_speed: live.equilibrium().speed,
            changes: live.changes(),
        }
    }
}

/// What linear theory says of the least stable lane.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct StabilitySummary {
    /// Whether every wave fades in the run's time steps; `null` where no wave can exist.
    pub stable: Option<bool>,
    /// Whether all drivers are the same.
    pub homogeneous: bool,
    /// Delay in force, s; the mean where drivers differ.
    pub reaction_time: f64,
    /// Critical reaction time in continuous time, s; `null` where every reaction time is stable.
    pub critical: Option<f64>,
    /// The same for the run's time step.
    pub critical_discrete: Option<f64>,
    /// Where drivers differ: the factor by which all reaction times may grow before waves do.
    pub scale: Option<f64>,
    /// Largest growth rate of the run, 1/s; `null` where nothing can grow or decay.
    pub rate: Option<f64>,
    /// Mode of the fastest wave: its number of jams.
    pub mode: Option<usize>,
    /// Equilibrium speed of the lane, m/s.
    pub equilibrium_speed: f64,
    /// Equilibrium flow of the lane, vehicles per second.
    pub flow: f64,
    /// Density of the lane, vehicles per metre.
    pub density: f64,
    /// The lane, from 1.
    pub lane: usize,
    /// Vehicles in it.
    pub vehicles: usize,
}

impl From<&summary::StabilitySummary> for StabilitySummary {
    fn from(s: &summary::StabilitySummary) -> Self {
        Self {
            stable: s.stable,
            homogeneous: s.homogeneous,
            reaction_time: s.reaction_time,
            critical: s.critical,
            critical_discrete: s.critical_discrete,
            scale: s.scale,
            rate: s.rate,
            mode: s.mode,
            equilibrium_speed: s.equilibrium.speed,
            flow: s.equilibrium.flow,
            density: s.equilibrium.density,
            lane: s.lane,
            vehicles: s.vehicles,
        }
    }
}

/// The state of a frame, apart from its values for every vehicle.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct FrameState {
    /// Time, s.
    pub time: f64,
    /// Steps taken since t = 0.
    pub step: u64,
    /// Whether the run is over.
    pub finished: bool,
    /// The collision that ended the run.
    pub collision: Option<Collision>,
    /// What the traffic does now.
    pub traffic: Traffic,
    /// What was recorded since the frame before.
    pub rows: Rows,
    /// Which run this is; it grows when one begins anew.
    pub epoch: u64,
    /// Differs from the snapshot's when that is out of date.
    pub changes: u64,
    /// Growth measured in the run; `null` while there is not enough of it.
    pub growth: Option<Growth>,
    /// Whether waves are now too large for linear theory; `growth` is from before then.
    pub large: bool,
}

impl FrameState {
    /// Takes the rows out of the run.
    pub fn take(live: &mut Live, epoch: u64) -> Self {
        let rows = Rows::new(&live.take_rows(), live.watched().len());
        let simulation = live.simulation();
        Self {
            time: simulation.time(),
            step: simulation.step_index(),
            finished: simulation.is_finished(),
            collision: simulation.collision().map(Collision::from),
            traffic: Traffic::of(simulation),
            rows,
            epoch,
            changes: live.changes(),
            growth: live.growth().map(Growth::from),
            large: live.is_large(),
        }
    }
}

/// A collision.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Collision {
    /// Time, s.
    pub time: f64,
    /// The vehicle behind, from 0.
    pub behind: usize,
    /// The vehicle ahead, from 0.
    pub ahead: usize,
    /// The lane, from 0.
    pub lane: usize,
}

impl From<crate::simulation::Collision> for Collision {
    fn from(c: crate::simulation::Collision) -> Self {
        Self { time: c.time, behind: c.behind, ahead: c.ahead, lane: c.lane }
    }
}

/// What is recorded at every interval, column by column.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Rows {
    /// Time, s.
    pub time: Vec<f64>,
    /// Mean speed, m/s.
    pub mean: Vec<f64>,
    /// Flow through L/2, vehicles per second; `null` until its window has passed.
    #[cfg_attr(test, ts(type = "Array<number | null>"))]
    pub flow: Vec<f64>,
    /// ΔN: vehicles in the fullest lane minus those in the emptiest.
    pub imbalance: Vec<f64>,
    /// Speed (m/s) of each watched vehicle.
    pub speeds: Vec<Vec<f64>>,
}

impl Rows {
    /// Columns of the rows of [`Live::take_rows`].
    fn new(rows: &[f64], watched: usize) -> Self {
        let column = |k: usize| rows.iter().skip(k).step_by(4 + watched).copied().collect();
        Self {
            time: column(0),
            mean: column(1),
            flow: column(2),
            imbalance: column(3),
            speeds: (4..4 + watched).map(column).collect(),
        }
    }
}

/// Growth of the fastest wave, measured in the run.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Growth {
    /// Growth rate, 1/s.
    pub rate: f64,
    /// Its standard error, 1/s.
    pub standard_error: f64,
    /// How far the size of the waves may have moved the rate, 1/s.
    pub nonlinear_bound: f64,
    /// Length of the time over which it was measured, s.
    pub window: f64,
    /// Fourier mode of the wave.
    pub mode: usize,
}

impl From<MeasuredGrowth> for Growth {
    fn from(g: MeasuredGrowth) -> Self {
        Self {
            rate: g.rate,
            standard_error: g.standard_error,
            nonlinear_bound: g.nonlinear_bound,
            window: g.window,
            mode: g.mode,
        }
    }
}

// ---- Colours and the map -----------------------------------------------------------------------------------------

/// The quantity of that name.
pub fn quantity(name: &str) -> Result<Quantity, Error> {
    match name {
        "difference" => Ok(Quantity::Difference),
        "speed" => Ok(Quantity::Speed),
        "frustration" => Ok(Quantity::Frustration),
        other => Err(Error::unknown("colour", quoted(other), "difference, speed, frustration")),
    }
}

/// The colour bars of ring and map.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ColourBars {
    /// Of the vehicles on the ring.
    pub ring: ColourBar,
    /// Of the map.
    pub map: ColourBar,
}

/// A colour bar.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ColourBar {
    /// Red, green, blue of its colours, from the lowest value to the highest.
    pub colours: Vec<usize>,
    /// Values to write beside it.
    pub ticks: Vec<Tick>,
}

/// A value beside a colour bar.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Tick {
    /// The value.
    pub value: f64,
    /// Its place, from 0 to 1.
    pub place: f64,
}

impl ColourBar {
    /// Of a quantity, on a ring with that equilibrium speed (m/s).
    pub fn new(quantity: Quantity, ground: Ground, equilibrium: f64) -> Self {
        let scale = Scale::new(quantity, ground, equilibrium);
        let tick = |value| Tick { value, place: scale.place(value) };
        Self {
            colours: scale.colours().iter().step_by(8).flatten().map(|&c| c.into()).collect(),
            ticks: scale.ticks().into_iter().map(tick).collect(),
        }
    }
}

/// What the map shows at a place.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct MapReading {
    /// Time, s.
    pub time: f64,
    /// Position on the road, m.
    pub position: f64,
    /// Speed, m/s; `null` in an empty lane.
    #[cfg_attr(test, ts(type = "number | null"))]
    pub speed: f64,
    /// Speed minus the equilibrium speed at that time, m/s; `null` in an empty lane.
    #[cfg_attr(test, ts(type = "number | null"))]
    pub difference: f64,
}

// ---- Theory ------------------------------------------------------------------------------------------------------

/// The stability diagram of the lane that the stability summary speaks of.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct StabilityDiagram {
    /// Critical reaction times.
    pub curves: Curves,
    /// The number of vehicles beyond which the lane is a jam.
    pub jam: f64,
    /// Reaction time of its drivers, s; where drivers differ, of those without an override.
    pub reaction_time: f64,
}

/// Critical reaction times over the number of vehicles in the lane; `null` where every reaction time is stable.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Curves {
    /// Numbers of vehicles, ascending.
    pub vehicles: Vec<usize>,
    /// In continuous time, s.
    pub continuous_s: Vec<Option<f64>>,
    /// In the run's time steps, s.
    pub discrete_s: Vec<Option<f64>>,
    /// Newell's limit 1/(2c), s.
    pub newell_s: Vec<Option<f64>>,
}

impl StabilityDiagram {
    /// Of a diagram, with curves at these numbers of vehicles.
    pub fn new(diagram: &stability_diagram::StabilityDiagram, numbers: Vec<usize>) -> Self {
        let curves = diagram.curves(numbers);
        Self {
            curves: Curves {
                vehicles: curves.vehicles,
                continuous_s: curves.continuous_s,
                discrete_s: curves.discrete_s,
                newell_s: curves.newell_s,
            },
            jam: diagram.jam(),
            reaction_time: diagram.driver.reaction_time,
        }
    }
}

/// Growth of the modes of a lane since the last change.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ModalGrowth {
    /// The time from which growth is measured, s.
    pub starts: f64,
    /// Number of modes that are or will be measured, from mode 1 on.
    pub followed: usize,
    /// The modes measured; none until there is something to measure.
    pub modes: Vec<ModeGrowth>,
}

/// Growth of one mode since the last change.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ModeGrowth {
    /// The mode, from 1.
    pub mode: usize,
    /// Growth rate measured, 1/s; `null` while there is none.
    #[cfg_attr(test, ts(type = "number | null"))]
    pub rate: f64,
    /// Its standard error, 1/s.
    #[cfg_attr(test, ts(type = "number | null"))]
    pub standard_error: f64,
    /// Growth rate by theory, 1/s; where drivers differ, of the root followed from this mode of equal drivers.
    #[cfg_attr(test, ts(type = "number | null"))]
    pub predicted: f64,
    /// How far the size of the waves may have moved the rate, 1/s.
    #[cfg_attr(test, ts(type = "number | null"))]
    pub nonlinear_bound: f64,
    /// Start of the time in which the mode was linear, s.
    #[cfg_attr(test, ts(type = "number | null"))]
    pub from: f64,
    /// Its end, s.
    #[cfg_attr(test, ts(type = "number | null"))]
    pub to: f64,
    /// What ended it.
    pub ended_by: WindowEnd,
}

impl ModalGrowth {
    /// Of the lane that the stability summary speaks of.
    pub fn of(live: &Live) -> Self {
        let modes = live.modal_growth().iter().map(ModeGrowth::from).collect();
        Self { starts: live.modal_from(), followed: live.modes_followed(), modes }
    }
}

impl From<&modal_growth::ModeGrowth> for ModeGrowth {
    fn from(g: &modal_growth::ModeGrowth) -> Self {
        Self {
            mode: g.mode,
            rate: g.rate,
            standard_error: g.standard_error,
            predicted: g.predicted,
            nonlinear_bound: g.nonlinear_bound,
            from: g.from,
            to: g.to,
            ended_by: g.ended_by,
        }
    }
}

// ---- The paper's figures -----------------------------------------------------------------------------------------

/// A figure of the paper, or beyond it.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct FigureInfo {
    /// Identifier.
    pub id: &'static str,
    /// Title.
    pub title: &'static str,
    /// Caption.
    pub caption: &'static str,
    /// Whether it goes beyond the paper.
    pub beyond: bool,
    /// Number of its tasks.
    pub tasks: usize,
}

impl From<&reproduction::Figure> for FigureInfo {
    fn from(f: &reproduction::Figure) -> Self {
        Self {
            id: f.id,
            title: f.title,
            caption: f.caption,
            beyond: f.beyond,
            tasks: f.tasks(Size::Full).len(),
        }
    }
}

/// A claim of the paper beside what is measured here; numbers are written with their units.
#[derive(Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Claim {
    /// What is claimed.
    pub claim: String,
    /// The paper's value.
    pub paper: String,
    /// The value measured here.
    pub ours: String,
    /// Whether they agree.
    pub verdict: ClaimVerdict,
    /// How it was measured.
    pub method: String,
}

/// Whether the paper and the measurement agree.
#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(test, derive(ts_rs::TS))]
pub enum ClaimVerdict {
    /// Within the tolerance of the claim.
    Agrees,
    /// Outside it.
    Differs,
    /// Not determined by the paper.
    Open,
}

impl From<&claim::Claim> for Claim {
    fn from(c: &claim::Claim) -> Self {
        let verdict = match c.verdict() {
            claim::ClaimVerdict::Agrees => ClaimVerdict::Agrees,
            claim::ClaimVerdict::Differs => ClaimVerdict::Differs,
            claim::ClaimVerdict::NotDetermined => ClaimVerdict::Open,
        };
        Self {
            claim: c.claim.clone(),
            paper: c.paper(),
            ours: c.ours_in_words(),
            verdict,
            method: c.method_in_words(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::json;
    use crate::live::{BINS, COLUMNS};
    use crate::plot;
    use crate::plot::Mark;
    use crate::stability::roots::{LaneRoots, ModeRoot};
    use std::collections::BTreeMap;
    use std::path::Path;
    use ts_rs::{Config, TS};

    // [`Scenario`] writes its JSON itself; this declares the fields for the page, and a test reads scenarios into it.
    /// A scenario in the core's JSON form.
    #[allow(dead_code, reason = "the fields are there to be declared and to be read into")]
    #[derive(serde::Deserialize, TS)]
    #[serde(deny_unknown_fields)]
    #[ts(rename = "Scenario")]
    struct ScenarioForm {
        /// Version of the form.
        version: u32,
        /// Vehicles, all lanes together.
        vehicles: u32,
        /// Length of the ring, m.
        length: f64,
        /// Number of lanes.
        lanes: u32,
        /// Time step, s.
        time_step: f64,
        /// End of the run, s.
        until: f64,
        /// Seed of every random draw.
        seed: u64,
        /// How the vehicles are placed at t = 0.
        start: String,
        /// Parameters of the default driver, by name.
        #[ts(type = "Record<string, number>")]
        driver: BTreeMap<String, f64>,
        /// Driver overrides: `7:sensitivity=2`.
        exceptions: Vec<String>,
        /// Timed actions: `at=40:7:brake=3`.
        actions: Vec<String>,
    }

    fn declaration<T: TS + ?Sized>(config: &Config) -> String {
        let docs = T::docs().unwrap_or_default();
        format!("{docs}export {}\n", T::decl(config))
    }

    /// The text of `generated.ts`.
    fn declarations() -> String {
        let config = Config::new().with_large_int("number");
        macro_rules! declare {
            ($($type:ty),* $(,)?) => { [$(declaration::<$type>(&config)),*].join("\n") };
        }
        let all = declare![
            Start,
            MapShape,
            Parameter,
            Slider,
            Owner,
            Preset,
            ScenarioForm,
            Snapshot,
            StabilitySummary,
            FrameState,
            Traffic,
            Collision,
            Rows,
            Growth,
            Quantity,
            ColourBars,
            ColourBar,
            Tick,
            MapReading,
            StabilityDiagram,
            Curves,
            LaneRoots,
            ModeRoot,
            ModalGrowth,
            ModeGrowth,
            WindowEnd,
            FigureInfo,
            Claim,
            ClaimVerdict,
            plot::readout::Field<'static>,
            Mark<'static>,
        ];
        format!(
            "// What crosses from the core to the page. Generated from the structs in src/web/types.rs; do not edit.\n\
             // `WRITE_TYPES=1 cargo test --lib web::types` writes this file anew.\n\n{all}"
        )
    }

    #[test]
    fn the_declarations_of_the_page_are_up_to_date() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("www/src/core");
        if !folder.exists() {
            // The published crate comes without the page.
            return;
        }
        let file = folder.join("generated.ts");
        if std::env::var_os("WRITE_TYPES").is_some() {
            std::fs::write(&file, declarations()).unwrap();
        }
        let there = std::fs::read_to_string(&file).unwrap_or_default();
        assert!(
            there == declarations(),
            "www/src/core/generated.ts is out of date: run WRITE_TYPES=1 cargo test --lib web::types"
        );
    }

    #[test]
    fn the_declared_scenario_has_the_fields_of_the_written_one() {
        for preset in Start::new(COLUMNS, BINS).presets {
            let text = json::text(&preset.scenario);
            let read: ScenarioForm = serde_json::from_str(&text).unwrap();
            assert_eq!(read.driver.len(), PARAMETERS.iter().filter(|p| p.is_of_driver()).count());
        }
    }

    #[test]
    fn rows_become_columns() {
        let rows = [0.0, 10.0, f64::NAN, 2.0, 11.0, 12.0, 0.5, 10.5, 0.5, 3.0, 13.0, 14.0];
        let text = json::text(&Rows::new(&rows, 2));
        let expected = r#"{"time":[0.0,0.5],"mean":[10.0,10.5],"flow":[null,0.5],"imbalance":[2.0,3.0],"speeds":[[11.0,13.0],[12.0,14.0]]}"#;
        assert_eq!(text, expected);
    }

    #[test]
    fn every_quantity_has_its_name() {
        let declared = Quantity::decl(&Config::new());
        for name in ["difference", "speed", "frustration"] {
            assert!(
                declared.contains(&format!("\"{name}\"")) && quantity(name).is_ok(),
                "{name}: {declared}"
            );
        }
        assert_eq!(declared.matches('"').count(), 6);
        assert!(quantity("time").is_err());
    }

    /// A run beyond its threshold ends the linear window of its fastest mode; a quiet one has no such window.
    #[test]
    fn ends_of_linear_windows_have_names() {
        let end = |link: &str, seconds: f64| {
            let mut live = Live::new(&link::parse(link).scenario).unwrap();
            let steps = live.simulation().scenario().steps(seconds) as u32;
            live.step(steps);
            let growth = ModalGrowth::of(&live);
            assert_eq!(growth.modes.len(), growth.followed);
            growth.modes[0].ended_by
        };
        assert_eq!(end("reaction-time=0.6&action=at%3D0%3A1%3Anudge%3D0.01", 60.0), WindowEnd::EndOfRun);
        assert_eq!(end("reaction-time=0.6", 60.0), WindowEnd::SankIntoRounding);
        assert_eq!(end("action=at%3D0%3A1%3Anudge%3D20", 60.0), WindowEnd::NeverLinear);
    }
}
