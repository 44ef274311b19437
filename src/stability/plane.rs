//! The stability plane: critical reaction times against the number of vehicles, and the map of the largest growth rate
//! over number and reaction time, for equal drivers (the scenario's default one).

use super::equal::{EqualRing, Time};
use super::report::Report;
use crate::error::Invalid;
use crate::parameters::Parameter;
use crate::scenario::Scenario;
use crate::table::{Column, Table};
use serde::Serialize;

/// The lanes of equal drivers into which `vehicles` are dealt; lanes with as many vehicles count once.
fn lanes(scenario: &Scenario, vehicles: usize) -> Vec<EqualRing> {
    let mut counts =
        Scenario { vehicles, exceptions: Vec::new(), actions: Vec::new(), ..*scenario }.vehicles_per_lane();
    counts.retain(|&count| count > 0);
    counts.dedup();
    let ring = |n: usize| EqualRing { vehicles: n, slope: scenario.driver.slope(scenario.length / n as f64) };
    counts.into_iter().map(ring).collect()
}

/// Critical reaction times over the number of vehicles (all lanes together; of the least stable lane). What is
/// infinite is `None`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curves {
    /// N.
    pub vehicles: Vec<usize>,
    /// τ(N), continuous time, s.
    pub continuous_s: Vec<Option<f64>>,
    /// τ_dt(N), the scenario's steps, s.
    pub discrete_s: Vec<Option<f64>>,
    /// Newell's limit 1/(2c), s.
    pub newell_s: Vec<Option<f64>>,
}

/// Numbers of vehicles at which a picture of the plane asks for its curves: from 2 to the jam, or to the scenario's
/// own number where that is larger, evenly spread, not many more than `points`. The last is always among them.
pub fn numbers(scenario: &Scenario, points: usize) -> Vec<usize> {
    let room = scenario.length * scenario.lanes as f64 / scenario.driver.min_headway;
    let last = (room as usize).max(scenario.vehicles).max(2);
    let stride = last.div_ceil(points.max(1));
    let mut numbers: Vec<_> = (2..last).step_by(stride).collect();
    numbers.push(last);
    numbers
}

/// The curves of the plane.
pub fn curves(scenario: &Scenario, vehicles: impl IntoIterator<Item = usize>) -> Curves {
    let vehicles: Vec<_> = vehicles.into_iter().collect();
    let least = |n: usize, of: &dyn Fn(&EqualRing) -> f64| {
        let smallest = lanes(scenario, n).iter().map(of).fold(f64::INFINITY, f64::min);
        smallest.is_finite().then_some(smallest)
    };
    let column = |of: &dyn Fn(&EqualRing) -> f64| vehicles.iter().map(|&n| least(n, of)).collect();
    let time = Time::Steps(scenario.time_step);
    let continuous_s = column(&|ring| ring.critical(Time::Continuous));
    let discrete_s = column(&|ring| ring.critical(time));
    let newell_s = column(&EqualRing::newell_limit);
    Curves { vehicles, continuous_s, discrete_s, newell_s }
}

/// Critical reaction times (s) of all modes 1 … ⌊n/2⌋ of a lane of n vehicles: continuous time and steps.
pub fn critical_of_modes(scenario: &Scenario, vehicles: usize) -> Vec<(f64, f64)> {
    let slope = scenario.driver.slope(scenario.length / vehicles as f64);
    let ring = EqualRing { vehicles, slope };
    let time = Time::Steps(scenario.time_step);
    ring.modes().map(|q| (ring.critical_of(q, Time::Continuous), ring.critical_of(q, time))).collect()
}

/// One row of the map: the largest growth rate (1/s) with `vehicles` vehicles at each reaction time (s), a number
/// for every one: 0 in the jam, NaN where no lane has modes. In steps, delays between whole steps are what
/// z^m means for a real m; the map has no stairs.
pub fn growth_rates(scenario: &Scenario, vehicles: usize, reaction_times: &[f64], time: Time) -> Vec<f64> {
    let lanes = lanes(scenario, vehicles);
    let rate = |ring: &EqualRing, delay: f64| match ring.fastest(delay, time) {
        Some(mode) => mode.root.re,
        None if ring.vehicles > 1 => 0.0,
        None => f64::NAN,
    };
    let largest = |delay: f64| lanes.iter().map(|ring| rate(ring, delay)).fold(f64::NAN, f64::max);
    reaction_times.iter().map(|&delay| largest(delay)).collect()
}

/// A parameter and the values that a sweep gives it: `vehicles=2:133`, `reaction-time=0:1.5:0.05`.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// The parameter.
    pub parameter: &'static Parameter,
    /// Its values.
    pub values: Vec<f64>,
}

/// More rows than anyone reads.
const MOST_VALUES: f64 = 100_000.0;

impl std::str::FromStr for Sweep {
    type Err = Invalid;
    fn from_str(text: &str) -> Result<Self, Invalid> {
        let form = || {
            Invalid::new(
                "sweep",
                crate::parameters::quoted(text),
                "PARAMETER=FROM:TO or PARAMETER=FROM:TO:STEP, such as vehicles=2:133",
            )
        };
        let (name, range) = text.split_once('=').ok_or_else(form)?;
        let parameter = Parameter::named(name.trim()).ok_or_else(form)?;
        let parts: Vec<_> = range.split(':').collect();
        let (from, to, step) = match parts[..] {
            [from, to] => (from, to, None),
            [from, to, step] => (from, to, Some(step)),
            _ => return Err(form()),
        };
        let (from, to) = (parameter.parse(from)?, parameter.parse(to)?);
        let step = match step {
            Some(step) => step.trim().parse().map_err(|_| form())?,
            None if parameter.whole => 1.0,
            None => (to - from) / 100.0,
        };
        if from == to {
            return Ok(Self { parameter, values: vec![from] });
        }
        let count = ((to - from) / step + 1e-9).floor();
        if !(0.0..MOST_VALUES).contains(&count) || (parameter.whole && step != f64::trunc(step)) {
            let allowed = format!("a step that leads from {from} to {to} in at most {MOST_VALUES} values");
            return Err(Invalid::new("sweep step", step, allowed));
        }
        // Steps such as 0.05 add up to 0.15000000000000002; what is meant is the nearest short decimal.
        let value = |k: usize| ((from + k as f64 * step) * 1e9).round() / 1e9;
        Ok(Self { parameter, values: (0..=count as usize).map(value).collect() })
    }
}

/// What the theory says of the scenario for every value of a parameter, as a table. Each of them must be a scenario that
/// can be run.
pub fn sweep(scenario: &Scenario, sweep: &Sweep) -> Result<Table, Invalid> {
    let mut reports = Vec::with_capacity(sweep.values.len());
    for &value in &sweep.values {
        let mut scenario = scenario.clone();
        sweep.parameter.set(&mut scenario, value)?;
        scenario.validate().map_err(|e| e.within(format!("{}={value}", sweep.parameter.hyphenated())))?;
        reports.push(Report::of(&scenario));
    }
    let column = |of: &dyn Fn(&Report) -> Option<f64>| -> Vec<f64> {
        reports.iter().map(|r| of(r).unwrap_or(f64::NAN)).collect()
    };
    let parameter = sweep.parameter;
    let number = |q: Option<usize>| q.map(|q| q as f64);
    Ok(Table::new(vec![
        Column::float(parameter.name, parameter.unit, parameter.meaning, sweep.values.clone()),
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

    #[test]
    fn curves_and_sweep_say_the_same() {
        let scenario = Scenario::default();
        let curves = curves(&scenario, 2..=133);
        let table = sweep(&scenario, &"vehicles=2:133".parse().unwrap()).unwrap();
        let continuous = table.floats("critical_reaction_time_s").unwrap();
        let discrete = table.floats("critical_reaction_time_discrete_s").unwrap();
        assert_eq!(table.rows(), 132);
        for (k, &n) in curves.vehicles.iter().enumerate() {
            assert_eq!(curves.continuous_s[k], Some(continuous[k]));
            assert_eq!(curves.discrete_s[k], Some(discrete[k]));
            let modes = critical_of_modes(&scenario, n);
            assert_eq!(modes.len(), n / 2);
            assert_eq!(modes[0], (continuous[k], discrete[k]));
            assert!(modes.windows(2).all(|w| w[0].0 < w[1].0 && w[0].1 < w[1].1));
        }
        // τ(N) falls with N, to Newell's 0.5 s at the jam.
        assert!(continuous.windows(2).all(|w| w[1] < w[0]));
        assert!((continuous[131] - 0.500_282).abs() < 5e-7);
    }

    #[test]
    fn the_map_changes_sign_on_the_curve() {
        let scenario = Scenario::default();
        for n in [2, 10, 50, 133] {
            let critical = curves(&scenario, n..=n);
            for (time, tau) in
                [(Time::Continuous, critical.continuous_s[0]), (Time::Steps(0.01), critical.discrete_s[0])]
            {
                let tau = tau.unwrap();
                let row = growth_rates(&scenario, n, &[tau - 1e-6, tau + 1e-6], time);
                assert!(row[0] < 0.0 && row[1] > 0.0, "{n} {time:?} {row:?}");
            }
        }
        assert_eq!(growth_rates(&scenario, 140, &[0.0, 5.0], Time::Continuous), [0.0, 0.0]);
        assert!(growth_rates(&scenario, 1, &[1.0], Time::Continuous)[0].is_nan());
    }

    #[test]
    fn two_lanes_have_the_threshold_of_the_fuller() {
        let scenario = Scenario { lanes: 2, ..Scenario::default() };
        let one = curves(&Scenario::default(), 51..=51);
        assert_eq!(curves(&scenario, 101..=101).continuous_s, one.continuous_s);
    }

    #[test]
    fn pictures_reach_from_two_vehicles_to_the_jam() {
        let scenario = Scenario::default();
        assert_eq!(numbers(&scenario, 400), (2..=133).collect::<Vec<_>>());
        assert_eq!(numbers(&Scenario { vehicles: 150, ..scenario.clone() }, 400).last(), Some(&150));
        let road = Scenario { length: 1e5, lanes: 2, ..scenario };
        let spread = numbers(&road, 400);
        assert!(spread.len() <= 401 && spread.last() == Some(&26_666), "{}", spread.len());
        assert!(spread.windows(2).all(|w| w[0] < w[1]));
    }

    #[test]
    fn sweeps_are_read_and_refused() {
        let values = |text: &str| text.parse::<Sweep>().unwrap().values;
        assert_eq!(values("vehicles=2:5"), [2.0, 3.0, 4.0, 5.0]);
        assert_eq!(values("reaction-time=0:0.2:0.05"), [0.0, 0.05, 0.1, 0.15, 0.2]);
        assert_eq!(values("sensitivity=1:2").len(), 101);
        for bad in [
            "vehicles",
            "cars=1:2",
            "vehicles=1",
            "vehicles=0:5",
            "vehicles=2:5:0",
            "vehicles=5:2",
            "vehicles=2:5:0.5",
            "reaction-time=0:1:x",
        ] {
            assert!(bad.parse::<Sweep>().is_err(), "{bad}");
        }
        assert!(
            sweep(&Scenario::default(), &"vehicles=190:210".parse().unwrap())
                .unwrap_err()
                .to_string()
                .contains("vehicles=200")
        );
    }
}
