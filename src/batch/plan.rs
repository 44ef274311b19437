//! A plan: which runs a batch consists of, numbered, and its JSON form.

use crate::error::{Error, quoted};
use crate::format::table::Table;
use crate::measurement::Measurement;
use crate::measurement::header::{Word, with_header};
use crate::scenario::Scenario;
use crate::scenario::action::VehicleSelector;
use crate::scenario::parameter_values::ParameterValues;
use crate::scenario::parameters::RoadField;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// The most runs of one batch.
pub const MOST_RUNS: u64 = 1_000_000;

/// The most memory that the rows of all runs may take, bytes.
const MOST_MEMORY: f64 = 8.0 * 1024.0 * 1024.0 * 1024.0;

/// Version of the JSON form.
const FORMAT: u64 = 1;

/// A scenario, what is varied, how many seeds, and what is measured: everything that determines a batch. All runs of a
/// plan are valid; this is checked when the plan is made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "Data", try_from = "Data")]
pub struct Plan {
    scenario: Scenario,
    vary: Vec<ParameterValues>,
    runs: u64,
    measurement: Measurement,
}

/// The JSON form.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Data {
    version: u64,
    scenario: Value,
    #[serde(default)]
    vary: Vec<ParameterValues>,
    #[serde(default = "one")]
    runs: u64,
    measurement: Value,
}

fn one() -> u64 {
    1
}

impl Plan {
    /// `runs` seeds of every combination of the varied values. The values that the scenario has for the varied parameters do not
    /// matter.
    ///
    /// # Errors
    /// A parameter varied twice, no runs or more than [`MOST_RUNS`], a cell whose scenario or measurement is not valid or
    /// whose table has other columns than the other cells have, and rows that would take too much memory.
    pub fn new(
        mut scenario: Scenario,
        vary: Vec<ParameterValues>,
        runs: u64,
        measurement: Measurement,
    ) -> Result<Self, Error> {
        for (i, varied) in vary.iter().enumerate() {
            let parameter = varied.parameter();
            if vary[..i].iter().any(|v| v.parameter() == parameter) {
                let name = parameter.hyphenated();
                return Err(Error::conflict(
                    "vary",
                    quoted(&name),
                    "every parameter once, with all its values",
                ));
            }
            scenario.set(parameter, varied.values()[0])?;
        }
        let plan = Self { scenario, vary, runs, measurement };
        plan.check_size()?;
        plan.check_cells()?;
        Ok(plan)
    }

    fn check_size(&self) -> Result<(), Error> {
        if self.runs == 0 {
            return Err(Error::out_of_range("runs", 0, "at least one run of every cell"));
        }
        let cells = self.vary.iter().map(|v| v.values().len() as f64).product::<f64>();
        let total = cells * self.runs as f64;
        if total > MOST_RUNS as f64 {
            let value = format!("{cells} cells of {} runs, {total} runs in all", self.runs);
            return Err(Error::too_large("batch", value, format!("at most {MOST_RUNS} runs")));
        }
        RoadField::Seed
            .parameter()
            .check(self.scenario.seed as f64 + (self.runs - 1) as f64)
            .map_err(|e| e.within(format!("seed of the last of {} runs", self.runs)))
    }

    fn check_cells(&self) -> Result<(), Error> {
        // Which vehicles a share (such as 10%) selects depends on the seed, and with it whether the start is valid.
        let shares = self.scenario.overrides.iter().map(|e| e.vehicles);
        let shares = shares.chain(self.scenario.actions.iter().map(|a| a.vehicles));
        let seeds = if shares.into_iter().any(|selector| matches!(selector, VehicleSelector::Share(_))) {
            self.runs
        } else {
            1
        };
        let mut memory = 0.0;
        for cell in 0..self.cells() {
            let in_cell = |e: Error| if self.vary.is_empty() { e } else { e.within(self.cell_name(cell)) };
            for k in 0..seeds {
                let scenario = self.scenario(cell * self.runs + k);
                scenario.validate().map_err(in_cell)?;
                if k == 0 {
                    self.measurement.validate(&scenario).map_err(in_cell)?;
                    self.check_columns(&scenario).map_err(in_cell)?;
                    memory += self.measurement.bytes(&scenario) * self.runs as f64;
                }
            }
        }
        if memory > MOST_MEMORY {
            const GIB: f64 = 1024.0 * 1024.0 * 1024.0;
            let allowed = format!("at most {} GiB: measure less often, or less", MOST_MEMORY / GIB);
            return Err(Error::too_large("rows of all runs", format!("{:.1} GiB", memory / GIB), allowed));
        }
        Ok(())
    }

    /// Some tables have a column for each lane, vehicle or mode; all runs must have the same columns.
    fn check_columns(&self, scenario: &Scenario) -> Result<(), Error> {
        let numbered_columns = |scenario: &Scenario| match self.measurement.resolved(scenario) {
            Measurement::Lanes { .. } => vec![scenario.lanes],
            Measurement::Speeds { vehicles, .. } => vehicles.unwrap_or_default(),
            Measurement::Modes { modes, .. } => modes.into_iter().collect(),
            _ => Vec::new(),
        };
        if numbered_columns(scenario) == numbered_columns(&self.scenario) {
            return Ok(());
        }
        let allowed = "a table that has the same columns in every cell, such as overview";
        Err(Error::conflict("table", quoted(self.measurement.name()), allowed))
    }

    /// A table of its runs as CSV, with the plan in the header.
    pub fn to_csv(&self, table: &Table) -> String {
        with_header(table, &[(Word::Plan, &self.to_json())])
    }

    /// The plan in the header of a file that [`Plan::to_csv`] wrote.
    pub fn from_csv(text: &str) -> Result<Self, Error> {
        Self::from_json(Word::Plan.read(text)?).map_err(|e| e.within("CSV header"))
    }

    /// What is varied.
    pub fn vary(&self) -> &[ParameterValues] {
        &self.vary
    }

    /// What is measured.
    pub fn measurement(&self) -> &Measurement {
        &self.measurement
    }

    /// Number of cells.
    pub fn cells(&self) -> u64 {
        self.vary.iter().map(|v| v.values().len() as u64).product()
    }

    /// Number of runs of each cell.
    pub fn runs_per_cell(&self) -> u64 {
        self.runs
    }

    /// Number of all runs.
    pub fn runs(&self) -> u64 {
        self.cells() * self.runs
    }

    /// The cell of a run.
    pub fn cell(&self, run: u64) -> u64 {
        run / self.runs
    }

    /// The varied parameters' values in a cell.
    pub fn cell_values(&self, cell: u64) -> Vec<f64> {
        let mut rest = cell as usize;
        let mut values = vec![0.0; self.vary.len()];
        for (value, vary) in values.iter_mut().zip(&self.vary).rev() {
            let count = vary.values().len();
            *value = vary.values()[rest % count];
            rest /= count;
        }
        values
    }

    /// The name of a cell in messages: `cell lanes=2, reaction-time=0.5`.
    fn cell_name(&self, cell: u64) -> String {
        let values = self.cell_values(cell);
        let pairs = self.vary.iter().zip(values).map(|(v, x)| format!("{}={x}", v.parameter().hyphenated()));
        format!("cell {}", pairs.collect::<Vec<_>>().join(", "))
    }

    /// The scenario of a run, with the values of its cell and its own seed.
    pub fn scenario(&self, run: u64) -> Scenario {
        let mut scenario = self.scenario.clone();
        for (vary, value) in self.vary.iter().zip(self.cell_values(self.cell(run))) {
            scenario.set(vary.parameter(), value).expect("checked when the plan was made");
        }
        scenario.seed = self.seed(run);
        scenario
    }

    /// The seed of a run.
    pub fn seed(&self, run: u64) -> u64 {
        self.scenario.seed + run % self.runs
    }

    /// One line of JSON with every field.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("plain data")
    }

    /// Reads JSON and checks every cell.
    ///
    /// # Errors
    /// What is wrong with the JSON or the plan.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        serde_json::from_str(text).map_err(|e| Error::malformed("plan", e, "a plan in JSON"))
    }

    /// The first difference of another plan from this one, as the part of a sentence: `runs is 10 and not 20`.
    pub fn difference(&self, other: &Self) -> Option<String> {
        let json = |plan: &Self| serde_json::to_value(plan).expect("plain data");
        difference("", &json(self), &json(other))
    }
}

fn difference(name: &str, expected: &Value, found: &Value) -> Option<String> {
    match (expected, found) {
        (Value::Object(a), Value::Object(b)) => {
            let keys = a.keys().chain(b.keys().filter(|k| !a.contains_key(*k)));
            keys.map(|key| {
                let null = &Value::Null;
                difference(key, a.get(key).unwrap_or(null), b.get(key).unwrap_or(null))
            })
            .find_map(|d| d)
        }
        _ if expected == found => None,
        _ => Some(format!("{name} is {found} and not {expected}")),
    }
}

impl From<Plan> for Data {
    fn from(plan: Plan) -> Self {
        let value = |json: String| serde_json::from_str(&json).expect("JSON that was just written");
        Self {
            version: FORMAT,
            scenario: value(plan.scenario.to_json()),
            vary: plan.vary,
            runs: plan.runs,
            measurement: value(plan.measurement.to_json()),
        }
    }
}

impl TryFrom<Data> for Plan {
    type Error = Error;
    fn try_from(data: Data) -> Result<Self, Error> {
        if data.version != FORMAT {
            return Err(Error::version("version of the plan", data.version, FORMAT.to_string()));
        }
        let scenario = Scenario::from_json(&data.scenario.to_string())?;
        let measurement = Measurement::from_json(&data.measurement.to_string())?;
        Self::new(scenario, data.vary, data.runs, measurement)
    }
}
