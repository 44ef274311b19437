//! What is wrong with an input: which field, which value, and what would be right.

use std::borrow::Cow;
use std::fmt;

/// A refused input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// The field, as the person who wrote it knows it.
    pub field: Cow<'static, str>,
    /// The value that was given.
    pub value: String,
    /// What is allowed instead.
    pub allowed: Cow<'static, str>,
}

impl Error {
    /// A refusal of `value` for `field`.
    pub fn new(
        field: impl Into<Cow<'static, str>>,
        value: impl fmt::Display,
        allowed: impl Into<Cow<'static, str>>,
    ) -> Self {
        Self { field: field.into(), value: value.to_string(), allowed: allowed.into() }
    }

    /// The same refusal, seen from further out: `actions[2]: …`.
    #[must_use]
    pub fn within(mut self, place: impl fmt::Display) -> Self {
        self.field = format!("{place}: {}", self.field).into();
        self
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} is not allowed; allowed: {}", self.field, self.value, self.allowed)
    }
}

impl std::error::Error for Error {}

/// A text as a message shows it.
pub(crate) fn quoted(text: &str) -> String {
    format!("“{text}”")
}

/// How a text begins, as a message shows it: of its first line at most 40 characters, none that a terminal obeys.
pub(crate) fn opening(text: &str) -> String {
    let line = text.lines().next().unwrap_or_default();
    let start: String = line.chars().take(40).map(|c| if c.is_control() { ' ' } else { c }).collect();
    quoted(&if start.len() < line.len() { start + "…" } else { start })
}
