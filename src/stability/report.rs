//! What the linear theory says of the least stable lane of a scenario, or of traffic as it is now: what `ringroad stability`
//! prints, and what the page's sentence on stability is made from.
//!
//! ```
//! use ringroad::scenario::Scenario;
//! use ringroad::stability::report::Report;
//!
//! let mut scenario = Scenario::default();
//! scenario.driver.reaction_time = 0.75;
//! let report = Report::of(&scenario);
//! assert!(!report.stable);
//! assert!((report.critical_reaction_time_s.unwrap() - 0.683_869).abs() < 1e-6);
//! assert_eq!(report.wave.unwrap().mode, 8);
//! assert!(report.sentence().starts_with("Reaction time 0.75 s, above the critical 0.6789 s: unstable."));
//! ```

use super::driver_classes::DriverClasses;
use super::homogeneous::{Mode, Time};
use super::lane::{Lane, LaneClasses, lanes_of};
use crate::scenario::Scenario;
use serde::Serialize;
use std::f64::consts::{LN_2, PI};
use std::fmt::Write as _;

/// What linear theory says of the least stable lane.
///
/// What does not exist is `None` (`null` in JSON): an infinite critical reaction time, the growth rate of a vehicle alone,
/// the fastest mode of a jam. "Discrete" is the simulation's difference equation at the delay in force, m·dt;
/// the rest is continuous time at the drivers' reaction times.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
#[allow(clippy::struct_excessive_bools)] // answers to separate questions, read by name in JSON
pub struct Report {
    /// The least stable lane, from 1; all below is of that lane.
    pub lane: usize,
    /// Vehicles in it.
    pub vehicles: usize,
    /// Whether all its drivers are the same to the theory.
    #[serde(rename = "equal_drivers")]
    pub homogeneous: bool,
    /// v∞, m/s.
    pub equilibrium_speed_m_per_s: f64,
    /// L/N, m.
    pub mean_headway_m: f64,
    /// c, 1/s; of heterogeneous drivers the harmonic mean.
    pub slope_per_s: f64,
    /// Whether all vehicles stand in equilibrium, so that nothing grows whatever the delay.
    pub jammed: bool,
    /// Δ, s; of heterogeneous drivers the mean.
    pub reaction_time_s: f64,
    /// m·dt, s; of heterogeneous drivers the mean.
    pub delay_in_force_s: f64,
    /// Below it the lane is stable in continuous time, s. Of heterogeneous drivers: the mean reaction time when all
    /// change in proportion.
    pub critical_reaction_time_s: Option<f64>,
    /// The same for the simulation with its steps, s; 0 where no delay is stable.
    pub critical_reaction_time_discrete_s: Option<f64>,
    /// Critical for infinitely long waves, s: Newell's limit, 1/(2c) of homogeneous drivers.
    pub newell_limit_s: Option<f64>,
    /// By what factor all reaction times may grow before the lane is unstable (below 1: must shrink).
    pub critical_scale: Option<f64>,
    /// The same for the delays in force.
    pub critical_scale_discrete: Option<f64>,
    /// The largest real part, 1/s.
    pub max_growth_rate_per_s: Option<f64>,
    /// The largest growth rate ln|z|/dt of the simulation, 1/s.
    pub max_growth_rate_discrete_per_s: Option<f64>,
    /// The mode that has it in continuous time.
    pub fastest_mode: Option<usize>,
    /// The mode that has it in the simulation.
    pub fastest_mode_discrete: Option<usize>,
    /// Whether no disturbance grows in the simulation at the delay in force.
    pub stable: bool,
    /// Whether none grows in continuous time.
    pub stable_continuous: bool,
    /// The fastest wave of the simulation.
    pub wave: Option<Wave>,
    /// Whether the roots that were followed are all those with Re s > 0, by the argument principle. `None` for homogeneous
    /// drivers, whose roots are known in closed form, and where the roots were not counted.
    pub all_roots_found: Option<bool>,
}

/// A mode as a wave on the road.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Wave {
    /// q, the number of waves on the ring.
    pub mode: usize,
    /// Growth rate σ, 1/s.
    pub growth_rate_per_s: f64,
    /// Wavelength on the road, L/q, m.
    pub wavelength_m: f64,
    /// Wavelength in vehicles, N/q.
    pub wavelength_vehicles: f64,
    /// Speed along the road, m/s; upstream where negative.
    pub speed_m_per_s: f64,
    /// Speed relative to the vehicles, m/s; upstream where negative.
    pub speed_relative_to_vehicles_m_per_s: f64,
    /// Time in which its amplitude doubles, s; `None` where it does not grow.
    pub doubling_time_s: Option<f64>,
    /// Time in which its amplitude halves, s; `None` where it does not fade.
    pub halving_time_s: Option<f64>,
}

impl Wave {
    /// The wave of a mode of `vehicles` vehicles on `length` metres with the equilibrium speed `speed` (m/s):
    /// x_j ∝ e^{i(2πqj/N + ωt)} passes N/q vehicles upstream in 2π/ω.
    pub fn new(mode: Mode, vehicles: usize, length: f64, speed: f64) -> Self {
        let (q, rate) = (mode.mode as f64, mode.root.re);
        let relative = -mode.root.im / (2.0 * PI) * length / q;
        Self {
            mode: mode.mode,
            growth_rate_per_s: rate,
            wavelength_m: length / q,
            wavelength_vehicles: vehicles as f64 / q,
            speed_m_per_s: speed + relative,
            speed_relative_to_vehicles_m_per_s: relative,
            doubling_time_s: (rate > 0.0).then(|| LN_2 / rate),
            halving_time_s: (rate < 0.0).then(|| -LN_2 / rate),
        }
    }
}

/// The growth of one lane in one time.
struct Growth {
    fastest: Option<Mode>,
    stable: bool,
    all_found: Option<bool>,
}

impl Growth {
    fn of(classes: &DriverClasses, time: Time) -> Self {
        if let Some((ring, delay)) = classes.homogeneous() {
            // By the closed form: at the threshold rounding decides the sign of the root.
            let stable = delay < ring.critical(time);
            return Self { fastest: ring.fastest(delay, time), stable, all_found: None };
        }
        let followed = classes.followed(time);
        let stable = followed.unstable == 0 && followed.counted.is_none_or(|count| count == 0);
        let all_found = followed.counted.map(|count| count == followed.unstable);
        Self { fastest: followed.fastest(), stable, all_found }
    }
}

/// Whether no disturbance grows.
pub(super) fn is_stable(classes: &DriverClasses, time: Time) -> bool {
    Growth::of(classes, time).stable
}

/// Four significant digits, or whole numbers where these are longer.
fn shown(x: f64) -> String {
    let magnitude = if x == 0.0 { 0.0 } else { libm::log10(x.abs()).floor() };
    let decimals = (3.0 - magnitude).clamp(0.0, 9.0) as usize;
    let text = format!("{x:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

impl Report {
    /// The report in one or two English sentences.
    pub fn sentence(&self) -> String {
        let n = self.vehicles;
        if n < 2 {
            return "One vehicle alone has no waves, so every reaction time is stable.".into();
        }
        if self.jammed {
            return "A jam: all vehicles stand, so nothing grows, whatever the reaction time.".into();
        }
        let delay = shown(self.delay_in_force_s);
        let (whose, mean) =
            if self.homogeneous { ("Reaction time", "") } else { ("Mean reaction time", " in the mean") };
        let side = match self.critical_reaction_time_discrete_s {
            Some(critical) if critical <= 0.0 => {
                "the steps are so long that no reaction time is stable".to_owned()
            }
            Some(critical) => {
                let side = if self.stable { "below" } else { "above" };
                format!("{side} the critical {} s{mean}", shown(critical))
            }
            None => "and no reaction time is critical".to_owned(),
        };
        let stability = if self.stable { "stable" } else { "unstable" };
        let mut text = format!("{whose} {delay} s, {side}: {stability}.");
        if let Some(wave) = self.wave {
            let waves = if wave.mode == 1 { "wave" } else { "waves" };
            let (what, how, time) = match (wave.doubling_time_s, wave.halving_time_s) {
                (Some(time), _) => ("Fastest", "doubling", time),
                (None, Some(time)) => ("Slowest to fade", "halving", time),
                (None, None) => return text,
            };
            let _ =
                write!(text, " {what}: {} {waves} on the ring, {how} every {} s.", wave.mode, shown(time));
        }
        text
    }

    /// The report on a scenario at its start; the actions on the way are not considered.
    pub fn of(scenario: &Scenario) -> Self {
        Self::of_lanes(&lanes_of(scenario), scenario.length, scenario.time_step)
    }

    /// The report on lanes of `length` metres in steps of `time_step` seconds, of which one at least holds a vehicle.
    ///
    /// # Panics
    /// If all lanes are empty.
    pub fn of_lanes(lanes: &[Lane], length: f64, time_step: f64) -> Self {
        let time = Time::Steps(time_step);
        let mut least: Option<(usize, LaneClasses, Growth)> = None;
        for (k, lane) in lanes.iter().enumerate().filter(|(_, lane)| !lane.drivers.is_empty()) {
            if lanes[..k].contains(lane) {
                continue;
            }
            let classes = lane.classes(length, time_step);
            let growth = Growth::of(&classes.in_steps, time);
            let rate = |g: &Growth| g.fastest.map_or(f64::NEG_INFINITY, |m| m.root.re);
            if least.as_ref().is_none_or(|(_, _, least)| rate(&growth) > rate(least)) {
                least = Some((k, classes, growth));
            }
        }
        let (place, classes, discrete) = least.expect("a vehicle in some lane");
        Self::of_lane(place, &classes, &discrete, length, time)
    }

    fn of_lane(place: usize, lane: &LaneClasses, discrete: &Growth, length: f64, time: Time) -> Self {
        let LaneClasses { continuous: classes, in_steps, equilibrium } = lane;
        let n = classes.vehicles();
        let speed = equilibrium.speed;
        let continuous = Growth::of(classes, Time::Continuous);
        let (critical, critical_discrete) = (classes.critical(Time::Continuous), in_steps.critical(time));
        let scale = |critical: f64, mean: f64| if mean > 0.0 { finite(critical / mean) } else { None };
        let rate = |mode: Option<Mode>| match mode {
            Some(mode) => finite(mode.root.re),
            // In the jam every root is 0; a vehicle alone has none.
            None => (n > 1).then_some(0.0),
        };
        Self {
            lane: place + 1,
            vehicles: n,
            homogeneous: classes.homogeneous().is_some(),
            equilibrium_speed_m_per_s: speed,
            mean_headway_m: length / n as f64,
            slope_per_s: classes.mean_slope(),
            jammed: classes.is_jammed(),
            reaction_time_s: classes.mean_delay(),
            delay_in_force_s: in_steps.mean_delay(),
            critical_reaction_time_s: finite(critical),
            critical_reaction_time_discrete_s: finite(critical_discrete),
            newell_limit_s: finite(classes.newell_limit()),
            critical_scale: scale(critical, classes.mean_delay()),
            critical_scale_discrete: scale(critical_discrete, in_steps.mean_delay()),
            max_growth_rate_per_s: rate(continuous.fastest),
            max_growth_rate_discrete_per_s: rate(discrete.fastest),
            fastest_mode: continuous.fastest.map(|m| m.mode),
            fastest_mode_discrete: discrete.fastest.map(|m| m.mode),
            stable: discrete.stable,
            stable_continuous: continuous.stable,
            wave: discrete.fastest.map(|mode| Wave::new(mode, n, length, speed)),
            all_roots_found: match (discrete.all_found, continuous.all_found) {
                (Some(a), Some(b)) => Some(a && b),
                _ => None,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Start;

    fn scenario(reaction_time: f64) -> Scenario {
        let mut scenario = Scenario::default();
        scenario.driver.reaction_time = reaction_time;
        scenario
    }

    #[test]
    fn the_default_ring_on_both_sides_of_the_threshold() {
        let stable = Report::of(&scenario(0.67));
        let unstable = Report::of(&scenario(0.68));
        assert!(stable.stable && !unstable.stable && unstable.stable_continuous);
        assert!((stable.critical_reaction_time_s.unwrap() - 0.683_869).abs() < 5e-7);
        assert!((stable.critical_reaction_time_discrete_s.unwrap() - 0.678_869).abs() < 5e-7);
        assert!(stable.wave.unwrap().halving_time_s.is_some());
        assert!(unstable.wave.unwrap().doubling_time_s.is_some());
    }

    /// Long waves run at the slope of the fundamental diagram: dq/dρ = v − h·v′(h).
    #[test]
    fn long_waves_are_kinematic_waves() {
        let mut scenario = scenario(0.1);
        (scenario.vehicles, scenario.length) = (2000, 40_000.0);
        let report = Report::of(&scenario);
        let wave = report.wave.unwrap();
        let driver = scenario.driver;
        assert_eq!(wave.mode, 1);
        assert!((wave.speed_m_per_s - (driver.speed(20.0) - 20.0 * driver.slope(20.0))).abs() < 1e-4);
        assert!((wave.speed_relative_to_vehicles_m_per_s + 20.0 * driver.slope(20.0)).abs() < 1e-4);
    }

    #[test]
    fn what_does_not_exist_is_null() {
        let json = |scenario: &Scenario| serde_json::to_value(Report::of(scenario)).unwrap();
        let alone = json(&Scenario { vehicles: 1, ..scenario(0.5) });
        for field in [
            "critical_reaction_time_s",
            "critical_reaction_time_discrete_s",
            "max_growth_rate_per_s",
            "fastest_mode",
        ] {
            assert!(alone[field].is_null(), "{field}");
        }
        assert_eq!(alone["stable"], true);
        let jam = json(&Scenario { vehicles: 150, ..scenario(5.0) });
        assert!(jam["critical_reaction_time_s"].is_null() && jam["fastest_mode_discrete"].is_null());
        assert_eq!((&jam["stable"], &jam["max_growth_rate_per_s"]), (&true.into(), &0.0.into()));
    }

    #[test]
    fn the_sentence_says_side_and_fastest_wave() {
        let sentence = |reaction_time| Report::of(&scenario(reaction_time)).sentence();
        let doubling = Report::of(&scenario(0.75)).wave.unwrap().doubling_time_s.unwrap();
        assert_eq!(
            sentence(0.75),
            format!(
                "Reaction time 0.75 s, above the critical 0.6789 s: unstable. Fastest: 8 waves on the ring, \
                 doubling every {doubling:.2} s."
            )
        );
        assert!(sentence(0.5).starts_with(
            "Reaction time 0.5 s, below the critical 0.6789 s: stable. Slowest to fade: 1 wave"
        ));
        assert!(Report::of(&Scenario { vehicles: 150, ..scenario(2.0) }).sentence().starts_with("A jam"));
        assert_eq!(shown(12345.6), "12346");
        assert_eq!((shown(0.0), shown(0.001_234_56)), ("0".to_owned(), "0.001235".to_owned()));
    }

    #[test]
    fn the_report_is_on_the_least_stable_lane() {
        let mut scenario = Scenario { vehicles: 101, lanes: 3, ..scenario(0.9) };
        scenario.overrides = vec!["36-68:reaction-time=0.95".parse().unwrap()];
        let report = Report::of(&scenario);
        assert_eq!((report.lane, report.vehicles), (2, 33));
        scenario.start = Start::OneLane(2);
        assert_eq!(Report::of(&scenario).vehicles, 101);
    }

    #[test]
    fn heterogeneous_drivers_have_a_critical_scale() {
        let mut scenario = scenario(0.75);
        scenario.overrides = vec!["1-4:reaction-time=0".parse().unwrap()];
        let report = Report::of(&scenario);
        assert!(!report.stable && !report.homogeneous);
        assert_eq!(report.all_roots_found, Some(true));
        let scale = report.critical_scale_discrete.unwrap();
        assert!((0.95..1.0).contains(&scale), "{scale}");
        scenario.overrides = vec!["11-15:reaction-time=0".parse().unwrap()];
        assert!(Report::of(&scenario).stable);
    }

    /// While delays still grow towards the reaction time, the report is on the delays in force.
    #[test]
    fn running_traffic_is_reported_at_its_delay_in_force() {
        let driver = scenario(0.9).driver;
        let live = |steps| Lane { drivers: vec![driver; 50], delay_steps: vec![steps; 50] };
        assert!(Report::of_lanes(&[live(60)], 1000.0, 0.01).stable);
        assert!(!Report::of_lanes(&[live(60), live(70)], 1000.0, 0.01).stable);
        assert_eq!(Report::of_lanes(&[live(60), live(70)], 1000.0, 0.01).lane, 2);
    }
}
