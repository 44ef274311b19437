//! The one table of parameters.
//!
//! The command's options, the link of the page, its sliders, the CSV header, validation and the reference
//! documentation all come from [`PARAMETERS`]. A row names the field of [`Scenario`](crate::scenario::Scenario) or
//! [`Driver`](crate::scenario::driver::Driver) that holds the value. The functions that read and write the fields stand
//! beside those two types and name every field, so a field without a parameter does not compile.
//!
//! ```
//! use ringroad::Scenario;
//! use ringroad::scenario::parameters::Parameter;
//! use ringroad::scenario::value::Value;
//!
//! let reaction_time = Parameter::named("reaction-time").unwrap();
//! assert_eq!((reaction_time.symbol, reaction_time.unit), ("Δ", "s"));
//! assert_eq!(reaction_time.parse("0.75"), Ok(Value::Number(0.75)));
//! let refusal = reaction_time.parse("11").unwrap_err();
//! assert_eq!(refusal.to_string(), "reaction-time: 11 is not allowed; allowed: a number from 0 to 10 s");
//!
//! let mut scenario = Scenario::default();
//! scenario.set(reaction_time, 0.75).unwrap();
//! assert_eq!(scenario.driver.reaction_time, 0.75);
//! ```

use crate::error::{Error, quoted};
use crate::format::json::Json;
use crate::scenario::value::{Kind, Range, Value};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// A value of the road or of the run. It cannot change while the run goes on. In the order of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // the table says what each of them means
pub enum RoadField {
    Vehicles,
    Length,
    Lanes,
    TimeStep,
    Until,
    Seed,
}

/// A value of a driver. An override or an action may change it. In the order of the table, after those of the road.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // the table says what each of them means
pub enum DriverField {
    MaxSpeed = RoadField::Seed as isize + 1,
    Sensitivity,
    MinHeadway,
    VehicleLength,
    ReactionTime,
    FrustrationRate,
    PassFrustration,
}

/// Where the value of a parameter is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Field {
    /// In the scenario itself.
    Road(RoadField),
    /// In a driver: the default one, and every one that an override or an action changes.
    Driver(DriverField),
}

/// A law of car following.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Law {
    /// Newell's first-order law with its reaction time.
    Newell,
}

/// The part of the allowed range that a slider covers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Slider {
    /// Smallest value.
    pub min: f64,
    /// Largest value.
    pub max: f64,
    /// Distance between neighbouring values.
    pub step: f64,
}

/// One row of the table.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Name in Rust and JSON, with underscores.
    pub name: &'static str,
    /// Symbol in formulas; empty where there is none.
    pub symbol: &'static str,
    /// Unit; empty for a pure number.
    pub unit: &'static str,
    /// Default value.
    pub default: Value,
    /// What values it can have.
    pub kind: Kind,
    /// Range of the slider, if the page has one.
    pub slider: Option<Slider>,
    /// What it means, in one line.
    pub meaning: &'static str,
    /// The laws that use it; `None` where all of them do.
    pub laws: Option<&'static [Law]>,
    /// Where its value is held.
    pub field: Field,
}

impl PartialEq for Parameter {
    /// A field has one row.
    fn eq(&self, other: &Self) -> bool {
        self.field == other.field
    }
}

impl Serialize for Parameter {
    /// An object with the row's fields. Rows whose values are not single numbers, or that some laws do not use, have more
    /// entries: `none`, `list`, `choices`, `laws`.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_map(None)?;
        object.serialize_entry("name", self.name)?;
        object.serialize_entry("symbol", self.symbol)?;
        object.serialize_entry("unit", self.unit)?;
        object.serialize_entry("default", &self.default)?;
        if let Some(range) = self.kind.range() {
            object.serialize_entry("min", &range.min)?;
            object.serialize_entry("max", &range.max)?;
        }
        object.serialize_entry("slider", &self.slider)?;
        object.serialize_entry("whole", &self.kind.is_whole())?;
        match self.kind {
            Kind::Number(_) | Kind::Whole(_) => {}
            Kind::NumberOrNone(_) => object.serialize_entry("none", &true)?,
            Kind::Choice(names) => object.serialize_entry("choices", names)?,
            Kind::List(_) => object.serialize_entry("list", &true)?,
        }
        object.serialize_entry("meaning", self.meaning)?;
        if let Some(laws) = self.laws {
            let names: Vec<_> = laws.iter().map(|law| law.name()).collect();
            object.serialize_entry("laws", &names)?;
        }
        object.serialize_entry("of", if self.is_of_driver() { "driver" } else { "road" })?;
        object.end()
    }
}

#[allow(clippy::unnecessary_wraps)] // keeps the table readable
const fn slider(min: f64, max: f64, step: f64) -> Option<Slider> {
    Some(Slider { min, max, step })
}
const fn number(min: f64, max: f64) -> Kind {
    Kind::Number(Range { min, max })
}
const fn whole(min: f64, max: f64) -> Kind {
    Kind::Whole(Range { min, max })
}

/// Every parameter, in the order in which people read them.
#[rustfmt::skip]
pub static PARAMETERS: [Parameter; 13] = [
    Parameter { name: "vehicles", symbol: "N", unit: "", default: Value::Number(50.0), kind: whole(1.0, 1e6), slider: slider(2.0, 133.0, 1.0),
        meaning: "vehicles on the ring, all lanes together", laws: None, field: Field::Road(RoadField::Vehicles) },
    Parameter { name: "length", symbol: "L", unit: "m", default: Value::Number(1000.0), kind: number(10.0, 1e8), slider: slider(200.0, 5000.0, 10.0),
        meaning: "length of the ring", laws: None, field: Field::Road(RoadField::Length) },
    Parameter { name: "lanes", symbol: "", unit: "", default: Value::Number(1.0), kind: whole(1.0, 8.0), slider: slider(1.0, 4.0, 1.0),
        meaning: "lanes; lane 1 is the outermost", laws: None, field: Field::Road(RoadField::Lanes) },
    Parameter { name: "time_step", symbol: "dt", unit: "s", default: Value::Number(0.01), kind: number(0.001, 0.5), slider: slider(0.01, 0.1, 0.005),
        meaning: "fixed Euler step", laws: None, field: Field::Road(RoadField::TimeStep) },
    Parameter { name: "until", symbol: "", unit: "s", default: Value::Number(600.0), kind: number(0.0, 1e7), slider: None,
        meaning: "end of the run", laws: None, field: Field::Road(RoadField::Until) },
    Parameter { name: "seed", symbol: "", unit: "", default: Value::Number(1.0), kind: whole(0.0, 9_007_199_254_740_991.0), slider: None,
        meaning: "seed of every random draw", laws: None, field: Field::Road(RoadField::Seed) },
    Parameter { name: "max_speed", symbol: "V", unit: "m/s", default: Value::Number(40.0), kind: number(0.1, 100.0), slider: slider(5.0, 60.0, 0.5),
        meaning: "speed at infinite headway", laws: None, field: Field::Driver(DriverField::MaxSpeed) },
    Parameter { name: "sensitivity", symbol: "λ", unit: "1/s", default: Value::Number(1.0), kind: number(0.01, 20.0), slider: slider(0.2, 4.0, 0.05),
        meaning: "slope of speed against headway at the minimum headway", laws: None, field: Field::Driver(DriverField::Sensitivity) },
    Parameter { name: "min_headway", symbol: "d", unit: "m", default: Value::Number(7.5), kind: number(0.1, 100.0), slider: slider(5.5, 20.0, 0.1),
        meaning: "headway at which the speed reaches 0; more than the vehicle's length", laws: None, field: Field::Driver(DriverField::MinHeadway) },
    Parameter { name: "vehicle_length", symbol: "C", unit: "m", default: Value::Number(5.0), kind: number(0.1, 50.0), slider: slider(2.0, 12.0, 0.1),
        meaning: "length of the vehicle: a collision when the headway falls to it", laws: None, field: Field::Driver(DriverField::VehicleLength) },
    Parameter { name: "reaction_time", symbol: "Δ", unit: "s", default: Value::Number(0.0), kind: number(0.0, 10.0), slider: slider(0.0, 1.5, 0.01),
        meaning: "delay between the scene and the response to it", laws: None, field: Field::Driver(DriverField::ReactionTime) },
    Parameter { name: "frustration_rate", symbol: "r", unit: "1/s", default: Value::Number(0.1), kind: number(0.0, 100.0), slider: slider(0.0, 1.0, 0.01),
        meaning: "rise of frustration while the adjacent lane looks better, fall while it looks worse", laws: None, field: Field::Driver(DriverField::FrustrationRate) },
    Parameter { name: "pass_frustration", symbol: "p", unit: "", default: Value::Number(0.1), kind: number(0.0, 100.0), slider: slider(0.0, 1.0, 0.01),
        meaning: "rise of frustration when a vehicle in an adjacent lane passes", laws: None, field: Field::Driver(DriverField::PassFrustration) },
];

/// Every field stands at its own place of the table, which is how a field finds its row.
const _: () = {
    let mut place = 0;
    while place < PARAMETERS.len() {
        assert!(PARAMETERS[place].field.place() == place, "a row of the table is at the wrong place");
        place += 1;
    }
};

impl Law {
    /// Name, as messages and JSON write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Newell => "newell",
        }
    }
}

impl Field {
    const fn place(self) -> usize {
        match self {
            Self::Road(field) => field as usize,
            Self::Driver(field) => field as usize,
        }
    }
}

impl RoadField {
    /// The row of the table.
    pub fn parameter(self) -> &'static Parameter {
        &PARAMETERS[self as usize]
    }
}

impl DriverField {
    /// The row of the table.
    pub fn parameter(self) -> &'static Parameter {
        &PARAMETERS[self as usize]
    }
}

/// A look-up of parameters by their names, and what its refusal says: where the name stood, and which names are allowed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lookup {
    /// What the refusal says that the name was for.
    pub of: &'static str,
    /// Which parameters are looked up.
    pub among: Among,
    /// Names are spelled as in JSON, with underscores only. Elsewhere they have hyphens or underscores.
    pub as_in_json: bool,
    /// Other names that are allowed at this place, for the refusal.
    pub others: &'static str,
}

/// A part of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Among {
    All,
    Road,
    Drivers,
}

impl Lookup {
    /// Of every parameter, with hyphens or underscores.
    pub(crate) const fn all(of: &'static str) -> Self {
        Self { of, among: Among::All, as_in_json: false, others: "" }
    }

    fn rows(self) -> impl Iterator<Item = &'static Parameter> {
        let is_meant = move |p: &&Parameter| match self.among {
            Among::All => true,
            Among::Road => !p.is_of_driver(),
            Among::Drivers => p.is_of_driver(),
        };
        PARAMETERS.iter().filter(is_meant)
    }

    /// The parameter of that name.
    pub(crate) fn find(self, name: &str) -> Result<&'static Parameter, Error> {
        let spelled = |p: &Parameter| if self.as_in_json { p.name.to_owned() } else { p.hyphenated() };
        let sought = if self.as_in_json { name.to_owned() } else { name.replace('_', "-") };
        self.rows().find(|p| spelled(p) == sought).ok_or_else(|| {
            let names: Vec<_> = self.rows().map(spelled).collect();
            Error::unknown(self.of, quoted(name), format!("{}{}", names.join(", "), self.others))
        })
    }
}

/// The parameter of that name, with hyphens or underscores, as messages call a parameter that stands by itself.
pub fn parameter(name: &str) -> Result<&'static Parameter, Error> {
    Lookup::all("parameter").find(name)
}

impl Parameter {
    /// The row of that name, with hyphens or underscores.
    pub fn named(name: &str) -> Option<&'static Self> {
        parameter(name).ok()
    }

    /// The name as the command and the link write it.
    pub fn hyphenated(&self) -> String {
        self.name.replace('_', "-")
    }

    /// Whether it belongs to a driver.
    pub fn is_of_driver(&self) -> bool {
        matches!(self.field, Field::Driver(_))
    }

    /// Whether a law of car following uses it.
    pub fn is_used_by(&self, law: Law) -> bool {
        self.laws.is_none_or(|laws| laws.contains(&law))
    }

    /// Whether a scenario with that law may have this value: a parameter that the law does not use has its default.
    pub fn check_use(&self, law: Law, value: Value) -> Result<(), Error> {
        if self.is_used_by(law) || value == self.default {
            return Ok(());
        }
        let allowed = format!("{} only: the law {} does not use it", self.default, law.name());
        Err(Error::conflict(self.hyphenated(), value, allowed))
    }

    /// Whether the value alone is allowed; combinations are the scenario's to check.
    pub fn check(&self, value: impl Into<Value>) -> Result<(), Error> {
        let value = value.into();
        if self.kind.allows(value) {
            Ok(())
        } else {
            Err(Error::out_of_range(self.hyphenated(), value, self.allowed()))
        }
    }

    /// Reads a value that a person wrote, and checks it.
    pub fn parse(&self, text: &str) -> Result<Value, Error> {
        let value = self
            .kind
            .parse(text)
            .ok_or_else(|| Error::malformed(self.hyphenated(), quoted(text), self.allowed()))?;
        self.check(value).map(|()| value)
    }

    /// Reads a value of a JSON form. Whether it is allowed is not checked.
    pub(crate) fn read(&self, value: &Json) -> Result<Value, Error> {
        self.kind.from_json(value).ok_or_else(|| Error::malformed(self.name, value, self.allowed()))
    }

    /// What is allowed, in words: `a number from 0 to 10 s`.
    pub fn allowed(&self) -> String {
        self.kind.allowed(self.unit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_are_allowed_and_names_are_found_in_both_spellings() {
        for parameter in &PARAMETERS {
            assert!(parameter.check(parameter.default).is_ok(), "{}", parameter.name);
            assert_eq!(Parameter::named(&parameter.hyphenated()).unwrap().name, parameter.name);
            assert_eq!(Parameter::named(parameter.name).unwrap().name, parameter.name);
        }
        assert!(Parameter::named("speed").is_none());
    }

    #[test]
    fn a_refusal_names_field_value_and_range() {
        let reaction_time = DriverField::ReactionTime.parameter();
        for bad in ["-1", "11", "NaN", "inf", "soon", ""] {
            let message = reaction_time.parse(bad).unwrap_err().to_string();
            assert!(message.contains("reaction-time") && message.contains("from 0 to 10 s"), "{message}");
            assert!(message.contains(bad), "{message}");
        }
        assert!(RoadField::Vehicles.parameter().parse("2.5").is_err());
    }

    #[test]
    fn a_name_is_looked_up_where_it_may_stand_and_refused_in_the_words_of_the_place() {
        assert_eq!(Lookup::all("x").find("time-step"), Lookup::all("x").find("time_step"));
        let json = Lookup { of: "field", among: Among::Road, as_in_json: true, others: ", version" };
        assert!(json.find("time_step").is_ok() && json.find("time-step").is_err());
        let message = json.find("reaction_time").unwrap_err().to_string();
        assert_eq!(
            message,
            "field: “reaction_time” is not allowed; \
             allowed: vehicles, length, lanes, time_step, until, seed, version"
        );
        let drivers = Lookup { among: Among::Drivers, ..Lookup::all("effect") };
        assert!(drivers.find("vehicles").unwrap_err().to_string().contains("max-speed, sensitivity"));
    }

    /// Rows of kinds that no parameter has yet.
    #[test]
    fn rows_of_every_kind_are_read_checked_and_written() {
        let row = Parameter { name: "some_value", ..*DriverField::ReactionTime.parameter() };
        let range = Range { min: 1.0, max: 100.0 };
        let braking =
            Parameter { kind: Kind::NumberOrNone(range), default: Value::None, unit: "m/s²", ..row };
        let choice =
            Parameter { kind: Kind::Choice(&["left", "right"]), default: Value::Choice("left"), ..row };
        let limits = Parameter { kind: Kind::List(range), default: Value::None, slider: None, ..row };
        for (row, text, wrong, message) in [
            (
                braking,
                "9",
                "0",
                "some-value: 0 is not allowed; allowed: a number from 1 to 100 m/s², or none",
            ),
            (braking, "none", "no", "“no”"),
            (choice, "right", "up", "some-value: “up” is not allowed; allowed: left, right"),
            (limits, "30,40", "30,0", "some-value: 30,0 is not allowed"),
        ] {
            let value = row.parse(text).unwrap();
            assert_eq!(value.to_string(), text);
            assert_eq!(row.read(&value.into()), Ok(value));
            let refusal = row.parse(wrong).unwrap_err().to_string();
            assert!(refusal.contains(message), "{refusal}");
            assert!(row.read(&Json::Bool(true)).unwrap_err().to_string().starts_with("some_value: true"));
        }
        let json = |row: &Parameter| serde_json::to_value(row).unwrap();
        assert_eq!(json(&braking)["none"], true);
        assert_eq!(
            (&json(&braking)["default"], &json(&braking)["max"]),
            (&serde_json::Value::Null, &100.0.into())
        );
        assert_eq!(json(&choice)["choices"], serde_json::json!(["left", "right"]));
        assert_eq!(json(&choice).get("min"), None);
        assert_eq!(json(&limits)["list"], true);
        let keys: Vec<_> = json(&row).as_object().unwrap().keys().cloned().collect();
        assert_eq!(
            keys,
            ["default", "max", "meaning", "min", "name", "of", "slider", "symbol", "unit", "whole"]
        );
    }

    #[test]
    fn a_parameter_that_the_law_does_not_use_keeps_its_default() {
        let row = *DriverField::Sensitivity.parameter();
        assert!(row.check_use(Law::Newell, Value::Number(2.0)).is_ok());
        let unused = Parameter { laws: Some(&[]), ..row };
        assert!(unused.check_use(Law::Newell, unused.default).is_ok());
        let message = unused.check_use(Law::Newell, Value::Number(2.0)).unwrap_err().to_string();
        assert_eq!(message, "sensitivity: 2 is not allowed; allowed: 1 only: the law newell does not use it");
        let used = Parameter { laws: Some(&[Law::Newell]), ..row };
        assert!(used.check_use(Law::Newell, Value::Number(2.0)).is_ok());
        assert_eq!(serde_json::to_value(used).unwrap()["laws"], serde_json::json!(["newell"]));
    }
}
