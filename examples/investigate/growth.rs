//! The cyclic growth rate k for every vehicle, definition and number of periods, fit and displacement.

use rayon::prelude::*;
use ringroad::numerics::least_squares;
use ringroad::scenario::Scenario;
use ringroad::scenario::driver::Driver;
use ringroad::simulation::Simulation;

/// The paper's k, at the reaction times `DELAYS` (s).
const PAPER: [f64; 3] = [-1.073, -0.790, 0.443];
const DELAYS: [f64; 3] = [0.0, 0.5, 0.75];
const N: usize = 50;

/// The definition of a period.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Period {
    UpwardCrossings,
    DownwardCrossings,
    LocalMinima,
    /// From t = 0.
    RoundTrips,
    /// Each from half a round trip before the disturbance reaches the vehicle to half a round trip after it.
    CentredRoundTrips,
}
const PERIODS: [Period; 5] = [
    Period::UpwardCrossings,
    Period::DownwardCrossings,
    Period::LocalMinima,
    Period::RoundTrips,
    Period::CentredRoundTrips,
];

/// Speeds of all vehicles less v∞ (m/s), a row for each step.
fn run(delay: f64, displacement: f64) -> Vec<[f64; N]> {
    let mut scenario = Scenario { until: 420.0, ..Scenario::default() };
    scenario.driver.reaction_time = delay;
    scenario.actions.push(format!("at=0:1:nudge={displacement}").parse().expect("an action"));
    let mut simulation = Simulation::new(&scenario).expect("a valid scenario");
    let v = Driver::default().speed(20.0);
    let mut rows = Vec::new();
    loop {
        let mut row = [0.0; N];
        row.iter_mut().zip(simulation.speeds()).for_each(|(row, speed)| *row = speed - v);
        rows.push(row);
        if simulation.is_finished() {
            return rows;
        }
        simulation.step();
    }
}

/// f(n) of a vehicle (from 0), m/s.
fn depths(rows: &[[f64; N]], vehicle: usize, period: Period) -> Vec<f64> {
    let trip = (N as f64 / Driver::default().slope(20.0) / 0.01).round() as usize;
    let u = |k: usize| rows[k][vehicle];
    let minimum = |from: usize, to: usize| (from..to).map(u).fold(f64::INFINITY, f64::min);
    let between = |starts: &[usize]| starts.windows(2).map(|w| -minimum(w[0], w[1])).collect();
    let steps = 1..rows.len();
    match period {
        Period::UpwardCrossings => {
            between(&steps.filter(|&k| u(k - 1) < 0.0 && u(k) >= 0.0).collect::<Vec<_>>())
        }
        Period::DownwardCrossings => {
            between(&steps.filter(|&k| u(k - 1) >= 0.0 && u(k) < 0.0).collect::<Vec<_>>())
        }
        Period::LocalMinima => (1..rows.len() - 1)
            .filter(|&k| u(k) < u(k - 1) && u(k) <= u(k + 1) && u(k) < 0.0)
            .map(|k| -u(k))
            .collect(),
        Period::RoundTrips => between(&(0..=rows.len() / trip).map(|n| n * trip).collect::<Vec<_>>()),
        Period::CentredRoundTrips => {
            // The disturbance travels upstream: it reaches vehicle N first after vehicle 1.
            let arrival = (N - vehicle) % N * trip / N;
            let first = (arrival + trip / 2) % trip;
            let starts: Vec<_> = (first..rows.len()).step_by(trip).collect();
            between(&starts)
        }
    }
}

/// One reading of the paper, and its k at the three reaction times.
struct Reading {
    /// From 1.
    vehicle: usize,
    period: Period,
    /// Periods left out at the start.
    skipped: usize,
    /// Periods fitted.
    periods: usize,
    /// Whether the fit is a line through the logarithms.
    logarithms: bool,
    displacement: f64,
    rates: [Option<f64>; 3],
}

pub fn main() {
    let displacements = [1.0, 2.0, 3.0];
    let runs: Vec<Vec<Vec<[f64; N]>>> =
        displacements.par_iter().map(|&a| DELAYS.iter().map(|&d| run(d, a)).collect()).collect();
    let readings: Vec<Reading> = (0..N)
        .into_par_iter()
        .flat_map_iter(|vehicle| {
            let mut readings = Vec::new();
            for (of_displacement, &displacement) in runs.iter().zip(&displacements) {
                for period in PERIODS {
                    let f: Vec<_> =
                        of_displacement.iter().map(|rows| depths(rows, vehicle, period)).collect();
                    for skipped in 0..=2 {
                        for periods in 2..=12 {
                            for logarithms in [false, true] {
                                let rate = |f: &Vec<f64>| {
                                    let used = f.get(skipped..skipped + periods)?;
                                    if used.iter().any(|&d| d <= 0.0) {
                                        return None;
                                    }
                                    let points: Vec<_> =
                                        used.iter().enumerate().map(|(n, &d)| (n as f64 + 1.0, d)).collect();
                                    let fit = if logarithms {
                                        least_squares::log_linear(&points)
                                    } else {
                                        least_squares::exponential(&points)
                                    };
                                    fit.map(|f| f.rate)
                                };
                                let rates = [rate(&f[0]), rate(&f[1]), rate(&f[2])];
                                if rates.iter().any(Option::is_some) {
                                    readings.push(Reading {
                                        vehicle: vehicle + 1,
                                        period,
                                        skipped,
                                        periods,
                                        logarithms,
                                        displacement,
                                        rates,
                                    });
                                }
                            }
                        }
                    }
                }
            }
            readings
        })
        .collect();
    println!(
        "Readings tried: {}: 50 vehicles, 5 kinds of period, 2 to 12 periods, the first 0 to 2 left out, 2 fits, displacements of 1, 2 and 3 m, as far as the runs of 420 s hold so many periods.\n",
        readings.len()
    );
    println!(
        "| Δ (s) | the paper's k | readings that have a k | within 0.02 | within 0.005 | nine tenths of k |\n|---|---|---|---|---|---|"
    );
    for (i, paper) in PAPER.iter().enumerate() {
        let k: Vec<f64> = readings.iter().filter_map(|r| r.rates[i]).collect();
        let within = |d: f64| k.iter().filter(|k| (**k - paper).abs() <= d).count();
        let mut sorted = k.clone();
        sorted.sort_by(f64::total_cmp);
        let (low, high) = (sorted[sorted.len() / 20], sorted[sorted.len() - 1 - sorted.len() / 20]);
        println!(
            "| {} | {paper} | {} | {} | {} | {low:.2} … {high:.2} |",
            DELAYS[i],
            k.len(),
            within(0.02),
            within(0.005)
        );
    }
    let worst = |r: &Reading| {
        r.rates.iter().zip(PAPER).map(|(k, p)| k.map_or(f64::INFINITY, |k| (k - p).abs())).fold(0.0, f64::max)
    };
    let pair = |r: &Reading| {
        (0..2).map(|i| r.rates[i].map_or(f64::INFINITY, |k| (k - PAPER[i]).abs())).fold(0.0, f64::max)
    };
    let mut order: Vec<&Reading> = readings.iter().collect();
    println!("\n| criterion | readings |\n|---|---|");
    println!("| all three within 0.02 | {} |", readings.iter().filter(|r| worst(r) <= 0.02).count());
    println!("| all three within 0.1 | {} |", readings.iter().filter(|r| worst(r) <= 0.1).count());
    println!("| the two stable ones within 0.02 | {} |", readings.iter().filter(|r| pair(r) <= 0.02).count());
    order.sort_by(|a, b| worst(a).total_cmp(&worst(b)));
    println!("\nThe ten readings nearest to all three:\n");
    table(&order[..10]);
    order.sort_by(|a, b| pair(a).total_cmp(&pair(b)));
    println!("\nThe ten readings nearest to the two stable ones:\n");
    table(&order[..10]);
}

fn table(readings: &[&Reading]) {
    println!(
        "| displacement | vehicle | period | left out | periods | fit | k at 0 s | at 0.5 s | at 0.75 s |\n|---|---|---|---|---|---|---|---|---|"
    );
    for r in readings {
        let k = |i: usize| r.rates[i].map_or_else(|| "none".into(), |k| format!("{k:.3}"));
        let fit = if r.logarithms { "logarithms" } else { "least squares" };
        println!(
            "| {} m | {} | {:?} | {} | {} | {fit} | {} | {} | {} |",
            r.displacement,
            r.vehicle,
            r.period,
            r.skipped,
            r.periods,
            k(0),
            k(1),
            k(2)
        );
    }
}
