//! Refusals of inputs: which field, which value, and what is allowed instead.
//!
//! The variants of [`Error`] say what kind of refusal it is, for code that goes on from there; the message is for people.
//!
//! ```
//! use ringroad::{Error, Scenario};
//!
//! match Scenario::from_json(r#"{"vehicles": 50, "lanes": 9}"#) {
//!     Err(Error::OutOfRange(refusal)) => {
//!         assert_eq!((&*refusal.field, &*refusal.value), ("lanes", "9"));
//!         assert_eq!(refusal.allowed, "a whole number from 1 to 8");
//!     }
//!     other => panic!("{other:?}"),
//! }
//! let unknown = Scenario::from_json(r#"{"cars": 50}"#).unwrap_err();
//! assert!(matches!(unknown, Error::UnknownName(_)));
//! ```

use std::borrow::Cow;
use std::fmt;

/// A refused input. Its message is the [`Refusal`]'s.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// There is nothing of that name: no such parameter, preset, table, figure …
    UnknownName(Refusal),
    /// A text, or a value of JSON, that is not of the form that is needed there.
    Malformed(Refusal),
    /// A value that is not allowed by itself, whatever the others are.
    OutOfRange(Refusal),
    /// A value, an action or a file that does not go together with the rest of the input or with the state of the run.
    Conflict(Refusal),
    /// It would need too much memory or too many values.
    TooLarge(Refusal),
    /// A file that this program did not write, or one of another purpose.
    NotOurs(Refusal),
    /// A form of another version.
    Version(Refusal),
}

/// What was refused and what is allowed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The field, as the person that wrote it knows it; with the place of the field before it, where that is needed.
    pub field: Cow<'static, str>,
    /// The value that was given.
    pub value: String,
    /// What is allowed instead.
    pub allowed: Cow<'static, str>,
}

impl Refusal {
    /// One function for every type of value: compiled once, it keeps the page's module small.
    #[inline(never)]
    fn new(field: Cow<'static, str>, value: &dyn fmt::Display, allowed: Cow<'static, str>) -> Self {
        Self { field, value: value.to_string(), allowed }
    }
}

/// A function for each variant that refuses `value` for `field`.
macro_rules! constructors {
    ($($(#[$doc:meta])* $name:ident => $variant:ident,)*) => {
        impl Error {
            $($(#[$doc])*
            #[inline]
            pub fn $name(
                field: impl Into<Cow<'static, str>>,
                value: impl fmt::Display,
                allowed: impl Into<Cow<'static, str>>,
            ) -> Self {
                Self::$variant(Refusal::new(field.into(), &value, allowed.into()))
            })*

            /// What was refused and what is allowed.
            pub fn refusal(&self) -> &Refusal {
                match self {
                    $(Self::$variant(refusal) => refusal,)*
                }
            }

            fn refusal_mut(&mut self) -> &mut Refusal {
                match self {
                    $(Self::$variant(refusal) => refusal,)*
                }
            }
        }
    };
}

constructors! {
    /// [`Error::UnknownName`]; `allowed` lists the names that there are.
    unknown => UnknownName,
    /// [`Error::Malformed`]; `allowed` says what the form is.
    malformed => Malformed,
    /// [`Error::OutOfRange`]; `allowed` says what the range is.
    out_of_range => OutOfRange,
    /// [`Error::Conflict`]; `allowed` says what would go together.
    conflict => Conflict,
    /// [`Error::TooLarge`]; `allowed` says what the limit is.
    too_large => TooLarge,
    /// [`Error::NotOurs`]; `allowed` says which files can be read.
    not_ours => NotOurs,
    /// [`Error::Version`]; `allowed` says which version can be read.
    version => Version,
}

impl Error {
    /// The same refusal with the place of its field before it: `actions[2]: …`.
    #[must_use]
    pub fn within(mut self, place: impl fmt::Display) -> Self {
        let refusal = self.refusal_mut();
        refusal.field = format!("{place}: {}", refusal.field).into();
        self
    }

    /// The same refusal with more said after what is allowed.
    #[must_use]
    pub fn with_advice(mut self, advice: &str) -> Self {
        self.refusal_mut().allowed.to_mut().push_str(advice);
        self
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Refusal { field, value, allowed } = self.refusal();
        write!(f, "{field}: {value} is not allowed; allowed: {allowed}")
    }
}

impl std::error::Error for Error {}

/// A text between quotation marks, as messages show it.
pub(crate) fn quoted(text: &str) -> String {
    format!("“{text}”")
}

/// The beginning of a text between quotation marks: at most 40 characters of its first line, with spaces in place of
/// control characters, which a terminal would obey.
pub(crate) fn opening(text: &str) -> String {
    let line = text.lines().next().unwrap_or_default();
    let start: String = line.chars().take(40).map(|c| if c.is_control() { ' ' } else { c }).collect();
    quoted(&if start.len() < line.len() { start + "…" } else { start })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_the_same_message_and_keeps_its_kind_within_a_place() {
        let of_each: [fn(&'static str, u32, &'static str) -> Error; 7] = [
            Error::unknown,
            Error::malformed,
            Error::out_of_range,
            Error::conflict,
            Error::too_large,
            Error::not_ours,
            Error::version,
        ];
        for (k, make) in of_each.into_iter().enumerate() {
            let error = make("lanes", 9, "at most 8");
            let placed = error.clone().within("cell 2").with_advice("; or fewer");
            assert_eq!(error.to_string(), "lanes: 9 is not allowed; allowed: at most 8");
            assert_eq!(placed.to_string(), "cell 2: lanes: 9 is not allowed; allowed: at most 8; or fewer");
            assert_eq!(std::mem::discriminant(&placed), std::mem::discriminant(&error));
            for other in &of_each[..k] {
                assert_ne!(other("lanes", 9, "at most 8"), error);
            }
        }
    }
}
