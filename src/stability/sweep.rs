//! What theory says of a scenario while one of its parameters is varied, as a table.
//!
//! ```
//! use ringroad::Scenario;
//! use ringroad::scenario::parameter_values::ParameterValues;
//! use ringroad::stability::sweep::sweep;
//!
//! let vehicles = ParameterValues::sweep("vehicles=25:100:25").unwrap();
//! let table = sweep(&Scenario::default(), &vehicles).unwrap();
//! let critical = table.floats("critical_reaction_time_s").unwrap();
//! assert!((critical[1] - 0.683869).abs() < 1e-6); // s, 50 vehicles
//! ```

use super::report::Report;
use crate::error::Error;
use crate::format::table::{Column, Table};
use crate::scenario::Scenario;
use crate::scenario::parameter_values::ParameterValues;

/// What theory says of the least stable lane of the scenario for every value of a parameter, a row a value. Every value must
/// give a scenario that can be run; the first one that does not is refused by name.
pub fn sweep(scenario: &Scenario, varied: &ParameterValues) -> Result<Table, Error> {
    let parameter = varied.parameter();
    let mut reports = Vec::with_capacity(varied.values().len());
    for &value in varied.values() {
        let mut scenario = scenario.clone();
        scenario.set(parameter, value)?;
        scenario.validate().map_err(|e| e.within(format!("{}={value}", parameter.hyphenated())))?;
        reports.push(Report::of(&scenario));
    }
    let column = |of: &dyn Fn(&Report) -> Option<f64>| -> Vec<f64> {
        reports.iter().map(|r| of(r).unwrap_or(f64::NAN)).collect()
    };
    let number = |q: Option<usize>| q.map(|q| q as f64);
    Ok(Table::new(vec![
        Column::float(parameter.name, parameter.unit, parameter.meaning, varied.values().to_vec()),
        Column::float(
            "critical_reaction_time_s",
            "s",
            "largest stable reaction time, continuous time; none where everything is stable",
            column(&|r| r.critical_reaction_time_s),
        ),
        Column::float(
            "critical_reaction_time_discrete_s",
            "s",
            "the same for the simulation with its steps",
            column(&|r| r.critical_reaction_time_discrete_s),
        ),
        Column::float(
            "newell_limit_s",
            "s",
            "1/(2c), the limit of long waves",
            column(&|r| r.newell_limit_s),
        ),
        Column::float(
            "max_growth_rate_per_s",
            "1/s",
            "largest growth rate at the scenario's reaction time, continuous time",
            column(&|r| r.max_growth_rate_per_s),
        ),
        Column::float(
            "max_growth_rate_discrete_per_s",
            "1/s",
            "the same for the simulation at the delay in force",
            column(&|r| r.max_growth_rate_discrete_per_s),
        ),
        Column::float(
            "fastest_mode",
            "",
            "the mode that grows fastest, continuous time",
            column(&|r| number(r.fastest_mode)),
        ),
        Column::float(
            "fastest_mode_discrete",
            "",
            "the mode that grows fastest in the simulation",
            column(&|r| number(r.fastest_mode_discrete)),
        ),
        Column::text(
            "stable",
            "whether no disturbance grows in the simulation: yes or no",
            reports.iter().map(|r| if r.stable { "yes".into() } else { "no".into() }).collect(),
        ),
    ]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stability::stability_diagram::StabilityDiagram;

    #[test]
    fn curves_and_sweep_say_the_same() {
        let scenario = Scenario::default();
        let plane = StabilityDiagram::of(&scenario);
        let curves = plane.curves(2..=133);
        let table = sweep(&scenario, &ParameterValues::sweep("vehicles=2:133").unwrap()).unwrap();
        let continuous = table.floats("critical_reaction_time_s").unwrap();
        let discrete = table.floats("critical_reaction_time_discrete_s").unwrap();
        assert_eq!(table.rows(), 132);
        for k in 0..132 {
            assert_eq!(curves.continuous_s[k], Some(continuous[k]));
            assert_eq!(curves.discrete_s[k], Some(discrete[k]));
        }
        // τ(N) falls with N, to Newell's 0.5 s at the jam.
        assert!(continuous.windows(2).all(|w| w[1] < w[0]));
        assert!((continuous[131] - 0.500_282).abs() < 5e-7);
    }

    #[test]
    fn a_value_that_cannot_be_run_is_named() {
        let vehicles = ParameterValues::sweep("vehicles=190:210").unwrap();
        let message = sweep(&Scenario::default(), &vehicles).unwrap_err().to_string();
        assert!(message.contains("vehicles=200"), "{message}");
    }
}
