//! Where the vehicles are at t = 0.
//!
//! ```
//! use ringroad::scenario::Start;
//!
//! assert_eq!("one-lane=2".parse(), Ok(Start::OneLane(2)));
//! assert_eq!(Start::OneLane(1).to_string(), "one-lane");
//! ```

use crate::error::{Error, quoted};
use std::fmt;
use std::str::FromStr;

/// Where the vehicles are at t = 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// Numbers dealt in blocks, lane 1 first and with the remainder; equal headways in each lane.
    Uniform,
    /// All in the given lane, equal headways.
    OneLane(usize),
    /// N divisible by n lanes; as uniform, lane l shifted downstream by (n − l)·L/N.
    Staggered,
    /// Seeded positions, no headway under the driver's minimum headway d.
    Random,
}

impl fmt::Display for Start {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Uniform => write!(f, "uniform"),
            Self::OneLane(1) => write!(f, "one-lane"),
            Self::OneLane(lane) => write!(f, "one-lane={lane}"),
            Self::Staggered => write!(f, "staggered"),
            Self::Random => write!(f, "random"),
        }
    }
}

impl FromStr for Start {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self, Error> {
        let wrong = || {
            Error::malformed("start", quoted(text), "uniform, one-lane, one-lane=LANE, staggered or random")
        };
        match text.trim().split_once('=') {
            None => match text.trim() {
                "uniform" => Ok(Self::Uniform),
                "one-lane" => Ok(Self::OneLane(1)),
                "staggered" => Ok(Self::Staggered),
                "random" => Ok(Self::Random),
                _ => Err(wrong()),
            },
            Some(("one-lane", lane)) => lane.trim().parse().map(Self::OneLane).map_err(|_| wrong()),
            Some(_) => Err(wrong()),
        }
    }
}
