//! Finished runs as text, one a line, in any order. An interrupted batch leaves such a file, and so does each shard of a
//! batch that is spread over machines; shards are merged from these files.
//!
//! The first line is a [`Header`] in JSON with the whole plan. Then each run is one line,
//! `[number, end, collided, [[…], …]]` with a list for each column, NaN being `null`. Numbers read back to the same bits.
//! A line counts only when it ends with a line feed, so that a line that was not written completely is ignored.
//!
//! ```
//! use ringroad::batch::record::{self, Record};
//! use ringroad::batch::{Header, Plan, Shard};
//! use ringroad::measurement::Measurement;
//! use ringroad::scenario::Scenario;
//!
//! let scenario = Scenario { until: 1.0, ..Scenario::default() };
//! let plan = Plan::new(scenario, Vec::new(), 2, Measurement::named("outcome")?)?;
//! let run = plan.run(0, &mut |_| true)?.unwrap();
//! let text = Header::new(plan, Shard::default(), false).line() + &record::line(&run);
//!
//! let read = Record::read(&text)?;
//! assert_eq!(read.runs[&0], run);
//! # Ok::<(), ringroad::error::Error>(())
//! ```

use super::plan::Plan;
use super::run::Run;
use crate::error::{Error, opening, quoted};
use crate::format::table::{Column, Values};
use crate::measurement::provenance::VERSION;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

/// A part of a plan: the runs with number ≡ index − 1 modulo count.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Shard {
    index: u64,
    count: u64,
}

impl Default for Shard {
    /// The whole plan, 1/1.
    fn default() -> Self {
        Self { index: 1, count: 1 }
    }
}

impl Shard {
    /// The numbers of its runs, ascending.
    pub fn numbers(self, plan: &Plan) -> impl Iterator<Item = u64> + use<> {
        (self.index - 1..plan.runs()).step_by(self.count as usize)
    }

    fn holds(self, number: u64) -> bool {
        number % self.count == self.index - 1
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

impl From<Shard> for String {
    fn from(shard: Shard) -> Self {
        shard.to_string()
    }
}

impl TryFrom<String> for Shard {
    type Error = Error;
    fn try_from(text: String) -> Result<Self, Error> {
        text.parse()
    }
}

impl FromStr for Shard {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self, Error> {
        let numbers = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((index, count)) if 1 <= index && index <= count && count <= super::plan::MOST_RUNS => {
                Ok(Self { index, count })
            }
            _ => Err(Error::malformed("shard", quoted(text), "i/n with i from 1 to n, such as 1/4")),
        }
    }
}

/// The first line of the text: the plan and the shard of the runs below it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Header {
    /// The program's version; a seed means the same run within one.
    pub ringroad: String,
    /// Whether the table is to be a summary.
    pub summary: bool,
    /// Which part of the plan.
    pub shard: Shard,
    /// The plan.
    pub plan: Plan,
}

impl Header {
    /// The header of a batch that is computed by this version.
    pub fn new(plan: Plan, shard: Shard, summary: bool) -> Self {
        Self { ringroad: VERSION.to_owned(), summary, shard, plan }
    }

    /// The header as a line, with its line feed.
    pub fn line(&self) -> String {
        serde_json::to_string(self).expect("plain data") + "\n"
    }

    /// Whether runs under the header `found` are runs of the same plan and version.
    fn check(&self, found: &Self) -> Result<(), Error> {
        if self.ringroad != found.ringroad {
            let what = format!("runs of version {} and not {}", found.ringroad, self.ringroad);
            let allowed = "runs of one version: a seed may mean another run in another";
            return Err(Error::version("batch", what, allowed));
        }
        match self.plan.difference(&found.plan) {
            Some(difference) => {
                let what = format!("another plan, in which {difference}");
                Err(Error::conflict("batch", what, "runs of the same plan"))
            }
            None => Ok(()),
        }
    }
}

/// A run as a line, with its line feed.
pub fn line(run: &Run) -> String {
    let values: Vec<Value> = run
        .values
        .iter()
        .map(|values| match values {
            Values::Float(v) => v.iter().copied().map(Value::from).collect(),
            Values::Whole(v) => v.iter().copied().map(Value::from).collect(),
            Values::Text(v) => v.iter().map(String::as_str).map(Value::from).collect(),
        })
        .collect();
    serde_json::to_string(&(run.number, run.end, run.collided, values)).expect("plain data") + "\n"
}

/// Reads a line as a run whose values have these columns.
fn parse(line: &str, columns: &[Column]) -> Option<Run> {
    let (number, end, collided, lists): (u64, f64, bool, Vec<Vec<Value>>) =
        serde_json::from_str(line).ok()?;
    if columns.len() != lists.len() || lists.windows(2).any(|w| w[0].len() != w[1].len()) {
        return None;
    }
    let values = columns.iter().zip(&lists).map(|(column, list)| {
        Some(match column.values {
            Values::Float(_) => {
                let number = |v: &Value| if v.is_null() { Some(f64::NAN) } else { v.as_f64() };
                Values::Float(list.iter().map(number).collect::<Option<_>>()?)
            }
            Values::Whole(_) => Values::Whole(list.iter().map(Value::as_u64).collect::<Option<_>>()?),
            Values::Text(_) => {
                Values::Text(list.iter().map(|v| v.as_str().map(str::to_owned)).collect::<Option<_>>()?)
            }
        })
    });
    Some(Run { number, end, collided, values: values.collect::<Option<_>>()? })
}

/// A text of finished runs, read.
#[derive(Clone, Debug)]
pub struct Record {
    /// Its first line.
    pub header: Header,
    /// The runs, by number.
    pub runs: BTreeMap<u64, Run>,
    /// Length of the text up to the end of its last complete line, in bytes; what follows was not written completely.
    pub whole: usize,
}

impl Record {
    /// Whether a text begins as finished runs do.
    pub fn is_record(text: &str) -> bool {
        text.starts_with("{\"ringroad\":")
    }

    /// Reads a text. Its last line may be incomplete.
    ///
    /// # Errors
    /// A text that does not begin with a header, and a complete line that is not a run of the plan and shard.
    pub fn read(text: &str) -> Result<Self, Error> {
        let allowed = "finished runs that ringroad batch wrote, with their plan";
        let refuse = || Error::not_ours("batch", opening(text), allowed);
        let (first, _) = text.split_once('\n').ok_or_else(refuse)?;
        if !Self::is_record(first) {
            return Err(refuse());
        }
        let header: Header =
            serde_json::from_str(first).map_err(|e| Error::malformed("header", e, "the plan of a batch"))?;
        let columns = header.plan.columns();
        let mut record = Self { header, runs: BTreeMap::new(), whole: first.len() + 1 };
        for (k, line) in text[record.whole..].split_inclusive('\n').enumerate() {
            if !line.ends_with('\n') {
                break;
            }
            record.whole += line.len();
            let Header { plan, shard, .. } = &record.header;
            let run = parse(line, &columns).filter(|r| r.number < plan.runs() && shard.holds(r.number));
            let run = run.ok_or_else(|| {
                Error::malformed(format!("line {}", k + 2), opening(line), "a finished run of the plan")
            })?;
            record.runs.insert(run.number, run);
        }
        Ok(record)
    }

    /// Whether its runs are runs of that plan and shard, computed by this version.
    pub fn check(&self, plan: &Plan, shard: Shard) -> Result<(), Error> {
        Header::new(plan.clone(), shard, false).check(&self.header)?;
        if self.header.shard == shard {
            Ok(())
        } else {
            let value = format!("shard {} and not {shard}", self.header.shard);
            Err(Error::conflict("batch", value, "the same shard"))
        }
    }
}

/// The text of a shard whose runs are all finished, in order of number; its bytes do not depend on the order in which they
/// were computed.
pub fn write(header: &Header, runs: &BTreeMap<u64, Run>) -> String {
    runs.values().fold(header.line(), |text, run| text + &line(run))
}

/// Merges the shards of one plan, each with its name for messages.
///
/// # Errors
/// Shards of different plans, versions or forms of table, shards that overlap, and a run that is missing.
pub fn merge(shards: Vec<(String, Record)>) -> Result<(Header, BTreeMap<u64, Run>), Error> {
    let mut shards = shards.into_iter();
    let Some((first_name, first)) = shards.next() else {
        return Err(Error::out_of_range("merge", "nothing", "the files of all shards of a batch"));
    };
    let header = first.header.clone();
    let mut runs: BTreeMap<u64, (Run, String)> = BTreeMap::new();
    for (name, shard) in std::iter::once((first_name.clone(), first)).chain(shards) {
        header.check(&shard.header).map_err(|e| e.within(&name))?;
        if header.summary != shard.header.summary {
            let allowed = format!("shards with one form of table, as in {first_name}");
            let form = if shard.header.summary { "with --summary" } else { "without --summary" };
            return Err(Error::conflict("shard", form, allowed).within(&name));
        }
        for (number, run) in shard.runs {
            if let Some((_, other)) = runs.insert(number, (run, name.clone())) {
                let value = format!("shard {} with run {}", shard.header.shard, number + 1);
                let allowed = format!("shards that do not overlap: the run is in {other}, too");
                return Err(Error::conflict("merge", value, allowed).within(&name));
            }
        }
    }
    if let Some(missing) = (0..header.plan.runs()).find(|n| !runs.contains_key(n)) {
        let value = format!("{} of {} runs", runs.len(), header.plan.runs());
        let count = header.shard.count;
        let allowed = format!(
            "all of them: run {} is missing, a run of shard {}/{count}",
            missing + 1,
            missing % count + 1
        );
        return Err(Error::conflict("merge", value, allowed));
    }
    Ok((header, runs.into_iter().map(|(number, (run, _))| (number, run)).collect()))
}
