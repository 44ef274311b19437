//! Space-time map of speed in one lane. The speed at a place is that of the vehicle whose headway holds the
//! place: the next one upstream.

use super::probe::{Due, Probe, Schedule};
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
/// A place belongs to the vehicle with x_j ≤ place < x_lead; NaN in an empty lane. Costs O(N + cells).
pub fn speed_row(simulation: &Simulation, lane: usize, row: &mut [f64]) {
    let (bins, length) = (row.len(), simulation.scenario().length);
    row.fill(f64::NAN);
    for j in (0..simulation.vehicles()).filter(|&j| simulation.lane(j) == lane) {
        let (speed, ahead) = (simulation.speed(j), simulation.leader(j));
        if ahead == j {
            row.fill(speed);
            return;
        }
        if simulation.headway(j) <= 0.0 {
            continue; // collided: holds no place
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
    schedule: Schedule,
    lane: usize,
    length: f64,
    bins: usize,
    times: Vec<f64>,
    speeds: Vec<f64>,
}

impl SpeedMap {
    /// A row of the map every so many steps, in `bins` cells; the lane from 0.
    pub fn new(every: u64, bins: usize, lane: usize, length: f64) -> Self {
        Self { schedule: Schedule::new(every), lane, length, bins, times: Vec::new(), speeds: Vec::new() }
    }
}

impl Probe for SpeedMap {
    fn observe(&mut self, simulation: &Simulation) {
        let due = self.schedule.due(simulation);
        if due == Due::Nothing {
            return;
        }
        if due == Due::Again {
            self.times.pop();
        }
        let start = self.times.len() * self.bins;
        self.times.push(simulation.time());
        self.speeds.resize(start + self.bins, f64::NAN);
        speed_row(simulation, self.lane, &mut self.speeds[start..]);
    }

    fn table(&self) -> Table {
        map_table(
            &self.times,
            self.bins,
            self.length,
            Column::float(
                "speed_m_per_s",
                "m/s",
                format!("speed there in lane {}: of the next vehicle upstream", self.lane + 1),
                self.speeds.clone(),
            ),
        )
    }
}

/// A map in long form: a row for each time and place.
pub(super) fn map_table(times: &[f64], bins: usize, length: f64, values: Column) -> Table {
    let long = times.iter().flat_map(|&t| std::iter::repeat_n(t, bins)).collect();
    let places = times.iter().flat_map(|_| (0..bins).map(|k| centre(k, bins, length))).collect();
    Table::new(vec![
        Column::float("time_s", "s", "time", long),
        Column::float("position_m", "m", "place on the ring, the centre of a cell", places),
        values,
    ])
}
