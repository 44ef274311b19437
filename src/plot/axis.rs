//! An axis of a panel: its label and ends, its ticks, and the way from a value to a place in the picture.
//!
//! ```
//! let labels: Vec<String> = ringroad::plot::ticks(0.0, 0.8, 4).into_iter().map(|tick| tick.1).collect();
//! assert_eq!(labels, ["0.0", "0.2", "0.4", "0.6", "0.8"]);
//! ```

use super::colour::{Ground, LARGEST, Quantity, Scale, signed_logarithmic};
use serde::Serialize;

/// An axis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Axis {
    /// What it measures, with the unit: `time (s)`.
    pub label: String,
    /// Its ends; `None` takes them from the data.
    pub range: Option<(f64, f64)>,
    /// Whether it has the signed logarithmic scale of [`colour`](super::colour), from −10 to 10, which shows small
    /// and large differences in one picture.
    pub signed_log: bool,
}

impl Axis {
    /// An axis whose ends follow from the data.
    pub fn new(label: impl Into<String>) -> Self {
        Self { label: label.into(), range: None, signed_log: false }
    }
    /// An axis from `low` to `high`.
    pub fn from_to(label: impl Into<String>, low: f64, high: f64) -> Self {
        Self { label: label.into(), range: Some((low, high)), signed_log: false }
    }
    /// An axis on the signed logarithmic scale.
    pub fn signed_log(label: impl Into<String>) -> Self {
        Self { label: label.into(), range: Some((-LARGEST, LARGEST)), signed_log: true }
    }
}

/// Values of ticks with their labels: 1, 2 or 5 times a power of ten apart, at most about `most` of them. Empty where
/// `high` is not larger than `low`.
pub fn ticks(low: f64, high: f64, most: usize) -> Vec<(f64, String)> {
    let span = high - low;
    if span.is_nan() || span <= 0.0 || most == 0 {
        return Vec::new();
    }
    let least = span / most as f64;
    let (mut power, mut decimals) = (1.0, 0_usize);
    while power > least {
        power /= 10.0;
        decimals += 1;
    }
    while power * 10.0 <= least {
        power *= 10.0;
        decimals = decimals.saturating_sub(1);
    }
    let factor = [1.0, 2.0, 5.0].into_iter().find(|f| f * power >= least * (1.0 - 1e-9)).unwrap_or(10.0);
    let (step, decimals) =
        if factor == 10.0 { (10.0 * power, decimals.saturating_sub(1)) } else { (factor * power, decimals) };
    let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
    (first..=last)
        .map(|k| {
            let value = k as f64 * step;
            (value, format!("{value:.decimals$}").replace('-', "−"))
        })
        .collect()
}

/// Ticks of the signed logarithmic axis.
fn signed_log_ticks() -> Vec<(f64, String)> {
    let scale = Scale::new(Quantity::Difference, Ground::Light, 1.0);
    scale.ticks().into_iter().map(|t| (t, format!("{t}").replace('-', "−"))).collect()
}

/// The way from a value to a place in the picture along one axis.
#[derive(Clone, Copy)]
pub(super) struct Mapping {
    /// The values at the two ends of the axis.
    pub low: f64,
    pub high: f64,
    /// The places of the two ends, in units of the picture.
    pub start: f64,
    pub end: f64,
    pub signed_log: bool,
}

impl Mapping {
    /// The place of a value.
    pub fn at(self, value: f64) -> f64 {
        let place = if self.signed_log && !value.is_nan() {
            0.5 + 0.5 * signed_logarithmic(value)
        } else {
            (value - self.low) / (self.high - self.low)
        };
        self.start + place * (self.end - self.start)
    }
    /// Ticks with their labels, about `most` of them on a linear axis.
    pub fn ticks(self, most: usize) -> Vec<(f64, String)> {
        if self.signed_log { signed_log_ticks() } else { ticks(self.low, self.high, most) }
    }
    /// Whether a value lies between the ends, allowing for rounding.
    pub fn holds(self, value: f64) -> bool {
        let slack = 1e-9 * (self.high - self.low);
        value >= self.low - slack && value <= self.high + slack
    }
}

/// Ends of an axis: those that it states, or those of the data with `padding` (a share of their range) on both sides.
/// Padding does not reach beyond 0 where the data do not.
pub(super) fn ends(axis: &Axis, data: impl Iterator<Item = f64>, padding: f64) -> (f64, f64) {
    if let Some(range) = axis.range {
        return range;
    }
    let (low, high) = data
        .filter(|v| v.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if low > high {
        return (0.0, 1.0);
    }
    if low == high {
        return (low - 0.5, high + 0.5);
    }
    let pad = padding * (high - low);
    let near_zero = |end: f64, padded: f64| if end >= 0.0 && padded < 0.0 { 0.0 } else { padded };
    (near_zero(low, low - pad), -near_zero(-high, -high - pad))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64, most: usize) -> Vec<String> {
        ticks(low, high, most).into_iter().map(|t| t.1).collect()
    }

    #[test]
    fn ticks_are_round_numbers() {
        assert_eq!(labels(0.0, 1000.0, 5), ["0", "200", "400", "600", "800", "1000"]);
        assert_eq!(labels(-1.2, 0.5, 5), ["−1.0", "−0.5", "0.0", "0.5"]);
        assert_eq!(labels(0.0, 0.8, 4), ["0.0", "0.2", "0.4", "0.6", "0.8"]);
        assert_eq!(labels(0.53, 0.55, 4), ["0.530", "0.535", "0.540", "0.545", "0.550"]);
        assert_eq!(labels(1.0, 1.0, 4), Vec::<String>::new());
        assert_eq!(labels(f64::NAN, 1.0, 4), Vec::<String>::new());
        assert_eq!(labels(0.0, 30_000.0, 3), ["0", "10000", "20000", "30000"]);
    }
}
