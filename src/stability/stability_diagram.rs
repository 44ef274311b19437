//! The stability diagram of one lane of homogeneous drivers: critical reaction times against the number of vehicles, and
//! the map of the largest growth rate over number and reaction time. And tables of what theory says of a scenario while
//! a parameter is swept.
//!
//! ```
//! use ringroad::scenario::Scenario;
//! use ringroad::stability::homogeneous::Time;
//! use ringroad::stability::stability_diagram::StabilityDiagram;
//!
//! let diagram = StabilityDiagram::of(&Scenario::default());
//! let curves = diagram.curves([25, 50, 140]);
//! assert!(curves.continuous_s[0] > curves.continuous_s[1]); // more vehicles are less stable,
//! assert_eq!(curves.continuous_s[2], None); // up to the jam, where every reaction time is stable
//! let rates = diagram.growth_rates(50, [0.5, 0.75], Time::Continuous);
//! assert!(rates[0] < 0.0 && rates[1] > 0.0);
//! ```

use super::homogeneous::{HomogeneousRing, Time};
use super::report::Report;
use crate::error::{Error, quoted};
use crate::format::table::{Column, Table};
use crate::scenario::Scenario;
use crate::scenario::driver::Driver;
use crate::scenario::parameters::{PARAMETERS, Parameter};
use crate::scenario::value::Kind;

/// The lane of the diagram: any number of homogeneous drivers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StabilityDiagram {
    /// Every driver; the reaction time is not used.
    pub driver: Driver,
    /// L, m.
    pub length: f64,
    /// dt, s.
    pub time_step: f64,
}

/// Critical reaction times over the number of vehicles in the lane. What is infinite is `None`.
#[derive(Clone, Debug, PartialEq)]
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

impl StabilityDiagram {
    /// The diagram of a scenario's default driver.
    pub fn of(scenario: &Scenario) -> Self {
        Self { driver: scenario.driver, length: scenario.length, time_step: scenario.time_step }
    }

    fn ring(&self, vehicles: usize) -> HomogeneousRing {
        HomogeneousRing { vehicles, slope: self.driver.slope(self.length / vehicles as f64) }
    }

    /// Steps or continuous time.
    pub fn time(&self, in_steps: bool) -> Time {
        if in_steps { Time::Steps(self.time_step) } else { Time::Continuous }
    }

    /// The number of vehicles beyond which the lane is a jam.
    pub fn jam(&self) -> f64 {
        self.length / self.driver.min_headway
    }

    /// Numbers of vehicles for the curves of a picture: from 2 to the jam, or to the lane's `own` number where that is larger,
    /// evenly spread, not many more than `points`. The last is always among them.
    pub fn numbers(&self, own: usize, points: usize) -> Vec<usize> {
        let last = (self.jam() as usize).max(own).max(2);
        let stride = last.div_ceil(points.max(1));
        let mut numbers: Vec<_> = (2..last).step_by(stride).collect();
        numbers.push(last);
        numbers
    }

    /// The neutral stability curves, and Newell's limit, at these numbers of vehicles.
    pub fn curves(&self, vehicles: impl IntoIterator<Item = usize>) -> Curves {
        let vehicles: Vec<_> = vehicles.into_iter().collect();
        let column = |of: &dyn Fn(&HomogeneousRing) -> f64| {
            let finite = |&n: &usize| Some(of(&self.ring(n))).filter(|x| x.is_finite());
            vehicles.iter().map(finite).collect()
        };
        let continuous_s = column(&|ring| ring.critical(Time::Continuous));
        let discrete_s = column(&|ring| ring.critical(Time::Steps(self.time_step)));
        let newell_s = column(&HomogeneousRing::newell_limit);
        Curves { vehicles, continuous_s, discrete_s, newell_s }
    }

    /// Critical reaction time (s) of a mode at every number of `vehicles`; infinite in the jam, NaN where there
    /// are too few vehicles for it.
    pub fn critical_of_mode(&self, mode: usize, vehicles: &[usize], time: Time) -> Vec<f64> {
        let critical =
            |&n: &usize| if 2 * mode > n { f64::NAN } else { self.ring(n).critical_of(mode, time) };
        vehicles.iter().map(critical).collect()
    }

    /// One row of the map: the largest growth rate (1/s) with `vehicles` vehicles at each reaction time (s), a number
    /// for every one: 0 in the jam, NaN for a vehicle alone, which has no modes. In steps, delays between whole
    /// steps are those of z^m for a real m, so that the map is smooth.
    pub fn growth_rates(
        &self,
        vehicles: usize,
        reaction_times: impl IntoIterator<Item = f64>,
        time: Time,
    ) -> Vec<f64> {
        let ring = self.ring(vehicles);
        let rate = |delay: f64| match ring.fastest(delay, time) {
            Some(mode) => mode.root.re,
            None if vehicles > 1 => 0.0,
            None => f64::NAN,
        };
        reaction_times.into_iter().map(rate).collect()
    }
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
    type Err = Error;
    fn from_str(text: &str) -> Result<Self, Error> {
        let form = || {
            Error::new(
                "sweep",
                quoted(text),
                "PARAMETER=FROM:TO or PARAMETER=FROM:TO:STEP, such as vehicles=2:133",
            )
        };
        let (name, range) = text.split_once('=').ok_or_else(form)?;
        let parameter = Parameter::named(name.trim()).ok_or_else(|| {
            let names: Vec<_> = PARAMETERS.iter().map(Parameter::hyphenated).collect();
            Error::new("parameter", quoted(name), names.join(", "))
        })?;
        let parts: Vec<_> = range.split(':').collect();
        let (from, to, step) = match parts[..] {
            [from, to] => (from, to, None),
            [from, to, step] => (from, to, Some(step)),
            _ => return Err(form()),
        };
        let number = |text| parameter.parse(text)?.number().ok_or_else(form);
        let (from, to) = (number(from)?, number(to)?);
        let whole = matches!(parameter.kind, Kind::Whole(_));
        let given = step.map(|step| step.trim().parse().map_err(|_| form())).transpose()?;
        if let Some(step) = given.filter(|step| whole && *step != f64::trunc(*step)) {
            let allowed = format!("a whole step: {} is a whole number", parameter.hyphenated());
            return Err(Error::new("step", step, allowed));
        }
        if from == to {
            return Ok(Self { parameter, values: vec![from] });
        }
        let step = given.unwrap_or(if whole { 1.0 } else { (to - from) / 100.0 });
        let count = ((to - from) / step + 1e-9).floor();
        if !(0.0..MOST_VALUES).contains(&count) {
            let most = format!("at most {MOST_VALUES} values");
            return Err(match given {
                Some(step) => {
                    Error::new("step", step, format!("a step that leads from {from} to {to} in {most}"))
                }
                None if count < 0.0 => Error::new(
                    "range",
                    quoted(range),
                    format!("{to}:{from}, or a step downwards: {from}:{to}:-1"),
                ),
                None => {
                    Error::new("range", quoted(range), format!("{most}, or a larger step: {from}:{to}:STEP"))
                }
            });
        }
        // Steps such as 0.05 add up to 0.15000000000000002; what is meant is the nearest short decimal.
        let value = |k: usize| ((from + k as f64 * step) * 1e9).round() / 1e9;
        Ok(Self { parameter, values: (0..=count as usize).map(value).collect() })
    }
}

/// What the theory says of the scenario for every value of a parameter, as a table. Each of them must be a scenario that
/// can be run.
pub fn sweep(scenario: &Scenario, sweep: &Sweep) -> Result<Table, Error> {
    let mut reports = Vec::with_capacity(sweep.values.len());
    for &value in &sweep.values {
        let mut scenario = scenario.clone();
        scenario.set(sweep.parameter, value)?;
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
        let diagram = StabilityDiagram::of(&scenario);
        let curves = diagram.curves(2..=133);
        let table = sweep(&scenario, &"vehicles=2:133".parse().unwrap()).unwrap();
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

    /// The curve of mode 1 is that of the ring; a shorter wave has a larger critical delay.
    #[test]
    fn every_mode_has_a_curve_of_its_own() {
        let diagram = StabilityDiagram { time_step: 0.05, ..StabilityDiagram::of(&Scenario::default()) };
        let numbers = diagram.numbers(150, 400);
        let curves = diagram.curves(numbers.iter().copied());
        for (in_steps, of_the_ring) in [(false, &curves.continuous_s), (true, &curves.discrete_s)] {
            let modes: Vec<_> =
                (1..=75).map(|q| diagram.critical_of_mode(q, &numbers, diagram.time(in_steps))).collect();
            for (k, &n) in numbers.iter().enumerate() {
                assert_eq!(Some(modes[0][k]).filter(|tau| tau.is_finite()), of_the_ring[k]);
                assert_eq!(modes.iter().filter(|mode| !mode[k].is_nan()).count(), n / 2);
                let rising = modes[..n / 2].windows(2).all(|w| w[0][k] < w[1][k]);
                assert!(rising || n > 133, "{n}");
            }
            assert_eq!(modes[20][numbers.len() - 1], f64::INFINITY, "the jam");
        }
    }

    #[test]
    fn the_map_changes_sign_on_the_neutral_curve() {
        let diagram = StabilityDiagram::of(&Scenario::default());
        for n in [2, 10, 50, 133] {
            let critical = diagram.curves(n..=n);
            for (in_steps, tau) in [(false, critical.continuous_s[0]), (true, critical.discrete_s[0])] {
                let tau = tau.unwrap();
                let row = diagram.growth_rates(n, [tau - 1e-6, tau + 1e-6], diagram.time(in_steps));
                assert!(row[0] < 0.0 && row[1] > 0.0, "{n} {in_steps} {row:?}");
            }
        }
        assert_eq!(diagram.growth_rates(140, [0.0, 5.0], Time::Continuous), [0.0, 0.0]);
        assert!(diagram.growth_rates(1, [1.0], Time::Continuous)[0].is_nan());
    }

    #[test]
    fn pictures_reach_from_two_vehicles_to_the_jam() {
        let diagram = StabilityDiagram::of(&Scenario::default());
        assert_eq!(diagram.numbers(50, 400), (2..=133).collect::<Vec<_>>());
        assert_eq!(diagram.numbers(150, 400).last(), Some(&150));
        let road = StabilityDiagram { length: 1e5, ..diagram };
        let spread = road.numbers(50, 400);
        assert!(spread.len() <= 401 && spread.last() == Some(&13_333), "{}", spread.len());
        assert!(spread.windows(2).all(|w| w[0] < w[1]));
    }

    #[test]
    fn sweeps_are_read_and_refused() {
        let values = |text: &str| text.parse::<Sweep>().unwrap().values;
        assert_eq!(values("vehicles=2:5"), [2.0, 3.0, 4.0, 5.0]);
        assert_eq!(values("reaction-time=0:0.2:0.05"), [0.0, 0.05, 0.1, 0.15, 0.2]);
        assert_eq!(values("sensitivity=1:2").len(), 101);
        assert_eq!(values("vehicles=5:2:-1"), [5.0, 4.0, 3.0, 2.0]);
        for (bad, named) in [
            ("vehicles", "PARAMETER=FROM:TO"),
            ("cars=1:2", "parameter: “cars” is not allowed; allowed: vehicles, "),
            ("vehicles=1", "PARAMETER=FROM:TO"),
            ("vehicles=0:5", "from 1 to"),
            ("vehicles=2:5:0", "step: 0 "),
            ("vehicles=2:5:-1", "step: -1 "),
            ("vehicles=5:2", "“5:2” is not allowed; allowed: 2:5, or a step downwards: 5:2:-1"),
            ("vehicles=1:200000", "“1:200000” is not allowed; allowed: at most 100000 values"),
            ("vehicles=2:5:0.5", "step: 0.5 is not allowed; allowed: a whole step"),
            ("vehicles=2:5:NaN", "step: NaN "),
            ("reaction-time=0:1:x", "PARAMETER=FROM:TO:STEP"),
        ] {
            let message = bad.parse::<Sweep>().unwrap_err().to_string();
            assert!(message.contains(named), "{bad}: {message}");
        }
        assert!(
            sweep(&Scenario::default(), &"vehicles=190:210".parse().unwrap())
                .unwrap_err()
                .to_string()
                .contains("vehicles=200")
        );
    }
}
