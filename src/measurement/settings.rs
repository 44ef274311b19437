//! The settings of measurements as one table: name, unit, range and meaning of each. The options of the command, the checks
//! of values and their messages are made from it.
//!
//! ```
//! use ringroad::measurement::{Measurement, SETTINGS};
//!
//! let window = SETTINGS.iter().find(|setting| setting.name == "window").unwrap();
//! assert_eq!(window.allowed(), "a number from 0.001 to 10000000 s");
//! assert!(Measurement::named("flow")?.settings().contains(&window));
//! # Ok::<(), ringroad::error::Error>(())
//! ```

use crate::error::{Error, quoted};
use crate::format::json::Json;
use serde::Serialize;

/// One setting of measurements.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Setting {
    /// Name in JSON.
    pub name: &'static str,
    /// Name of the command's option.
    pub option: &'static str,
    /// Unit; empty for a pure number.
    pub unit: &'static str,
    /// Smallest allowed value.
    pub min: f64,
    /// Largest allowed value.
    pub max: f64,
    /// Whether only whole numbers are allowed.
    pub whole: bool,
    /// Whether it is a list of numbers.
    pub list: bool,
    /// What it means, in one line.
    pub meaning: &'static str,
}

/// Every setting of any measurement.
#[rustfmt::skip]
pub static SETTINGS: [Setting; 12] = [
    Setting { name: "every", option: "every", unit: "s", min: 1e-3, max: 1e7, whole: false, list: false, meaning: "time between rows" },
    Setting { name: "vehicle", option: "vehicle", unit: "", min: 1.0, max: 1e6, whole: true, list: false, meaning: "whose speed is followed" },
    Setting { name: "vehicles", option: "vehicle", unit: "", min: 1.0, max: 1e6, whole: true, list: true, meaning: "whose speeds" },
    Setting { name: "bins", option: "bins", unit: "", min: 1.0, max: 1e5, whole: true, list: false, meaning: "cells of a map round the ring" },
    Setting { name: "lane", option: "lane", unit: "", min: 1.0, max: 8.0, whole: true, list: false, meaning: "which lane" },
    Setting { name: "window", option: "window", unit: "s", min: 1e-3, max: 1e7, whole: false, list: false, meaning: "window δ over which vehicles are counted" },
    Setting { name: "at", option: "at", unit: "m", min: 0.0, max: 1e8, whole: false, list: false, meaning: "place where vehicles are counted" },
    Setting { name: "modes", option: "modes", unit: "", min: 1.0, max: 1e4, whole: true, list: false, meaning: "Fourier modes from 1 to this" },
    Setting { name: "from", option: "from", unit: "s", min: 0.0, max: 1e7, whole: false, list: false, meaning: "start of the fit" },
    Setting { name: "smallest", option: "smallest", unit: "m", min: 1e-12, max: 1e3, whole: false, list: false, meaning: "amplitude under which a mode is lost in rounding" },
    Setting { name: "nonlinearity", option: "nonlinearity", unit: "", min: 1e-12, max: 1e3, whole: false, list: false, meaning: "share of what is not linear in a mode's motion above which it is left out" },
    Setting { name: "periods", option: "periods", unit: "", min: 2.0, max: 1e6, whole: true, list: false, meaning: "number of periods fitted" },
];

impl Setting {
    /// What is allowed, in words.
    pub fn allowed(&self) -> String {
        let numbers = match (self.list, self.whole) {
            (true, _) => "whole numbers",
            (false, true) => "a whole number",
            (false, false) => "a number",
        };
        let space = if self.unit.is_empty() { "" } else { " " };
        format!("{numbers} from {} to {}{space}{}", self.min, self.max, self.unit)
    }

    fn refuse(&self, value: impl std::fmt::Display) -> Error {
        Error::out_of_range(self.name, value, self.allowed())
    }

    pub(super) fn check(&self, value: &Json) -> Result<(), Error> {
        let one = |value: &Json| {
            let inside = |x: f64| x >= self.min && x <= self.max && (!self.whole || x == x.trunc());
            if value.as_number().is_some_and(inside) { Ok(()) } else { Err(self.refuse(value)) }
        };
        match value {
            Json::List(items) if self.list && !items.is_empty() => items.iter().try_for_each(one),
            _ if self.list => Err(self.refuse(value)),
            _ => one(value),
        }
    }

    /// Reads what a person wrote; a list has commas between its numbers.
    pub(super) fn parse(&self, text: &str) -> Result<Json, Error> {
        let one = |text: &str| {
            let number: f64 = text.trim().parse().map_err(|_| self.refuse(quoted(text)))?;
            if number.is_finite() { Ok(Json::from(number)) } else { Err(self.refuse(number)) }
        };
        let value = if self.list {
            Json::List(text.split(',').map(one).collect::<Result<_, _>>()?)
        } else {
            one(text)?
        };
        self.check(&value).map(|()| value)
    }
}
