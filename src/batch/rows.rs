//! A table of all runs: one row for each run, or the rows that the measurement gives for each.

use super::plan::Plan;
use super::run::Run;
use crate::format::table::{Column, Table, Values};
use crate::scenario::parameters::Parameter;
use std::collections::BTreeMap;

/// Columns that every table of runs has. A measurement with a column of one of these names repeats it, so it is left out.
pub(super) const OF_EVERY_RUN: [&str; 2] = ["outcome", "end_time_s"];

impl Plan {
    /// The rows of these runs, in order of number: varied values, seed, outcome and end of the run, then what was
    /// measured.
    pub fn table(&self, runs: &BTreeMap<u64, Run>) -> Table {
        // Each run as often as it has rows.
        let of_rows = || runs.values().flat_map(|run| std::iter::repeat_n(run, rows(run)));
        let numbers = of_rows().map(|run| run.number + 1).collect();
        let cells: Vec<u64> = of_rows().map(|run| self.cell(run.number)).collect();
        let seeds = of_rows().map(|run| self.seed(run.number)).collect();
        let outcomes =
            of_rows().map(|run| if run.collided { "collision" } else { "end" }.to_owned()).collect();
        let ends = of_rows().map(|run| run.end).collect();

        let mut columns = vec![Column::whole("run", "", "number of the run, from 1", numbers)];
        columns.extend(self.varied_columns(&cells));
        columns.push(Column::whole("seed", "", "base seed + number of the run in its cell, from 0", seeds));
        let [outcome, end] = OF_EVERY_RUN;
        columns.push(Column::text(outcome, "collision, or the end asked for", outcomes));
        columns.push(Column::float(end, "s", "time at which the run ended", ends));
        for (k, column) in self.columns().into_iter().enumerate() {
            if OF_EVERY_RUN.contains(&column.name.as_str()) {
                continue;
            }
            let mut values = column.values;
            for run in runs.values() {
                append(&mut values, &run.values[k]);
            }
            columns.push(Column { name: self.distinct(column.name), values, ..column });
        }
        Table::new(columns)
    }

    /// The columns of the varied parameters, with a value for each of these cells.
    pub(super) fn varied_columns(&self, cells: &[u64]) -> Vec<Column> {
        let of_cells: Vec<Vec<f64>> = cells.iter().map(|&cell| self.cell_values(cell)).collect();
        let column = |(k, parameter): (usize, &Parameter)| {
            let values = of_cells.iter().map(|values| values[k]);
            let name = column_name(parameter);
            if parameter.kind.is_whole() {
                Column::whole(name, parameter.unit, parameter.meaning, values.map(|x| x as u64).collect())
            } else {
                Column::float(name, parameter.unit, parameter.meaning, values.collect())
            }
        };
        self.vary().iter().map(super::ParameterValues::parameter).enumerate().map(column).collect()
    }

    /// The name of a measured column; one that a varied parameter has, too, gets `_measured` at its end.
    pub(super) fn distinct(&self, name: String) -> String {
        if self.vary().iter().any(|v| column_name(v.parameter()) == name) { name + "_measured" } else { name }
    }
}

/// `reaction_time_s`, with the unit at its end as in every table.
fn column_name(parameter: &Parameter) -> String {
    let unit = match parameter.unit {
        "" => String::new(),
        "1/s" => "_per_s".to_owned(),
        unit => format!("_{}", unit.replace('/', "_per_")),
    };
    format!("{}{unit}", parameter.name)
}

/// How many rows a run has.
pub(super) fn rows(run: &Run) -> usize {
    run.values.first().map_or(0, |values| match values {
        Values::Float(v) => v.len(),
        Values::Whole(v) => v.len(),
        Values::Text(v) => v.len(),
    })
}

fn append(all: &mut Values, more: &Values) {
    match (all, more) {
        (Values::Float(all), Values::Float(more)) => all.extend(more),
        (Values::Whole(all), Values::Whole(more)) => all.extend(more),
        (Values::Text(all), Values::Text(more)) => all.extend_from_slice(more),
        _ => unreachable!("the columns of a plan are the same in every run"),
    }
}
