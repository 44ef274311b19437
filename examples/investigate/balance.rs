//! Load balance and lane changes: readings of the paper, and plausible slips in its program, at the paper's r and p.
//! (Over r and p: `maps.rs`.)

use crate::lanes::{Attempt, Clearance, Lanes, N, Order, Passes, Reading, Rise};
use rayon::prelude::*;
use ringroad::reproduction::claim::{Estimate, Expected};
use ringroad::reproduction::{Figure, Size};
use ringroad::scenario::driver::Driver;
use std::ops::RangeInclusive;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The numbers of the paper with the tolerances of the table of claims. A statement is met like a claim: when the 95 %
/// interval of our mean overlaps the interval of the tolerance.
pub const AT_30: Expected = Expected::About(5.0, 1.0);
pub const LATE: Expected = Expected::About(5.0, 1.0);
pub const FLOW: Expected = Expected::About(1.0, 0.05);
pub const AGGRESSIVE: Expected = Expected::About(12.0, 0.5);
pub const CONTROL: Expected = Expected::About(3.0, 0.5);

/// The results of a reading: means over the seeds, with 95 % confidence intervals.
#[derive(Clone, Copy, Debug)]
pub struct Outcome {
    /// ΔN at 30 s, and its mean from 30 to 100 s.
    pub at_30: Estimate,
    pub late: Estimate,
    /// Flow from 30 to 100 s, veh/s.
    pub flow: Estimate,
    /// Lane changes in 500 s of the aggressive driver and of the mean of its two neighbours.
    pub aggressive: Estimate,
    pub control: Estimate,
    /// Runs that end in a collision; the means are over the others.
    pub crashed: usize,
}

pub const HEADER: &str =
    "ΔN at 30 s | ΔN 30–100 s | Q (veh/s) | changes, aggressive | changes, control | collisions | meets |";

impl Outcome {
    /// ΔN is about 5 at 30 s and stays there.
    pub fn balance(&self) -> bool {
        AT_30.is_met_by(self.at_30) && LATE.is_met_by(self.late)
    }
    pub fn q(&self) -> bool {
        FLOW.is_met_by(self.flow)
    }
    pub fn changes(&self) -> bool {
        AGGRESSIVE.is_met_by(self.aggressive) && CONTROL.is_met_by(self.control)
    }
    /// How many of the three statements are met.
    pub fn met(&self) -> u8 {
        u8::from(self.balance()) + u8::from(self.q()) + u8::from(self.changes())
    }
    pub fn row(&self) -> String {
        let words = |e: Estimate, digits: usize| format!("{:.digits$} ± {:.digits$}", e.value, e.uncertainty);
        format!(
            "{} | {} | {} | {} | {} | {} | {}{}{}",
            words(self.at_30, 1),
            words(self.late, 1),
            words(self.flow, 3),
            words(self.aggressive, 1),
            words(self.control, 1),
            self.crashed,
            if self.balance() { "ΔN " } else { "" },
            if self.q() { "Q " } else { "" },
            if self.changes() { "Δl" } else { "" }
        )
    }
}

/// ΔN at 30 s, its mean and the flow (veh/s) from 30 to 100 s; `None` after a collision.
fn load_balance(reading: Reading, seed: u64) -> Option<[f64; 3]> {
    let steps = |seconds: f64| (seconds / reading.dt).round() as usize;
    let mut lanes = Lanes::new(reading, false, seed);
    let (mut at_30, mut late, mut passed) = (0.0, 0.0, 0.0);
    for k in 0..steps(100.0) {
        if k == steps(30.0) {
            at_30 = lanes.imbalance();
            passed = lanes.passings();
        }
        if k >= steps(30.0) {
            late += lanes.imbalance();
        }
        lanes.step();
    }
    (!lanes.crashed).then(|| [at_30, late / steps(70.0) as f64, (lanes.passings() - passed) / 70.0])
}

/// Lane changes in 500 s of the aggressive driver and of its two neighbours (their mean); `None` after a collision.
fn lane_changes(reading: Reading, seed: u64) -> Option<[f64; 2]> {
    let mut lanes = Lanes::new(reading, true, seed);
    for _ in 0..(500.0 / reading.dt).round() as usize {
        lanes.step();
    }
    let control = 0.5 * f64::from(lanes.changes[N / 2] + lanes.changes[N / 2 + 1]);
    (!lanes.crashed).then(|| [f64::from(lanes.changes[0]), control])
}

/// Runs both experiments with these seeds. They differ in p as in the paper: 0.2 for load balance, 0.1 for lane changes.
pub fn measure(reading: Reading, seeds: RangeInclusive<u64>) -> Outcome {
    let halved = Reading { p: 0.5 * reading.p, ..reading };
    let balance: Vec<_> = seeds.clone().map(|seed| load_balance(reading, seed)).collect();
    let changes: Vec<_> = seeds.map(|seed| lane_changes(halved, seed)).collect();
    let of_balance = |k: usize| Estimate::mean(&balance.iter().flatten().map(|v| v[k]).collect::<Vec<_>>());
    let of_changes = |k: usize| Estimate::mean(&changes.iter().flatten().map(|v| v[k]).collect::<Vec<_>>());
    Outcome {
        at_30: of_balance(0),
        late: of_balance(1),
        flow: of_balance(2),
        aggressive: of_changes(0),
        control: of_changes(1),
        crashed: balance.iter().filter(|v| v.is_none()).count()
            + changes.iter().filter(|v| v.is_none()).count(),
    }
}

/// The results of many readings, on all cores; progress goes to the standard error.
pub fn all(readings: &[Reading], seeds: &RangeInclusive<u64>) -> Vec<(Reading, Outcome)> {
    let done = AtomicUsize::new(0);
    let one = |&reading: &Reading| {
        let outcome = measure(reading, seeds.clone());
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        if done.is_multiple_of(200) {
            eprintln!("{done} of {}", readings.len());
        }
        (reading, outcome)
    };
    readings.par_iter().map(one).collect()
}

/// Prints how many readings meet which statements.
pub fn summary(results: &[(Reading, Outcome)]) {
    let count = |f: &dyn Fn(&Outcome) -> bool| results.iter().filter(|r| f(&r.1)).count();
    println!("| statement | readings of {} that meet it |\n|---|---|", results.len());
    println!("| ΔN = 5 ± 1 at 30 s and from 30 to 100 s | {} |", count(&Outcome::balance));
    println!("| Q = 1.0 ± 0.05 veh/s from 30 to 100 s | {} |", count(&Outcome::q));
    println!("| 12 ± 0.5 and 3 ± 0.5 lane changes in 500 s | {} |", count(&Outcome::changes));
    println!("| ΔN and Q | {} |", count(&|r| r.balance() && r.q()));
    println!("| ΔN and lane changes | {} |", count(&|r| r.balance() && r.changes()));
    println!("| Q and lane changes | {} |", count(&|r| r.q() && r.changes()));
    println!("| all three | {} |\n", count(&|r| r.met() == 3));
}

pub const READING: &str = "gap | rise | attempt | passes | order | φ is 0 after | dt";

/// Prints the readings that meet at least `least` statements, at most `most` of them.
pub fn those_that_meet(results: &[(Reading, Outcome)], least: u8, most: usize, with_r_and_p: bool) {
    let first = if with_r_and_p { "r | p | " } else { "" };
    let rules = "---|".repeat(if with_r_and_p { 16 } else { 14 });
    println!("| {first}{READING} | {HEADER}\n|{rules}");
    for (reading, outcome) in results.iter().filter(|r| r.1.met() >= least).take(most) {
        let first =
            if with_r_and_p { format!("{:.3} | {:.3} | ", reading.r, reading.p) } else { String::new() };
        println!("| {first}{reading} | {} |", outcome.row());
    }
}

pub fn main() {
    let literal = Reading::literal(0.1, 0.2);
    agrees_with_the_core(literal);

    println!("## One thing changed at a time, r = 0.1, p = 0.2 and 0.1; 40 runs, seeds 1 to 40\n");
    let singles = singles(literal);
    let readings: Vec<Reading> = singles.iter().map(|s| s.1).collect();
    let results = all(&readings, &(1..=40));
    println!("| changed | {HEADER}\n|---|---|---|---|---|---|---|---|");
    for ((name, _), (_, outcome)) in singles.iter().zip(&results) {
        println!("| {name} | {} |", outcome.row());
    }
    chance();

    println!("\n## Every combination, r = 0.1, p = 0.2 and 0.1; 20 runs, seeds 1 to 20\n");
    let results = all(&combinations(literal), &(1..=20));
    summary(&results);
    println!("Those that meet at least two:\n");
    those_that_meet(&results, 2, 40, false);
}

/// Prints ΔN of two lanes filled by tossing a coin for every vehicle, and their flow with each lane in equilibrium.
fn chance() {
    let driver = Driver::default();
    let flow = |n: usize| driver.flow(n as f64 / 1000.0);
    let (mut weight, mut total, mut mean, mut square, mut flows) = (1.0, 0.0, 0.0, 0.0, 0.0);
    for k in 0..=N {
        let difference = (2 * k).abs_diff(N) as f64;
        total += weight;
        mean += weight * difference;
        square += weight * difference * difference;
        flows += weight * (flow(k) + flow(N - k));
        weight *= (N - k) as f64 / (k + 1) as f64;
    }
    let mean = mean / total;
    println!(
        "\nTwo lanes filled by tossing a coin for every vehicle have a mean ΔN of {mean:.2}, with a standard deviation of {:.2}; their flow at equilibrium is {:.3} veh/s, against {:.3} of two lanes of 25.",
        (square / total - mean * mean).sqrt(),
        flows / total,
        2.0 * flow(25)
    );
}

pub const PASSES: [Passes; 5] =
    [Passes::Alongside, Passes::FarSideToo, Passes::Wrapped, Passes::NextChanged, Passes::Never];

/// The literal reading, then readings with one choice changed.
pub fn singles(literal: Reading) -> Vec<(String, Reading)> {
    let mut list = vec![("nothing".to_owned(), literal)];
    let mut add = |name: String, reading| list.push((name, reading));
    add("gap: C instead of d".into(), Reading { clearance: Clearance::Length, ..literal });
    for rise in [Rise::TimesOtherStep, Rise::WholeR] {
        add(format!("φ: {rise:?}"), Reading { rise, ..literal });
    }
    for attempt in [Attempt::Twice, Attempt::EveryStep] {
        add(format!("attempt: {attempt:?}"), Reading { attempt, ..literal });
    }
    for passes in &PASSES[1..] {
        add(format!("passes: {passes:?}"), Reading { passes: *passes, ..literal });
    }
    for order in [Order::Backwards, Order::Together] {
        add(format!("order: {order:?}"), Reading { order, ..literal });
    }
    add("φ: 0 after every attempt".into(), Reading { reset_always: true, ..literal });
    for dt in [0.01, 0.1, 0.25, 0.5] {
        add(format!("dt = {dt} s"), Reading { dt, ..literal });
    }
    list
}

/// Every combination of clearance, rise, attempt, passes, order and reset.
pub fn combinations(literal: Reading) -> Vec<Reading> {
    let mut readings = Vec::new();
    for clearance in [Clearance::MinHeadway, Clearance::Length] {
        for rise in [Rise::TimesStep, Rise::TimesOtherStep, Rise::WholeR] {
            for attempt in [Attempt::Rescaled, Attempt::Twice, Attempt::EveryStep] {
                for passes in PASSES {
                    for order in [Order::InTurn, Order::Together] {
                        for reset_always in [false, true] {
                            readings.push(Reading {
                                clearance,
                                rise,
                                attempt,
                                passes,
                                order,
                                reset_always,
                                ..literal
                            });
                        }
                    }
                }
            }
        }
    }
    readings
}

/// Prints the literal reading here beside the core.
///
/// # Panics
/// If the two differ by more than the noise of their runs.
fn agrees_with_the_core(literal: Reading) {
    let here = measure(literal, 1..=200);
    let claims = |id: &str| Figure::named(id).expect("a figure").outcome(Size::Full, &|| {}).claims;
    let (balance, aggressive) = (claims("load-balance"), claims("aggressive-driver"));
    println!("| literal reading | core, 10 and 20 runs | here, 200 runs |\n|---|---|---|");
    for (name, claims, words, here) in [
        ("ΔN at 30 s", &balance, "about 5 at 30 s", here.at_30),
        ("ΔN, mean from 30 to 100 s", &balance, "keeps oscillating", here.late),
        ("flow (veh/s)", &balance, "about 1.0 veh/s", here.flow),
        ("lane changes, aggressive", &aggressive, "of the aggressive driver in 500", here.aggressive),
        ("lane changes, control", &aggressive, "of a control driver in 500", here.control),
    ] {
        let core = claims.iter().find(|c| c.claim.contains(words)).expect("a claim").ours();
        println!(
            "| {name} | {:.3} ± {:.3} | {:.3} ± {:.3} |",
            core.value, core.uncertainty, here.value, here.uncertainty
        );
        let noise = core.uncertainty.hypot(here.uncertainty);
        assert!((core.value - here.value).abs() <= 1.5 * noise, "{name} differs from the core");
    }
    println!();
}
