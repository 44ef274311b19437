//! The one table of parameters.
//!
//! The command's options, the link of the page, its sliders, the CSV header, validation and the reference
//! documentation all come from [`PARAMETERS`]; a parameter is added here and nowhere else.

use crate::error::{Error, quoted};
use crate::scenario::Scenario;
use crate::scenario::driver::Driver;
use serde::Serialize;

/// What a parameter belongs to, and how it is read and written there.
#[derive(Clone, Copy, Debug)]
pub enum Scope {
    /// The road and the run: cannot change while the run goes on.
    Road {
        /// Reads the value.
        get: fn(&Scenario) -> f64,
        /// Writes a value that the caller has checked.
        set: fn(&mut Scenario, f64),
    },
    /// A driver: the default one, an exception, or from some time on.
    Driver {
        /// Reads the value.
        get: fn(&Driver) -> f64,
        /// Writes a value that the caller has checked.
        set: fn(&mut Driver, f64),
    },
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
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Parameter {
    /// Name in Rust and JSON, with underscores.
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
    /// Range of the slider, if the page has one.
    pub slider: Option<Slider>,
    /// Whether only whole numbers are allowed.
    pub whole: bool,
    /// What it means, in one line.
    pub meaning: &'static str,
    /// Whose it is.
    #[serde(serialize_with = "scope_name", rename = "of")]
    pub scope: Scope,
}

impl PartialEq for Parameter {
    /// A name stands for its row.
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

fn scope_name<S: serde::Serializer>(scope: &Scope, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(match scope {
        Scope::Road { .. } => "road",
        Scope::Driver { .. } => "driver",
    })
}

macro_rules! road {
    ($field:ident) => {
        Scope::Road { get: |s| s.$field, set: |s, v| s.$field = v }
    };
    // Whole numbers; the table's range keeps the conversion exact.
    ($field:ident as $type:ty) => {
        Scope::Road { get: |s| s.$field as f64, set: |s, v| s.$field = v as $type }
    };
}
macro_rules! driver {
    ($field:ident) => {
        Scope::Driver { get: |d| d.$field, set: |d, v| d.$field = v }
    };
}
#[allow(clippy::unnecessary_wraps)] // keeps the table readable
const fn slider(min: f64, max: f64, step: f64) -> Option<Slider> {
    Some(Slider { min, max, step })
}

/// Every parameter, in the order in which people read them.
#[rustfmt::skip]
pub static PARAMETERS: [Parameter; 13] = [
    Parameter { name: "vehicles", symbol: "N", unit: "", default: 50.0, min: 1.0, max: 1e6, slider: slider(2.0, 133.0, 1.0), whole: true,
        meaning: "vehicles on the ring, all lanes together", scope: road!(vehicles as usize) },
    Parameter { name: "length", symbol: "L", unit: "m", default: 1000.0, min: 10.0, max: 1e8, slider: slider(200.0, 5000.0, 10.0), whole: false,
        meaning: "length of the ring", scope: road!(length) },
    Parameter { name: "lanes", symbol: "", unit: "", default: 1.0, min: 1.0, max: 8.0, slider: slider(1.0, 4.0, 1.0), whole: true,
        meaning: "lanes; lane 1 is the outermost", scope: road!(lanes as usize) },
    Parameter { name: "time_step", symbol: "dt", unit: "s", default: 0.01, min: 0.001, max: 0.5, slider: slider(0.01, 0.1, 0.005), whole: false,
        meaning: "fixed Euler step", scope: road!(time_step) },
    Parameter { name: "until", symbol: "", unit: "s", default: 600.0, min: 0.0, max: 1e7, slider: None, whole: false,
        meaning: "end of the run", scope: road!(until) },
    Parameter { name: "seed", symbol: "", unit: "", default: 1.0, min: 0.0, max: 9_007_199_254_740_991.0, slider: None, whole: true,
        meaning: "seed of every random draw", scope: road!(seed as u64) },
    Parameter { name: "max_speed", symbol: "V", unit: "m/s", default: 40.0, min: 0.1, max: 100.0, slider: slider(5.0, 60.0, 0.5), whole: false,
        meaning: "speed at infinite headway", scope: driver!(max_speed) },
    Parameter { name: "sensitivity", symbol: "λ", unit: "1/s", default: 1.0, min: 0.01, max: 20.0, slider: slider(0.2, 4.0, 0.05), whole: false,
        meaning: "slope of speed against headway at the minimum headway", scope: driver!(sensitivity) },
    Parameter { name: "min_headway", symbol: "d", unit: "m", default: 7.5, min: 0.1, max: 100.0, slider: slider(5.5, 20.0, 0.1), whole: false,
        meaning: "headway at which the speed reaches 0; more than the vehicle's length", scope: driver!(min_headway) },
    Parameter { name: "vehicle_length", symbol: "C", unit: "m", default: 5.0, min: 0.1, max: 50.0, slider: slider(2.0, 12.0, 0.1), whole: false,
        meaning: "length of the vehicle: a collision when the headway falls to it", scope: driver!(vehicle_length) },
    Parameter { name: "reaction_time", symbol: "Δ", unit: "s", default: 0.0, min: 0.0, max: 10.0, slider: slider(0.0, 1.5, 0.01), whole: false,
        meaning: "delay between the scene and the response to it", scope: driver!(reaction_time) },
    Parameter { name: "frustration_rate", symbol: "r", unit: "1/s", default: 0.1, min: 0.0, max: 100.0, slider: slider(0.0, 1.0, 0.01), whole: false,
        meaning: "rise of frustration while the adjacent lane looks better, fall while it looks worse", scope: driver!(frustration_rate) },
    Parameter { name: "pass_frustration", symbol: "p", unit: "", default: 0.1, min: 0.0, max: 100.0, slider: slider(0.0, 1.0, 0.01), whole: false,
        meaning: "rise of frustration when a vehicle in an adjacent lane passes", scope: driver!(pass_frustration) },
];

impl Parameter {
    /// The row of that name, with hyphens or underscores.
    pub fn named(name: &str) -> Option<&'static Self> {
        PARAMETERS.iter().find(|p| p.name.len() == name.len() && p.hyphenated() == name.replace('_', "-"))
    }

    /// The name as the command and the link write it.
    pub fn hyphenated(&self) -> String {
        self.name.replace('_', "-")
    }

    /// Whether it belongs to a driver.
    pub fn is_of_driver(&self) -> bool {
        matches!(self.scope, Scope::Driver { .. })
    }

    /// Its value in a scenario; a driver's parameter is that of the default driver.
    pub fn get(&self, scenario: &Scenario) -> f64 {
        match self.scope {
            Scope::Road { get, .. } => get(scenario),
            Scope::Driver { get, .. } => get(&scenario.driver),
        }
    }

    /// Checks a value and writes it into the scenario (a driver's parameter: of the default driver).
    pub fn set(&self, scenario: &mut Scenario, value: f64) -> Result<(), Error> {
        self.check(value)?;
        match self.scope {
            Scope::Road { set, .. } => set(scenario, value),
            Scope::Driver { set, .. } => set(&mut scenario.driver, value),
        }
        Ok(())
    }

    /// Whether the value alone is allowed; combinations are the scenario's to check.
    pub fn check(&self, value: f64) -> Result<(), Error> {
        let inside = value >= self.min && value <= self.max;
        if inside && (!self.whole || value == value.trunc()) {
            Ok(())
        } else {
            Err(Error::new(self.hyphenated(), value, self.allowed()))
        }
    }

    /// Reads a value that a person wrote.
    pub fn parse(&self, text: &str) -> Result<f64, Error> {
        let value =
            text.trim().parse().map_err(|_| Error::new(self.hyphenated(), quoted(text), self.allowed()))?;
        self.check(value).map(|()| value)
    }

    /// What is allowed, in words: `a number from 0 to 10 s`.
    pub fn allowed(&self) -> String {
        let kind = if self.whole { "a whole number" } else { "a number" };
        let space = if self.unit.is_empty() { "" } else { " " };
        format!("{kind} from {} to {}{space}{}", self.min, self.max, self.unit)
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
    fn a_scenario_holds_what_the_table_says() {
        let mut scenario = Scenario::default();
        for parameter in &PARAMETERS {
            assert_eq!(parameter.get(&scenario), parameter.default, "{}", parameter.name);
            let edge = if parameter.default == parameter.max { parameter.min } else { parameter.max };
            parameter.set(&mut scenario, edge).unwrap();
            assert_eq!(parameter.get(&scenario), edge, "{}", parameter.name);
        }
    }

    #[test]
    fn a_refusal_names_field_value_and_range() {
        let reaction_time = Parameter::named("reaction-time").unwrap();
        for bad in ["-1", "11", "NaN", "inf", "soon", ""] {
            let message = reaction_time.parse(bad).unwrap_err().to_string();
            assert!(message.contains("reaction-time") && message.contains("from 0 to 10 s"), "{message}");
            assert!(message.contains(bad), "{message}");
        }
        assert!(Parameter::named("vehicles").unwrap().parse("2.5").is_err());
    }
}
