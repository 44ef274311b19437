//! The values that a parameter can have, and the kinds of parameters: how the values of a kind are read from a text or
//! from JSON, which of them are allowed, and how they are written.
//!
//! ```
//! use ringroad::scenario::value::{Kind, Range, Value};
//!
//! let kind = Kind::NumberOrNone(Range { min: 1.0, max: 100.0 });
//! assert_eq!(kind.parse("9"), Some(Value::Number(9.0)));
//! assert_eq!(kind.parse("none"), Some(Value::None));
//! assert!(!kind.allows(Value::Number(0.5)));
//! assert_eq!(kind.allowed("m/s²"), "a number from 1 to 100 m/s², or none");
//! ```

use crate::format::json::Json;
use serde::{Serialize, Serializer};
use std::fmt;

/// The value of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A number, in the unit of its parameter. Whole numbers are exact to 2^53.
    Number(f64),
    /// No value: the parameter has no effect.
    None,
    /// One of the names of a choice.
    Choice(&'static str),
    /// Some numbers.
    List(List),
}

/// A list of at most [`List::MOST`] numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct List {
    /// The numbers; 0 after the first `count`.
    numbers: [f64; Self::MOST],
    count: usize,
}

/// The smallest and the largest number that are allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Smallest number.
    pub min: f64,
    /// Largest number.
    pub max: f64,
}

/// What kind of value a parameter has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A number.
    Number(Range),
    /// A whole number.
    Whole(Range),
    /// A number or `none`.
    NumberOrNone(Range),
    /// One of these names.
    Choice(&'static [&'static str]),
    /// A list of numbers, separated by commas, or `none`.
    List(Range),
}

impl Value {
    /// The number, if it is one.
    pub fn number(self) -> Option<f64> {
        if let Self::Number(x) = self { Some(x) } else { None }
    }
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(x) => x.fmt(f),
            Self::None => f.pad("none"),
            Self::Choice(name) => f.pad(name),
            Self::List(list) => {
                let texts: Vec<_> = list.numbers().iter().map(f64::to_string).collect();
                f.pad(&texts.join(","))
            }
        }
    }
}

impl From<Value> for Json {
    fn from(value: Value) -> Self {
        match value {
            Value::Number(x) => x.into(),
            Value::None => Self::Null,
            Value::Choice(name) => name.into(),
            Value::List(list) => list.numbers().iter().copied().collect(),
        }
    }
}

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(x) => serializer.serialize_f64(*x),
            Self::None => serializer.serialize_unit(),
            Self::Choice(name) => serializer.serialize_str(name),
            Self::List(list) => serializer.collect_seq(list.numbers()),
        }
    }
}

impl List {
    /// The most numbers of a list: one for each of the most lanes that a road can have.
    pub const MOST: usize = 8;

    /// A list of these numbers, from one to [`Self::MOST`] of them.
    pub fn new(numbers: &[f64]) -> Option<Self> {
        let mut list = Self { numbers: [0.0; Self::MOST], count: numbers.len() };
        list.numbers.get_mut(..numbers.len()).filter(|places| !places.is_empty())?.copy_from_slice(numbers);
        Some(list)
    }

    /// The numbers.
    pub fn numbers(&self) -> &[f64] {
        &self.numbers[..self.count]
    }
}

impl Range {
    /// Whether a number lies in it, ends included.
    pub fn contains(self, number: f64) -> bool {
        number >= self.min && number <= self.max
    }
}

impl Kind {
    /// The range of a number, or of each number of a list; a choice has none.
    pub fn range(self) -> Option<Range> {
        match self {
            Self::Number(range) | Self::Whole(range) | Self::NumberOrNone(range) | Self::List(range) => {
                Some(range)
            }
            Self::Choice(_) => None,
        }
    }

    /// Whether every value is a whole number.
    pub fn is_whole(self) -> bool {
        matches!(self, Self::Whole(_))
    }

    /// Reads a text that a person wrote. Whether the value is allowed is another question.
    pub fn parse(self, text: &str) -> Option<Value> {
        let text = text.trim();
        let has_none = matches!(self, Self::NumberOrNone(_) | Self::List(_));
        match self {
            _ if has_none && text == "none" => Some(Value::None),
            Self::Number(_) | Self::Whole(_) | Self::NumberOrNone(_) => text.parse().ok().map(Value::Number),
            Self::Choice(names) => named(names, text),
            Self::List(_) => {
                let numbers: Option<Vec<_>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
                List::new(&numbers?).map(Value::List)
            }
        }
    }

    /// Reads what [`Json::from`] writes.
    pub fn from_json(self, json: &Json) -> Option<Value> {
        match (self, json) {
            (Self::Number(_) | Self::Whole(_) | Self::NumberOrNone(_), Json::Number(x)) => {
                Some(Value::Number(*x))
            }
            (Self::NumberOrNone(_) | Self::List(_), Json::Null) => Some(Value::None),
            (Self::Choice(names), Json::Text(text)) => named(names, text),
            (Self::List(_), Json::List(list)) => {
                let numbers: Option<Vec<_>> = list.iter().map(Json::as_number).collect();
                List::new(&numbers?).map(Value::List)
            }
            _ => None,
        }
    }

    /// Whether a value is of this kind and in its range.
    pub fn allows(self, value: Value) -> bool {
        match (self, value) {
            (Self::Number(range) | Self::NumberOrNone(range), Value::Number(x)) => range.contains(x),
            (Self::Whole(range), Value::Number(x)) => range.contains(x) && x == x.trunc(),
            (Self::NumberOrNone(_) | Self::List(_), Value::None) => true,
            (Self::Choice(names), Value::Choice(name)) => names.contains(&name),
            (Self::List(range), Value::List(list)) => list.numbers().iter().all(|&x| range.contains(x)),
            _ => false,
        }
    }

    /// What a value of this kind is, in words, without its range: `a number`.
    pub fn words(self) -> String {
        match self {
            Self::Number(_) => "a number".to_owned(),
            Self::Whole(_) => "a whole number".to_owned(),
            Self::NumberOrNone(_) => "a number or none".to_owned(),
            Self::Choice(names) => names.join(", "),
            Self::List(_) => "numbers with commas between them, or none".to_owned(),
        }
    }

    /// What is allowed, in words: `a number from 0 to 10 s`.
    pub fn allowed(self, unit: &str) -> String {
        let space = if unit.is_empty() { "" } else { " " };
        let within = |what: &str, range: Range, more: &str| {
            format!("{what} from {} to {}{space}{unit}{more}", range.min, range.max)
        };
        match self {
            Self::Number(range) => within("a number", range, ""),
            Self::Whole(range) => within("a whole number", range, ""),
            Self::NumberOrNone(range) => within("a number", range, ", or none"),
            Self::Choice(_) => self.words(),
            Self::List(range) => within("numbers with commas between them", range, ", or none"),
        }
    }
}

fn named(names: &[&'static str], text: &str) -> Option<Value> {
    names.iter().find(|&&name| name == text).map(|name| Value::Choice(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    const RANGE: Range = Range { min: 1.0, max: 100.0 };
    const LAWS: &[&str] = &["first", "second"];

    #[test]
    fn values_of_every_kind_read_back_from_text_and_json() {
        for (kind, texts) in [
            (Kind::Number(RANGE), &["1.5", "100"][..]),
            (Kind::Whole(RANGE), &["7"]),
            (Kind::NumberOrNone(RANGE), &["9.25", "none"]),
            (Kind::Choice(LAWS), &["first", "second"]),
            (Kind::List(RANGE), &["30", "30,40.5", "none", "1,2,3,4,5,6,7,8"]),
        ] {
            for text in texts {
                let value = kind.parse(&format!(" {text} ")).unwrap();
                assert!(kind.allows(value), "{kind:?} {text}");
                assert_eq!(value.to_string(), *text);
                let json = Json::from(value);
                assert_eq!(kind.from_json(&json.to_string().parse().unwrap()), Some(value));
                assert_eq!(serde_json::to_string(&value).unwrap().parse(), Ok(json));
            }
        }
    }

    #[test]
    fn other_values_are_not_read_or_not_allowed() {
        for (kind, unread, refused) in [
            (Kind::Number(RANGE), &["", "none", "x", "1,2"][..], &["0.5", "101", "NaN", "inf"][..]),
            (Kind::Whole(RANGE), &["none"], &["2.5", "0"]),
            (Kind::NumberOrNone(RANGE), &["None", ""], &["0", "NaN"]),
            (Kind::Choice(LAWS), &["third", "", "1"], &[]),
            (Kind::List(RANGE), &["", "30,", "30;40", "1,2,3,4,5,6,7,8,9"], &["30,0", "NaN"]),
        ] {
            for text in unread {
                assert_eq!(kind.parse(text), None, "{kind:?} “{text}”");
            }
            for text in refused {
                assert!(!kind.allows(kind.parse(text).unwrap()), "{kind:?} “{text}”");
            }
        }
        assert!(!Kind::Number(RANGE).allows(Value::None));
        assert!(!Kind::Choice(LAWS).allows(Value::Choice("third")));
        assert!(!Kind::Choice(LAWS).allows(Value::Number(1.0)));
        for json in ["\"5\"", "true", "[1,null]", "[]", "{}"] {
            for kind in [Kind::Number(RANGE), Kind::List(RANGE), Kind::Choice(LAWS)] {
                assert_eq!(kind.from_json(&json.parse().unwrap()), None, "{kind:?} {json}");
            }
        }
    }

    #[test]
    fn what_is_allowed_is_said_in_words() {
        assert_eq!(Kind::Number(RANGE).allowed("s"), "a number from 1 to 100 s");
        assert_eq!(Kind::Whole(RANGE).allowed(""), "a whole number from 1 to 100");
        assert_eq!(Kind::Choice(LAWS).allowed(""), "first, second");
        assert_eq!(
            Kind::List(RANGE).allowed("m/s"),
            "numbers with commas between them from 1 to 100 m/s, or none"
        );
        for kind in [Kind::Number(RANGE), Kind::NumberOrNone(RANGE), Kind::List(RANGE), Kind::Whole(RANGE)] {
            assert!(!kind.words().contains("100") && kind.range() == Some(RANGE));
        }
        assert_eq!(Kind::Choice(LAWS).range(), None);
        assert_eq!([Kind::Whole(RANGE), Kind::List(RANGE)].map(Kind::is_whole), [true, false]);
    }
}
