//! The cyclic growth rate k under every choice that the paper leaves open.
//!
//! f(n) = v∞ − v_min,n is taken from one vehicle in its n-th period. The paper states neither the vehicle, nor the number
//! of periods, nor what a period is. Two definitions of a period are tried: from one upward crossing of v∞ to the next,
//! and the round trip of the disturbance. The disturbance passes c = dv/dh vehicles each second, against the direction
//! of driving, and so returns to a vehicle after N/c = 68.3 s. The second definition gives a meaning to what the paper
//! says of Δ = 0.8 s, a collision "within one cycle".

use super::shared::column;
use crate::format::table::{Column, Table};
use crate::measurement::Measurement;
use crate::measurement::probe::{Probe, measure};
use crate::numerics::least_squares;
use crate::scenario::Scenario;
use crate::scenario::driver::Driver;
use crate::simulation::Simulation;

/// Number of vehicles; each of them is a choice.
pub(super) const VEHICLES: usize = 50;
/// Largest numbers of upward crossings and of round trips that are tried.
const MOST: [usize; 2] = [12, 4];

/// The definition of a period.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Period {
    /// From one upward crossing of v∞ to the next.
    Crossings,
    /// A round trip of the disturbance, from t = 0.
    RoundTrips,
}

/// A choice of everything that the paper leaves open about k.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Choice {
    /// The vehicle, from 0.
    pub vehicle: usize,
    pub period: Period,
    /// Number of periods fitted, from the first.
    pub periods: usize,
    /// Whether the fit is a line through the logarithms instead of non-linear least squares.
    pub logarithms: bool,
}

/// The choice that we take: one of the vehicles that the paper shows, and as many round trips as end before the collision
/// that it reports for 0.75 s.
pub(super) const TAKEN: Choice =
    Choice { vehicle: 20, period: Period::RoundTrips, periods: 3, logarithms: false };

impl Choice {
    /// Every choice.
    pub fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for vehicle in 0..VEHICLES {
            for (period, most) in [(Period::Crossings, MOST[0]), (Period::RoundTrips, MOST[1])] {
                for periods in 2..=most {
                    for logarithms in [false, true] {
                        all.push(Self { vehicle, period, periods, logarithms });
                    }
                }
            }
        }
        all
    }

    /// In words.
    pub fn words(self) -> String {
        format!("vehicle {}, {} {}, {}", self.vehicle + 1, self.periods, self.period_word(), self.fit_word())
    }

    /// The definition of the period, in words.
    pub fn period_word(self) -> &'static str {
        if self.period == Period::Crossings { "upward crossings" } else { "round trips" }
    }

    /// The fit, in words.
    pub fn fit_word(self) -> &'static str {
        if self.logarithms { "line through the logarithms" } else { "least squares" }
    }
}

/// v∞ of the paper's ring, m/s.
pub(super) fn equilibrium_speed() -> f64 {
    Driver::default().speed(1000.0 / VEHICLES as f64)
}

/// The time after which a disturbance returns to the same vehicle, N/c, s.
pub(super) fn round_trip() -> f64 {
    VEHICLES as f64 / Driver::default().slope(1000.0 / VEHICLES as f64)
}

/// f(n) of every vehicle, m/s: first the columns for upward crossings, then those for round trips.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Depths {
    columns: Vec<Vec<f64>>,
}

impl Depths {
    /// From the columns of a task result.
    pub fn new(columns: &[Vec<f64>]) -> Self {
        Self { columns: columns.to_vec() }
    }

    /// As columns of a task result.
    pub fn into_columns(self) -> Vec<Vec<f64>> {
        self.columns
    }

    /// Runs a scenario of 50 vehicles, with further probes. Returns f(n), the tables of those probes and the last state.
    pub fn measure(scenario: &Scenario, probes: Vec<Box<dyn Probe>>) -> (Self, Vec<Table>, Simulation) {
        let further = probes.len();
        let mut probes = probes;
        for vehicle in 1..=VEHICLES {
            let growth = Measurement::CyclicGrowth { vehicle, periods: MOST[0] };
            probes.push(growth.probe(scenario).expect("measurements of figures are valid"));
        }
        probes.push(Box::new(RoundTrips { slowest: Vec::new() }));
        let mut simulation = Simulation::new(scenario).expect("scenarios of figures are valid");
        measure(&mut simulation, &mut probes, &mut |_| true);
        let mut tables: Vec<Table> = probes.iter().map(|p| p.table()).collect();
        let of_growth = tables.split_off(further);
        let (trips, crossings) = of_growth.split_last().expect("the round trips");
        let depth = |t: &Table| column(t, "f_m_per_s");
        let mut columns: Vec<_> = crossings.iter().map(depth).collect();
        let all = depth(trips);
        let complete = ((simulation.time() / round_trip()) as usize).min(MOST[1]);
        columns.extend((0..VEHICLES).map(|j| (0..complete).map(|n| all[n * VEHICLES + j]).collect()));
        (Self { columns }, tables, simulation)
    }

    /// f(n) of a vehicle (from 0), m/s.
    pub fn of(&self, vehicle: usize, period: Period) -> &[f64] {
        &self.columns[vehicle + if period == Period::Crossings { 0 } else { VEHICLES }]
    }

    /// The fit of a choice; `None` where the run has too few periods or an f(n) is not positive.
    pub fn growth(&self, choice: Choice) -> Option<least_squares::Exponential> {
        let depths = self.of(choice.vehicle, choice.period).get(..choice.periods)?;
        if depths.iter().any(|&f| f <= 0.0) {
            return None;
        }
        let points: Vec<_> = depths.iter().enumerate().map(|(k, &f)| (k as f64 + 1.0, f)).collect();
        if choice.logarithms {
            least_squares::log_linear(&points)
        } else {
            least_squares::exponential(&points)
        }
    }
}

/// The smallest speed of every vehicle in each round trip, from t = 0.
struct RoundTrips {
    slowest: Vec<[f64; VEHICLES]>,
}

impl Probe for RoundTrips {
    fn observe(&mut self, simulation: &Simulation) {
        let trip = (simulation.time() / round_trip()) as usize;
        if trip >= self.slowest.len() {
            self.slowest.resize(trip + 1, [f64::INFINITY; VEHICLES]);
        }
        for (slowest, &speed) in self.slowest[trip].iter_mut().zip(simulation.speeds()) {
            *slowest = slowest.min(speed);
        }
    }

    fn table(&self) -> Table {
        let v = equilibrium_speed();
        let depths = self.slowest.iter().flatten().map(|slowest| v - slowest).collect();
        Table::new(vec![Column::float(
            "f_m_per_s",
            "m/s",
            "v∞ − smallest speed, by round trip and vehicle",
            depths,
        )])
    }
}
