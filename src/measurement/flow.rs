//! Flow past a place over a window δ, and its space-time map, all lanes together:
//! `Q(t, x) = (1/δ)·Σ_j [⌊(X_j(t) − x)/L⌋ − ⌊(X_j(t − δ) − x)/L⌋]` with unwrapped positions X_j, so that every
//! lap counts, and a vehicle that is displaced backwards is subtracted. Q does not exist for t < δ.
//!
//! Each of the two sums is the number of passings since the beginning, up to a constant. One state gives it for all
//! positions x in O(N + positions), by counting the vehicles between neighbouring positions and summing up along the ring. So
//! the probe keeps, for each row to come, one whole number for each position instead of the positions of all vehicles.

use super::due_rows::DueRows;
use super::probe::Probe;
use super::speed_map::{centre, centres_below, map_table};
use crate::format::table::{Column, Table};
use crate::scenario::Scenario;
use crate::simulation::Simulation;

/// The probe of the tables `flow` and `flow-map`.
#[derive(Clone, Debug)]
pub struct Flow {
    every: u64,
    /// δ in steps and in s.
    window: u64,
    seconds: f64,
    length: f64,
    /// One position, m; none for the centres of `bins` cells.
    place: Option<f64>,
    bins: usize,
    /// Passings at the beginning of the windows of the rows to come; the row of step m·every has slot m modulo their number.
    begun: Vec<i64>,
    /// The step at which each slot was filled.
    begun_at: Vec<Option<u64>>,
    passings: Vec<i64>,
    /// At each time the flow past each place, veh/s.
    flows: DueRows<f64>,
}

impl Flow {
    /// Flow past one position (m) every so many steps, over a window in steps.
    pub fn at(scenario: &Scenario, every: u64, window: u64, place: f64) -> Self {
        Self::new(scenario, every, window, Some(place), 1)
    }

    /// Flow past the centres of `bins` cells.
    pub fn map(scenario: &Scenario, every: u64, window: u64, bins: usize) -> Self {
        Self::new(scenario, every, window, None, bins)
    }

    fn new(scenario: &Scenario, every: u64, window: u64, place: Option<f64>, bins: usize) -> Self {
        let slots = (window / every) as usize + 2;
        Self {
            every,
            window,
            seconds: window as f64 * scenario.time_step,
            length: scenario.length,
            place,
            bins,
            begun: vec![0; slots * bins],
            begun_at: vec![None; slots],
            passings: vec![0; bins],
            flows: DueRows::every(every),
        }
    }

    /// Counts the passings of every position since the beginning, up to a constant:
    /// Σ_j ⌊(X_j − x)/L⌋ = Σ_j ⌊X_j/L⌋ − (number of vehicles that have not reached x on their lap).
    fn count(&mut self, simulation: &Simulation) {
        let mut laps = 0;
        self.passings.fill(0);
        for j in 0..simulation.vehicles() {
            let unwrapped = simulation.unwrapped_position(j);
            let mut lap = (unwrapped / self.length).floor();
            let mut x = unwrapped - lap * self.length;
            if x < 0.0 {
                // The quotient was rounded up to a whole lap.
                lap -= 1.0;
                x = unwrapped - lap * self.length;
            } else if x >= self.length {
                lap += 1.0;
                x = unwrapped - lap * self.length;
            }
            laps += lap as i64;
            let beyond = match self.place {
                Some(place) => usize::from(place <= x),
                // A centre at the position of the vehicle is passed.
                None => self.centres_reached(x),
            };
            if beyond < self.bins {
                self.passings[beyond] += 1;
            }
        }
        let mut before = 0;
        for passings in &mut self.passings {
            before += *passings;
            *passings = laps - before;
        }
    }

    fn centres_reached(&self, x: f64) -> usize {
        let below = centres_below(x, self.bins, self.length);
        below + usize::from(below < self.bins && centre(below, self.bins, self.length) == x)
    }
}

impl Probe for Flow {
    fn observe(&mut self, simulation: &Simulation) {
        let step = simulation.step_index();
        let due = self.flows.begin(simulation).is_some();
        let begins = (step + self.window).is_multiple_of(self.every);
        if !due && !begins {
            return;
        }
        self.count(simulation);
        let bins = self.bins;
        if begins {
            let slot = ((step + self.window) / self.every) as usize % self.begun_at.len();
            self.begun_at[slot] = Some(step);
            self.begun[slot * bins..][..bins].copy_from_slice(&self.passings);
        }
        if !due {
            return;
        }
        let slot = (step / self.every) as usize % self.begun_at.len();
        let known = step >= self.window && self.begun_at[slot] == Some(step - self.window);
        for k in 0..bins {
            let passed = self.passings[k] - self.begun[slot * bins + k];
            self.flows.push(if known { passed as f64 / self.seconds } else { f64::NAN });
        }
    }

    fn table(&self) -> Table {
        let meaning = format!("flow over the last {} s, all lanes together; none before", self.seconds);
        let (name, unit) = ("flow_veh_per_s", "veh/s");
        match self.place {
            Some(_) => Table::new(vec![
                self.flows.time_column(),
                Column::float(name, unit, meaning, self.flows.rows().to_vec()),
            ]),
            None => map_table(&self.flows, self.bins, self.length, name, unit, meaning),
        }
    }
}
