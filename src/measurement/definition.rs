//! A measurement: what is measured in a run, how often and with which settings. It is plain data that travels next to the
//! scenario and validates itself.
//!
//! In JSON it is one flat object: `table` names the measurement, the other fields are its settings. A setting that is left
//! out has its default; `null` stands for a default that follows from the scenario, such as the middle of the ring.

use super::settings::{SETTINGS, Setting};
use super::{
    cyclic_growth::CyclicGrowth,
    driver_groups::{DriverGroups, Vehicles},
    equilibrium::Equilibria,
    events::Events,
    flow::Flow,
    lanes::Lanes,
    modal_growth::{Linear, ModalGrowth},
    modes::Modes,
    overview::{Outcome, Overview},
    probe::Probe,
    speed_map::SpeedMap,
    speeds::Speeds,
    trajectories::Trajectories,
};
use crate::error::{Error, quoted};
use crate::format::json::{Json, Object};
use crate::scenario::Scenario;

/// The most numbers that the window of a flow may hold: one for each row that has begun, and each position.
const COUNTS: f64 = 1e8;

/// What is measured. Times are in seconds and round to whole steps; vehicles and lanes are numbered from 1.
///
/// Read it with [`Measurement::from_json`], which fills in defaults and names what is wrong.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Measurement {
    /// The result of a run in one row, which exists when the run has ended.
    Outcome {},
    /// The whole ring, a row for each time.
    Overview {
        /// Time between rows, s.
        every: f64,
    },
    /// Every vehicle's state, a row for each vehicle and time.
    Trajectories {
        /// Time between rows, s.
        every: f64,
    },
    /// Speeds of some vehicles, one column each.
    Speeds {
        /// Time between rows, s.
        every: f64,
        /// Numbers of the vehicles; by default 1, 11, 21, 31 and 41, as far as they exist.
        vehicles: Option<Vec<usize>>,
    },
    /// Space-time map of speed in one lane.
    SpeedMap {
        /// Time between rows of the map, s.
        every: f64,
        /// Number of cells round the ring.
        bins: usize,
        /// Number of the lane.
        lane: usize,
    },
    /// Space-time map of flow, all lanes together.
    FlowMap {
        /// Time between rows of the map, s.
        every: f64,
        /// Number of places round the ring.
        bins: usize,
        /// Window δ, s.
        window: f64,
    },
    /// Flow past one place, all lanes together.
    Flow {
        /// Time between rows, s.
        every: f64,
        /// Window δ, s.
        window: f64,
        /// The position, m; by default the middle, L/2.
        at: Option<f64>,
    },
    /// Amplitudes of the Fourier modes of the headways' deviations from equilibrium.
    Modes {
        /// Time between rows, s.
        every: f64,
        /// Modes 1 to this; by default 10, or N/2 where that is less.
        modes: Option<usize>,
        /// Number of the lane.
        lane: usize,
    },
    /// Growth rate of each mode in the linear regime.
    Growth {
        /// Time between the amplitudes that are fitted, s.
        every: f64,
        /// Modes 1 to this; by default 10, or N/2 where that is less.
        modes: Option<usize>,
        /// Number of the lane.
        lane: usize,
        /// Start of the fit, s; by default 20 times the longest reaction time. What the start excited besides the leading
        /// root has died away by then.
        from: Option<f64>,
        /// Amplitude below which a mode is lost in rounding errors, m.
        smallest: f64,
        /// Share of the nonlinear part in the motion of a mode above which the regime is no longer linear.
        nonlinearity: f64,
    },
    /// The cyclic growth rate of one vehicle's speed.
    CyclicGrowth {
        /// Number of the vehicle.
        vehicle: usize,
        /// Number of periods fitted.
        periods: usize,
    },
    /// Equilibrium of each lane: a row at the start and whenever it has changed.
    Equilibrium {
        /// Time between two checks whether it has changed, s.
        every: f64,
    },
    /// Lane changes, refused attempts, passes and the collision.
    Events {},
    /// Vehicles in each lane and their imbalance.
    Lanes {
        /// Time between rows, s.
        every: f64,
    },
    /// Lane changes, distance and speed for each group of equal drivers.
    Drivers {
        /// Time between rows, s.
        every: f64,
    },
    /// Lane changes, distance and mean speed of each vehicle.
    Vehicles {
        /// Time between rows, s.
        every: f64,
    },
}

/// The field that holds a setting, by the type of its value.
enum Field<'a> {
    Number(&'a mut f64),
    Whole(&'a mut usize),
    OptionalNumber(&'a mut Option<f64>),
    OptionalWhole(&'a mut Option<usize>),
    List(&'a mut Option<Vec<usize>>),
}

impl Field<'_> {
    fn read(&self) -> Json {
        match self {
            Self::Number(x) => (**x).into(),
            Self::Whole(n) => (**n).into(),
            Self::OptionalNumber(x) => (**x).into(),
            Self::OptionalWhole(n) => (**n).into(),
            Self::List(list) => list.as_ref().map_or(Json::Null, |l| l.iter().copied().collect()),
        }
    }

    /// Writes a value that its [`Setting`] has checked; whole numbers may come as 2.0.
    fn write(self, value: &Json) {
        let whole = |v: &Json| v.as_number().map(|x| x as usize);
        match self {
            Self::Number(x) => *x = value.as_number().unwrap_or(*x),
            Self::Whole(n) => *n = whole(value).unwrap_or(*n),
            Self::OptionalNumber(x) => *x = value.as_number(),
            Self::OptionalWhole(n) => *n = whole(value),
            Self::List(list) => *list = value.as_list().map(|l| l.iter().filter_map(whole).collect()),
        }
    }
}

impl Measurement {
    /// Every measurement with its default settings, in the order in which lists show them.
    pub fn all() -> [Self; 15] {
        let every = 1.0;
        [
            Self::Trajectories { every },
            Self::Speeds { every, vehicles: None },
            Self::SpeedMap { every, bins: 100, lane: 1 },
            Self::FlowMap { every, bins: 100, window: 18.63 },
            Self::Flow { every, window: 5.0, at: None },
            Self::Modes { every, modes: None, lane: 1 },
            Self::Growth { every: 0.5, modes: None, lane: 1, from: None, smallest: 1e-8, nonlinearity: 0.01 },
            Self::CyclicGrowth { vehicle: 1, periods: 5 },
            Self::Equilibrium { every },
            Self::Events {},
            Self::Lanes { every },
            Self::Drivers { every },
            Self::Vehicles { every },
            Self::Overview { every },
            Self::Outcome {},
        ]
    }

    /// The measurement of that name with its default settings.
    pub fn named(name: &str) -> Result<Self, Error> {
        let mut all = Self::all();
        let Some(found) = all.iter_mut().find(|m| m.name() == name) else {
            let names: Vec<_> = all.iter().map(Self::name).collect();
            return Err(Error::unknown("table", quoted(name), names.join(", ")));
        };
        Ok(found.clone())
    }

    /// The name of the measurement and of its table.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Trajectories { .. } => "trajectories",
            Self::Speeds { .. } => "speeds",
            Self::SpeedMap { .. } => "speed-map",
            Self::FlowMap { .. } => "flow-map",
            Self::Flow { .. } => "flow",
            Self::Modes { .. } => "modes",
            Self::Growth { .. } => "growth",
            Self::CyclicGrowth { .. } => "cyclic-growth",
            Self::Equilibrium { .. } => "equilibrium",
            Self::Events {} => "events",
            Self::Lanes { .. } => "lanes",
            Self::Drivers { .. } => "drivers",
            Self::Vehicles { .. } => "vehicles",
            Self::Overview { .. } => "overview",
            Self::Outcome {} => "outcome",
        }
    }

    /// Time between rows, s, where they come at regular times.
    pub fn every(&self) -> Option<f64> {
        self.to_object().get("every").and_then(Json::as_number)
    }

    /// The settings that this measurement has.
    pub fn settings(&self) -> Vec<&'static Setting> {
        let object = self.to_object();
        SETTINGS.iter().filter(|s| object.get(s.name).is_some()).collect()
    }

    /// The measurement with settings changed given as text, by the names of the command's options.
    pub fn with_options<'a>(
        self,
        options: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> Result<Self, Error> {
        let mut object = self.to_object();
        let settings = self.settings();
        for (option, text) in options {
            let setting = settings.iter().find(|s| s.option == option).ok_or_else(|| {
                let names: Vec<_> = settings.iter().map(|s| format!("--{}", s.option)).collect();
                let names = if names.is_empty() { "no setting".to_owned() } else { names.join(", ") };
                Error::unknown(format!("table {}", self.name()), format!("--{option}"), names)
            })?;
            object.insert(setting.name, setting.parse(text)?);
        }
        Self::from_object(&object)
    }

    /// The settings that this measurement has, by their names in JSON.
    ///
    /// Reading and writing both go through this list: serde's derived code for the same weighs a tenth of the
    /// page's WebAssembly module.
    fn fields(&mut self) -> Vec<(&'static str, Field<'_>)> {
        use Field::{List, Number, OptionalNumber, OptionalWhole, Whole};
        match self {
            Self::Trajectories { every }
            | Self::Equilibrium { every }
            | Self::Lanes { every }
            | Self::Drivers { every }
            | Self::Vehicles { every }
            | Self::Overview { every } => vec![("every", Number(every))],
            Self::Speeds { every, vehicles } => vec![("every", Number(every)), ("vehicles", List(vehicles))],
            Self::SpeedMap { every, bins, lane } => {
                vec![("every", Number(every)), ("bins", Whole(bins)), ("lane", Whole(lane))]
            }
            Self::FlowMap { every, bins, window } => {
                vec![("every", Number(every)), ("bins", Whole(bins)), ("window", Number(window))]
            }
            Self::Flow { every, window, at } => {
                vec![("every", Number(every)), ("window", Number(window)), ("at", OptionalNumber(at))]
            }
            Self::Modes { every, modes, lane } => {
                vec![("every", Number(every)), ("modes", OptionalWhole(modes)), ("lane", Whole(lane))]
            }
            Self::Growth { every, modes, lane, from, smallest, nonlinearity } => vec![
                ("every", Number(every)),
                ("modes", OptionalWhole(modes)),
                ("lane", Whole(lane)),
                ("from", OptionalNumber(from)),
                ("smallest", Number(smallest)),
                ("nonlinearity", Number(nonlinearity)),
            ],
            Self::CyclicGrowth { vehicle, periods } => {
                vec![("vehicle", Whole(vehicle)), ("periods", Whole(periods))]
            }
            Self::Events {} | Self::Outcome {} => vec![],
        }
    }

    fn to_object(&self) -> Object {
        let mut object = Object::default();
        object.insert("table", self.name());
        for (name, field) in self.clone().fields() {
            object.insert(name, field.read());
        }
        object
    }

    fn from_object(given: &Object) -> Result<Self, Error> {
        let mut table = match given.get("table") {
            Some(Json::Text(name)) => Self::named(name)?,
            other => {
                let value = other.map_or_else(|| "nothing".to_owned(), Json::to_string);
                return Err(Error::malformed("table", value, "the name of a table, a text"));
            }
        };
        let (known, of) = (table.to_object(), table.name());
        for (name, value) in given.iter().filter(|(name, _)| *name != "table") {
            let Some(default) = known.get(name) else {
                let names: Vec<_> = known.iter().map(|(name, _)| name).collect();
                return Err(Error::unknown("field", quoted(name), names.join(", ")).within(of));
            };
            let follows = *default == Json::Null && *value == Json::Null;
            if !follows && let Some(setting) = SETTINGS.iter().find(|s| s.name == name) {
                setting.check(value).map_err(|e| e.within(of))?;
            }
            for (field, place) in table.fields() {
                if field == name {
                    place.write(value);
                }
            }
        }
        Ok(table)
    }

    /// One line of JSON with every field.
    pub fn to_json(&self) -> String {
        Json::from(self.to_object()).to_string()
    }

    /// Reads JSON; what depends on a scenario is for [`Measurement::validate`].
    pub fn from_json(text: &str) -> Result<Self, Error> {
        Object::read("measurement", text).and_then(|object| Self::from_object(&object))
    }

    /// The measurement with every default that follows from the scenario written out.
    #[must_use]
    pub fn resolved(&self, scenario: &Scenario) -> Self {
        let mut resolved = self.clone();
        let most_modes = (scenario.vehicles / 2).clamp(1, 10);
        match &mut resolved {
            Self::Speeds { vehicles, .. } => {
                vehicles.get_or_insert_with(|| {
                    (1..=41).step_by(10).filter(|&n| n <= scenario.vehicles).collect()
                });
            }
            Self::Flow { at, .. } => {
                at.get_or_insert(0.5 * scenario.length);
            }
            Self::Modes { modes, .. } => {
                modes.get_or_insert(most_modes);
            }
            Self::Growth { modes, from, .. } => {
                modes.get_or_insert(most_modes);
                from.get_or_insert_with(|| {
                    let longest = scenario.drivers().iter().map(|d| d.reaction_time).fold(0.0, f64::max);
                    scenario.steps(20.0 * longest) as f64 * scenario.time_step
                });
            }
            _ => {}
        }
        resolved
    }

    /// Whether it makes sense for runs of the scenario.
    pub fn validate(&self, scenario: &Scenario) -> Result<(), Error> {
        let resolved = self.resolved(scenario);
        // Also catches what no JSON can hold: NaN and infinities become null.
        Self::from_object(&resolved.to_object())?;
        for (name, value) in resolved.to_object().iter() {
            let number = value.as_number().unwrap_or(0.0);
            let refuse =
                |allowed: String| Err(Error::conflict(name.to_owned(), value, allowed).within(self.name()));
            let most = |limit: usize, what: &str| {
                if number > limit as f64 { refuse(format!("at most {limit}, {what}")) } else { Ok(()) }
            };
            match name {
                "every" | "window" if scenario.steps(number) == 0 => {
                    refuse(format!("at least one step, {} s", scenario.time_step))
                }
                "vehicle" => most(scenario.vehicles, "the number of vehicles"),
                "vehicles" => {
                    let numbers = value.as_list().into_iter().flatten();
                    match numbers.filter_map(Json::as_number).find(|&n| n > scenario.vehicles as f64) {
                        Some(n) => Err(Error::conflict(
                            name.to_owned(),
                            n,
                            format!("at most {}, the number of vehicles", scenario.vehicles),
                        )
                        .within(self.name())),
                        None => Ok(()),
                    }
                }
                "lane" => most(scenario.lanes, "the number of lanes"),
                "modes" => most((scenario.vehicles / 2).max(1), "half the number of vehicles"),
                "at" if number >= scenario.length => {
                    refuse(format!("less than {} m, the length of the ring", scenario.length))
                }
                _ => Ok(()),
            }?;
        }
        let counts = match resolved {
            Self::FlowMap { every, bins, window } => Some((every, bins, window)),
            Self::Flow { every, window, .. } => Some((every, 1, window)),
            _ => None,
        };
        if let Some((every, bins, window)) = counts
            && window / every * bins as f64 > COUNTS
        {
            let most = COUNTS * every / bins as f64;
            let allowed = format!("at most {most} s with rows every {every} s at {bins} places");
            return Err(Error::too_large("window", window, allowed).within(self.name()));
        }
        Ok(())
    }

    /// A probe that measures this in a run of the scenario.
    ///
    /// # Errors
    /// A setting that does not fit the scenario.
    pub fn probe(&self, scenario: &Scenario) -> Result<Box<dyn Probe>, Error> {
        self.validate(scenario)?;
        let steps = |seconds: f64| scenario.steps(seconds);
        Ok(match self.resolved(scenario) {
            Self::Modes { every, modes, lane } => {
                Box::new(Modes::new(steps(every), modes.unwrap_or_default(), lane - 1))
            }
            Self::CyclicGrowth { vehicle, periods } => Box::new(CyclicGrowth::new(vehicle - 1, periods)),
            Self::Equilibrium { every } => Box::new(Equilibria::new(steps(every))),
            Self::Drivers { every } => Box::new(DriverGroups::new(steps(every))),
            Self::Vehicles { every } => Box::new(Vehicles::new(steps(every))),
            Self::Overview { every } => Box::new(Overview::new(scenario, steps(every))),
            Self::Outcome {} => Box::new(Outcome::new(scenario)),
            Self::Trajectories { every } => Box::new(Trajectories::new(steps(every))),
            Self::Speeds { every, vehicles } => {
                Box::new(Speeds::new(steps(every), &vehicles.unwrap_or_default()))
            }
            Self::SpeedMap { every, bins, lane } => {
                Box::new(SpeedMap::new(steps(every), bins, lane - 1, scenario.length))
            }
            Self::FlowMap { every, bins, window } => {
                Box::new(Flow::map(scenario, steps(every), steps(window), bins))
            }
            Self::Flow { every, window, at } => {
                Box::new(Flow::at(scenario, steps(every), steps(window), at.unwrap_or_default()))
            }
            Self::Growth { every, modes, lane, from, smallest, nonlinearity } => Box::new(ModalGrowth::new(
                steps(every),
                modes.unwrap_or_default(),
                lane - 1,
                steps(from.unwrap_or_default()),
                Linear { smallest, nonlinearity },
            )),
            Self::Events {} => Box::new(Events::default()),
            Self::Lanes { every } => Box::new(Lanes::new(steps(every))),
        })
    }

    /// Memory that the rows of a whole run take, bytes, roughly. Used to refuse a run that would not fit into memory.
    pub fn bytes(&self, scenario: &Scenario) -> f64 {
        let (every, numbers) = match self.resolved(scenario) {
            Self::Trajectories { every } => (every, 8 * scenario.vehicles),
            Self::Speeds { every, vehicles } => (every, 1 + vehicles.map_or(0, |v| v.len())),
            Self::SpeedMap { every, bins, .. } | Self::FlowMap { every, bins, .. } => (every, bins),
            Self::Modes { every, modes, .. } | Self::Growth { every, modes, .. } => {
                (every, 2 + modes.unwrap_or(0))
            }
            Self::Vehicles { every } => (every, 4 * scenario.vehicles),
            Self::Flow { every, .. } => (every, 2),
            Self::Overview { every } => (every, 6),
            Self::Outcome {} => (scenario.until.max(1.0), 8),
            Self::Lanes { every } | Self::Equilibrium { every } | Self::Drivers { every } => {
                (every, 8 * scenario.lanes)
            }
            Self::CyclicGrowth { .. } | Self::Events {} => (scenario.until.max(1.0), 1),
        };
        8.0 * numbers as f64 * (scenario.until / every)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn json_reads_back_every_table_and_holds_every_field() {
        let scenario = Scenario::default();
        for measurement in Measurement::all() {
            assert_eq!(Measurement::from_json(&measurement.to_json()).unwrap(), measurement);
            assert_eq!(Measurement::named(measurement.name()).unwrap(), measurement);
            let resolved = measurement.resolved(&scenario);
            assert!(!resolved.to_json().contains("null"), "{}", resolved.to_json());
            assert_eq!(Measurement::from_json(&resolved.to_json()).unwrap(), resolved);
            assert!(measurement.validate(&scenario).is_ok());
            assert_eq!(measurement.to_json().lines().count(), 1);
            assert_eq!(measurement.to_object().get("table"), Some(&measurement.name().into()));
        }
        let speeds = Measurement::from_json(r#"{"table":"speeds"}"#).unwrap().resolved(&scenario);
        assert_eq!(speeds.to_json(), r#"{"every":1,"table":"speeds","vehicles":[1,11,21,31,41]}"#);
        let few = Scenario { vehicles: 15, ..scenario };
        assert!(Measurement::named("speeds").unwrap().resolved(&few).to_json().contains("[1,11]"));
    }

    #[test]
    fn options_are_read_by_their_names() {
        let map =
            Measurement::named("flow-map").unwrap().with_options([("window", "5"), ("bins", "20")]).unwrap();
        assert_eq!(map, Measurement::FlowMap { every: 1.0, bins: 20, window: 5.0 });
        let speeds = Measurement::named("speeds").unwrap().with_options([("vehicle", "3, 7")]).unwrap();
        assert_eq!(speeds, Measurement::Speeds { every: 1.0, vehicles: Some(vec![3, 7]) });
    }

    #[test]
    fn every_refusal_names_field_value_and_what_is_allowed() {
        let scenario = Scenario::default();
        for (json, words) in [
            ("{", &["measurement", "JSON"][..]),
            ("[]", &["measurement", "[]", "JSON object"]),
            ("{}", &["table", "nothing", "name of a table"]),
            (r#"{"table":7}"#, &["table", "7"]),
            (r#"{"table":"speed"}"#, &["table", "“speed”", "trajectories", "speed-map"]),
            (r#"{"table":"events","every":1}"#, &["events", "“every”"]),
            (r#"{"table":"speeds","vehicle":1}"#, &["speeds", "“vehicle”", "vehicles"]),
            (r#"{"table":"lanes","every":0}"#, &["lanes: every", "0 is", "from 0.001"]),
            (r#"{"table":"lanes","every":"1"}"#, &["lanes: every", "\"1\"", "a number"]),
            (r#"{"table":"lanes","every":null}"#, &["lanes: every", "null", "a number"]),
            (r#"{"table":"lanes","every":0.004}"#, &["lanes: every", "0.004", "one step, 0.01 s"]),
            (r#"{"table":"speeds","vehicles":[]}"#, &["speeds: vehicles", "[]", "whole numbers"]),
            (r#"{"table":"speeds","vehicles":[1.5]}"#, &["speeds: vehicles", "1.5", "whole"]),
            (r#"{"table":"speeds","vehicles":[1,51]}"#, &["speeds: vehicles", "51", "at most 50"]),
            (r#"{"table":"speed-map","lane":2}"#, &["speed-map: lane", "2", "at most 1"]),
            (r#"{"table":"speed-map","bins":0}"#, &["speed-map: bins", "0", "from 1"]),
            (r#"{"table":"flow","at":1000}"#, &["flow: at", "1000", "less than 1000 m"]),
            (r#"{"table":"flow","window":-1}"#, &["flow: window", "-1"]),
            (r#"{"table":"flow","window":1e7,"every":0.01}"#, &["flow: window", "10000000", "1000000 s"]),
            (r#"{"table":"modes","modes":26}"#, &["modes: modes", "26", "at most 25"]),
            (r#"{"table":"growth","from":-1}"#, &["growth: from", "-1"]),
            (r#"{"table":"growth","nonlinearity":0}"#, &["growth: nonlinearity", "0", "from 0.000000000001"]),
            (r#"{"table":"cyclic-growth","vehicle":99}"#, &["cyclic-growth: vehicle", "99", "at most 50"]),
            (r#"{"table":"cyclic-growth","periods":1}"#, &["cyclic-growth: periods", "1", "from 2"]),
        ] {
            let message =
                Measurement::from_json(json).and_then(|m| m.validate(&scenario)).expect_err(json).to_string();
            for word in words {
                assert!(message.contains(word), "{json}: {message} lacks {word}");
            }
        }
        for every in [f64::NAN, f64::INFINITY] {
            assert!(Measurement::Lanes { every }.validate(&scenario).is_err());
        }
        for (options, words) in [
            (("window", "1"), ["--window", "lanes", "--every"]),
            (("every", "soon"), ["every", "“soon”", "a number"]),
            (("every", "NaN"), ["every", "NaN", "a number"]),
        ] {
            let message =
                Measurement::named("lanes").unwrap().with_options([options]).unwrap_err().to_string();
            assert!(words.iter().all(|w| message.contains(w)), "{message}");
        }
    }
}
