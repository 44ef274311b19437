//! Statistics over the runs of every cell: mean, standard deviation, quantiles and a confidence interval of every quantity,
//! at every time.

use super::plan::Plan;
use super::rows::OF_EVERY_RUN;
use super::run::Run;
use crate::error::{Error, quoted};
use crate::format::table::{Column, Table, Values};
use crate::measurement::Measurement;
use crate::numerics::statistics::{QUANTILES, Statistics, Student};
use std::collections::BTreeMap;

/// The columns that identify a row of a measurement (a time, a vehicle, …), so that the rows of different runs can be
/// matched; none where they cannot.
fn keys(measurement: &Measurement) -> Option<&'static [&'static str]> {
    Some(match measurement {
        Measurement::Outcome {} => &[],
        Measurement::Overview { .. }
        | Measurement::Speeds { .. }
        | Measurement::Flow { .. }
        | Measurement::Modes { .. }
        | Measurement::Lanes { .. } => &["time_s"],
        Measurement::Trajectories { .. } | Measurement::Vehicles { .. } => &["time_s", "vehicle"],
        Measurement::Drivers { .. } => &["time_s", "group"],
        Measurement::SpeedMap { .. } | Measurement::FlowMap { .. } => &["time_s", "position_m"],
        Measurement::Growth { .. } => &["lane", "mode"],
        Measurement::CyclicGrowth { .. } => &["vehicle", "period"],
        // The times of the rows differ from run to run.
        Measurement::Events {} | Measurement::Equilibrium { .. } => return None,
    })
}

/// The value of an identifying column. Keys sort as their values do.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Key {
    /// The bits of a number; those of numbers that are not negative sort as the numbers do.
    Number(u64),
    Whole(u64),
    Text(String),
}

impl Key {
    fn of(values: &Values, row: usize) -> Self {
        match values {
            Values::Float(v) => Self::Number(v[row].max(0.0).to_bits()),
            Values::Whole(v) => Self::Whole(v[row]),
            Values::Text(v) => Self::Text(v[row].clone()),
        }
    }
}

/// The rows of a summary while it is being made.
#[derive(Default)]
struct Rows {
    cells: Vec<u64>,
    keys: Vec<Vec<Key>>,
    quantities: Vec<String>,
    statistics: Vec<Statistics>,
}

impl Plan {
    /// Whether the measurement can be summarised.
    ///
    /// # Errors
    /// A measurement whose rows do not correspond from run to run.
    pub fn check_summary(&self) -> Result<(), Error> {
        if keys(self.measurement()).is_some() {
            return Ok(());
        }
        let allowed =
            "a table whose rows correspond from run to run, such as outcome, overview, lanes or drivers";
        Err(Error::conflict("table of a summary", quoted(self.measurement().name()), allowed))
    }

    /// A row for each cell, each row of the measurement (time, vehicle, …), and each quantity.
    ///
    /// # Errors
    /// As [`Self::check_summary`].
    ///
    /// At each time, the statistics are over the runs that have not ended yet; `collided` is the share of all runs that have
    /// collided by then.
    pub fn summary(&self, runs: &BTreeMap<u64, Run>) -> Result<Table, Error> {
        self.check_summary()?;
        let keys = keys(self.measurement()).unwrap_or_default();
        let columns = self.columns();
        let is_key = |column: &Column| keys.contains(&column.name.as_str());
        let key_places: Vec<usize> = (0..columns.len()).filter(|&k| is_key(&columns[k])).collect();
        let measured: Vec<usize> = (0..columns.len())
            .filter(|&k| {
                let known = OF_EVERY_RUN.contains(&columns[k].name.as_str());
                !is_key(&columns[k]) && !known && !matches!(columns[k].values, Values::Text(_))
            })
            .collect();
        let of_cells = keys.is_empty();

        let mut rows = Rows::default();
        let mut student = Student::default();
        for cell in 0..self.cells() {
            let numbers = cell * self.runs_per_cell()..(cell + 1) * self.runs_per_cell();
            let members: Vec<&Run> = runs.range(numbers).map(|(_, run)| run).collect();
            // The values of every quantity, runs in order of number.
            let mut samples: BTreeMap<Vec<Key>, Vec<Vec<f64>>> = BTreeMap::new();
            if of_cells && !members.is_empty() {
                samples.insert(Vec::new(), vec![Vec::new(); measured.len()]);
            }
            for run in &members {
                for row in 0..super::rows::rows(run) {
                    if !self.is_regular(run, row, &columns) {
                        continue;
                    }
                    let key = key_places.iter().map(|&k| Key::of(&run.values[k], row)).collect();
                    let sample = samples.entry(key).or_insert_with(|| vec![Vec::new(); measured.len()]);
                    for (sample, &k) in sample.iter_mut().zip(&measured) {
                        sample.push(number(&run.values[k], row));
                    }
                }
            }
            for (key, sample) in samples {
                let by = match key[..] {
                    [] => Some(f64::INFINITY),
                    [Key::Number(bits)] => Some(f64::from_bits(bits)),
                    _ => None,
                };
                let mut add = |name: &str, statistics| rows.push(cell, &key, name, statistics);
                if let Some(by) = by {
                    let collided = members.iter().map(|run| run.collided && run.end <= by);
                    add("collided", Statistics::of_share(collided));
                }
                if of_cells {
                    add("end_time_s", Statistics::of(members.iter().map(|run| run.end), &mut student));
                    let collisions = members.iter().filter(|run| run.collided).map(|run| run.end);
                    add("collision_time_s", Statistics::of(collisions, &mut student));
                }
                for (&k, values) in measured.iter().zip(sample) {
                    add(&columns[k].name, Statistics::of(values, &mut student));
                }
            }
        }
        Ok(rows.table(self, &key_places.iter().map(|&k| columns[k].clone()).collect::<Vec<_>>()))
    }

    /// Whether a row is at one of the regular times of the measurement. Some tables have an additional row at a collision,
    /// at a time that other runs do not have.
    fn is_regular(&self, run: &Run, row: usize, columns: &[Column]) -> bool {
        if !run.collided {
            return true;
        }
        let Some(k) = columns.iter().position(|c| c.name == "time_s") else { return true };
        let time = number(&run.values[k], row);
        time < run.end || {
            let scenario = self.scenario(run.number);
            let steps = |seconds| scenario.steps(seconds);
            self.measurement().every().is_none_or(|every| steps(time).is_multiple_of(steps(every)))
        }
    }
}

fn number(values: &Values, row: usize) -> f64 {
    match values {
        Values::Float(v) => v[row],
        Values::Whole(v) => v[row] as f64,
        Values::Text(_) => f64::NAN,
    }
}

impl Rows {
    fn push(&mut self, cell: u64, key: &[Key], quantity: &str, statistics: Statistics) {
        self.cells.push(cell);
        self.keys.push(key.to_vec());
        self.quantities.push(quantity.to_owned());
        self.statistics.push(statistics);
    }

    fn table(self, plan: &Plan, key_columns: &[Column]) -> Table {
        let mut columns = plan.varied_columns(&self.cells);
        for (k, column) in key_columns.iter().enumerate() {
            let mut values = column.values.clone();
            for key in &self.keys {
                match (&mut values, &key[k]) {
                    (Values::Float(v), Key::Number(bits)) => v.push(f64::from_bits(*bits)),
                    (Values::Whole(v), Key::Whole(n)) => v.push(*n),
                    (Values::Text(v), Key::Text(text)) => v.push(text.clone()),
                    _ => unreachable!("a key is made from its column"),
                }
            }
            columns.push(Column { values, name: plan.distinct(column.name.clone()), ..column.clone() });
        }
        let of = |f: &dyn Fn(&Statistics) -> f64| self.statistics.iter().map(f).collect::<Vec<f64>>();
        let counts = self.statistics.iter().map(|s| s.count as u64).collect();
        columns.push(Column::text(
            "quantity",
            "what the numbers are of; its unit is at its end",
            self.quantities,
        ));
        columns.push(Column::whole("runs", "", "number of runs that have a value", counts));
        columns.push(Column::float("mean", "", "mean", of(&|s| s.mean)));
        columns.push(Column::float(
            "sd",
            "",
            "standard deviation, n − 1 in the denominator",
            of(&|s| s.deviation),
        ));
        for (k, p) in QUANTILES.iter().enumerate() {
            let percent = (100.0 * p).round();
            let meaning = format!("{percent} % quantile, interpolated linearly (type 7 of Hyndman and Fan)");
            columns.push(Column::float(format!("q{percent:02}"), "", meaning, of(&|s| s.quantiles[k])));
        }
        let meaning = |end| {
            format!("{end} end of the 95 % confidence interval of the mean (Student's; of a share: Wilson's)")
        };
        columns.push(Column::float("ci95_low", "", meaning("lower"), of(&|s| s.interval[0])));
        columns.push(Column::float("ci95_high", "", meaning("upper"), of(&|s| s.interval[1])));
        Table::new(columns)
    }
}
