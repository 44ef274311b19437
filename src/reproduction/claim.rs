//! Claims of the paper beside the values that are measured here, each with a verdict that is computed and never written
//! by hand.
//!
//! # How a verdict comes about
//!
//! A measured value is an [`Estimate`]: the value with its uncertainty, which is the half-width of the 95 % confidence
//! interval over independent runs, or half the distance of the grid on which the value was searched, or 0 where the
//! value is exact.
//!
//! - [`Expected::About`], a number with a tolerance that the claim states: met when the interval of the estimate and
//!   that of the tolerance overlap.
//! - [`Expected::AtMost`] and [`Expected::MoreThan`], an inequality: met when the whole interval of the estimate obeys
//!   it.
//!
//! Where the paper leaves a choice open that changes the value (which vehicle's speed, how many periods), each choice
//! is a [`Reading`]. If all readings meet the claim, it *agrees*; if none does, it *differs*; if some do, it is *not
//! determined by the paper*.
//!
//! ```
//! use ringroad::reproduction::claim::{Claim, ClaimVerdict, Estimate, Expected};
//!
//! let claim = |ours| {
//!     Claim::new("figure", "jam density", "veh/km", Expected::About(134.0, 0.5), ours, "1/d.")
//! };
//! assert_eq!(claim(Estimate::exact(133.3)).verdict(), ClaimVerdict::Differs);
//! assert_eq!(claim(Estimate::new(133.3, 0.4)).verdict(), ClaimVerdict::Agrees);
//! let open = claim(Estimate::exact(133.3)).or("whole vehicles on 1 km", Estimate::exact(134.0));
//! assert_eq!(open.verdict(), ClaimVerdict::NotDetermined);
//! ```

use crate::numerics::statistics::{Statistics, Student};
use serde::{Serialize, Serializer};
use std::fmt::{self, Write as _};

/// A measured value with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The value; NaN where there is none.
    pub value: f64,
    /// Half-width of the interval about the value; NaN where it is unknown, 0 where the value is exact.
    pub uncertainty: f64,
}

/// The value, and the uncertainty unless it is 0.
impl fmt::Display for Estimate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&short(self.value))?;
        if self.uncertainty == 0.0 { Ok(()) } else { write!(f, " ± {}", short(self.uncertainty)) }
    }
}

impl Estimate {
    /// A value with an uncertainty.
    pub fn new(value: f64, uncertainty: f64) -> Self {
        Self { value, uncertainty }
    }

    /// A value without uncertainty.
    pub fn exact(value: f64) -> Self {
        Self { value, uncertainty: 0.0 }
    }

    /// The mean of a sample with the half-width of its 95 % confidence interval.
    pub fn of(statistics: &Statistics) -> Self {
        let [low, high] = statistics.interval;
        Self { value: statistics.mean, uncertainty: 0.5 * (high - low) }
    }

    /// The mean of independent samples with its 95 % confidence interval (Student's t). With fewer than two samples
    /// the uncertainty is NaN, with a sample that is NaN the value too; no claim is met then.
    pub fn mean(samples: &[f64]) -> Self {
        if samples.iter().any(|sample| sample.is_nan()) {
            return Self::new(f64::NAN, f64::NAN);
        }
        Self::of(&Statistics::of(samples.iter().copied(), &mut Student::default()))
    }
}

/// The paper's statement in a form that can be checked.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Expected {
    /// This number, within this tolerance.
    About(f64, f64),
    /// No more than this.
    AtMost(f64),
    /// More than this.
    MoreThan(f64),
}

impl Expected {
    /// Whether an estimate meets it. An estimate with NaN never does.
    pub fn is_met_by(self, ours: Estimate) -> bool {
        let Estimate { value, uncertainty } = ours;
        match self {
            Self::About(paper, tolerance) => (value - paper).abs() <= tolerance + uncertainty,
            Self::AtMost(most) => value + uncertainty <= most,
            Self::MoreThan(least) => value - uncertainty > least,
        }
    }
}

/// One choice where the paper leaves a choice open, and the value that it gives.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Reading {
    /// The choice, in words.
    pub choice: String,
    /// Our value under this choice.
    pub ours: Estimate,
}

/// The verdict on a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClaimVerdict {
    /// Every reading meets the claim.
    Agrees,
    /// No reading meets it.
    Differs,
    /// Some readings meet it, some do not.
    NotDetermined,
}

impl fmt::Display for ClaimVerdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Agrees => "agrees",
            Self::Differs => "differs",
            Self::NotDetermined => "not determined by the paper",
        })
    }
}

/// A claim of the paper beside our value: one row of the table of claims.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Claim {
    /// Identifier of the figure whose runs check it.
    pub figure: &'static str,
    /// The claim, in words.
    pub claim: String,
    /// Unit of the numbers; empty for a pure one.
    pub unit: &'static str,
    /// The paper's statement.
    pub expected: Expected,
    /// The reading that we take, first; then others that the paper allows as well.
    pub readings: Vec<Reading>,
    /// How the value was measured, and where the tolerance comes from.
    pub method: String,
}

impl Claim {
    /// A claim with one reading.
    pub fn new(
        figure: &'static str,
        claim: impl Into<String>,
        unit: &'static str,
        expected: Expected,
        ours: Estimate,
        method: impl Into<String>,
    ) -> Self {
        let readings = vec![Reading { choice: String::new(), ours }];
        Self { figure, claim: claim.into(), unit, expected, readings, method: method.into() }
    }

    /// The same claim, with another reading that the paper allows.
    #[must_use]
    pub fn or(mut self, choice: impl Into<String>, ours: Estimate) -> Self {
        self.readings.push(Reading { choice: choice.into(), ours });
        self
    }

    /// Our value, under the reading that we take.
    pub fn ours(&self) -> Estimate {
        self.readings[0].ours
    }

    /// The verdict, from all readings.
    pub fn verdict(&self) -> ClaimVerdict {
        let met = self.readings.iter().filter(|r| self.expected.is_met_by(r.ours)).count();
        match met {
            0 => ClaimVerdict::Differs,
            n if n == self.readings.len() => ClaimVerdict::Agrees,
            _ => ClaimVerdict::NotDetermined,
        }
    }

    /// The paper's statement in words, with the tolerance: `2065 ± 0.5 veh/h`.
    pub fn paper(&self) -> String {
        let text = match self.expected {
            Expected::About(value, tolerance) => format!("{} ± {}", short(value), short(tolerance)),
            Expected::AtMost(most) => format!("at most {}", short(most)),
            Expected::MoreThan(least) => format!("more than {}", short(least)),
        };
        with_unit(text, self.unit)
    }

    /// Our value in words: `2065 veh/h`, or `40.2 ± 0.3 %`; `none` where there is none.
    pub fn ours_in_words(&self) -> String {
        let ours = self.ours();
        if ours.value.is_nan() { "none".into() } else { with_unit(ours.to_string(), self.unit) }
    }

    /// How the value was measured, and the values of the other readings (their range where they are more than six).
    pub fn method_in_words(&self) -> String {
        let mut text = self.method.clone();
        let others = &self.readings[1..];
        if others.is_empty() {
            return text;
        }
        let met = self.readings.iter().filter(|r| self.expected.is_met_by(r.ours)).count();
        let _ = write!(text, " Readings tried: {}, of which {met} meet the claim.", self.readings.len());
        if others.len() <= 6 {
            let each = |r: &Reading| format!("{}: {}", r.choice, r.ours);
            let _ = write!(text, " Others: {}.", others.iter().map(each).collect::<Vec<_>>().join("; "));
        } else {
            let values = || self.readings.iter().map(|r| r.ours.value);
            let (low, high) = (values().fold(f64::NAN, f64::min), values().fold(f64::NAN, f64::max));
            let _ = write!(text, " They range from {} to {}.", short(low), short(high));
        }
        text
    }
}

impl Serialize for Claim {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Row {
            figure: &'static str,
            claim: String,
            paper: String,
            /// `null` where there is no value.
            ours: f64,
            uncertainty: f64,
            verdict: String,
            method: String,
        }
        Row {
            figure: self.figure,
            claim: with_unit(self.claim.clone() + ",", self.unit).trim_end_matches(',').to_owned(),
            paper: self.paper(),
            ours: self.ours().value,
            uncertainty: self.ours().uncertainty,
            verdict: self.verdict().to_string(),
            method: self.method_in_words(),
        }
        .serialize(serializer)
    }
}

/// A text with its unit behind it.
fn with_unit(text: String, unit: &str) -> String {
    match unit {
        "" => text,
        "%" => text + " %",
        unit => format!("{text} {unit}"),
    }
}

/// A number with about four significant digits; `none` for NaN.
pub fn short(value: f64) -> String {
    if value.is_nan() {
        return "none".into();
    }
    let size = value.abs();
    let digits = match size {
        s if s >= 1000.0 || s == 0.0 => 0,
        s if s >= 100.0 => 1,
        s if s >= 10.0 => 2,
        s if s >= 0.1 => 3,
        s if s >= 0.01 => 4,
        s if s >= 0.001 => 5,
        _ => return format!("{value:.2e}"),
    };
    let text = format!("{value:.digits$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    text.replace('-', "−")
}

/// The table of claims for a terminal.
pub fn to_text(claims: &[Claim]) -> String {
    let mut out = String::new();
    let mut figure = "";
    for claim in claims {
        if claim.figure != figure {
            figure = claim.figure;
            let _ = writeln!(out, "{}{figure}", if out.is_empty() { "" } else { "\n" });
        }
        let _ = writeln!(out, "  {:<11} {}", Short(claim.verdict()), claim.claim);
        let _ = writeln!(out, "  {:<11} paper: {}   ours: {}", "", claim.paper(), claim.ours_in_words());
        for line in wrapped(&claim.method_in_words(), 96) {
            let _ = writeln!(out, "  {:<11} {line}", "");
        }
    }
    let count = |v| claims.iter().filter(|c| c.verdict() == v).count();
    let words = |n: usize, one: &str, many: &str| format!("{n} {}", if n == 1 { one } else { many });
    let _ = writeln!(
        out,
        "\n{}: {}, {}, {} not determined by the paper (“open” above)",
        words(claims.len(), "claim", "claims"),
        words(count(ClaimVerdict::Agrees), "agrees", "agree"),
        words(count(ClaimVerdict::Differs), "differs", "differ"),
        count(ClaimVerdict::NotDetermined)
    );
    out
}

/// A verdict in one word, for the text on a terminal.
struct Short(ClaimVerdict);
impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self.0 {
            ClaimVerdict::Agrees => "agrees",
            ClaimVerdict::Differs => "DIFFERS",
            ClaimVerdict::NotDetermined => "open",
        })
    }
}

/// The words of a text in lines of at most so many characters.
fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let line = lines.last_mut().expect("never empty");
        if !line.is_empty() && line.chars().count() + 1 + word.chars().count() > width {
            lines.push(word.to_owned());
        } else {
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines
}

/// The table of claims as Markdown.
pub fn to_markdown(claims: &[Claim]) -> String {
    let mut out = String::from("| claim | paper | ours | verdict | how |\n|---|---|---|---|---|\n");
    for claim in claims {
        let _ = writeln!(
            out,
            "| {} | {} | {} | {} | {} |",
            claim.claim,
            claim.paper(),
            claim.ours_in_words(),
            claim.verdict(),
            claim.method_in_words()
        );
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn claim(expected: Expected, ours: Estimate) -> Claim {
        Claim::new("figure", "something", "m", expected, ours, "By looking.")
    }

    #[test]
    fn a_perturbed_value_flips_its_verdict() {
        let about = |ours| claim(Expected::About(2065.0, 0.5), ours).verdict();
        assert_eq!(about(Estimate::exact(2065.4)), ClaimVerdict::Agrees);
        assert_eq!(about(Estimate::exact(2065.6)), ClaimVerdict::Differs);
        assert_eq!(about(Estimate::new(2065.6, 0.2)), ClaimVerdict::Agrees);
        let most = |ours| claim(Expected::AtMost(2.0), ours).verdict();
        assert_eq!(most(Estimate::new(1.5, 0.4)), ClaimVerdict::Agrees);
        assert_eq!(
            most(Estimate::new(1.5, 0.6)),
            ClaimVerdict::Differs,
            "an inequality must hold for the whole interval"
        );
        let more = |ours| claim(Expected::MoreThan(0.0), ours).verdict();
        assert_eq!(more(Estimate::new(0.5, 0.4)), ClaimVerdict::Agrees);
        assert_eq!(more(Estimate::new(0.5, 0.5)), ClaimVerdict::Differs);
        for expected in [Expected::About(0.0, 1.0), Expected::AtMost(1.0), Expected::MoreThan(0.0)] {
            assert_eq!(
                claim(expected, Estimate::exact(f64::NAN)).verdict(),
                ClaimVerdict::Differs,
                "no value"
            );
            assert_eq!(
                claim(expected, Estimate::new(0.5, f64::NAN)).verdict(),
                ClaimVerdict::Differs,
                "one sample"
            );
        }
    }

    #[test]
    fn readings_that_disagree_leave_a_claim_open() {
        let base = claim(Expected::About(1.0, 0.1), Estimate::exact(1.05));
        assert_eq!(base.clone().or("other", Estimate::exact(0.95)).verdict(), ClaimVerdict::Agrees);
        assert_eq!(base.clone().or("other", Estimate::exact(2.0)).verdict(), ClaimVerdict::NotDetermined);
        let far = claim(Expected::About(1.0, 0.1), Estimate::exact(3.0)).or("other", Estimate::exact(2.0));
        assert_eq!(far.verdict(), ClaimVerdict::Differs);
        assert!(far.method_in_words().contains("Readings tried: 2, of which 0"));
    }

    #[test]
    fn the_summary_has_the_singular_for_one() {
        let of = |ours: &[f64]| {
            let claims: Vec<_> =
                ours.iter().map(|&v| claim(Expected::AtMost(1.0), Estimate::exact(v))).collect();
            to_text(&claims).lines().last().unwrap_or_default().to_owned()
        };
        assert!(of(&[2.0]).starts_with("1 claim: 0 agree, 1 differs, 0 not determined"));
        assert!(of(&[0.0, 2.0, 3.0]).starts_with("3 claims: 1 agrees, 2 differ, 0 not determined"));
    }

    #[test]
    fn json_has_the_seven_fields() {
        let json = serde_json::to_value(claim(Expected::About(1.0, 0.1), Estimate::new(1.05, 0.2))).unwrap();
        let names: Vec<_> = json.as_object().unwrap().keys().cloned().collect();
        assert_eq!(names, ["claim", "figure", "method", "ours", "paper", "uncertainty", "verdict"]);
        assert_eq!(json["ours"], 1.05);
        assert_eq!(json["verdict"], "agrees");
        assert_eq!(json["claim"], "something, m");
        let none = serde_json::to_value(claim(Expected::AtMost(1.0), Estimate::exact(f64::NAN))).unwrap();
        assert!(none["ours"].is_null());
    }

    /// The 0.975 quantile of Student's t for three degrees of freedom is 3.182446 (NIST/SEMATECH handbook, 1.3.6.7.2).
    #[test]
    fn a_mean_has_the_interval_of_student() {
        let four = Estimate::mean(&[1.0, 2.0, 3.0, 4.0]);
        assert!((four.value - 2.5).abs() < 1e-15, "{four}");
        assert!((four.uncertainty - 3.182_446 * (5.0_f64 / 3.0).sqrt() / 2.0).abs() < 1e-6, "{four}");
        assert_eq!(Estimate::mean(&[0.1, 0.1, 0.1]), Estimate::exact(0.1));
        assert!(Estimate::mean(&[1.0]).uncertainty.is_nan());
        let unknown = Estimate::mean(&[1.0, f64::NAN, 2.0]);
        assert!(unknown.value.is_nan() && unknown.uncertainty.is_nan());
    }

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (2065.2, "2065"),
            (-1.0734, "−1.073"),
            (0.5368, "0.537"),
            (0.0, "0"),
            (33.333, "33.33"),
            (0.02, "0.02"),
        ] {
            assert_eq!(short(value), text);
        }
    }
}
