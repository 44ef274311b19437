//! A scenario as the readable part of a link: `vehicles=30&reaction-time=0.75&action=at%3D40%3A7%3Abrake%3D3`.
//!
//! ```
//! use ringroad::scenario::link;
//!
//! let reading = link::parse("#vehicles=30&reaction-time=0.75&colour=red");
//! assert_eq!(reading.scenario.vehicles, 30);
//! assert_eq!(reading.refused[0].0, "colour=red");
//! assert_eq!(link::format(&reading.scenario), "vehicles=30&reaction-time=0.75");
//! ```
//!
//! The entries are the parameters by their hyphenated names, `start`, and any number of `driver` (overrides) and
//! `action`, the last two in the grammar of [`crate::scenario::action`]. Only what differs from [`base`] is written. A bad
//! entry is reported and the rest applies.

use crate::error::{Error, quoted};
use crate::scenario::parameters::{Lookup, PARAMETERS, Parameter, RoadField};
use crate::scenario::value::Value;
use crate::scenario::{Scenario, Start};
use std::fmt::Write as _;

/// The scenario of an empty link: the default one, but with the largest `until` that is allowed, because a run that is
/// watched on the page is stopped by hand.
pub fn base() -> Scenario {
    let mut scenario = Scenario::default();
    scenario.until = RoadField::Until.parameter().kind.range().map_or(scenario.until, |range| range.max);
    scenario
}

/// What was read from a link.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// A valid scenario, made of every entry that could be used.
    pub scenario: Scenario,
    /// The entries that could not be used, each with the reason.
    pub refused: Vec<(String, Error)>,
}

/// One entry, understood by itself.
enum Entry {
    Parameter(&'static Parameter, Value),
    Start(Start),
    Driver(crate::scenario::action::DriverOverride),
    Action(crate::scenario::action::Action),
}

impl Entry {
    fn read(text: &str) -> Result<Self, Error> {
        let form = || Error::malformed("link", quoted(text), "NAME=VALUE, such as reaction-time=0.75");
        let (name, value) = text.split_once('=').ok_or_else(form)?;
        let value = decoded(value)?;
        match name {
            "start" => value.parse().map(Self::Start),
            "driver" => value.parse().map(Self::Driver),
            "action" => value.parse().map(Self::Action),
            name => {
                let parameter = NAMES.find(name)?;
                Ok(Self::Parameter(parameter, parameter.parse(&value)?))
            }
        }
    }

    fn apply(&self, scenario: &mut Scenario) -> Result<(), Error> {
        match self {
            Self::Parameter(parameter, value) => scenario.set(parameter, *value)?,
            Self::Start(start) => scenario.start = *start,
            Self::Driver(differing) => scenario.overrides.push(differing.clone()),
            Self::Action(action) => scenario.actions.push(action.clone()),
        }
        Ok(())
    }
}

/// Names of entries.
const NAMES: Lookup = Lookup { others: ", start, driver, action", ..Lookup::all("link") };

/// Reads the part of a link after `#`; a leading `#` is skipped.
pub fn parse(text: &str) -> Reading {
    let mut refused = Vec::new();
    let mut entries = Vec::new();
    for part in text.trim_start_matches('#').split('&').filter(|part| !part.is_empty()) {
        match Entry::read(part) {
            Ok(entry) => entries.push((part, entry)),
            Err(e) => refused.push((decoded(part).unwrap_or_else(|_| part.into()), e)),
        }
    }
    // First all entries together. If that scenario is refused, entries are added one by one and kept where the scenario
    // stays valid. This takes several passes, because an entry may fit only after a later one (200 vehicles, then the
    // longer road).
    let mut used = vec![true; entries.len()];
    if build(&entries, &used).is_err() {
        used.fill(false);
        let mut again = true;
        while std::mem::take(&mut again) {
            for k in 0..entries.len() {
                if !used[k] {
                    used[k] = true;
                    used[k] = build(&entries, &used).is_ok();
                    again |= used[k];
                }
            }
        }
        for k in 0..entries.len() {
            if !used[k] {
                used[k] = true;
                if let Err(e) = build(&entries, &used) {
                    refused.push((decoded(entries[k].0).unwrap_or_default(), e));
                }
                used[k] = false;
            }
        }
    }
    Reading { scenario: build(&entries, &used).unwrap_or_else(|_| base()), refused }
}

fn build(entries: &[(&str, Entry)], used: &[bool]) -> Result<Scenario, Error> {
    let mut scenario = base();
    for ((_, entry), _) in entries.iter().zip(used).filter(|(_, used)| **used) {
        entry.apply(&mut scenario)?;
    }
    scenario.validate().map(|()| scenario)
}

/// What [`parse`] reads, without the `#`: empty for [`base`].
pub fn format(scenario: &Scenario) -> String {
    let base = base();
    let mut parts = Vec::new();
    for parameter in &PARAMETERS {
        let value = scenario.value(parameter);
        if value != base.value(parameter) {
            parts.push(format!("{}={}", parameter.hyphenated(), encoded(&value.to_string())));
        }
    }
    if scenario.start != base.start {
        parts.push(format!("start={}", encoded(&scenario.start.to_string())));
    }
    parts.extend(scenario.overrides.iter().map(|e| format!("driver={}", encoded(&e.to_string()))));
    parts.extend(scenario.actions.iter().map(|a| format!("action={}", encoded(&a.to_string()))));
    parts.join("&")
}

/// Percent-encoded, all but RFC 3986's unreserved characters.
fn encoded(text: &str) -> String {
    let mut out = String::new();
    for byte in text.bytes() {
        if byte.is_ascii_alphanumeric() || b"-._~".contains(&byte) {
            out.push(char::from(byte));
        } else {
            let _ = write!(out, "%{byte:02X}");
        }
    }
    out
}

fn decoded(text: &str) -> Result<String, Error> {
    let wrong =
        || Error::malformed("link", quoted(text), "percent-encoded text, such as at%3D40%3A7%3Abrake%3D3");
    let mut bytes = Vec::new();
    let mut rest = text.as_bytes();
    while let Some((&first, tail)) = rest.split_first() {
        rest = tail;
        if first == b'%' {
            let digits = rest.get(..2).and_then(|d| std::str::from_utf8(d).ok()).ok_or_else(wrong)?;
            if !digits.bytes().all(|d| d.is_ascii_hexdigit()) {
                return Err(wrong());
            }
            bytes.push(u8::from_str_radix(digits, 16).map_err(|_| wrong())?);
            rest = &rest[2..];
        } else {
            bytes.push(first);
        }
    }
    String::from_utf8(bytes).map_err(|_| wrong())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_differs_is_written_and_it_reads_back() {
        assert_eq!(format(&base()), "");
        let link = "vehicles=30&lanes=2&reaction-time=0.75&start=one-lane%3D2&driver=12%3Asensitivity%3D2\
                    &driver=10%25%3Amax-speed%3D30&action=at%3D0%3A1%3Anudge%3D1&action=at%3D40%3A7%3Abrake%3D3";
        let reading = parse(&format!("#{link}"));
        assert_eq!(reading.refused, []);
        assert_eq!((reading.scenario.vehicles, reading.scenario.driver.reaction_time), (30, 0.75));
        assert_eq!(reading.scenario.actions.len(), 2);
        assert_eq!(format(&reading.scenario), link);
    }

    #[test]
    fn the_end_is_the_latest_allowed_unless_the_link_sets_it() {
        assert_eq!(parse("").scenario.until, 1e7);
        let closed = parse("until=600").scenario;
        assert_eq!((closed.until, format(&closed).as_str()), (600.0, "until=600"));
    }

    #[test]
    fn a_bad_entry_is_reported_and_the_rest_applies() {
        for (bad, words) in [
            ("colour=red", &["colour", "vehicles", "action"][..]),
            ("vehicles", &["vehicles", "NAME=VALUE"]),
            ("reaction-time=11", &["reaction-time", "11", "0 to 10 s"]),
            ("vehicles=2.5", &["vehicles", "2.5"]),
            ("start=spiral", &["spiral"]),
            ("action=at%3D40", &["at=40", "at=SECONDS"]),
            ("action=%4", &["%4", "percent"]),
            ("action=%+1", &["%+1", "percent"]),
            ("action=%FF", &["%FF", "percent"]),
            ("action=at%3D40%3A80%3Abrake%3D3", &["80", "1 to 30"]),
            ("driver=31%3Asensitivity%3D2", &["31", "1 to 30"]),
            ("length=100", &["30", "5 m"]),
        ] {
            let reading = parse(&format!("vehicles=30&{bad}&sensitivity=1.5"));
            assert_eq!(reading.refused.len(), 1, "{bad}: {:?}", reading.refused);
            let message = reading.refused[0].1.to_string();
            for word in words {
                assert!(message.contains(word), "{bad}: {message} lacks {word}");
            }
            let expected = Scenario { vehicles: 30, ..base() };
            assert_eq!(reading.scenario.driver.sensitivity, 1.5);
            assert_eq!(
                Scenario { driver: expected.driver, ..reading.scenario },
                expected,
                "{bad} must change nothing"
            );
        }
    }

    #[test]
    fn entries_that_fit_only_together_are_taken_in_any_order() {
        let reading = parse("vehicles=400&lanes=9&length=5000&action=at%3D1%3A300%3Abrake%3D2");
        assert_eq!((reading.scenario.vehicles, reading.scenario.length), (400, 5000.0));
        assert_eq!(reading.scenario.actions.len(), 1);
        assert_eq!(reading.refused.len(), 1, "only the nine lanes are too many");
    }
}
