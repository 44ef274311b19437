//! (c) Load balance and lane changes over (r, p) and over readings and slips.

use crate::lanes::{Attempt, Gap, Lanes, N, Order, Passes, Reading, Rise};
use rayon::prelude::*;
use ringroad::figure::{Figure, Size};
use std::sync::Mutex;

/// What the runs of a reading give: means over seeds 1 to `runs`.
#[derive(Clone, Copy, Debug, Default)]
struct Result {
    /// ΔN at 30 s, and its mean from 30 to 100 s.
    at_30: f64,
    late: f64,
    /// Flow from 30 to 100 s, veh/s.
    flow: f64,
    /// Lane changes in 500 s of the aggressive driver and of the mean of its two neighbours.
    aggressive: f64,
    control: f64,
    /// Share of the runs that end in a collision.
    crashed: f64,
}

/// Late ΔN of 5 ± 1.5, flow of 1.0 ± 0.05 veh/s, 12 ± 2 and 3 ± 1 lane changes: wider than the claims' tolerances, so
/// that chance does not hide a reading.
impl Result {
    fn balance(&self) -> bool {
        (self.at_30 - 5.0).abs() <= 1.5 && (self.late - 5.0).abs() <= 1.5
    }
    fn flow(&self) -> bool {
        (self.flow - 1.0).abs() <= 0.05
    }
    fn changes(&self) -> bool {
        (self.aggressive - 12.0).abs() <= 2.0 && (self.control - 3.0).abs() <= 1.0
    }
    fn row(&self) -> String {
        format!(
            "{:.1} | {:.1} | {:.2} | {:.1} | {:.1} | {:.0} % | {}{}{}",
            self.at_30,
            self.late,
            self.flow,
            self.aggressive,
            self.control,
            100.0 * self.crashed,
            if self.balance() { "ΔN " } else { "" },
            if self.flow() { "Q " } else { "" },
            if self.changes() { "Δl" } else { "" }
        )
    }
}
const HEADER: &str =
    "ΔN at 30 s | ΔN 30–100 s | Q (veh/s) | changes, aggressive | changes, control | collisions | meets |";

/// `balance` and `aggressive` differ in p only: 0.2 and 0.1 in the paper.
fn measure(reading: Reading, runs: u64) -> Result {
    let mut sum = Result::default();
    let steps = |seconds: f64| (seconds / reading.dt).round() as usize;
    for seed in 1..=runs {
        let mut lanes = Lanes::new(reading, false, seed);
        let (mut late, mut passed) = (0.0, 0.0);
        for k in 0..steps(100.0) {
            if k == steps(30.0) {
                sum.at_30 += lanes.imbalance();
                passed = lanes.passings();
            }
            if k >= steps(30.0) {
                late += lanes.imbalance();
            }
            lanes.step();
        }
        sum.late += late / steps(70.0) as f64;
        sum.flow += (lanes.passings() - passed) / 70.0;
        let mut crashed = lanes.crashed;
        let mut lanes = Lanes::new(Reading { p: 0.5 * reading.p, ..reading }, true, seed);
        for _ in 0..steps(500.0) {
            lanes.step();
            if lanes.crashed {
                break;
            }
        }
        crashed |= lanes.crashed;
        sum.aggressive += f64::from(lanes.changes[0]);
        sum.control += 0.5 * f64::from(lanes.changes[N / 2] + lanes.changes[N / 2 + 1]);
        sum.crashed += f64::from(u8::from(crashed));
    }
    let n = runs as f64;
    Result {
        at_30: sum.at_30 / n,
        late: sum.late / n,
        flow: sum.flow / n,
        aggressive: sum.aggressive / n,
        control: sum.control / n,
        crashed: sum.crashed / n,
    }
}

fn all(readings: &[Reading], runs: u64) -> Vec<(Reading, Result)> {
    let done = Mutex::new(0);
    readings
        .par_iter()
        .map(|&r| {
            let result = measure(r, runs);
            let mut done = done.lock().expect("counting");
            *done += 1;
            if *done % 50 == 0 {
                eprintln!("{done} of {}", readings.len());
            }
            (r, result)
        })
        .collect()
}

fn summary(results: &[(Reading, Result)]) {
    let count = |f: &dyn Fn(&Result) -> bool| results.iter().filter(|r| f(&r.1)).count();
    println!("| statement | readings of {} that meet it |\n|---|---|", results.len());
    println!("| ΔN = 5 ± 1.5 at 30 s and from 30 to 100 s | {} |", count(&Result::balance));
    println!("| Q = 1.0 ± 0.05 veh/s from 30 to 100 s | {} |", count(&Result::flow));
    println!("| 12 ± 2 and 3 ± 1 lane changes in 500 s | {} |", count(&Result::changes));
    println!("| ΔN and Q | {} |", count(&|r| r.balance() && r.flow()));
    println!("| ΔN and lane changes | {} |", count(&|r| r.balance() && r.changes()));
    println!("| Q and lane changes | {} |", count(&|r| r.flow() && r.changes()));
    println!("| all three | {} |\n", count(&|r| r.balance() && r.flow() && r.changes()));
}

pub fn main() {
    let literal = Reading::literal(0.1, 0.2);
    agrees_with_the_core(literal);

    println!("## One thing changed at a time, r = 0.1, p = 0.2 and 0.1; 20 runs\n");
    let singles = singles(literal);
    let readings: Vec<Reading> = singles.iter().map(|s| s.1).collect();
    let results = all(&readings, 20);
    println!("| changed | {HEADER}\n|---|---|---|---|---|---|---|---|");
    for ((name, _), (_, result)) in singles.iter().zip(&results) {
        println!("| {name} | {} |", result.row());
    }
    println!("\nTwo lanes filled by tossing a coin for every vehicle would have a mean ΔN of 5.61.");

    println!("\n## Every combination, r = 0.1, p = 0.2 and 0.1; 5 runs\n");
    let mut readings = Vec::new();
    for gap in [Gap::MinHeadway, Gap::Length] {
        for rise in [Rise::TimesStep, Rise::TimesOtherStep, Rise::WholeR] {
            for attempt in [Attempt::Rescaled, Attempt::Twice, Attempt::EveryStep] {
                for passes in PASSES {
                    for order in [Order::InTurn, Order::Together] {
                        for reset_always in [false, true] {
                            readings.push(Reading {
                                gap,
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
    let results = all(&readings, 5);
    summary(&results);
    let meets = |r: &Result| u8::from(r.balance()) + u8::from(r.flow()) + u8::from(r.changes());
    println!("Those that meet at least two (at most 20):\n");
    println!(
        "| gap | rise | attempt | passes | order | φ returns to 0 after | {HEADER}\n|---|---|---|---|---|---|---|---|---|---|---|---|---|"
    );
    for (reading, result) in results.iter().filter(|r| meets(&r.1) >= 2).take(20) {
        println!("| {reading} | {} |", result.row());
    }

    println!("\n## Over r and p, literal rules; 10 runs, the aggressive driver at half of p\n");
    let rates = [0.005, 0.01, 0.015, 0.02, 0.025, 0.03, 0.04, 0.05, 0.07, 0.1, 0.2];
    let shares = [0.0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0];
    let pairs: Vec<Reading> =
        rates.iter().flat_map(|&r| shares.map(|p| Reading { r, p, ..literal })).collect();
    let results = all(&pairs, 10);
    summary(&results);
    for (title, value) in [
        ("ΔN at 30 s", (|r: &Result| r.at_30) as fn(&Result) -> f64),
        ("ΔN, mean from 30 to 100 s", |r| r.late),
        ("flow from 30 to 100 s (veh/s)", |r| r.flow),
        ("lane changes of the aggressive driver in 500 s (at p/2)", |r| r.aggressive),
        ("lane changes of a control driver in 500 s (at p/2)", |r| r.control),
    ] {
        println!("{title}:\n");
        println!("| r \\ p |{}", shares.map(|p| format!(" {p} |")).concat());
        println!("|---|{}", "---|".repeat(shares.len()));
        for (k, r) in rates.iter().enumerate() {
            let row = &results[k * shares.len()..(k + 1) * shares.len()];
            println!(
                "| {r} |{}",
                row.iter().map(|x| format!(" {:.2} |", value(&x.1))).collect::<Vec<_>>().concat()
            );
        }
        println!();
    }
}

const PASSES: [Passes; 5] =
    [Passes::Alongside, Passes::FarSideToo, Passes::Wrapped, Passes::NextChanged, Passes::Never];

fn singles(literal: Reading) -> Vec<(String, Reading)> {
    let mut list = vec![("nothing".to_owned(), literal)];
    let mut add = |name: String, reading| list.push((name, reading));
    add("gap: C instead of d".into(), Reading { gap: Gap::Length, ..literal });
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
    add("φ returns to 0 after every attempt".into(), Reading { reset_always: true, ..literal });
    for dt in [0.01, 0.1, 0.25, 0.5] {
        add(format!("dt = {dt} s"), Reading { dt, ..literal });
    }
    list
}

/// The literal reading here and the core give the same, within the noise of their runs.
fn agrees_with_the_core(literal: Reading) {
    let here = measure(literal, 20);
    let claims = |id: &str| Figure::named(id).expect("a figure").outcome(Size::Full, &|| {}).claims;
    let core = |id: &str, words: &str| {
        claims(id).into_iter().find(|c| c.claim.contains(words)).expect("a claim").ours()
    };
    println!("| literal reading | core | here, 20 runs |\n|---|---|---|");
    for (name, core, here) in [
        ("ΔN at 30 s", core("load-balance", "about 5 at 30 s"), here.at_30),
        ("ΔN, mean from 30 to 100 s", core("load-balance", "keeps oscillating"), here.late),
        ("flow (veh/s)", core("load-balance", "about 1.0 veh/s"), here.flow),
        (
            "lane changes, aggressive",
            core("aggressive-driver", "of the aggressive driver in 500"),
            here.aggressive,
        ),
        ("lane changes, control", core("aggressive-driver", "of a control driver in 500"), here.control),
    ] {
        println!("| {name} | {:.2} ± {:.2} | {here:.2} |", core.value, core.uncertainty);
        assert!(
            (core.value - here).abs() <= 3.0 * core.uncertainty.max(0.02),
            "{name} differs from the core"
        );
    }
    println!();
}
