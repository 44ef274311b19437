//! The values that a varied parameter takes, in the grammar of the command:
//!
//! ```text
//! NAME=ITEM[,ITEM …]        lanes=1,2,4
//! ITEM  VALUE | FROM:TO:BY  reaction-time=0:0.8:0.05
//! ```
//!
//! A range ends with the last value that does not go beyond TO. It is counted in decimal whole numbers, so that its
//! fourth value is 0.15 and not 3 · 0.05 = 0.15000000000000002.

use crate::error::{Error, quoted};
use crate::scenario::parameters::{PARAMETERS, Parameter};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// The most values of one parameter.
pub const MOST_VALUES: usize = 100_000;

/// A parameter and the values that it takes, all of them different and allowed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct ParameterValues {
    parameter: &'static Parameter,
    values: Vec<f64>,
}

impl ParameterValues {
    /// A parameter, except the seed, with its values.
    pub fn new(parameter: &'static Parameter, values: Vec<f64>) -> Result<Self, Error> {
        let refuse = |value: String, allowed: String| Err(Error::new("vary", value, allowed));
        if parameter.name == "seed" {
            return refuse(
                quoted("seed"),
                "any other parameter: seeds follow from the number of runs".to_owned(),
            );
        }
        if values.is_empty() {
            let name = parameter.hyphenated();
            return refuse(quoted(&format!("{name}=")), format!("{name} with at least one value"));
        }
        for (i, &value) in values.iter().enumerate() {
            parameter.check(value).map_err(|e| e.within("vary"))?;
            if values[..i].contains(&value) {
                let name = parameter.hyphenated();
                return refuse(quoted(&format!("{name}={value}")), format!("every value of {name} once"));
            }
        }
        Ok(Self { parameter, values })
    }

    /// What is varied.
    pub fn parameter(&self) -> &'static Parameter {
        self.parameter
    }

    /// The values, in the order given.
    pub fn values(&self) -> &[f64] {
        &self.values
    }
}

impl fmt::Display for ParameterValues {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let values: Vec<_> = self.values.iter().map(f64::to_string).collect();
        write!(f, "{}={}", self.parameter.hyphenated(), values.join(","))
    }
}

impl From<ParameterValues> for String {
    fn from(vary: ParameterValues) -> Self {
        vary.to_string()
    }
}

impl TryFrom<String> for ParameterValues {
    type Error = Error;
    fn try_from(text: String) -> Result<Self, Error> {
        text.parse()
    }
}

impl FromStr for ParameterValues {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self, Error> {
        let (name, items) = text.split_once('=').ok_or_else(|| {
            let form = "NAME=VALUES, such as reaction-time=0:0.8:0.05 or lanes=1,2,4";
            Error::new("vary", quoted(text), form)
        })?;
        let parameter = Parameter::named(name.trim()).ok_or_else(|| {
            let names: Vec<_> = PARAMETERS.iter().map(Parameter::hyphenated).collect();
            Error::new("vary", quoted(name), names.join(", "))
        })?;
        let mut values = Vec::new();
        for item in items.split(',') {
            values.extend(expand(item.trim()).map_err(|e| e.within(format!("vary {}", name.trim())))?);
            if values.len() > MOST_VALUES {
                let allowed = format!("at most {MOST_VALUES} values of one parameter");
                return Err(Error::new("vary", quoted(text), allowed));
            }
        }
        Self::new(parameter, values)
    }
}

/// A value or a range.
fn expand(item: &str) -> Result<Vec<f64>, Error> {
    let refuse = |allowed: &'static str| Error::new("values", quoted(item), allowed);
    let parts: Vec<_> = item.split(':').collect();
    let (from, to, by) = match parts[..] {
        [value] => {
            let value: f64 = value.parse().map_err(|_| refuse("a number, or a range FROM:TO:BY"))?;
            return Ok(vec![value]);
        }
        [from, to, by] => (from, to, by),
        _ => return Err(refuse("a number, or a range FROM:TO:BY such as 0:0.8:0.05")),
    };
    let decimal = |text: &str| Decimal::parse(text).ok_or_else(|| refuse("a range of plain decimal numbers"));
    let (from, to, by) = (decimal(from)?, decimal(to)?, decimal(by)?);
    let exponent = from.exponent.min(to.exponent).min(by.exponent);
    let scaled = |d: Decimal| d.at(exponent).ok_or_else(|| refuse("a range of fewer digits"));
    let (from, to, by) = (scaled(from)?, scaled(to)?, scaled(by)?);
    if by == 0 || (to - from).signum() * by.signum() < 0 {
        return Err(refuse("a range FROM:TO:BY whose steps lead from FROM to TO"));
    }
    let steps = (to - from) / by;
    if steps >= MOST_VALUES as i128 {
        return Err(refuse("a range with longer steps: it has too many values"));
    }
    // Reading the decimal text rounds once, to the number that a person would have written.
    let value = |k: i128| format!("{}e{exponent}", from + k * by).parse().expect("a decimal number");
    Ok((0..=steps).map(value).collect())
}

/// mantissa · 10^exponent.
#[derive(Clone, Copy)]
struct Decimal {
    mantissa: i128,
    exponent: i32,
}

impl Decimal {
    fn parse(text: &str) -> Option<Self> {
        let (digits, exponent) = match text.trim().split_once(['e', 'E']) {
            Some((digits, exponent)) => (digits, exponent.parse::<i32>().ok()?),
            None => (text.trim(), 0),
        };
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        let sound = whole.len() + fraction.len() <= 25
            && exponent.abs() <= 25
            && fraction.bytes().all(|b| b.is_ascii_digit());
        let mantissa = format!("{whole}{fraction}").parse().ok().filter(|_| sound)?;
        Some(Self { mantissa, exponent: exponent - fraction.len() as i32 })
    }

    /// The whole number of units 10^exponent; `exponent` is at most its own.
    fn at(self, exponent: i32) -> Option<i128> {
        let factor = 10_i128.checked_pow((self.exponent - exponent) as u32)?;
        // Room for the difference of two such numbers.
        self.mantissa.checked_mul(factor).filter(|m| m.abs() < i128::MAX / 4)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<f64> {
        text.parse::<ParameterValues>().unwrap().values
    }

    #[test]
    fn a_range_has_clean_decimals() {
        let range = values("reaction-time=0:0.8:0.05");
        assert_eq!(range.len(), 17);
        let written = "0,0.05,0.1,0.15,0.2,0.25,0.3,0.35,0.4,0.45,0.5,0.55,0.6,0.65,0.7,0.75,0.8";
        assert_eq!(
            "reaction-time=0:0.8:0.05".parse::<ParameterValues>().unwrap().to_string(),
            format!("reaction-time={written}")
        );
        assert!(3.0 * 0.05 != 0.15 && range[3] == 0.15);
    }

    #[test]
    fn ranges_and_lists_may_be_mixed_and_run_down() {
        assert_eq!(values("lanes=1,2,4"), [1.0, 2.0, 4.0]);
        assert_eq!(values("vehicles=10:50:20,100"), [10.0, 30.0, 50.0, 100.0]);
        assert_eq!(values("sensitivity=1:0.4:-0.2"), [1.0, 0.8, 0.6, 0.4]);
        assert_eq!(values("sensitivity=0.5:1:0.3"), [0.5, 0.8]);
        assert_eq!(values("length=1e3:2e3:5e2"), [1000.0, 1500.0, 2000.0]);
        assert_eq!(values("until=5:5:1"), [5.0]);
        assert_eq!(values("time_step=.1:.3:.1"), [0.1, 0.2, 0.3]);
    }

    #[test]
    fn what_is_written_reads_back() {
        let vary: ParameterValues = "reaction_time=0.1,1e-9,3:4:0.3".parse().unwrap();
        assert_eq!(vary.to_string().parse::<ParameterValues>().unwrap(), vary);
        assert_eq!(
            serde_json::from_str::<ParameterValues>(&serde_json::to_string(&vary).unwrap()).unwrap(),
            vary
        );
    }

    #[test]
    fn what_is_wrong_is_named() {
        for (text, named) in [
            ("reaction-time", "NAME=VALUES"),
            ("colour=1", "“colour”"),
            ("seed=1,2", "seed"),
            ("lanes=1,2,1", "lanes=1"),
            ("lanes=1.5", "1.5"),
            ("lanes=0:4:1", "from 1 to 8"),
            ("reaction-time=0:1", "FROM:TO:BY"),
            ("reaction-time=0:1:0", "0:1:0"),
            ("reaction-time=0:1:-0.1", "0:1:-0.1"),
            ("reaction-time=0:1:1e-9", "too many"),
            ("reaction-time=0:x:1", "0:x:1"),
            ("reaction-time=", "a number"),
            ("reaction-time=NaN", "NaN"),
        ] {
            let message = text.parse::<ParameterValues>().unwrap_err().to_string();
            assert!(message.contains(named), "{text}: {message}");
        }
    }
}
