//! A parameter and the values that a batch (`--vary`) or a sweep of the theory (`--sweep`) gives it, in the grammar of
//! the command:
//!
//! ```text
//! NAME=ITEM[,ITEM …]        lanes=1,2,4
//! ITEM  VALUE | FROM:TO:BY  reaction-time=0:0.8:0.05
//!       FROM:TO             vehicles=2:133 (sweeps only: steps of 1, or 100 steps where numbers need not be whole)
//! ```
//!
//! A range ends with the last value that does not go beyond TO. It is counted in decimal whole numbers, so that the
//! fourth value of `0:0.8:0.05` is 0.15 and not 3 · 0.05 = 0.15000000000000002.
//!
//! ```
//! use ringroad::scenario::parameter_values::ParameterValues;
//!
//! let varied: ParameterValues = "reaction-time=0:0.2:0.05,0.5".parse().unwrap();
//! assert_eq!(varied.values(), [0.0, 0.05, 0.1, 0.15, 0.2, 0.5]);
//! assert_eq!(ParameterValues::sweep("vehicles=2:4").unwrap().values(), [2.0, 3.0, 4.0]);
//! ```

use crate::error::{Error, quoted};
use crate::scenario::parameters::{Lookup, Parameter, RoadField};
use serde::{Deserialize, Serialize};
use std::collections::HashSet;
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

/// What the values are for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Use {
    Batch,
    Sweep,
}

impl Use {
    /// What a refusal says that the text was for.
    fn name(self) -> &'static str {
        match self {
            Self::Batch => "vary",
            Self::Sweep => "sweep",
        }
    }

    fn names(self) -> Lookup {
        Lookup::all(match self {
            Self::Batch => "vary",
            Self::Sweep => "parameter",
        })
    }

    fn form(self) -> &'static str {
        match self {
            Self::Batch => "NAME=VALUES, such as reaction-time=0:0.8:0.05 or lanes=1,2,4",
            Self::Sweep => {
                "PARAMETER=FROM:TO or PARAMETER=FROM:TO:STEP, such as vehicles=2:133, or PARAMETER=VALUE,VALUE"
            }
        }
    }
}

impl ParameterValues {
    /// A parameter with its values, for a batch. The seed is refused: the runs of a batch have seeds of their own.
    pub fn new(parameter: &'static Parameter, values: Vec<f64>) -> Result<Self, Error> {
        if parameter == RoadField::Seed.parameter() {
            let allowed = "any other parameter: seeds follow from the number of runs";
            return Err(Error::conflict("vary", quoted("seed"), allowed));
        }
        Self::checked(parameter, values, Use::Batch)
    }

    /// Reads the values of a sweep. Here a range may leave out its step: `vehicles=2:133`.
    pub fn sweep(text: &str) -> Result<Self, Error> {
        let (parameter, values) = read(text, Use::Sweep)?;
        Self::checked(parameter, values, Use::Sweep)
    }

    fn checked(parameter: &'static Parameter, values: Vec<f64>, of: Use) -> Result<Self, Error> {
        let refuse = |value: String, allowed: String| Err(Error::conflict(of.name(), value, allowed));
        let name = parameter.hyphenated();
        if values.is_empty() {
            return refuse(quoted(&format!("{name}=")), format!("{name} with at least one value"));
        }
        let mut known = HashSet::with_capacity(values.len());
        for &value in &values {
            parameter.check(value).map_err(|e| e.within(of.name()))?;
            // The sum makes 0 of −0.
            if !known.insert((value + 0.0).to_bits()) {
                return refuse(quoted(&format!("{name}={value}")), format!("every value of {name} once"));
            }
        }
        Ok(Self { parameter, values })
    }

    /// The parameter.
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
    /// Reads the values of a batch.
    fn from_str(text: &str) -> Result<Self, Error> {
        let (parameter, values) = read(text, Use::Batch)?;
        Self::new(parameter, values)
    }
}

/// The parameter and its values, ranges written out; whether they are allowed is not checked.
fn read(text: &str, of: Use) -> Result<(&'static Parameter, Vec<f64>), Error> {
    let (name, items) =
        text.split_once('=').ok_or_else(|| Error::malformed(of.name(), quoted(text), of.form()))?;
    let parameter = of.names().find(name.trim())?;
    let mut values = Vec::new();
    for item in items.split(',') {
        let place = |e: Error| if of == Use::Batch { e.within(format!("vary {}", name.trim())) } else { e };
        values.extend(expand(item.trim(), parameter, of).map_err(place)?);
        if values.len() > MOST_VALUES {
            let allowed = format!("at most {MOST_VALUES} values of one parameter");
            return Err(Error::too_large(of.name(), quoted(text), allowed));
        }
    }
    Ok((parameter, values))
}

/// The values of an item: one value, or those of a range.
fn expand(item: &str, parameter: &Parameter, of: Use) -> Result<Vec<f64>, Error> {
    let refuse = |allowed: &'static str| Error::malformed("values", quoted(item), allowed);
    let parts: Vec<_> = item.split(':').map(str::trim).collect();
    let (from, to, by) = match parts[..] {
        [value] => {
            let value: f64 = value.parse().map_err(|_| refuse("a number, or a range FROM:TO:BY"))?;
            return Ok(vec![value]);
        }
        [from, to, by] => (from, to, Some(by)),
        [from, to] if of == Use::Sweep => (from, to, None),
        _ => return Err(refuse("a number, or a range FROM:TO:BY such as 0:0.8:0.05")),
    };
    let decimal = |text: &str| Decimal::parse(text).ok_or_else(|| refuse("a range of plain decimal numbers"));
    let ends = [decimal(from)?, decimal(to)?];
    let whole = parameter.kind.is_whole();
    let step = match by {
        Some(by) => Some(decimal(by)?),
        None if whole => Some(Decimal { mantissa: 1, exponent: 0 }),
        None => None,
    };
    let smallest = ends.iter().chain(&step).map(|d| d.exponent).min().unwrap_or(0);
    // Without a step, a hundredth of the difference is needed.
    let exponent = if step.is_some() { smallest } else { smallest - 2 };
    let scaled = |d: Decimal| d.at(exponent).ok_or_else(|| refuse("a range of fewer digits"));
    let (first, last) = (scaled(ends[0])?, scaled(ends[1])?);
    let step = step.map_or(Ok((last - first) / 100), scaled)?;
    if by.is_none() && first == last {
        return Ok(vec![Decimal { mantissa: first, exponent }.value()]);
    }
    if step == 0 || (last - first).signum() * step.signum() < 0 {
        return Err(if by.is_some() {
            refuse("a range FROM:TO:BY whose steps lead from FROM to TO")
        } else {
            let allowed = format!("{to}:{from}, or a step downwards: {from}:{to}:-1");
            Error::malformed("range", quoted(item), allowed)
        });
    }
    let steps = (last - first) / step;
    if steps >= MOST_VALUES as i128 {
        return Err(if by.is_some() {
            Error::too_large("values", quoted(item), "a range with longer steps: it has too many values")
        } else {
            let allowed = format!("at most {MOST_VALUES} values, or a larger step: {from}:{to}:STEP");
            Error::too_large("range", quoted(item), allowed)
        });
    }
    if let Some(by) = by.filter(|_| whole && steps > 0) {
        let value = Decimal { mantissa: step, exponent }.value();
        if value != value.trunc() {
            let allowed = format!("a whole step: {} is a whole number", parameter.hyphenated());
            return Err(Error::out_of_range("step", by, allowed));
        }
    }
    Ok((0..=steps).map(|k| Decimal { mantissa: first + k * step, exponent }.value()).collect())
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
            && (-25..=25).contains(&exponent)
            && fraction.bytes().all(|b| b.is_ascii_digit());
        if !sound {
            return None;
        }
        let mantissa = format!("{whole}{fraction}").parse().ok()?;
        Some(Self { mantissa, exponent: exponent - fraction.len() as i32 })
    }

    /// The nearest number: reading the decimal text rounds once.
    fn value(self) -> f64 {
        format!("{}e{}", self.mantissa, self.exponent).parse().expect("a decimal number")
    }

    /// The whole number of units 10^exponent; `exponent` is at most its own.
    fn at(self, exponent: i32) -> Option<i128> {
        let factor = 10_i128.checked_pow((self.exponent - exponent) as u32)?;
        // A difference of two such numbers must fit, too.
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
    fn written_values_read_back() {
        let vary: ParameterValues = "reaction_time=0.1,1e-9,3:4:0.3".parse().unwrap();
        assert_eq!(vary.to_string().parse::<ParameterValues>().unwrap(), vary);
        assert_eq!(
            serde_json::from_str::<ParameterValues>(&serde_json::to_string(&vary).unwrap()).unwrap(),
            vary
        );
    }

    #[test]
    fn refusals_name_the_wrong_part() {
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
            ("lanes=1:4:0.5", "step: 0.5 is not allowed; allowed: a whole step: lanes is a whole number"),
            ("reaction-time=0:1:1e-2147483648", "plain decimal"),
            ("reaction-time=0,-0", "every value of reaction-time once"),
        ] {
            let message = text.parse::<ParameterValues>().unwrap_err().to_string();
            assert!(message.contains(named), "{text}: {message}");
        }
    }
    #[test]
    fn sweeps_may_leave_out_the_step() {
        let values = |text: &str| ParameterValues::sweep(text).unwrap().values;
        assert_eq!(values("vehicles=2:5"), [2.0, 3.0, 4.0, 5.0]);
        assert_eq!(values("reaction-time=0:0.2:0.05"), [0.0, 0.05, 0.1, 0.15, 0.2]);
        assert_eq!(values("reaction-time=0.5:0.5"), [0.5]);
        assert_eq!(values("vehicles=5:2:-1"), [5.0, 4.0, 3.0, 2.0]);
        assert_eq!(values("seed=1:3"), [1.0, 2.0, 3.0]);
        let hundred = values("sensitivity=1:2");
        assert_eq!((hundred.len(), hundred[0], hundred[7], hundred[100]), (101, 1.0, 1.07, 2.0));
        assert_eq!(values("sensitivity=2:1")[1], 1.99);
        for (bad, named) in [
            ("vehicles", "PARAMETER=FROM:TO"),
            ("cars=1:2", "parameter: “cars” is not allowed; allowed: vehicles, "),
            ("vehicles=0:5", "from 1 to"),
            ("vehicles=2:5:0", "“2:5:0”"),
            ("vehicles=2:5:-1", "“2:5:-1”"),
            ("vehicles=5:2", "“5:2” is not allowed; allowed: 2:5, or a step downwards: 5:2:-1"),
            ("vehicles=1:200000", "“1:200000” is not allowed; allowed: at most 100000 values"),
            ("vehicles=2:5:0.5", "step: 0.5 is not allowed; allowed: a whole step"),
            ("vehicles=2:5:NaN", "“2:5:NaN”"),
            ("reaction-time=0:1:x", "“0:1:x”"),
        ] {
            let message = ParameterValues::sweep(bad).unwrap_err().to_string();
            assert!(message.contains(named), "{bad}: {message}");
        }
        assert!("vehicles=2:5".parse::<ParameterValues>().is_err(), "a batch needs the step");
    }

    /// As many as are allowed are read at once: the time does not grow with the square of their number.
    #[test]
    fn many_values_are_compared_in_short_time() {
        let varied = ParameterValues::sweep("length=10:100009:1").unwrap();
        assert_eq!(varied.values().len(), MOST_VALUES);
    }
}
