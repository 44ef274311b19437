//! The verdict on a scenario, or on traffic as it is now: what `ringroad stability` prints and what the page's verdict
//! line speaks from.

use super::discrete_roots::DiscreteRoot;
use super::driver_classes::DriverClasses;
use super::homogeneous::{Mode, Time};
use crate::numerics::complex::{Complex64, norm};
use crate::scenario::Scenario;
use crate::scenario::driver::{Driver, equilibrium};
use serde::Serialize;
use std::f64::consts::{LN_2, PI};
use std::fmt::Write as _;

/// The drivers of a lane and the delay of each that is in force, in steps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lane {
    /// Drivers, in any order.
    pub drivers: Vec<Driver>,
    /// Delay of each, steps.
    pub delay_steps: Vec<u64>,
}

/// What linear theory says of the least stable lane.
///
/// What does not exist is `None` (`null` in JSON): an infinite critical reaction time, the growth rate of a vehicle alone,
/// the fastest mode of a jam. "Discrete" is the simulation's difference equation at the delay in force, m·dt;
/// the rest is continuous time at the drivers' reaction times.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(clippy::struct_excessive_bools)] // answers to separate questions, read by name in JSON
pub struct Report {
    /// The least stable lane, from 1; all below is of that lane.
    pub lane: usize,
    /// Vehicles in it.
    pub vehicles: usize,
    /// Whether all its drivers are the same to the theory.
    pub equal_drivers: bool,
    /// v∞, m/s.
    pub equilibrium_speed_m_per_s: f64,
    /// L/N, m.
    pub mean_headway_m: f64,
    /// c, 1/s; of drivers that differ the harmonic mean.
    pub slope_per_s: f64,
    /// Whether nobody moves in equilibrium, so that nothing grows whatever the delay.
    pub jammed: bool,
    /// Δ, s; of drivers that differ the mean.
    pub reaction_time_s: f64,
    /// m·dt, s; of drivers that differ the mean.
    pub delay_in_force_s: f64,
    /// Below it the lane is stable in continuous time, s. Of drivers that differ: the mean reaction time when all
    /// change in proportion.
    pub critical_reaction_time_s: Option<f64>,
    /// The same for the simulation with its steps, s; 0 where no delay is stable.
    pub critical_reaction_time_discrete_s: Option<f64>,
    /// Critical for infinitely long waves, s: Newell's limit, 1/(2c) of equal drivers.
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
    /// Whether the roots that were followed are all those with Re s > 0, by the argument principle. None of equal
    /// drivers, whose roots are known in closed form, and where it was not counted.
    pub all_roots_found: Option<bool>,
}

/// A mode as a wave on the road.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Wave {
    /// q, the number of waves on the ring.
    pub mode: usize,
    /// 1/s.
    pub growth_rate_per_s: f64,
    /// L/q, m.
    pub wavelength_m: f64,
    /// N/q.
    pub wavelength_vehicles: f64,
    /// Speed along the road, m/s; upstream where negative.
    pub speed_m_per_s: f64,
    /// Speed as the vehicles see it, m/s; upstream where negative.
    pub speed_relative_to_vehicles_m_per_s: f64,
    /// s, where it grows.
    pub doubling_time_s: Option<f64>,
    /// s, where it fades.
    pub halving_time_s: Option<f64>,
}

impl Wave {
    /// The wave of a mode: x_j ∝ e^{i(2πqj/N + ωt)} passes N/q vehicles upstream in 2π/ω.
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

/// The drivers of every lane of a scenario at the start, with the delays that they will have in force.
pub fn lanes_of(scenario: &Scenario) -> Vec<Lane> {
    let drivers = scenario.drivers();
    let mut rest = drivers.as_slice();
    let mut lane = |count: usize| {
        let (own, others) = rest.split_at(count);
        rest = others;
        let delay_steps = own.iter().map(|d| scenario.steps(d.reaction_time)).collect();
        Lane { drivers: own.to_vec(), delay_steps }
    };
    scenario.vehicles_per_lane().into_iter().map(&mut lane).collect()
}

/// The growth of one lane in one time.
struct Growth {
    fastest: Option<Mode>,
    stable: bool,
    all_found: Option<bool>,
}

fn growth(ring: &DriverClasses, time: Time) -> Growth {
    if let Some((equal, delay)) = ring.equal() {
        // By the closed form rather than by the sign of a root that rounding decides at the threshold.
        let stable = delay < equal.critical(time);
        return Growth { fastest: equal.fastest(delay, time), stable, all_found: None };
    }
    let followed = ring.followed(time);
    let stable = followed.unstable == 0 && followed.counted.is_none_or(|count| count == 0);
    let all_found = followed.counted.map(|count| count == followed.unstable);
    Growth { fastest: followed.fastest(), stable, all_found }
}

/// A characteristic root in continuous time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ModeRoot {
    /// q.
    pub mode: usize,
    /// The branch of Lambert's W; of drivers that differ, the branch of equal drivers from which it was followed.
    pub branch: i32,
    /// Re s, 1/s.
    pub real_per_s: f64,
    /// Im s, 1/s.
    pub imaginary_per_s: f64,
    /// What rounding has left of the equation, as a change of the root, relative to max(1, |s|).
    pub residual: f64,
}

/// The `count` leading characteristic roots of every mode of a lane (from 0), mode by mode, by falling real part.
pub fn leading_roots(scenario: &Scenario, lane: usize, count: usize) -> Vec<ModeRoot> {
    let lane = lanes_of(scenario).swap_remove(lane);
    let (ring, _) = rings(&lane, scenario.length, scenario.time_step);
    roots_of_modes(&ring, 1..=ring.vehicles() / 2, count)
}

/// The same of the simulation: its `count` leading growth factors for every mode, by falling modulus.
pub fn leading_factors(scenario: &Scenario, lane: usize, count: usize) -> Vec<DiscreteRoot> {
    let lane = lanes_of(scenario).swap_remove(lane);
    let dt = scenario.time_step;
    let (_, ring) = rings(&lane, scenario.length, dt);
    let modes = 1..=ring.vehicles() / 2;
    if let Some((equal, _)) = ring.equal() {
        let steps = lane.delay_steps[0];
        return modes.flat_map(|q| equal.leading_factors(q, steps, dt, count)).collect();
    }
    let time = Time::Steps(dt);
    let of_mode = |q: usize| {
        let reach = count as i32;
        let mut roots: Vec<DiscreteRoot> = Vec::new();
        // From the middle outwards: z knows no turns beyond a half, so what comes round again is not a new root.
        for k in (0..=reach).flat_map(|k| if k == 0 { vec![0] } else { vec![-k, k] }) {
            let Some(s) = ring.follow(q, k, time).filter(|s| (s.im * dt).abs() < PI + 1e-9) else { continue };
            let root = DiscreteRoot::new(q, k, s, dt, ring.residual(s, time) / norm(s).max(1.0));
            let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
            let known = |r: &DiscreteRoot| {
                near(r.factor_real, root.factor_real) && near(r.factor_imaginary, root.factor_imaginary)
            };
            if !roots.iter().any(known) {
                roots.push(root);
            }
        }
        roots.sort_by(|a, b| b.real_per_s.total_cmp(&a.real_per_s));
        roots.truncate(count);
        roots
    };
    modes.flat_map(of_mode).collect()
}

fn roots_of_modes(ring: &DriverClasses, modes: impl Iterator<Item = usize>, count: usize) -> Vec<ModeRoot> {
    let root = |mode: usize, branch: i32, s: Complex64, residual: f64| ModeRoot {
        mode,
        branch,
        real_per_s: s.re,
        imaginary_per_s: s.im,
        residual,
    };
    if let Some((equal, delay)) = ring.equal() {
        let of_mode = |q: usize| {
            let roots = equal.leading_roots(q, delay, count).into_iter();
            roots.map(move |r| root(q, r.branch, r.value, r.residual))
        };
        return modes.flat_map(of_mode).collect();
    }
    let of_mode = |q: usize| {
        let reach = count as i32;
        let mut roots: Vec<ModeRoot> = Vec::new();
        for k in -reach..=reach {
            let Some(s) = ring.follow(q, k, Time::Continuous) else { continue };
            let residual = ring.residual(s, Time::Continuous) / norm(s).max(1.0);
            roots.insert(roots.partition_point(|r| r.real_per_s >= s.re), root(q, k, s, residual));
        }
        roots.truncate(count);
        roots
    };
    modes.flat_map(of_mode).collect()
}

/// The roots of a lane as a picture shows them.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Roots {
    /// Vehicles in the lane.
    pub vehicles: usize,
    /// Whether all its drivers are the same to the theory, so that its modes are Fourier's.
    pub equal_drivers: bool,
    /// The modes shown.
    pub modes: Vec<usize>,
    /// Growth rate (1/s) of each in the simulation's steps; `None` where the root could not be followed.
    pub growth_per_s: Vec<Option<f64>>,
    /// Angular frequency (1/s) of each in steps.
    pub frequency_per_s: Vec<Option<f64>>,
    /// The next roots of the modes, in continuous time.
    pub next: Vec<ModeRoot>,
}

/// The dominant root of every mode in the steps of the simulation, and the next `others` of each in continuous
/// time; of some `most` modes, evenly spread, where there are more.
pub fn roots_of_lane(lane: &Lane, length: f64, time_step: f64, others: usize, most: usize) -> Roots {
    let (continuous, in_steps) = rings(lane, length, time_step);
    let last = continuous.vehicles() / 2;
    if continuous.is_jammed() || last == 0 {
        return Roots { vehicles: continuous.vehicles(), ..Roots::default() };
    }
    let modes: Vec<usize> = (1..=last).step_by(last.div_ceil(most.max(1))).collect();
    let time = Time::Steps(time_step);
    let dominant: Vec<_> = match in_steps.equal() {
        Some((equal, delay)) => modes.iter().map(|&q| Some(equal.root(q, delay, time))).collect(),
        None => modes.iter().map(|&q| in_steps.follow(q, 0, time)).collect(),
    };
    let mut next = roots_of_modes(&continuous, modes.iter().copied(), others + 1);
    next.retain(|root| root.branch != 0);
    Roots {
        vehicles: continuous.vehicles(),
        equal_drivers: in_steps.equal().is_some(),
        growth_per_s: dominant.iter().map(|s| s.map(|s| s.re)).collect(),
        frequency_per_s: dominant.iter().map(|s| s.map(|s| s.im)).collect(),
        modes,
        next,
    }
}

/// Whether no disturbance grows.
pub(super) fn is_stable(ring: &DriverClasses, time: Time) -> bool {
    growth(ring, time).stable
}

/// A lane as the theory sees it in continuous time, and in steps.
fn rings(lane: &Lane, length: f64, time_step: f64) -> (DriverClasses, DriverClasses) {
    let continuous = DriverClasses::of(&lane.drivers, lane.drivers.iter().map(|d| d.reaction_time), length);
    let delays = lane.delay_steps.iter().map(|&m| m as f64 * time_step);
    (continuous, DriverClasses::of(&lane.drivers, delays, length))
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
    /// The verdict in words.
    pub fn verdict(&self) -> String {
        let n = self.vehicles;
        if n < 2 {
            return "One vehicle alone: there is nobody to be disturbed by, so every reaction time is stable.".into();
        }
        if self.jammed {
            return "A jam: nobody moves, so nothing grows, whatever the reaction time.".into();
        }
        let delay = shown(self.delay_in_force_s);
        let (whose, mean) =
            if self.equal_drivers { ("Reaction time", "") } else { ("Mean reaction time", " in the mean") };
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
        let verdict = if self.stable { "stable" } else { "unstable" };
        let mut text = format!("{whose} {delay} s, {side}: {verdict}.");
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

    /// The report on lanes of `length` metres in steps of `time_step` seconds. At least one lane holds a vehicle.
    ///
    /// # Panics
    /// If all lanes are empty.
    pub fn of_lanes(lanes: &[Lane], length: f64, time_step: f64) -> Self {
        let time = Time::Steps(time_step);
        let mut least: Option<(usize, &Lane, Growth)> = None;
        for (k, lane) in lanes.iter().enumerate().filter(|(_, lane)| !lane.drivers.is_empty()) {
            if lanes[..k].contains(lane) {
                continue;
            }
            let growth = growth(&rings(lane, length, time_step).1, time);
            let rate = |g: &Growth| g.fastest.map_or(f64::NEG_INFINITY, |m| m.root.re);
            if least.as_ref().is_none_or(|(_, _, least)| rate(&growth) > rate(least)) {
                least = Some((k, lane, growth));
            }
        }
        let (place, lane, discrete) = least.expect("a vehicle in some lane");
        Self::of_lane(place, lane, &discrete, length, time_step)
    }

    fn of_lane(place: usize, lane: &Lane, discrete: &Growth, length: f64, time_step: f64) -> Self {
        let (ring, in_steps) = rings(lane, length, time_step);
        let time = Time::Steps(time_step);
        let n = ring.vehicles();
        let continuous = growth(&ring, Time::Continuous);
        let speed = equilibrium(&lane.drivers, length).map_or(0.0, |e| e.speed);
        let (critical, critical_discrete) = (ring.critical(Time::Continuous), in_steps.critical(time));
        let scale = |critical: f64, mean: f64| if mean > 0.0 { finite(critical / mean) } else { None };
        let rate = |mode: Option<Mode>| match mode {
            Some(mode) => finite(mode.root.re),
            // In the jam every root is 0; a vehicle alone has none.
            None => (n > 1).then_some(0.0),
        };
        let slope = ring.mean_slope();
        Self {
            lane: place + 1,
            vehicles: n,
            equal_drivers: ring.equal().is_some(),
            equilibrium_speed_m_per_s: speed,
            mean_headway_m: length / n as f64,
            slope_per_s: slope,
            jammed: ring.is_jammed(),
            reaction_time_s: ring.mean_delay(),
            delay_in_force_s: in_steps.mean_delay(),
            critical_reaction_time_s: finite(critical),
            critical_reaction_time_discrete_s: finite(critical_discrete),
            newell_limit_s: finite(ring.newell_limit()),
            critical_scale: scale(critical, ring.mean_delay()),
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
        let calm = Report::of(&scenario(0.67));
        let wild = Report::of(&scenario(0.68));
        assert!(calm.stable && !wild.stable && wild.stable_continuous);
        assert!((calm.critical_reaction_time_s.unwrap() - 0.683_869).abs() < 5e-7);
        assert!((calm.critical_reaction_time_discrete_s.unwrap() - 0.678_869).abs() < 5e-7);
        assert!(calm.wave.unwrap().halving_time_s.is_some() && wild.wave.unwrap().doubling_time_s.is_some());
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
    fn the_verdict_in_words() {
        let verdict = |reaction_time| Report::of(&scenario(reaction_time)).verdict();
        let doubling = Report::of(&scenario(0.75)).wave.unwrap().doubling_time_s.unwrap();
        assert_eq!(
            verdict(0.75),
            format!(
                "Reaction time 0.75 s, above the critical 0.6789 s: unstable. Fastest: 8 waves on the ring, \
                 doubling every {doubling:.2} s."
            )
        );
        assert!(verdict(0.5).starts_with(
            "Reaction time 0.5 s, below the critical 0.6789 s: stable. Slowest to fade: 1 wave"
        ));
        assert!(Report::of(&Scenario { vehicles: 150, ..scenario(2.0) }).verdict().starts_with("A jam"));
        assert_eq!(shown(12345.6), "12346");
        assert_eq!((shown(0.0), shown(0.001_234_56)), ("0".to_owned(), "0.001235".to_owned()));
    }

    #[test]
    fn the_least_stable_lane_speaks() {
        let mut scenario = Scenario { vehicles: 101, lanes: 3, ..scenario(0.9) };
        scenario.exceptions = vec!["36-68:reaction-time=0.95".parse().unwrap()];
        let report = Report::of(&scenario);
        assert_eq!((report.lane, report.vehicles), (2, 33));
        scenario.start = Start::OneLane(2);
        assert_eq!(Report::of(&scenario).vehicles, 101);
    }

    #[test]
    fn drivers_that_differ_have_a_scale() {
        let mut scenario = scenario(0.75);
        scenario.exceptions = vec!["1-4:reaction-time=0".parse().unwrap()];
        let report = Report::of(&scenario);
        assert!(!report.stable && !report.equal_drivers);
        assert_eq!(report.all_roots_found, Some(true));
        let scale = report.critical_scale_discrete.unwrap();
        assert!((0.95..1.0).contains(&scale), "{scale}");
        scenario.exceptions = vec!["11-15:reaction-time=0".parse().unwrap()];
        assert!(Report::of(&scenario).stable);
    }

    /// The largest growth rate among the roots of a picture is the report's; all next roots lie to the left.
    #[test]
    fn roots_of_a_picture_and_the_report_agree() {
        let mut mixed = scenario(0.75);
        mixed.exceptions = vec!["1-4:reaction-time=0.3".parse().unwrap()];
        for scenario in [scenario(0.5), scenario(0.75), mixed] {
            let lane = lanes_of(&scenario).remove(0);
            let roots = roots_of_lane(&lane, 1000.0, 0.01, 1, 200);
            let largest = roots.growth_per_s.iter().flatten().copied().fold(f64::NEG_INFINITY, f64::max);
            let report = Report::of(&scenario);
            assert_eq!((roots.modes.len(), roots.equal_drivers), (25, report.equal_drivers));
            assert!((largest - report.max_growth_rate_discrete_per_s.unwrap()).abs() < 1e-12);
            let dominant = report.max_growth_rate_per_s.unwrap();
            assert_eq!(roots.next.len(), 25);
            assert!(roots.next.iter().all(|root| root.branch != 0 && root.real_per_s < dominant));
        }
        let jam = Scenario { vehicles: 150, ..scenario(1.0) };
        assert!(roots_of_lane(&lanes_of(&jam)[0], 1000.0, 0.01, 1, 200).modes.is_empty());
    }

    /// Delays still growing towards the reaction time: the verdict is of the delay in force.
    #[test]
    fn live_traffic_is_judged_by_its_delay_in_force() {
        let driver = scenario(0.9).driver;
        let live = |steps| Lane { drivers: vec![driver; 50], delay_steps: vec![steps; 50] };
        assert!(Report::of_lanes(&[live(60)], 1000.0, 0.01).stable);
        assert!(!Report::of_lanes(&[live(60), live(70)], 1000.0, 0.01).stable);
        assert_eq!(Report::of_lanes(&[live(60), live(70)], 1000.0, 0.01).lane, 2);
    }
}
