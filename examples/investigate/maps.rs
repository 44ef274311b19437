//! Load balance and lane changes over r and p: a map for each reading, and a search over all combinations.

use crate::balance::{
    AGGRESSIVE, AT_30, CONTROL, FLOW, HEADER, LATE, Outcome, all, combinations, singles, summary,
    those_that_meet,
};
use crate::lanes::Reading;
use ringroad::plot::{Axis, Layer, Panel, Plot};
use ringroad::reproduction::claim::{Estimate, Expected};
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

/// Values of r (1/s): the paper's 0.1 times 10^(k/8) for k from −10 to 2; of p: 0.2 times 10^(k/4) for k from −5 to 3.
const RATES: (f64, f64, i32, i32) = (0.1, 8.0, -10, 2);
const SHARES: (f64, f64, i32, i32) = (0.2, 4.0, -5, 3);
const SEEDS: std::ops::RangeInclusive<u64> = 1..=20;

/// The values of such a list.
fn values((middle, parts, low, high): (f64, f64, i32, i32)) -> Vec<f64> {
    (low..=high).map(|k| middle * 10.0_f64.powf(f64::from(k) / parts)).collect()
}

/// Ends of the cells on a logarithmic axis.
fn ends((middle, parts, low, high): (f64, f64, i32, i32)) -> (f64, f64) {
    let at = |k: f64| middle.log10() + k / parts;
    (at(f64::from(low) - 0.5), at(f64::from(high) + 0.5))
}

/// A quantity that is mapped: name of the file, title, the paper's number, half the range of the colours about it, and
/// the value.
type Quantity = (&'static str, &'static str, Expected, f64, fn(&Outcome) -> Estimate);
const QUANTITIES: [Quantity; 5] = [
    ("imbalance-30", "ΔN at 30 s", AT_30, 4.0, |o| o.at_30),
    ("imbalance-late", "ΔN, mean from 30 to 100 s", LATE, 4.0, |o| o.late),
    ("flow", "Flow of both lanes from 30 to 100 s (veh/s)", FLOW, 0.12, |o| o.flow),
    ("changes-aggressive", "Lane changes of the aggressive driver in 500 s, p/2", AGGRESSIVE, 12.0, |o| {
        o.aggressive
    }),
    ("changes-control", "Lane changes of a control driver in 500 s, p/2", CONTROL, 3.0, |o| o.control),
];

pub fn main(folder: &Path) {
    fs::create_dir_all(folder).expect("a folder to write to");
    let (rates, shares) = (values(RATES), values(SHARES));
    // Steps of 0.25 s give the same as steps of 0.1 and 0.5 s.
    let readings: Vec<(String, Reading)> =
        singles(Reading::literal(0.1, 0.2)).into_iter().filter(|s| s.1.dt != 0.25).collect();
    let points: Vec<Reading> = readings
        .iter()
        .flat_map(|s| shares.iter().map(move |&p| (s.1, p)))
        .flat_map(|(reading, p)| rates.iter().map(move |&r| Reading { r, p, ..reading }))
        .collect();
    let results = all(&points, &SEEDS);
    let of_reading = |k: usize| &results[k * rates.len() * shares.len()..][..rates.len() * shares.len()];

    println!("## Over r and p, one thing changed at a time; {} runs, seeds 1 to {0}\n", SEEDS.end());
    let list = |v: &[f64]| v.iter().map(|v| format!("{v:.4}")).collect::<Vec<_>>().join(", ");
    println!("r (1/s): {}.\np: {}; half of it for the aggressive driver.\n", list(&rates), list(&shares));
    summary(&results);
    println!(
        "| changed | pairs of {} with ΔN | with Q | with lane changes | ΔN, Q | ΔN, changes | Q, changes | all |\n|---|---|---|---|---|---|---|---|",
        rates.len() * shares.len()
    );
    for (k, (name, _)) in readings.iter().enumerate() {
        let count = |f: fn(&Outcome) -> bool| of_reading(k).iter().filter(|r| f(&r.1)).count();
        println!(
            "| {name} | {} | {} | {} | {} | {} | {} | {} |",
            count(Outcome::balance),
            count(Outcome::q),
            count(Outcome::changes),
            count(|o| o.balance() && o.q()),
            count(|o| o.balance() && o.changes()),
            count(|o| o.q() && o.changes()),
            count(|o| o.met() == 3)
        );
    }
    println!("\nOf each reading the pair of r and p that is nearest to all five numbers:\n");
    println!(
        "| changed | r | p | farthest (tolerances) | {HEADER}\n|---|---|---|---|---|---|---|---|---|---|---|"
    );
    for (k, (name, _)) in readings.iter().enumerate() {
        let nearest = of_reading(k).iter().min_by(|a, b| farthest(&a.1).total_cmp(&farthest(&b.1)));
        let (reading, outcome) = nearest.expect("a pair");
        println!(
            "| {name} | {:.3} | {:.3} | {:.1} | {} |",
            reading.r,
            reading.p,
            farthest(outcome),
            outcome.row()
        );
    }
    again("Those that meet all three", &results);
    for quantity in QUANTITIES {
        let maps = readings.iter().enumerate().map(|(k, (name, _))| {
            (name.as_str(), of_reading(k).iter().map(|r| quantity.4(&r.1).value).collect())
        });
        let svg = picture(&quantity, &maps.collect::<Vec<_>>()).to_svg();
        fs::write(folder.join(format!("{}.svg", quantity.0)), svg).expect("a file to write");
    }
    fs::write(folder.join("maps.csv"), csv(&readings, &results)).expect("a file to write");
}

/// The largest distance from the five numbers of the paper, in units of their tolerances.
fn farthest(outcome: &Outcome) -> f64 {
    let distance = |(_, _, expected, _, of): &Quantity| match *expected {
        Expected::About(paper, tolerance) => (of(outcome).value - paper).abs() / tolerance,
        _ => unreachable!("numbers only"),
    };
    QUANTITIES.iter().map(distance).fold(0.0, f64::max)
}

/// A map for each reading.
fn picture((id, title, expected, reach, _): &Quantity, maps: &[(&str, Vec<f64>)]) -> Plot {
    let &Expected::About(paper, _) = expected else { unreachable!("numbers only") };
    let panel = |(name, values): &(&str, Vec<f64>)| Panel {
        title: (*name).to_owned(),
        x: Axis::from_to("log₁₀ r (1/s)", ends(RATES).0, ends(RATES).1),
        y: Axis::from_to("log₁₀ p", ends(SHARES).0, ends(SHARES).1),
        layers: vec![Layer::Map {
            name: String::new(),
            width: values_along(RATES),
            x: ends(RATES),
            y: ends(SHARES),
            values: values.clone(),
            range: (paper - reach, paper + reach),
            middle: Some(paper),
            signed_log: false,
        }],
    };
    Plot {
        id: (*id).to_owned(),
        title: format!("{title}; white: the paper’s {paper}"),
        description: format!(
            "A map over r and p for each of {} readings, mean of {} runs in each cell: less than the paper is blue, more is amber.",
            maps.len(),
            SEEDS.end()
        ),
        columns: 4,
        panels: maps.iter().map(panel).collect(),
    }
}

fn values_along((_, _, low, high): (f64, f64, i32, i32)) -> usize {
    (high - low + 1) as usize
}

/// All means with the half-widths of their 95 % intervals, as CSV.
fn csv(readings: &[(String, Reading)], results: &[(Reading, Outcome)]) -> String {
    let mut out = format!(
        "# means over seeds 1 to {}, each with the half-width of its 95 % confidence interval (half_…); lane changes at p/2\n",
        SEEDS.end()
    );
    out.push_str("changed,r_per_s,p");
    for name in
        ["imbalance_30_s", "imbalance_late", "flow_veh_per_s", "changes_aggressive", "changes_control"]
    {
        let _ = write!(out, ",{name},half_{name}");
    }
    out.push_str(",collisions\n");
    let each = results.len() / readings.len();
    for (k, (reading, outcome)) in results.iter().enumerate() {
        let _ = write!(out, "{},{:.4},{:.4}", readings[k / each].0, reading.r, reading.p);
        for (name, _, _, _, of) in QUANTITIES {
            let (digits, e) = (if name == "flow" { 4 } else { 2 }, of(outcome));
            let _ = write!(out, ",{:.digits$},{:.digits$}", e.value, e.uncertainty);
        }
        let _ = writeln!(out, ",{}", outcome.crashed);
    }
    out
}

/// Prints the readings that meet all three statements, and their results in many other runs.
fn again(title: &str, results: &[(Reading, Outcome)]) {
    println!("\n{title}:\n");
    those_that_meet(results, 3, usize::MAX, true);
    println!("\nThe same with 200 other runs, seeds 1001 to 1200:\n");
    let again: Vec<Reading> = results.iter().filter(|r| r.1.met() == 3).map(|r| r.0).collect();
    those_that_meet(&all(&again, &(1001..=1200)), 0, usize::MAX, true);
}

/// Tries every combination at some pairs of r and p with few runs; then repeats those that meet all three statements with
/// many other runs.
pub fn search() {
    let (rates, shares) = ([0.018, 0.032, 0.056, 0.1], [0.06, 0.2, 0.6]);
    let literal = Reading::literal(0.1, 0.2);
    let readings: Vec<Reading> = rates
        .iter()
        .flat_map(|&r| shares.map(|p| (r, p)))
        .flat_map(|(r, p)| combinations(Reading { r, p, ..literal }))
        .collect();
    println!("## Every combination over r and p; 10 runs, seeds 1 to 10\n");
    println!("r of {rates:?} /s, p of {shares:?}; half of it for the aggressive driver.\n");
    let results = all(&readings, &(1..=10));
    summary(&results);
    again("Those that meet all three", &results);
    let mut order: Vec<_> = results.iter().collect();
    order.sort_by(|a, b| farthest(&a.1).total_cmp(&farthest(&b.1)));
    println!("\nThe ten that are nearest to all five numbers, with the same other runs:\n");
    let nearest: Vec<Reading> = order[..10].iter().map(|r| r.0).collect();
    those_that_meet(&all(&nearest, &(1001..=1200)), 0, usize::MAX, true);
}
