//! The cyclic growth rate k of one vehicle's speed: `f(n) = v∞ − v_min,n`, v_min,n being the smallest speed in the
//! n-th period, between successive upward crossings of v∞; k from `f(n) ≈ a·exp(k·n)` by non-linear least
//! squares, and beside it the log-linear fit.
//!
//! v∞ is the equilibrium speed of the vehicle's lane in the first state. A crossing lies between two steps; its time is that of
//! the later one. k depends on the vehicle and on the number of periods, so the table states both.

use super::probe::Probe;
use crate::format::table::{Column, Table};
use crate::numerics::least_squares::{exponential, log_linear};
use crate::scenario::driver::{Driver, equilibrium};
use crate::simulation::Simulation;

/// The probe of the table `cyclic-growth`.
#[derive(Clone, Debug)]
pub struct CyclicGrowth {
    vehicle: usize,
    periods: usize,
    /// v∞, m/s; NaN before the first state.
    equilibrium: f64,
    /// The last state: step, time (s), speed (m/s). It is added to the periods only when the next time comes, since a second
    /// look at the same time may replace it.
    pending: Option<(u64, f64, f64)>,
    cycles: Cycles,
}

/// The periods of the speed up to some time.
#[derive(Clone, Debug, Default)]
struct Cycles {
    speed: Option<f64>,
    /// Time of the last upward crossing and smallest speed since.
    open: Option<(f64, f64)>,
    /// Finished periods: start (s), end (s), smallest speed (m/s).
    finished: Vec<(f64, f64, f64)>,
}

impl Cycles {
    fn add(&mut self, time: f64, speed: f64, equilibrium: f64, most: usize) {
        if self.finished.len() == most {
            return;
        }
        if let Some((_, smallest)) = &mut self.open {
            *smallest = smallest.min(speed);
        }
        if self.speed.is_some_and(|before| before < equilibrium) && speed >= equilibrium {
            if let Some((start, smallest)) = self.open {
                self.finished.push((start, time, smallest));
            }
            self.open = Some((time, speed));
        }
        self.speed = Some(speed);
    }
}

impl CyclicGrowth {
    /// Of a vehicle (from 0), over at most so many periods.
    pub fn new(vehicle: usize, periods: usize) -> Self {
        Self { vehicle, periods, equilibrium: f64::NAN, pending: None, cycles: Cycles::default() }
    }
}

/// v∞ of the lane in which vehicle `j` is.
fn equilibrium_speed(simulation: &Simulation, j: usize) -> f64 {
    let lane = simulation.lane(j);
    let in_lane = (0..simulation.vehicles()).filter(|&i| simulation.lane(i) == lane);
    let drivers: Vec<Driver> = in_lane.map(|i| *simulation.driver(i)).collect();
    equilibrium(&drivers, simulation.scenario().length).map_or(f64::NAN, |e| e.speed)
}

impl Probe for CyclicGrowth {
    fn observe(&mut self, simulation: &Simulation) {
        let step = simulation.step_index();
        match self.pending {
            Some((before, time, speed)) if before != step => {
                self.cycles.add(time, speed, self.equilibrium, self.periods);
            }
            Some(_) => {}
            None => self.equilibrium = equilibrium_speed(simulation, self.vehicle),
        }
        self.pending = Some((step, simulation.time(), simulation.speed(self.vehicle)));
    }

    fn table(&self) -> Table {
        let mut cycles = self.cycles.clone();
        if let Some((_, time, speed)) = self.pending {
            cycles.add(time, speed, self.equilibrium, self.periods);
        }
        let finished = &cycles.finished;
        let n = finished.len();
        let depths: Vec<f64> = finished.iter().map(|c| self.equilibrium - c.2).collect();
        let points: Vec<_> = depths.iter().enumerate().map(|(k, &f)| (k as f64 + 1.0, f)).collect();
        let (fit, log_fit) = (exponential(&points), log_linear(&points));
        let constant = |x: Option<f64>| vec![x.unwrap_or(f64::NAN); n];
        Table::new(vec![
            Column::whole("vehicle", "", "number of the vehicle, from 1", vec![self.vehicle as u64 + 1; n]),
            Column::whole("period", "", "number n of the period, from 1", (1..=n as u64).collect()),
            Column::float(
                "from_s",
                "s",
                "its start: an upward crossing of v∞",
                finished.iter().map(|c| c.0).collect(),
            ),
            Column::float("to_s", "s", "its end: the next one", finished.iter().map(|c| c.1).collect()),
            Column::float(
                "smallest_speed_m_per_s",
                "m/s",
                "smallest speed in the period",
                finished.iter().map(|c| c.2).collect(),
            ),
            Column::float("f_m_per_s", "m/s", "f(n) = v∞ − smallest speed", depths),
            Column::float("equilibrium_speed_m_per_s", "m/s", "v∞", vec![self.equilibrium; n]),
            Column::whole("periods", "", "number of periods fitted", vec![n as u64; n]),
            Column::float(
                "growth_rate_per_period",
                "",
                "k of a·exp(k·n) by non-linear least squares",
                constant(fit.map(|f| f.rate)),
            ),
            Column::float(
                "standard_error_per_period",
                "",
                "standard error of k",
                constant(fit.map(|f| f.rate_error)),
            ),
            Column::float(
                "fit_amplitude_m_per_s",
                "m/s",
                "a of that fit",
                constant(fit.map(|f| f.amplitude)),
            ),
            Column::float(
                "growth_rate_log_linear_per_period",
                "",
                "k by the log-linear fit",
                constant(log_fit.map(|f| f.rate)),
            ),
            Column::float(
                "fit_amplitude_log_linear_m_per_s",
                "m/s",
                "a of that fit",
                constant(log_fit.map(|f| f.amplitude)),
            ),
        ])
    }
}
