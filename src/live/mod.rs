//! A run that somebody watches: the simulation together with what a page shows of it: the space-time map, the
//! speeds of a few vehicles, flow and lane balance over time, the growth measured so far, the verdict of theory.
//!
//! Everything here is bounded in memory, however long the run. Tables for files come from the probes.

pub mod traffic;

use crate::error::{Error, quoted};
use crate::format::table::Table;
use crate::measurement::modal_growth::{Linear, ModalGrowth};
use crate::measurement::probe::Probe;
use crate::scenario::action::{Action, Effect, VehicleSelector};
use crate::scenario::driver::{Driver, Equilibrium, equilibrium};
use crate::scenario::link;
use crate::scenario::parameters::Parameter;
use crate::scenario::{Scenario, assign};
use crate::simulation::Simulation;
use crate::stability::report::{Roots, roots_of_lane};
use crate::stability::stability_diagram::StabilityDiagram;
use crate::stability::summary::{self, StabilitySummary, verdict};
use std::collections::VecDeque;

/// Seconds between two columns of the map, rounded to whole steps.
pub const INTERVAL: f64 = 0.5;
/// Columns that the map keeps.
pub const COLUMNS: usize = 600;
/// Cells of the map round the ring.
pub const BINS: usize = 300;
/// Rows in the window of the flow.
const FLOW_ROWS: usize = 40;
/// Seconds over which growth is measured.
const GROWTH_WINDOW: f64 = 60.0;
/// Amplitude below which a wave cannot be told from rounding, m.
const ROUNDING: f64 = 1e-9;
/// A wave is small while no headway differs from rest by more than this part of the gap to the minimum headway.
const SMALL: f64 = 0.2;

/// Rows for which the growth of all modes is followed after a change.
const MODAL_ROWS: usize = 2400;
/// What counts as linear there, as in the table of growth.
const LINEAR: Linear = Linear { smallest: 1e-8, nonlinearity: 0.01 };

/// What the page opens with: fifty vehicles beyond the critical reaction time, one of them nudged.
pub fn opening() -> Scenario {
    let mut scenario = link::base();
    scenario.driver.reaction_time = 0.75;
    scenario.actions =
        vec![Action { at: 0.0, who: VehicleSelector::Vehicle(1), effects: vec![Effect::Nudge(1.0)] }];
    scenario
}

/// One column of the map.
#[derive(Clone, Debug)]
pub struct Column {
    /// Time, s.
    pub time: f64,
    /// The equilibrium speed then, m/s.
    pub equilibrium: f64,
    /// Speeds (m/s) from x = 0 on, lane after lane, interpolated between vehicles; NaN in an empty lane.
    pub speeds: Vec<f32>,
}

/// Growth of one wave, measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredGrowth {
    /// Slope of ln|amplitude|, 1/s.
    pub rate: f64,
    /// Of the slope, 1/s.
    pub standard_error: f64,
    /// How far what is not linear in waves of this size may have moved the slope, 1/s.
    pub nonlinear_bound: f64,
    /// Seconds looked back.
    pub window: f64,
    /// Which Fourier mode of the headways.
    pub mode: usize,
}

/// A watched run.
#[derive(Clone, Debug)]
pub struct Live {
    simulation: Simulation,
    /// Steps between two rows.
    every: u64,
    /// Vehicles (indices) whose speeds are followed.
    watched: Vec<usize>,
    /// Steps of the scenario's actions, ascending; what has passed is behind `next`.
    agenda: Vec<u64>,
    next: usize,
    /// Grows with everything that changes what theory says.
    changes: u64,
    balance: Vec<usize>,
    equilibrium: Equilibrium,
    verdict: StabilitySummary,
    /// Lanes have changed since theory was asked: with several lanes it is asked only when somebody wants to know.
    stale: bool,
    /// Columns made so far; the last [`COLUMNS`] are kept.
    made: u64,
    columns: VecDeque<Column>,
    /// Rows not yet taken: time, mean speed, flow, ΔN, speeds of the watched.
    rows: Vec<f64>,
    crossings: VecDeque<f64>,
    /// Time and ln|amplitude| of the fastest wave while it is small, and the bound of what is not linear in its
    /// growth then, 1/s.
    amplitudes: VecDeque<(f64, f64, f64)>,
    /// Whether waves are too large for linear theory now.
    large: bool,
    /// Growth of every mode of the verdict's lane since the last change; none until theory was asked.
    modal: Option<ModalGrowth>,
    /// The step from which on it is looked at.
    modal_from: u64,
}

impl Live {
    /// The run of a scenario, at t = 0.
    pub fn new(scenario: &Scenario) -> Result<Self, Error> {
        let simulation = Simulation::new(scenario)?;
        let n = scenario.vehicles;
        let watched = if n < 5 { (0..n).collect() } else { (0..5).map(|k| k * n / 5).collect() };
        let mut live = Self {
            every: scenario.steps(INTERVAL).max(1),
            watched,
            agenda: Vec::new(),
            next: 0,
            changes: 0,
            balance: Vec::new(),
            equilibrium: Equilibrium { speed: 0.0, density: 0.0, flow: 0.0 },
            verdict: StabilitySummary::default(),
            stale: true,
            made: 0,
            columns: VecDeque::new(),
            rows: Vec::new(),
            crossings: VecDeque::new(),
            amplitudes: VecDeque::new(),
            large: false,
            modal: None,
            modal_from: 0,
            simulation,
        };
        live.plan();
        live.consider();
        live.record();
        Ok(live)
    }

    /// The simulation.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }
    /// What theory says now.
    pub fn verdict(&mut self) -> &StabilitySummary {
        if std::mem::take(&mut self.stale) {
            let scenario = self.simulation.scenario();
            let lanes: Vec<Vec<Driver>> = (self.lanes().iter())
                .map(|lane| lane.iter().map(|&j| *self.simulation.driver(j)).collect())
                .collect();
            self.verdict = verdict(&lanes, scenario.length, scenario.time_step);
        }
        &self.verdict
    }
    /// The equilibrium with the vehicles spread evenly over all lanes; the density is that of a lane.
    pub fn equilibrium(&self) -> Equilibrium {
        self.equilibrium
    }
    /// A number that grows whenever [`Self::verdict`] or the drivers have changed.
    pub fn changes(&self) -> u64 {
        self.changes
    }
    /// Vehicles (indices) whose speeds are in the rows.
    pub fn watched(&self) -> &[usize] {
        &self.watched
    }
    /// Seconds between two rows, and two columns of the map.
    pub fn interval(&self) -> f64 {
        self.every as f64 * self.simulation.scenario().time_step
    }
    /// Window of the flow in the rows, s.
    pub fn flow_window(&self) -> f64 {
        self.interval() * FLOW_ROWS as f64
    }
    /// Columns of the map made so far.
    pub fn columns_made(&self) -> u64 {
        self.made
    }
    /// The columns kept, the oldest first.
    pub fn columns(&self) -> &VecDeque<Column> {
        &self.columns
    }
    /// The rows since this was last asked, one after another: time (s), mean speed (m/s), flow through L/2 (veh/s;
    /// NaN until a window has passed), ΔN, speeds of the watched vehicles (m/s).
    pub fn take_rows(&mut self) -> Vec<f64> {
        std::mem::take(&mut self.rows)
    }

    /// At most so many steps. Returns how many were taken.
    pub fn step(&mut self, steps: u32) -> u32 {
        let begin = self.simulation.step_index();
        let end = begin + u64::from(steps);
        while !self.simulation.is_finished() && self.simulation.step_index() < end {
            // As far as there is nothing to look at.
            let step = self.simulation.step_index();
            let row = step + self.every - step % self.every;
            let due = self.agenda.get(self.next).map_or(u64::MAX, |&due| due.max(step + 1));
            self.simulation.run_to(end.min(row).min(due));
            if self.simulation.step_index() > step {
                self.observe();
            }
        }
        (self.simulation.step_index() - begin) as u32
    }

    fn observe(&mut self) {
        let step = self.simulation.step_index();
        if self.agenda.get(self.next).is_some_and(|&due| due <= step) {
            self.consider();
        }
        if step.is_multiple_of(self.every) {
            if self.simulation.vehicles_per_lane() != self.balance {
                self.consider();
            }
            self.record();
        }
    }

    /// Does something now. Of several settings of one parameter at one instant the last stays.
    pub fn act(&mut self, action: Action) -> Result<(), Error> {
        self.simulation.act(action)?;
        self.simulation.forget_replaced();
        self.plan();
        self.consider();
        Ok(())
    }

    /// Moves the end of the run, s.
    pub fn set_until(&mut self, until: f64) -> Result<(), Error> {
        self.simulation.set_until(until)
    }

    fn plan(&mut self) {
        let scenario = self.simulation.scenario();
        self.agenda = scenario.actions_in_time().into_iter().map(|(step, _)| step).collect();
    }

    /// Drivers, lanes or positions have changed: theory is asked anew, and growth is measured from now on.
    fn consider(&mut self) {
        let step = self.simulation.step_index();
        self.next = self.agenda.partition_point(|&due| due <= step);
        let scenario = self.simulation.scenario();
        let drivers: Vec<Driver> = (0..scenario.vehicles).map(|j| *self.simulation.driver(j)).collect();
        self.balance = self.simulation.vehicles_per_lane().to_vec();
        // Spread evenly, every lane holds its share of the headways.
        if let Some(e) = equilibrium(&drivers, scenario.length * scenario.lanes as f64) {
            self.equilibrium = e;
        }
        self.stale = true;
        self.changes += 1;
        self.amplitudes.clear();
        self.modal = None;
        // What the change has excited beside the leading roots is given time to die away.
        let longest = drivers.iter().map(|d| d.reaction_time).fold(0.0, f64::max);
        self.modal_from = step + scenario.steps(20.0 * longest);
    }

    /// Number of modes whose growth is measured, from mode 1 on: twice the fastest mode, but at least 10, at most 40,
    /// and at most as many as the lane has.
    pub fn modes_followed(&self) -> usize {
        let StabilitySummary { lane, mode, .. } = self.verdict;
        let most = self.simulation.vehicles_per_lane()[lane - 1] / 2;
        (2 * mode.unwrap_or(1)).clamp(10, 40).min(most)
    }

    /// Looks at all modes, beyond the fastest by as far again.
    fn record_modes(&mut self) {
        if self.stale {
            return;
        }
        let (lane, modes) = (self.verdict.lane, self.modes_followed());
        let (every, from) = (self.every, self.modal_from);
        let modal = self.modal.get_or_insert_with(|| ModalGrowth::new(every, modes, lane - 1, from, LINEAR));
        if modal.rows() < MODAL_ROWS {
            modal.observe(&self.simulation);
        }
    }

    /// The characteristic roots of the lane that the verdict speaks of: of some `most` modes, each with so many
    /// `others` beside the dominant one.
    pub fn roots(&mut self, others: usize, most: usize) -> Roots {
        let place = self.verdict().lane - 1;
        let drivers = self.lanes()[place].iter().map(|&j| *self.simulation.driver(j)).collect();
        let scenario = self.simulation.scenario();
        let lane = summary::lane(drivers, scenario.time_step);
        roots_of_lane(&lane, scenario.length, scenario.time_step, others, most)
    }

    /// Growth of the modes of that lane since the last change, a row for each: the table `growth`.
    pub fn modal_growth(&self) -> Option<Table> {
        self.modal.as_ref().map(Probe::table)
    }

    /// From when on that growth is looked at, s.
    pub fn modal_from(&self) -> f64 {
        self.modal_from as f64 * self.simulation.scenario().time_step
    }

    /// The vehicles of each lane in the order of the road, from the lowest number on.
    fn lanes(&self) -> Vec<Vec<usize>> {
        let mut lanes = vec![Vec::new(); self.simulation.scenario().lanes];
        for j in 0..self.simulation.vehicles() {
            let lane: &mut Vec<usize> = &mut lanes[self.simulation.lane(j)];
            if lane.is_empty() {
                let mut k = j;
                loop {
                    lane.push(k);
                    k = self.simulation.leader(k);
                    if k == j {
                        break;
                    }
                }
            }
        }
        lanes
    }

    fn record(&mut self) {
        let lanes = self.lanes();
        self.record_column(&lanes);
        self.record_row();
        self.record_amplitude(&lanes);
        self.record_modes();
    }

    fn record_column(&mut self, lanes: &[Vec<usize>]) {
        if self.columns.len() == COLUMNS {
            self.columns.pop_front();
        }
        self.made += 1;
        let mut speeds = vec![f32::NAN; lanes.len() * BINS];
        for (lane, cells) in lanes.iter().zip(speeds.chunks_exact_mut(BINS)) {
            self.fill(lane, cells);
        }
        let (time, equilibrium) = (self.simulation.time(), self.equilibrium.speed);
        self.columns.push_back(Column { time, equilibrium, speeds });
    }

    /// Speed at the centre of every cell, linear between each vehicle and its leader.
    fn fill(&self, lane: &[usize], cells: &mut [f32]) {
        let s = &self.simulation;
        let width = s.scenario().length / cells.len() as f64;
        for &j in lane {
            let (x, gap, v) = (s.position(j), s.headway(j), s.speed(j));
            let ahead = s.speed(s.leader(j));
            let mut cell = (x / width - 0.5).ceil().max(0.0);
            loop {
                let part = ((cell + 0.5) * width - x) / gap;
                // NaN, for a headway of 0, ends it too.
                if part.is_nan() || part >= 1.0 {
                    break;
                }
                cells[cell as usize % cells.len()] = (v + part * (ahead - v)) as f32;
                cell += 1.0;
            }
        }
    }

    fn record_row(&mut self) {
        let s = &self.simulation;
        let (n, length) = (s.vehicles(), s.scenario().length);
        let crossed: f64 = (0..n).map(|j| (s.unwrapped_position(j) / length - 0.5).floor()).sum();
        self.crossings.push_back(crossed);
        let flow = if self.crossings.len() > FLOW_ROWS {
            self.crossings.pop_front().map_or(f64::NAN, |before| (crossed - before) / self.flow_window())
        } else {
            f64::NAN
        };
        let mean = s.speeds().iter().sum::<f64>() / n as f64;
        let per_lane = s.vehicles_per_lane();
        let imbalance = per_lane.iter().max().unwrap_or(&0) - per_lane.iter().min().unwrap_or(&0);
        let width = 4 + self.watched.len();
        if self.rows.len() >= width * COLUMNS {
            self.rows.drain(..width);
        }
        self.rows.extend([s.time(), mean, flow, imbalance as f64]);
        self.rows.extend(self.watched.iter().map(|&j| s.speed(j)));
    }

    fn record_amplitude(&mut self, lanes: &[Vec<usize>]) {
        if lanes.len() == 1 {
            self.verdict();
        }
        if self.stale {
            return;
        }
        let (Some(mode), Some(lane)) = (self.verdict.mode, lanes.get(self.verdict.lane - 1)) else { return };
        let s = &self.simulation;
        let angle = -std::f64::consts::TAU * mode as f64 / lane.len() as f64;
        let (cos, sin) = (libm::cos(angle), libm::sin(angle));
        let (mut turn, mut sum) = ((1.0, 0.0), (0.0, 0.0));
        // The largest deviation as a part of the gap to the minimum headway.
        let mut largest = 0.0_f64;
        // As in the table of growth.
        let (mut second_order, mut slope) = (0.0, 0.0_f64);
        for &j in lane {
            let driver = s.driver(j);
            let rest = driver.headway(self.verdict.equilibrium.speed);
            let deviation = s.headway(j) - rest;
            largest = largest.max(deviation.abs() / (rest - driver.min_headway));
            second_order += driver.sensitivity / driver.max_speed * deviation * deviation;
            slope = slope.max(driver.slope(rest));
            sum = (sum.0 + deviation * turn.0, sum.1 + deviation * turn.1);
            turn = (turn.0 * cos - turn.1 * sin, turn.0 * sin + turn.1 * cos);
        }
        let amplitude = libm::hypot(sum.0, sum.1) / lane.len() as f64;
        let twice = if 2 * mode == lane.len() { 1.0 } else { 2.0 };
        let share = second_order / lane.len() as f64 / (twice * amplitude);
        let bound = 2.0 * slope * libm::sin(-0.5 * angle) * share;
        if amplitude < ROUNDING {
            self.amplitudes.clear();
            return;
        }
        // What was measured before the waves became large stays; it begins anew when they are small again.
        if self.large && largest < SMALL / 4.0 {
            self.large = false;
            self.amplitudes.clear();
        }
        self.large |= largest > SMALL;
        if self.large {
            return;
        }
        self.amplitudes.push_back((self.simulation.time(), libm::log(amplitude), bound));
        while self.amplitudes.front().is_some_and(|a| a.0 < self.simulation.time() - GROWTH_WINDOW) {
            self.amplitudes.pop_front();
        }
    }

    /// Whether waves are too large now for linear theory to speak of them.
    pub fn is_large(&self) -> bool {
        self.large
    }

    /// Growth of the wave that theory calls the fastest, over the last minute in which all waves were small, or
    /// since the last change; none before ten seconds of that have been seen.
    pub fn growth(&self) -> Option<MeasuredGrowth> {
        let n = self.amplitudes.len() as f64;
        let window = self.amplitudes.back()?.0 - self.amplitudes.front()?.0;
        if window < 10.0 || n < 5.0 {
            return None;
        }
        let t = self.amplitudes.iter().map(|a| a.0).sum::<f64>() / n;
        let y = self.amplitudes.iter().map(|a| a.1).sum::<f64>() / n;
        let tt: f64 = self.amplitudes.iter().map(|a| (a.0 - t) * (a.0 - t)).sum();
        let ty: f64 = self.amplitudes.iter().map(|a| (a.0 - t) * (a.1 - y)).sum();
        let rate = ty / tt;
        let rest = |a: &(f64, f64, f64)| a.1 - y - rate * (a.0 - t);
        let squares: f64 = self.amplitudes.iter().map(|a| rest(a) * rest(a)).sum();
        let (first, last) = (self.amplitudes.front()?.0, self.amplitudes.back()?.0);
        let weight = |a: &(f64, f64, f64)| (a.0 - first) * (last - a.0);
        let bounds: f64 = self.amplitudes.iter().map(|a| weight(a) * a.2).sum();
        Some(MeasuredGrowth {
            rate,
            standard_error: libm::sqrt(squares / (n - 2.0) / tt),
            nonlinear_bound: bounds / self.amplitudes.iter().map(weight).sum::<f64>(),
            window,
            mode: self.verdict.mode?,
        })
    }

    /// What this run has been so far, as a scenario of its own: it ends now.
    pub fn so_far(&self) -> Scenario {
        let mut scenario = self.simulation.scenario().clone();
        // The step in which vehicles touch belongs to the run.
        let steps = self.simulation.step_index() + u64::from(self.simulation.collision().is_some());
        scenario.until = scenario.time_of(steps);
        scenario
    }

    /// A fresh start with what holds now: what was set for all drivers on the way becomes the default driver, and
    /// of the actions those at t = 0 remain and those still to come.
    pub fn settled(&self) -> Scenario {
        let mut scenario = self.simulation.scenario().clone();
        let now = self.simulation.step_index();
        let set_for_all: Vec<_> = (scenario.actions_in_time().into_iter())
            .filter(|&(step, k)| step <= now && scenario.actions[k].who == VehicleSelector::All)
            .flat_map(|(_, k)| scenario.actions[k].effects.clone())
            .filter_map(|effect| if let Effect::Set(p, value) = effect { Some((p, value)) } else { None })
            .collect();
        for (parameter, value) in set_for_all {
            assign(&mut scenario.driver, parameter, value);
            for exception in &mut scenario.exceptions {
                exception.values.retain(|(p, _)| *p != parameter);
            }
        }
        scenario.exceptions.retain(|e| !e.values.is_empty());
        let is_set = |e: &Effect| matches!(e, Effect::Set(..));
        let steps = |a: &Action| (a.at / scenario.time_step).round() as u64;
        let is_settled = |a: &Action| a.who == VehicleSelector::All && a.effects.iter().all(is_set);
        scenario.actions.retain(|a| steps(a) > now || steps(a) == 0 && !is_settled(a));
        scenario
    }

    /// The scenario that a parameter (or `start`) set to `text` leads to, if it must start again; `None` where it
    /// is set on the way.
    pub fn with(&self, name: &str, text: &str) -> Result<Scenario, Error> {
        let mut scenario = self.settled();
        if name == "start" {
            scenario.start = text.parse()?;
        } else {
            let parameter = named(name)?;
            parameter.set(&mut scenario, parameter.parse(text)?)?;
            if name == "vehicles" {
                let n = scenario.vehicles;
                scenario.actions.retain(|a| a.who.check(n).is_ok());
            }
        }
        scenario.validate()?;
        Ok(scenario)
    }

    /// Sets a parameter. A driver's holds for all drivers from now on; any other, and every one at t = 0 or after
    /// a collision, starts the run again with what was set.
    /// Returns whether it started again.
    pub fn set(&mut self, name: &str, text: &str) -> Result<bool, Error> {
        let running = self.simulation.step_index() > 0 && self.simulation.collision().is_none();
        if name == "until" {
            let parameter = named(name)?;
            return self.set_until(parameter.parse(text)?).map(|()| false);
        }
        if running && name != "start" && named(name)?.is_of_driver() {
            let parameter = named(name)?;
            let value = parameter.parse(text)?;
            let action =
                Action { at: 0.0, who: VehicleSelector::All, effects: vec![Effect::Set(parameter, value)] };
            return self.act(action).map(|()| false);
        }
        *self = Self::new(&self.with(name, text)?)?;
        Ok(true)
    }

    /// What theory would say after [`Self::set`].
    pub fn preview(&self, name: &str, text: &str) -> Result<StabilitySummary, Error> {
        let scenario = self.with(name, text)?;
        let drivers = scenario.drivers();
        let mut rest = drivers.as_slice();
        let mut lanes = Vec::new();
        let balance =
            if scenario.vehicles == self.simulation.vehicles() && scenario.lanes == self.balance.len() {
                self.balance.clone()
            } else {
                scenario.vehicles_per_lane()
            };
        for count in balance {
            let (lane, others) = rest.split_at(count);
            lanes.push(lane.to_vec());
            rest = others;
        }
        Ok(verdict(&lanes, scenario.length, scenario.time_step))
    }

    /// What theory would say at that reaction time with so many vehicles on all lanes, both as typed; without a number,
    /// with the vehicles in the lanes where they are now.
    pub fn preview_point(
        &self,
        vehicles: Option<&str>,
        reaction_time: &str,
    ) -> Result<StabilitySummary, Error> {
        match vehicles {
            None => self.preview("reaction_time", reaction_time),
            Some(n) => Self::new(&self.with("vehicles", n)?)?.preview("reaction_time", reaction_time),
        }
    }

    /// The stability plane of the lane that the verdict speaks of: of its drivers where they are alike, else of
    /// those without an exception. Its driver has the reaction time where the lane stands in the plane.
    pub fn plane(&mut self) -> StabilityDiagram {
        let &StabilitySummary { alike, lane, .. } = self.verdict();
        let settled = self.settled();
        let first = (0..self.simulation.vehicles()).find(|&j| alike && self.simulation.lane(j) + 1 == lane);
        let driver = first.map_or(settled.driver, |j| *self.simulation.driver(j));
        StabilityDiagram { driver, ..StabilityDiagram::of(&settled) }
    }

    /// The same scenario from its beginning, with all its actions, or with those at t = 0 only.
    pub fn restarted(&self, keep_actions: bool) -> Result<Self, Error> {
        let mut scenario = self.simulation.scenario().clone();
        if !keep_actions {
            let steps: Vec<_> = scenario.actions.iter().map(|a| scenario.steps(a.at)).collect();
            let mut k = 0;
            scenario.actions.retain(|_| {
                k += 1;
                steps[k - 1] == 0
            });
        }
        Self::new(&scenario)
    }

    /// The same scenario from its beginning without the action at that place of the list.
    pub fn without(&self, index: usize) -> Result<Self, Error> {
        let mut scenario = self.simulation.scenario().clone();
        if index >= scenario.actions.len() {
            let allowed = format!("a place from 1 to {}", scenario.actions.len());
            return Err(Error::new("actions", index + 1, allowed));
        }
        scenario.actions.remove(index);
        Self::new(&scenario)
    }
}

fn named(name: &str) -> Result<&'static Parameter, Error> {
    Parameter::named(name).ok_or_else(|| {
        let names: Vec<_> =
            crate::scenario::parameters::PARAMETERS.iter().map(Parameter::hyphenated).collect();
        Error::new("parameter", quoted(name), names.join(", "))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(link: &str, seconds: f64) -> Live {
        let mut live = Live::new(&link::parse(link).scenario).unwrap();
        let steps = live.simulation().scenario().steps(seconds) as u32;
        assert_eq!(live.step(steps), steps);
        live
    }

    /// In the linear regime the amplitude of the fastest mode follows its root.
    #[test]
    fn growth_measured_agrees_with_theory_on_both_sides() {
        for (delta, grows) in [("0.6", false), ("0.72", true)] {
            let mut live = run(&format!("reaction-time={delta}&action=at%3D0%3A1%3Anudge%3D0.1"), 200.0);
            let (verdict, growth) = (*live.verdict(), live.growth().unwrap());
            assert_eq!((verdict.stable, growth.rate > 0.0), (Some(!grows), grows));
            let predicted = verdict.rate.unwrap();
            assert!(
                (growth.rate - predicted).abs() < 0.01 * predicted.abs(),
                "{growth:?}, predicted {predicted}"
            );
            assert_eq!(growth.window, GROWTH_WINDOW);
            assert!((growth.rate - predicted).abs() < growth.nonlinear_bound + 3.0 * growth.standard_error);
            assert!(growth.nonlinear_bound > 0.0 && growth.nonlinear_bound < 0.1 * predicted.abs());
        }
    }

    /// With several lanes the plane is of the lane that the verdict speaks of, and a point of it says what the run does
    /// that is started there.
    #[test]
    fn plane_and_verdict_speak_of_the_same_lane() {
        let mut live = run("vehicles=50&lanes=2&reaction-time=0.75", 0.0);
        let verdict = *live.verdict();
        let tau = live.plane().curves([verdict.vehicles]).discrete_s[0];
        assert_eq!((verdict.lane, verdict.vehicles, verdict.critical_discrete), (1, 25, tau));
        let foreseen = live.preview_point(Some("80"), "0.9").unwrap();
        assert_eq!((foreseen.vehicles, foreseen.stable), (40, Some(false)));
        live.set("reaction-time", "0.9").unwrap();
        live.set("vehicles", "80").unwrap();
        assert_eq!(foreseen, *live.verdict());

        // A lane of exceptions only has a plane of its own; a lane that is mixed has that of the others.
        let mut live = run("vehicles=50&lanes=2&driver=1-25:sensitivity=2,reaction-time=0.4", 0.0);
        let (verdict, driver) = (*live.verdict(), live.plane().driver);
        assert_eq!((verdict.lane, verdict.alike), (1, true));
        assert_eq!((driver.sensitivity, driver.reaction_time), (2.0, 0.4));
        let mut live = run("reaction-time=0.7&driver=1-25:sensitivity=2,reaction-time=0.4", 0.0);
        assert!(!live.verdict().alike);
        assert_eq!((live.plane().driver.sensitivity, live.plane().driver.reaction_time), (1.0, 0.7));
    }

    #[test]
    fn the_map_holds_the_speed_of_every_vehicle_at_its_place_and_a_bounded_number_of_columns() {
        let live = run("vehicles=20&reaction-time=0.3&lanes=2&action=at%3D0%3A1%3Anudge%3D5", 400.0);
        assert_eq!((live.columns().len(), live.columns_made()), (COLUMNS, 801));
        let (s, newest) = (live.simulation(), live.columns().back().unwrap());
        assert_eq!(newest.time, s.time());
        assert!(newest.speeds.iter().all(|v| v.is_finite()));
        let width = s.scenario().length / BINS as f64;
        for j in 0..s.vehicles() {
            // Speed falls or rises by less than 0.1 m/s within a cell here.
            let cell = (s.position(j) / width) as usize % BINS;
            let shown = f64::from(newest.speeds[s.lane(j) * BINS + cell]);
            assert!((shown - s.speed(j)).abs() < 0.1, "vehicle {}: {shown} for {}", j + 1, s.speed(j));
        }
    }

    /// Uniform traffic crosses every place at the equilibrium flow, up to one vehicle a window.
    #[test]
    fn flow_is_the_equilibrium_flow() {
        let mut live = run("", 60.0);
        let width = 4 + live.watched().len();
        let rows = live.take_rows();
        assert_eq!(rows.len(), 121 * width);
        let flow = 50.0 / 1000.0 * live.equilibrium().speed;
        let flows: Vec<_> = rows.chunks(width).map(|row| row[2]).filter(|q| !q.is_nan()).collect();
        assert_eq!(flows.len(), 121 - FLOW_ROWS);
        assert!(flows.iter().all(|q| (q - flow).abs() <= 1.0 / live.flow_window()), "{flow}");
        assert!(live.take_rows().is_empty());
    }

    #[test]
    fn a_driver_is_set_on_the_way_and_the_road_starts_again_with_what_was_set() {
        let mut live = run("action=at%3D0%3A1%3Anudge%3D1", 10.0);
        assert!(!live.set("reaction-time", "0.5").unwrap());
        assert!(live.act("at=0:7:brake=1".parse().unwrap()).is_ok());
        assert_eq!(live.simulation().scenario().actions[1].to_string(), "at=10:all:reaction-time=0.5");
        live.step(100);
        assert!(live.set("vehicles", "40").unwrap());
        let scenario = live.simulation().scenario();
        assert_eq!((scenario.vehicles, scenario.driver.reaction_time), (40, 0.5));
        assert_eq!(scenario.actions.len(), 1, "the nudge at t = 0 only");
        assert_eq!(live.simulation().step_index(), 0);
        let before = live.simulation().scenario().clone();
        assert!(live.set("vehicles", "300").is_err() && live.set("colour", "1").is_err());
        assert_eq!(*live.simulation().scenario(), before, "a refusal changes nothing");
    }

    #[test]
    fn what_is_still_to_come_is_kept_where_the_road_starts_again() {
        let actions = "action=at%3D5%3A7%3Abrake%3D3&action=at%3D20%3A45%3Anudge%3D1&action=at%3D30%3Aall%3Asensitivity%3D2";
        let kept = |seconds: f64, vehicles: &str| {
            let mut live = run(actions, seconds);
            live.set("vehicles", vehicles).unwrap();
            live.simulation().scenario().actions.iter().map(Action::to_string).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(kept(0.0, "60"), "at=5:7:brake=3 at=20:45:nudge=1 at=30:all:sensitivity=2");
        assert_eq!(kept(10.0, "60"), "at=20:45:nudge=1 at=30:all:sensitivity=2");
        assert_eq!(kept(10.0, "40"), "at=30:all:sensitivity=2", "there is no vehicle 45");
    }

    #[test]
    fn what_is_set_again_at_the_same_instant_is_kept_once() {
        let mut live = run("reaction-time=0.6&action=at%3D20%3A9%3Abrake%3D1", 5.0);
        let act = |live: &mut Live, text: &str| live.act(Action::at(0.0, text).unwrap()).unwrap();
        for text in ["all:reaction-time=0.3", "7:nudge=1", "3:brake=2"] {
            act(&mut live, text);
        }
        live.set("sensitivity", "1.2").unwrap();
        for text in ["7:nudge=1", "3:brake=3", "all:reaction-time=0.7"] {
            act(&mut live, text);
        }
        // A longer headway needs the shorter vehicle, so that this stays.
        for text in ["5:vehicle-length=4", "5:min-headway=4.5", "5:vehicle-length=4.2"] {
            act(&mut live, text);
        }
        let texts = |live: &Live| {
            live.simulation().scenario().actions.iter().map(Action::to_string).collect::<Vec<_>>().join(" ")
        };
        let kept = "at=20:9:brake=1 at=5:7:nudge=1 at=5:all:sensitivity=1.2 at=5:7:nudge=1 at=5:3:brake=3 \
                    at=5:all:reaction-time=0.7 at=5:5:vehicle-length=4 at=5:5:min-headway=4.5 \
                    at=5:5:vehicle-length=4.2";
        assert_eq!(texts(&live), kept);
        // Another instant is another action.
        live.step(1);
        act(&mut live, "all:reaction-time=0.65");
        assert_eq!(texts(&live), format!("{kept} at=5.01:all:reaction-time=0.65"));
        is_replayed(live);
    }

    #[test]
    fn what_is_still_to_come_stays_where_something_is_set_again() {
        let live = |actions: &str| {
            let mut live = run(&format!("reaction-time=0.6&{actions}"), 5.0);
            live.act("at=0:3:sensitivity=1.3".parse().unwrap()).unwrap();
            let count = live.simulation().scenario().actions.len();
            is_replayed(live);
            count
        };
        assert_eq!(live("action=at%3D5%3A3%3Asensitivity%3D1.1&action=at%3D20%3A9%3Abrake%3D1"), 2);
        // A share is drawn by its place in the list.
        assert_eq!(live("action=at%3D5%3A3%3Asensitivity%3D1.1&action=at%3D20%3A20%25%3Abrake%3D1"), 3);
    }

    /// The rest of the run, and all of it again.
    fn is_replayed(mut live: Live) {
        live.step(2500);
        let mut replay = Simulation::new(&live.so_far()).unwrap();
        replay.run_to(u64::MAX);
        for j in 0..replay.vehicles() {
            let [a, b] = [&replay, live.simulation()].map(|s| s.unwrapped_position(j).to_bits());
            assert_eq!(a, b, "vehicle {}", j + 1);
        }
    }

    #[test]
    fn a_replay_of_the_run_so_far_ends_in_the_same_state() {
        let mut live = run("reaction-time=0.6&lanes=2&start=random", 15.0);
        live.act("at=0:3:brake=2".parse().unwrap()).unwrap();
        live.step(777);
        let mut replay = Simulation::new(&live.so_far()).unwrap();
        replay.run_to(u64::MAX);
        let bits =
            |s: &Simulation| (0..s.vehicles()).map(|j| s.unwrapped_position(j).to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&replay), bits(live.simulation()));
        // A collision belongs to the run so far.
        let mut crash =
            Live::new(&link::parse("reaction-time=1.2&action=at%3D0%3A1%3Anudge%3D1").scenario).unwrap();
        crash.step(100_000);
        let mut replay = Simulation::new(&crash.so_far()).unwrap();
        replay.run_to(u64::MAX);
        assert_eq!(replay.collision(), crash.simulation().collision());
        assert!(replay.collision().is_some());
    }
}
