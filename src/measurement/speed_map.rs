//! Space-time map of speed in one lane. The speed at a position is that of the next vehicle upstream.

use super::due_rows::DueRows;
use super::probe::Probe;
use crate::format::table::{Column, Table};
use crate::simulation::Simulation;

/// Centre of cell `k` of `bins` on a ring, m.
pub(super) fn centre(k: usize, bins: usize, length: f64) -> f64 {
    (k as f64 + 0.5) * length / bins as f64
}

/// How many of the centres lie below `x`, exactly as [`centre`] computes them.
pub(super) fn centres_below(x: f64, bins: usize, length: f64) -> usize {
    let mut k = (x / length * bins as f64).clamp(0.0, bins as f64) as usize;
    while k > 0 && centre(k - 1, bins, length) >= x {
        k -= 1;
    }
    while k < bins && centre(k, bins, length) < x {
        k += 1;
    }
    k
}

/// Fills `row` with the speeds at the centres of as many equal cells round the ring, in the given lane (from 0).
/// A position x belongs to the vehicle with x_j ≤ x < x_lead; all are NaN in an empty lane. Costs O(N + cells).
fn speed_row(simulation: &Simulation, lane: usize, row: &mut [f64]) {
    let (bins, length) = (row.len(), simulation.scenario().length);
    row.fill(f64::NAN);
    for j in (0..simulation.vehicles()).filter(|&j| simulation.lane(j) == lane) {
        let (speed, ahead) = (simulation.speed(j), simulation.leader(j));
        if ahead == j {
            row.fill(speed);
            return;
        }
        if simulation.headway(j) <= 0.0 {
            continue; // collided: no position belongs to it
        }
        let (x, x_ahead) = (simulation.position(j), simulation.position(ahead));
        let (first, end) = (centres_below(x, bins, length), centres_below(x_ahead, bins, length));
        if x < x_ahead {
            row[first..end].fill(speed);
        } else {
            row[first..].fill(speed);
            row[..end].fill(speed);
        }
    }
}

/// The probe of the table `speed-map`.
#[derive(Clone, Debug)]
pub struct SpeedMap {
    lane: usize,
    length: f64,
    /// The speeds of one time, m/s.
    row: Vec<f64>,
    speeds: DueRows<f64>,
}

impl SpeedMap {
    /// A row of the map every so many steps, in `bins` cells; the lane from 0, the length of the ring in m.
    pub fn new(every: u64, bins: usize, lane: usize, length: f64) -> Self {
        Self { lane, length, row: vec![f64::NAN; bins], speeds: DueRows::every(every) }
    }
}

impl Probe for SpeedMap {
    fn observe(&mut self, simulation: &Simulation) {
        if self.speeds.begin(simulation).is_some() {
            speed_row(simulation, self.lane, &mut self.row);
            self.speeds.extend(self.row.iter().copied());
        }
    }

    fn table(&self) -> Table {
        let meaning = format!("speed there in lane {}: of the next vehicle upstream", self.lane + 1);
        map_table(&self.speeds, self.row.len(), self.length, "speed_m_per_s", "m/s", meaning)
    }
}

/// A map in long form: a row for each time and each of `bins` cells, the value in the column `name`.
pub(super) fn map_table(
    values: &DueRows<f64>,
    bins: usize,
    length: f64,
    name: &str,
    unit: &'static str,
    meaning: String,
) -> Table {
    let places = values.times().iter().flat_map(|_| (0..bins).map(|k| centre(k, bins, length))).collect();
    Table::new(vec![
        values.time_column(),
        Column::float("position_m", "m", "place on the ring, the centre of a cell", places),
        Column::float(name, unit, meaning, values.rows().to_vec()),
    ])
}
