//! The JSON form of a scenario: one flat object with `version`, the road's parameters, `start`, the default `driver`,
//! `exceptions` and `actions` (texts in the grammar of [`crate::scenario::action`]). What is left out has its default; an
//! unknown name is refused.

use crate::error::Error;
use crate::format::json::{Json, Object};
use crate::scenario::Scenario;
use crate::scenario::action::{Action, DriverOverride};
use crate::scenario::parameters::{Among, Lookup, PARAMETERS};
use serde::Serialize;
use std::str::FromStr;

/// Version of the JSON form.
const FORMAT: u64 = 1;

/// Names in the object of a scenario, and in that of its driver.
const OF_SCENARIO: Lookup = Lookup {
    of: "field",
    among: Among::Road,
    as_in_json: true,
    others: ", version, start, driver, exceptions, actions",
};
const OF_DRIVER: Lookup = Lookup { among: Among::Drivers, others: "", ..OF_SCENARIO };

impl Scenario {
    /// One line of JSON with every field, as headers carry it.
    pub fn to_json(&self) -> String {
        self.tree().to_string()
    }

    /// Reads JSON and validates.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        Object::read("scenario", text).and_then(|object| Self::from_object(&object))
    }

    /// The scenario as an object of JSON, with every field.
    pub fn tree(&self) -> Json {
        let (mut object, mut driver) = (Object::default(), Object::default());
        for parameter in PARAMETERS.iter().filter(|p| p.is_used_by(self.law())) {
            let holder = if parameter.is_of_driver() { &mut driver } else { &mut object };
            holder.insert(parameter.name, self.value(parameter));
        }
        object.insert("version", FORMAT);
        object.insert("start", self.start.to_string());
        object.insert("driver", driver);
        object.insert("exceptions", self.overrides.iter().map(DriverOverride::to_string).collect::<Json>());
        object.insert("actions", self.actions.iter().map(Action::to_string).collect::<Json>());
        object.into()
    }

    fn from_object(object: &Object) -> Result<Self, Error> {
        let mut scenario = Self::default();
        for (name, value) in object.iter() {
            match name {
                "version" if value.as_number() == Some(FORMAT as f64) => {}
                "version" => return Err(Error::version("version", value, FORMAT.to_string())),
                "start" => {
                    let text = value.as_text().ok_or_else(|| Error::malformed("start", value, "a text"))?;
                    scenario.start = text.parse()?;
                }
                "driver" => {
                    let Json::Object(driver) = value else {
                        return Err(Error::malformed("driver", value, "a JSON object"));
                    };
                    for (name, value) in driver.iter() {
                        let parameter = OF_DRIVER.find(name).map_err(|e| e.within("driver"))?;
                        scenario.set(parameter, parameter.read(value)?)?;
                    }
                }
                "exceptions" => scenario.overrides = read_texts("exceptions", value)?,
                "actions" => scenario.actions = read_texts("actions", value)?,
                name => {
                    let parameter = OF_SCENARIO.find(name)?;
                    scenario.set(parameter, parameter.read(value)?)?;
                }
            }
        }
        scenario.validate()?;
        Ok(scenario)
    }
}

impl Serialize for Scenario {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.tree().serialize(serializer)
    }
}

fn read_texts<T: FromStr<Err = Error>>(field: &'static str, value: &Json) -> Result<Vec<T>, Error> {
    let list = value.as_list().ok_or_else(|| Error::malformed(field, value, "a list of texts"))?;
    let one = |(k, item): (usize, &Json)| {
        let text =
            item.as_text().ok_or_else(|| Error::malformed(format!("{field}[{}]", k + 1), item, "a text"))?;
        text.parse().map_err(|e: Error| e.within(format!("{field}[{}]", k + 1)))
    };
    list.iter().enumerate().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn json_reads_back_and_defaults_fill_the_rest() {
        let json = r#"{"version":1,"vehicles":20,"time_step":0.05,"driver":{"reaction_time":0.1},
            "exceptions":["3:sensitivity=2"],"actions":["at=0:1:nudge=1"]}"#;
        let scenario = Scenario::from_json(json).unwrap();
        assert_eq!((scenario.vehicles, scenario.length), (20, 1000.0));
        assert_eq!(Scenario::from_json(&scenario.to_json()).unwrap(), scenario);
        assert_eq!(serde_json::to_string(&scenario).unwrap(), scenario.to_json());
    }
}
