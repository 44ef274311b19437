//! Timed actions and driver overrides, in the one grammar that the command, the link, JSON and the page share.
//!
//! ```text
//! override    WHO:PARAMETER=VALUE[,PARAMETER=VALUE …]     12:sensitivity=2     10%:sensitivity=2
//! action      at=SECONDS:WHO:EFFECT[,EFFECT …]            at=30:all:reaction-time=0.75
//! EFFECT      PARAMETER=VALUE | brake=SECONDS | nudge=METRES
//! WHO         all | NUMBER | FIRST-LAST | SHARE%          (a share of the vehicles, drawn by the seed)
//! ```
//!
//! JSON calls the overrides `exceptions`, the link and the command call each of them `driver`.
//!
//! ```
//! use ringroad::scenario::action::{Action, Effect, VehicleSelector};
//!
//! let action: Action = "at=40:7:brake=3,nudge=-0.5".parse().unwrap();
//! assert_eq!((action.at, action.vehicles), (40.0, VehicleSelector::Vehicle(7)));
//! assert_eq!(action.effects, [Effect::Brake(3.0), Effect::Nudge(-0.5)]);
//! ```

use crate::error::{Error, quoted};
use crate::scenario::parameters::{Among, DriverField, Field, Lookup};
use crate::scenario::value::Value;
use std::fmt;
use std::str::FromStr;

/// The vehicles that an action or an override is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum VehicleSelector {
    /// Every vehicle.
    All,
    /// One vehicle, by its number from 1.
    Vehicle(usize),
    /// Vehicles from the first to the last number, both included.
    Range(usize, usize),
    /// So many per cent of the vehicles, rounded to whole ones and drawn by the seed.
    Share(f64),
}

/// One effect of an action.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Effect {
    /// Gives a driver's parameter a value.
    Set(DriverField, Value),
    /// Speed 0 for so many seconds.
    Brake(f64),
    /// A displacement by so many metres, downstream where positive.
    Nudge(f64),
}

/// Something that happens at a time, which is rounded to a whole step.
#[derive(Clone, Debug, PartialEq)]
pub struct Action {
    /// Time, s.
    pub at: f64,
    /// For which vehicles.
    pub vehicles: VehicleSelector,
    /// What happens to them, in this order.
    pub effects: Vec<Effect>,
}

/// Drivers that differ from the default driver, from t = 0 on.
#[derive(Clone, Debug, PartialEq)]
pub struct DriverOverride {
    /// Which vehicles they drive.
    pub vehicles: VehicleSelector,
    /// The values that differ.
    pub values: Vec<(DriverField, Value)>,
}

impl VehicleSelector {
    /// Whether there are such vehicles where the vehicles are numbered from 1 to `vehicles`.
    pub fn check(self, vehicles: usize) -> Result<(), Error> {
        let fits = match self {
            Self::All => true,
            Self::Vehicle(n) => (1..=vehicles).contains(&n),
            Self::Range(first, last) => 1 <= first && first <= last && last <= vehicles,
            Self::Share(percent) => (0.0..=100.0).contains(&percent),
        };
        if fits {
            Ok(())
        } else {
            let allowed =
                format!("a vehicle from 1 to {vehicles}, a range such as 3-7, “all”, or 0% to 100%");
            Err(Error::out_of_range("vehicle", self, allowed))
        }
    }
}

impl fmt::Display for VehicleSelector {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::All => write!(f, "all"),
            Self::Vehicle(n) => write!(f, "{n}"),
            Self::Range(a, b) => write!(f, "{a}-{b}"),
            Self::Share(percent) => write!(f, "{percent}%"),
        }
    }
}

impl FromStr for VehicleSelector {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self, Error> {
        let text = text.trim();
        let wrong = || {
            Error::malformed(
                "vehicle",
                quoted(text),
                "a number, a range such as 3-7, “all”, or a share such as 10%",
            )
        };
        if text == "all" {
            Ok(Self::All)
        } else if let Some(share) = text.strip_suffix('%') {
            share.trim().parse().map(Self::Share).map_err(|_| wrong())
        } else if let Some((first, last)) = text.split_once('-') {
            match (first.trim().parse(), last.trim().parse()) {
                (Ok(first), Ok(last)) => Ok(Self::Range(first, last)),
                _ => Err(wrong()),
            }
        } else {
            text.parse().map(Self::Vehicle).map_err(|_| wrong())
        }
    }
}

impl Effect {
    /// Whether the value is allowed on a ring of `length` metres.
    pub fn check(self, length: f64) -> Result<(), Error> {
        match self {
            Self::Set(field, value) => field.parameter().check(value),
            Self::Brake(seconds) if (0.0..=1e7).contains(&seconds) => Ok(()),
            Self::Brake(seconds) => {
                Err(Error::out_of_range("brake", seconds, "a number from 0 to 10000000 s"))
            }
            Self::Nudge(metres) if metres.abs() <= length => Ok(()),
            Self::Nudge(metres) => Err(Error::out_of_range(
                "nudge",
                metres,
                format!("a number from -{length} to {length} m, one lap"),
            )),
        }
    }
}

impl fmt::Display for Effect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Set(field, value) => write!(f, "{}={value}", field.parameter().hyphenated()),
            Self::Brake(seconds) => write!(f, "brake={seconds}"),
            Self::Nudge(metres) => write!(f, "nudge={metres}"),
        }
    }
}

/// Name and value of `NAME=VALUE`; a refusal names `what` it is.
fn assignment<'a>(what: &'static str, text: &'a str) -> Result<(&'a str, &'a str), Error> {
    let (name, value) = text
        .split_once('=')
        .ok_or_else(|| Error::malformed(what, quoted(text), "NAME=VALUE, such as reaction-time=0.75"))?;
    Ok((name.trim(), value))
}

fn number(name: &'static str, text: &str) -> Result<f64, Error> {
    text.trim().parse().map_err(|_| Error::malformed(name, quoted(text), "a number"))
}

/// A field of a driver with its value, of which only the kind is checked.
fn setting(names: Lookup, name: &str, text: &str) -> Result<(DriverField, Value), Error> {
    let parameter = names.find(name)?;
    let Field::Driver(field) = parameter.field else { unreachable!("the look-up is among those of drivers") };
    let wrong = || Error::malformed(name.to_owned(), quoted(text), parameter.kind.words());
    parameter.kind.parse(text).map(|value| (field, value)).ok_or_else(wrong)
}

/// Names of an [`Effect`], and of what a [`DriverOverride`] sets.
const EFFECT: Lookup = Lookup { among: Among::Drivers, others: ", brake, nudge", ..Lookup::all("effect") };
const OF_DRIVER: Lookup = Lookup { among: Among::Drivers, ..Lookup::all("driver's parameter") };

impl FromStr for Effect {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self, Error> {
        match assignment(EFFECT.of, text)? {
            ("brake", seconds) => number("brake", seconds).map(Self::Brake),
            ("nudge", metres) => number("nudge", metres).map(Self::Nudge),
            (name, value) => setting(EFFECT, name, value).map(|(field, value)| Self::Set(field, value)),
        }
    }
}

impl fmt::Display for Action {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "at={}:{}:{}", self.at, self.vehicles, joined(&self.effects))
    }
}

impl Action {
    /// `WHO:EFFECT[,EFFECT …]`, at a time in s.
    pub fn at(at: f64, text: &str) -> Result<Self, Error> {
        let form = || Error::malformed("action", quoted(text), "WHO:EFFECT, such as 7:brake=3");
        let (vehicles, effects) =
            text.split_once(':').filter(|(vehicles, _)| !vehicles.contains('=')).ok_or_else(form)?;
        Self::of(at, vehicles, effects).map_err(|e| e.within(quoted(text)))
    }

    /// Whether `earlier` has no effect any more when this action follows it in the same step: both are for the same
    /// vehicles, and this one sets the same parameters again or brakes for at least as long. Nudges never replace one
    /// another, because they add up; nor do actions for a share, because every action draws its own vehicles.
    pub(crate) fn replaces(&self, earlier: &Self) -> bool {
        let again = |old: &Effect| {
            self.effects.iter().any(|new| match (old, new) {
                (Effect::Set(a, _), Effect::Set(b, _)) => a == b,
                (Effect::Brake(before), Effect::Brake(now)) => before <= now,
                _ => false,
            })
        };
        !matches!(self.vehicles, VehicleSelector::Share(_))
            && self.vehicles == earlier.vehicles
            && earlier.effects.iter().all(again)
    }

    fn of(at: f64, vehicles: &str, effects: &str) -> Result<Self, Error> {
        let effects = effects.split(',').map(str::parse).collect::<Result<_, _>>()?;
        Ok(Self { at, vehicles: vehicles.parse()?, effects })
    }
}

impl FromStr for Action {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self, Error> {
        let form = || {
            Error::malformed(
                "action",
                quoted(text),
                "at=SECONDS:WHO:EFFECT, such as at=30:all:reaction-time=0.75",
            )
        };
        let mut parts = text.trim().splitn(3, ':');
        let (Some(at), Some(vehicles), Some(effects)) = (parts.next(), parts.next(), parts.next()) else {
            return Err(form());
        };
        let Ok(("at", at)) = assignment(EFFECT.of, at) else { return Err(form()) };
        let at = number("at", at).map_err(|_| form())?;
        Self::of(at, vehicles, effects).map_err(|e| e.within(quoted(text)))
    }
}

impl fmt::Display for DriverOverride {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let values: Vec<_> = self.values.iter().map(|&(p, v)| Effect::Set(p, v)).collect();
        write!(f, "{}:{}", self.vehicles, joined(&values))
    }
}

impl FromStr for DriverOverride {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self, Error> {
        let (vehicles, values) = text.split_once(':').ok_or_else(|| {
            Error::malformed("driver", quoted(text), "WHO:PARAMETER=VALUE, such as 12:sensitivity=2")
        })?;
        Ok(Self {
            vehicles: vehicles.parse().map_err(|e: Error| e.within(quoted(text)))?,
            values: driver_values(values).map_err(|e| e.within(quoted(text)))?,
        })
    }
}

/// `PARAMETER=VALUE[,PARAMETER=VALUE …]` of a driver.
pub(crate) fn driver_values(text: &str) -> Result<Vec<(DriverField, Value)>, Error> {
    let one = |text: &str| {
        let (name, value) = assignment(OF_DRIVER.of, text)?;
        setting(OF_DRIVER, name, value)
    };
    text.split(',').map(one).collect()
}

fn joined(effects: &[Effect]) -> String {
    effects.iter().map(Effect::to_string).collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn written_actions_and_overrides_read_back() {
        for text in [
            "at=30:all:reaction-time=0.75",
            "at=40:7:brake=3",
            "at=0:1:nudge=1",
            "at=1.5:3-7:nudge=-0.1,brake=2",
        ] {
            assert_eq!(text.parse::<Action>().unwrap().to_string(), text);
        }
        for text in ["12:sensitivity=2", "10%:sensitivity=2,reaction-time=0.5", "all:max-speed=30"] {
            assert_eq!(text.parse::<DriverOverride>().unwrap().to_string(), text);
        }
        assert_eq!("at=1:2:reaction_time=1".parse::<Action>().unwrap().to_string(), "at=1:2:reaction-time=1");
    }

    #[test]
    fn a_refused_action_without_a_time_is_not_asked_for_one() {
        assert_eq!(Action::at(1.5, "7:brake=3,nudge=1").unwrap().to_string(), "at=1.5:7:brake=3,nudge=1");
        for text in ["brake=3", "7", "at=3:7:brake=3", ""] {
            let message = Action::at(0.0, text).unwrap_err().to_string();
            assert!(message.contains("WHO:EFFECT") && !message.contains("SECONDS"), "{message}");
        }
        let message = Action::at(0.0, "7:sleep=3").unwrap_err().to_string();
        assert!(message.contains("“7:sleep=3”") && message.contains("“sleep”"), "{message}");
    }

    #[test]
    fn an_action_replaces_an_earlier_one_of_which_no_effect_is_left() {
        for (earlier, now, replaced) in [
            ("all:sensitivity=1", "all:sensitivity=2", true),
            ("all:sensitivity=1", "all:reaction-time=1,sensitivity=2", true),
            ("all:reaction-time=1,sensitivity=1", "all:sensitivity=2", false),
            ("7:sensitivity=1", "8:sensitivity=2", false),
            ("7:sensitivity=1", "7:reaction-time=1", false),
            ("7:brake=3", "7:brake=3", true),
            ("7:brake=3", "7:brake=2", false),
            ("7:nudge=1", "7:nudge=1", false),
            ("10%:sensitivity=1", "10%:sensitivity=1", false),
        ] {
            let [earlier, now] = [earlier, now].map(|text| Action::at(0.0, text).unwrap());
            assert_eq!(now.replaces(&earlier), replaced, "{earlier}, then {now}");
        }
    }

    #[test]
    fn refusals_name_the_wrong_part() {
        for (text, named) in [
            ("30:all:reaction-time=1", "at=SECONDS"),
            ("at=30:all", "at=SECONDS"),
            ("at=30:some:brake=1", "“some”"),
            ("at=30:1:sleep=1", "“sleep”"),
            ("at=30:1:vehicles=1", "“vehicles”"),
            ("at=30:1:brake=soon", "“soon”"),
        ] {
            let message = text.parse::<Action>().unwrap_err().to_string();
            assert!(message.contains(named), "{message}");
        }
        for (text, named) in [
            ("sensitivity=2", "WHO:PARAMETER=VALUE"),
            ("x:sensitivity=1", "“x”"),
            ("12:brake=2", "driver's parameter: “brake”"),
            ("12:sensitivity", "driver's parameter: “sensitivity”"),
        ] {
            let message = text.parse::<DriverOverride>().unwrap_err().to_string();
            assert!(message.contains(named) && !message.contains("effect"), "{message}");
        }
        assert!(VehicleSelector::Vehicle(51).check(50).unwrap_err().to_string().contains("51"));
        assert!(
            VehicleSelector::Vehicle(0).check(50).is_err() && VehicleSelector::Range(7, 3).check(50).is_err()
        );
        assert!(
            VehicleSelector::Share(f64::NAN).check(50).is_err()
                && VehicleSelector::Share(101.0).check(50).is_err()
        );
    }
}
