//! What several figures share: their scenario, runs with measurements, numbers of a table, and statistics over runs.

use super::claim::Estimate;
use crate::format::table::{Column, Table, Values};
use crate::measurement::Measurement;
use crate::measurement::probe::{Probe, measure};
use crate::numerics::statistics::{Statistics, Student};
use crate::scenario::Scenario;
use crate::simulation::Simulation;

/// The scenario of the paper's single-lane figures: vehicle 1 displaced downstream by so many metres at t = 0.
pub fn nudged(reaction_time: f64, metres: f64, until: f64) -> Scenario {
    let mut scenario = Scenario { until, ..Scenario::default() };
    scenario.driver.reaction_time = reaction_time;
    scenario.actions.push(format!("at=0:1:nudge={metres}").parse().expect("the grammar of actions"));
    scenario
}

/// Runs a valid scenario to its end with measurements. Returns their tables and the state at the end.
pub fn measured(scenario: &Scenario, measurements: &[Measurement]) -> (Vec<Table>, Simulation) {
    let probe = |m: &Measurement| m.probe(scenario).expect("measurements of figures are valid");
    let mut probes: Vec<_> = measurements.iter().map(probe).collect();
    let mut simulation = Simulation::new(scenario).expect("scenarios of figures are valid");
    measure(&mut simulation, &mut probes, &mut |_| true);
    (probes.iter().map(|p| p.table()).collect(), simulation)
}

/// Runs a valid scenario to its end with a probe of the figure's own. Returns the state at the end.
pub fn observed(scenario: &Scenario, probe: &mut dyn Probe) -> Simulation {
    let mut simulation = Simulation::new(scenario).expect("scenarios of figures are valid");
    probe.observe(&simulation);
    while !simulation.is_finished() {
        simulation.step();
        probe.observe(&simulation);
    }
    simulation
}

/// The numbers of a table, column by column; text columns are left out.
pub fn numbers(table: &Table) -> Vec<Vec<f64>> {
    let one = |column: &Column| match &column.values {
        Values::Float(values) => Some(values.clone()),
        Values::Whole(values) => Some(values.iter().map(|&v| v as f64).collect()),
        Values::Text(_) => None,
    };
    table.columns().iter().filter_map(one).collect()
}

/// The table of a measurement without text columns, from its [`numbers`] in a task result.
pub fn refilled(scenario: &Scenario, measurement: &Measurement, columns: &[Vec<f64>]) -> Table {
    let empty = measurement.probe(scenario).expect("measurements of figures are valid").table();
    let fill = |(column, values): (&Column, &Vec<f64>)| match &column.values {
        Values::Whole(_) => Column::whole(
            column.name.clone(),
            column.unit,
            column.meaning.clone(),
            values.iter().map(|&v| v as u64).collect(),
        ),
        _ => Column::float(column.name.clone(), column.unit, column.meaning.clone(), values.clone()),
    };
    Table::new(empty.columns().iter().zip(columns).map(fill).collect())
}

/// The numbers of the column of that name.
pub fn column(table: &Table, name: &str) -> Vec<f64> {
    table.floats(name).map_or_else(
        || table.wholes(name).expect("a column of numbers of that name").iter().map(|&v| v as f64).collect(),
        <[f64]>::to_vec,
    )
}

/// Mean, standard deviation and half-width of the 95 % confidence interval of the mean over runs, row by row.
pub struct Spread {
    pub mean: Vec<f64>,
    pub deviation: Vec<f64>,
    half: Vec<f64>,
}

impl Spread {
    /// Of the same column of several runs; rows beyond the shortest run are left out.
    pub fn of(runs: &[&[f64]]) -> Self {
        let mut student = Student::default();
        let rows = runs.iter().map(|r| r.len()).min().unwrap_or(0);
        let mut spread = Self { mean: Vec::new(), deviation: Vec::new(), half: Vec::new() };
        for row in 0..rows {
            let statistics = Statistics::of(runs.iter().map(|r| r[row]), &mut student);
            spread.mean.push(statistics.mean);
            spread.deviation.push(statistics.deviation);
            spread.half.push(Estimate::of(&statistics).uncertainty);
        }
        spread
    }

    /// Lower ends of the intervals.
    pub fn low(&self) -> Vec<f64> {
        self.mean.iter().zip(&self.half).map(|(m, h)| m - h).collect()
    }

    /// Upper ends of the intervals.
    pub fn high(&self) -> Vec<f64> {
        self.mean.iter().zip(&self.half).map(|(m, h)| m + h).collect()
    }

    /// Columns `NAME_mean`, `NAME_deviation` and `NAME_half_interval`, the unit at the end of each name.
    pub fn columns(&self, name: &str, unit: &'static str, meaning: &str) -> Vec<Column> {
        let suffix = match unit {
            "" => "",
            "m" => "_m",
            "m/s" => "_m_per_s",
            "veh/s" => "_veh_per_s",
            "%" => "_percent",
            other => unreachable!("no suffix for {other}"),
        };
        [
            ("mean", "mean over the runs", &self.mean),
            ("deviation", "standard deviation over the runs", &self.deviation),
            ("half_interval", "half-width of the 95 % confidence interval of the mean", &self.half),
        ]
        .map(|(which, words, values)| {
            Column::float(
                format!("{name}_{which}{suffix}"),
                unit,
                format!("{meaning}: {words}"),
                values.clone(),
            )
        })
        .into()
    }
}

/// 1 if something holds and 0 if not, for claims about what happens.
pub fn indicator(holds: bool) -> Estimate {
    Estimate::exact(f64::from(u8::from(holds)))
}
