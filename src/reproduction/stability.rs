//! Growth against reaction time and the critical reaction time against N, each in the simulation and in theory.

use super::claim::{Claim, Estimate, Expected, short};
use super::cyclic::{Depths, Period, TAKEN, round_trip};
use super::figure::{Figure, FigureTable, Outcome};
use super::shared::{column, indicator, nudged};
use super::task::{Size, Task, TaskResult};
use crate::format::table::{Column, Table};
use crate::measurement::Measurement;
use crate::measurement::probe::Probe;
use crate::numerics::bisection::Whole;
use crate::plot::{Axis, Layer, Panel, Plot};
use crate::scenario::driver::Driver;
use crate::simulation::Simulation;
use crate::stability::homogeneous::{HomogeneousRing, Time};
use crate::stability::jacobian::{numerical_eigenvalues, smallest_distance};

const ID: &str = "stability";

pub(super) const FIGURE: Figure = Figure {
    id: ID,
    title: "Stability of a single lane",
    caption: "Left and middle: the cyclic growth rate k of vehicle 21 over three round trips of the disturbance, and the \
              largest real part of the characteristic roots, against the reaction time; N = 50, a displacement of 1 m. Right: \
              the critical reaction time against the number of vehicles on 1 km: theory in continuous time, and \
              runs of 3000 s in steps of 0.01 s after a displacement of 1 mm, searched by bisection for the step at which \
              the longest wave begins to grow.",
    beyond: false,
    tasks,
    start,
    assemble,
};

/// Time step, s.
const STEP: f64 = 0.01;

/// Reaction times at which k is measured, s.
fn reaction_times(size: Size) -> Vec<f64> {
    size.choose((0..=16).collect::<Vec<i32>>(), vec![0, 10, 13, 15, 16])
        .iter()
        .map(|&k| f64::from(k) * 0.05)
        .collect()
}

/// Numbers of vehicles for which the critical reaction time is searched.
fn rings(size: Size) -> Vec<usize> {
    size.choose(vec![20, 30, 40, 50, 65, 80, 100, 133], vec![50])
}

fn tasks(size: Size) -> Vec<String> {
    let delays = reaction_times(size).into_iter().map(|d| format!("reaction time {d} s"));
    delays.chain(rings(size).iter().map(|n| format!("critical reaction time of {n} vehicles"))).collect()
}

/// The ring of 1 km with so many vehicles, in theory.
fn ring(vehicles: usize) -> HomogeneousRing {
    HomogeneousRing { vehicles, slope: Driver::default().slope(1000.0 / vehicles as f64) }
}

fn start(size: Size, task: usize) -> Box<dyn Task> {
    let delays = reaction_times(size);
    if let Some(&delay) = delays.get(task) {
        return Box::new(move || TaskResult { columns: vec![growth(delay)] });
    }
    Box::new(Search {
        vehicles: rings(size)[task - delays.len()],
        until: size.choose(3000.0, 2000.0),
        delays: Whole::new(20, 160),
        run: None,
    })
}

/// k of vehicle 21 with its standard error, time of the collision, number of complete round trips, number of upward
/// crossings of vehicle 21.
fn growth(reaction_time: f64) -> Vec<f64> {
    let scenario = nudged(reaction_time, 1.0, 300.0);
    let (depths, _, simulation) = Depths::measure(&scenario, Vec::new());
    let fitted = depths.growth(TAKEN);
    let count = |period| depths.of(TAKEN.vehicle, period).len() as f64;
    vec![
        fitted.map_or(f64::NAN, |f| f.rate),
        fitted.map_or(f64::NAN, |f| f.rate_error),
        simulation.collision().map_or(f64::NAN, |c| c.time),
        count(Period::RoundTrips),
        count(Period::Crossings),
    ]
}

/// The search by bisection for the largest delay, in steps, at which the longest wave fades; at the next one it grows.
struct Search {
    vehicles: usize,
    /// End of a run near the threshold, s.
    until: f64,
    /// Delays, in steps: at the lower end the wave fades, at the upper it grows.
    delays: Whole,
    /// The run that is going on, at the delay in the middle of the two.
    run: Option<(Simulation, Box<dyn Probe>)>,
}

impl Search {
    fn begin(&self, steps: usize) -> (Simulation, Box<dyn Probe>) {
        // Far from the threshold growth or decay is clear after a shorter run.
        let until = if self.delays.fails - self.delays.holds > 16 { 1000.0 } else { self.until };
        let mut scenario = nudged(steps as f64 * STEP, 1e-3, until);
        scenario.vehicles = self.vehicles;
        let growth = Measurement::Growth {
            every: 1.0,
            modes: Some(1),
            lane: 1,
            from: Some(500.0),
            smallest: 1e-9,
            nonlinearity: 0.01,
        };
        let mut probe = growth.probe(&scenario).expect("measurements of figures are valid");
        let simulation = Simulation::new(&scenario).expect("scenarios of figures are valid");
        probe.observe(&simulation);
        (simulation, probe)
    }
}

impl Task for Search {
    /// The result is the threshold in steps: the middle of the last two delays.
    fn advance(&mut self, updates: u64) -> Option<TaskResult> {
        let mut steps = updates / self.vehicles as u64;
        while let Some(middle) = self.delays.middle() {
            let (mut simulation, mut probe) = self.run.take().unwrap_or_else(|| self.begin(middle));
            while !simulation.is_finished() {
                if steps == 0 {
                    self.run = Some((simulation, probe));
                    return None;
                }
                steps -= 1;
                simulation.step();
                probe.observe(&simulation);
            }
            let rate = column(&probe.table(), "growth_rate_per_s")[0];
            // Without a rate the wave had left the linear regime before the fit began, so it grows.
            let grows = simulation.collision().is_some() || rate.is_nan() || rate > 0.0;
            self.delays.narrow(middle, !grows);
        }
        Some(TaskResult { columns: vec![vec![self.delays.holds as f64 + 0.5]] })
    }
}

fn assemble(size: Size, results: &[TaskResult]) -> Outcome {
    let delays = reaction_times(size);
    let (scans, thresholds) = results.split_at(delays.len());
    let values = |k: usize| scans.iter().map(|p| p.columns[0][k]).collect::<Vec<f64>>();
    let ring50 = ring(50);
    let fastest = |delay: f64, time| ring50.fastest(delay, time).map_or(f64::NAN, |m| m.root.re);
    let continuous: Vec<f64> = delays.iter().map(|&d| fastest(d, Time::Continuous)).collect();
    let discrete: Vec<f64> = delays.iter().map(|&d| fastest(d, Time::Steps(STEP))).collect();

    let counts: Vec<usize> = (2..=133).collect();
    let critical: Vec<f64> = counts.iter().map(|&n| ring(n).critical(Time::Continuous)).collect();
    let critical_steps: Vec<f64> = counts.iter().map(|&n| ring(n).critical(Time::Steps(STEP))).collect();
    let run_counts = rings(size);
    let found: Vec<f64> = thresholds.iter().map(|p| p.columns[0][0] * STEP).collect();

    let scan = Table::new(vec![
        Column::float("reaction_time_s", "s", "Δ", delays.clone()),
        Column::float(
            "growth_rate_per_period",
            "",
            "cyclic growth rate k of vehicle 21 over three round trips; none where a collision ends the run before",
            values(0),
        ),
        Column::float("standard_error_per_period", "", "standard error of k", values(1)),
        Column::whole(
            "round_trips",
            "",
            "complete round trips of the disturbance, at most 4 counted",
            values(3).iter().map(|&p| p as u64).collect(),
        ),
        Column::float("collision_s", "s", "time of the collision, if there is one", values(2)),
        Column::float(
            "largest_real_part_per_s",
            "1/s",
            "largest real part of the characteristic roots",
            continuous.clone(),
        ),
        Column::float(
            "largest_real_part_discrete_per_s",
            "1/s",
            "the same of the difference equation with steps of 0.01 s",
            discrete,
        ),
    ]);
    let theory = Table::new(vec![
        Column::whole("vehicles", "", "N on 1 km", counts.iter().map(|&n| n as u64).collect()),
        Column::float("critical_s", "s", "critical reaction time τ in continuous time", critical.clone()),
        Column::float("critical_discrete_s", "s", "the same in steps of 0.01 s", critical_steps),
    ]);
    let runs = Table::new(vec![
        Column::whole("vehicles", "", "N on 1 km", run_counts.iter().map(|&n| n as u64).collect()),
        Column::float(
            "critical_s",
            "s",
            "middle between the last fading and the first growing delay; uncertainty 0.005 s",
            found.clone(),
        ),
    ]);
    let base = nudged(0.0, 1.0, 300.0);
    let tables = vec![
        FigureTable::summary("stability-growth", scan, &base, "one run for each reaction time; theory"),
        FigureTable::summary("stability-critical", theory, &base, "theory"),
        FigureTable::summary(
            "stability-critical-runs",
            runs,
            &nudged(0.0, 1e-3, 3000.0),
            "bisection over steps of delay",
        ),
    ];
    let plot =
        plot(&delays, &values(0), &values(1), &continuous, (&counts, &critical), (&run_counts, &found));
    let at_50 = run_counts.iter().position(|&n| n == 50).map_or(f64::NAN, |k| found[k]);
    Outcome { tables, plot, claims: claims(&Scan { delays, scans }, &continuous, &critical, at_50) }
}

/// The results at all reaction times.
struct Scan<'a> {
    delays: Vec<f64>,
    scans: &'a [TaskResult],
}

impl Scan<'_> {
    /// k at every reaction time.
    fn rates(&self) -> Vec<f64> {
        self.scans.iter().map(|result| result.columns[0][0]).collect()
    }

    /// The numbers of [`growth`] at a reaction time.
    fn at(&self, delay: f64) -> &[f64] {
        let k =
            self.delays.iter().position(|d| (d - delay).abs() < 1e-9).expect("a reaction time of the scan");
        &self.scans[k].columns[0]
    }

    /// The middle of the interval of reaction times in which a rate becomes positive, and half its width.
    fn sign_change(&self, rates: &[f64]) -> Estimate {
        let known: Vec<_> = self.delays.iter().zip(rates).filter(|r| !r.1.is_nan()).collect();
        known.windows(2).find(|w| *w[0].1 < 0.0 && *w[1].1 >= 0.0).map_or(Estimate::exact(f64::NAN), |w| {
            Estimate::new(0.5 * (w[0].0 + w[1].0), 0.5 * (w[1].0 - w[0].0))
        })
    }
}

fn plot(
    delays: &[f64],
    k: &[f64],
    k_error: &[f64],
    real_parts: &[f64],
    theory: (&[usize], &[f64]),
    runs: (&[usize], &[f64]),
) -> Plot {
    let numbers = |counts: &[usize]| counts.iter().map(|&n| n as f64).collect::<Vec<f64>>();
    let tau = ring(50).critical(Time::Continuous);
    let rule = |name: &str, vertical, at| Layer::Rule { name: name.into(), vertical, at, left: false };
    Plot {
        id: ID.into(),
        title: FIGURE.title.into(),
        description: "Left, the growth rate k per round trip and, in the middle, the largest real part of the \
                      characteristic roots both rise with the reaction time and change sign near 0.68 s. Right, \
                      the critical reaction time falls with the number of vehicles towards 0.5 s; the runs lie on the \
                      curve."
            .into(),
        columns: 3,
        panels: vec![
            Panel {
                title: "Simulation: growth a round trip".into(),
                x: Axis::from_to("reaction time Δ (s)", 0.0, 0.85),
                y: Axis::new("k (per round trip)"),
                layers: vec![
                    rule("", false, 0.0),
                    rule("τ", true, tau),
                    Layer::Points {
                        name: "k of vehicle 21".into(),
                        style: 0,
                        x: delays.to_vec(),
                        y: k.to_vec(),
                        error: k_error.to_vec(),
                    },
                ],
            },
            Panel {
                title: "Theory: the leading root".into(),
                x: Axis::from_to("reaction time Δ (s)", 0.0, 0.85),
                y: Axis::new("max Re λ̃ (1/s)"),
                layers: vec![
                    rule("", false, 0.0),
                    rule("τ", true, tau),
                    Layer::Points {
                        name: "characteristic roots".into(),
                        style: 1,
                        x: delays.to_vec(),
                        y: real_parts.to_vec(),
                        error: Vec::new(),
                    },
                ],
            },
            Panel {
                title: "Critical reaction time".into(),
                x: Axis::from_to("vehicles N on 1 km", 0.0, 140.0),
                y: Axis::from_to("τ (s)", 0.0, 1.6),
                layers: vec![
                    Layer::Rule { name: "Newell’s limit".into(), vertical: false, at: 0.5, left: true },
                    Layer::Curve {
                        name: "theory".into(),
                        style: 0,
                        x: numbers(theory.0),
                        y: theory.1.to_vec(),
                    },
                    Layer::Points {
                        name: "runs".into(),
                        style: 1,
                        x: numbers(runs.0),
                        y: runs.1.to_vec(),
                        error: Vec::new(),
                    },
                ],
            },
        ],
    }
}

/// The smallest distance between two numerical eigenvalues of the Jacobian, 1/s. The uncertainty is twice the largest distance
/// of one of them from the closed form, as two of them may be wrong by so much.
fn eigenvalue_distance(vehicles: usize) -> Estimate {
    let found = numerical_eigenvalues(&vec![Driver::default(); vehicles], 1000.0);
    found.map_or(Estimate::exact(f64::NAN), |found| {
        let error = found.iter().map(|e| e.distance_per_s).fold(0.0, f64::max);
        Estimate::new(smallest_distance(&found), 2.0 * error)
    })
}

/// A claim about a critical reaction time, in seconds.
fn critical_claim(claim: &str, paper: f64, tolerance: f64, ours: Estimate, method: &str) -> Claim {
    Claim::new(ID, claim, "s", Expected::About(paper, tolerance), ours, method)
}

fn claims(scan: &Scan, real_parts: &[f64], critical: &[f64], found: f64) -> Vec<Claim> {
    let mut claims = threshold_claims(scan, found);
    claims.extend(reaction_time_claims(scan, real_parts));
    claims.extend(collision_claims(scan));
    claims.extend(vehicle_count_claims(critical));
    claims.push(Claim::new(
        ID,
        "the simulation is stable at 0.65 s and unstable at 0.75 s",
        "",
        Expected::About(1.0, 0.0),
        indicator(scan.at(0.65)[0] < 0.0 && scan.at(0.75)[0] > 0.0),
        "Sign of k of vehicle 21 over three round trips; 1 means that both hold.",
    ));
    claims
}

/// The critical reaction time at N = 50, found in three ways.
fn threshold_claims(scan: &Scan, found: f64) -> Vec<Claim> {
    let tolerance = "tolerance 0.05 s, the interval at which the paper looks.";
    let eigenvalues = eigenvalue_distance(50);
    vec![
        Claim::new(
            ID,
            "J has N − 1 distinct eigenvalues, hence is diagonalizable: smallest distance between two, N = 50",
            "1/s",
            Expected::MoreThan(0.0),
            eigenvalues,
            format!(
                "Numerical eigenvalues of the matrix J at Δ = 0. The largest distance of one of them from the closed form \
                 −c(1 − e^(2πiq/N)) is {} 1/s, and the uncertainty twice that.",
                short(0.5 * eigenvalues.uncertainty)
            ),
        )
        .or("N = 133", eigenvalue_distance(133)),
        critical_claim(
            "critical reaction time τ at N = 50, linear theory",
            0.7,
            0.05,
            Estimate::exact(ring(50).critical(Time::Continuous)),
            &format!("τ = (π/N)/(2c·sin(π/N)); {tolerance}"),
        ),
        critical_claim(
            "critical reaction time τ at N = 50, simulation: where k changes sign",
            0.7,
            0.05,
            scan.sign_change(&scan.rates()),
            &format!(
                "Vehicle 21, three round trips, reaction times 0.05 s apart as in the paper; {tolerance}"
            ),
        ),
        critical_claim(
            "critical reaction time τ at N = 50, simulation: where the longest wave begins to grow",
            0.7,
            0.05,
            Estimate::new(found, 0.5 * STEP),
            &format!(
                "Displacement 1 mm, Fourier mode 1 from 500 s on, bisection over steps of 0.01 s; {tolerance}"
            ),
        ),
    ]
}

/// Stability falls with the reaction time.
fn reaction_time_claims(scan: &Scan, real_parts: &[f64]) -> Vec<Claim> {
    let known = |rates: &[f64]| rates.iter().copied().filter(|r| !r.is_nan()).collect::<Vec<f64>>();
    let falls = known(real_parts).windows(2).filter(|w| w[1] <= w[0]).count();
    let sign_changes = known(&scan.rates()).windows(2).filter(|w| (w[0] < 0.0) != (w[1] < 0.0)).count();
    vec![
        Claim::new(
            ID,
            "a longer reaction time is less stable, simulation: number of times that k changes its sign from 0 to 0.8 s",
            "",
            Expected::About(1.0, 0.0),
            Estimate::exact(sign_changes as f64),
            "Vehicle 21, three round trips; from stable to unstable and never back.",
        ),
        Claim::new(
            ID,
            "a longer reaction time is less stable, theory: number of times that the largest real part falls from one reaction time to the next",
            "",
            Expected::AtMost(0.0),
            Estimate::exact(falls as f64),
            format!(
                "Characteristic roots of all modes at {} reaction times from 0 to 0.8 s.",
                real_parts.len()
            ),
        ),
    ]
}

/// The collision at Δ = 0.8 s.
fn collision_claims(scan: &Scan) -> Vec<Claim> {
    let at_08 = scan.at(0.8);
    vec![
        Claim::new(
            ID,
            "collision within one cycle at Δ = 0.8 s: cycles before it",
            "",
            Expected::AtMost(1.0),
            Estimate::exact(at_08[2] / round_trip()),
            format!(
                "The collision is at {:.2} s; a cycle is a round trip of the disturbance, {:.2} s.",
                at_08[2],
                round_trip()
            ),
        )
        .or("upward crossings of v∞ by vehicle 21, at most 12 counted", Estimate::exact(at_08[4])),
        Claim::new(
            ID,
            "no k can be fitted at Δ = 0.8 s: complete round trips before the collision",
            "",
            Expected::AtMost(1.0),
            Estimate::exact(at_08[3]),
            "A fit needs two; a round trip of the disturbance is a period.",
        ),
    ]
}

/// The critical reaction time against the number of vehicles, and its limit. `critical` begins at N = 2.
fn vehicle_count_claims(critical: &[f64]) -> Vec<Claim> {
    vec![
        Claim::new(
            ID,
            "τ falls with the number of vehicles: number of times that it rises from one N to the next",
            "",
            Expected::AtMost(0.0),
            Estimate::exact(critical.windows(2).filter(|w| w[1] >= w[0]).count() as f64),
            "Linear theory at every N from 2 to 133.",
        ),
        critical_claim(
            "τ at N = 133, near the densest ring",
            0.5,
            0.005,
            Estimate::exact(*critical.last().expect("a list to 133")),
            "Linear theory; tolerance: half a unit of the second digit.",
        ),
        Claim::new(
            ID,
            "the continuum limit is Newell’s λτ = 1/2 at h = d",
            "",
            Expected::About(0.5, 1e-9),
            Estimate::exact(
                Driver::default().sensitivity
                    * HomogeneousRing { vehicles: 1_000_000, slope: Driver::default().sensitivity }
                        .critical(Time::Continuous),
            ),
            "Linear theory at a slope of λ and a million vehicles; tolerance 1e-9.",
        ),
    ]
}
