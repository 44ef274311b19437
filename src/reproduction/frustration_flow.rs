//! Beyond the paper: flow, balance and lane changes against r and p.

use super::claim::{Claim, Estimate, Expected};
use super::figure::{Figure, FigureTable, Outcome};
use super::shared::{column, measured};
use super::task::{Size, TaskResult};
use crate::format::table::{Column, Table};
use crate::measurement::Measurement;
use crate::numerics::statistics::mean;
use crate::plot::{Axis, Layer, Panel, Plot};
use crate::scenario::{Scenario, Start};

const ID: &str = "frustration-flow";

pub(super) const FIGURE: Figure = Figure {
    id: ID,
    title: "Flow against frustration",
    caption: "Fifty vehicles start in lane 1 of two, steps of 0.05 s, no reaction time; r and p each from 0.001 to 1 in \
              thirds of a power of ten. Means over 60 to 300 s and 8 runs, seeds 1 to 8.",
    beyond: true,
    tasks: |size| {
        let rates = rates(size);
        let pairs = rates.iter().flat_map(|r| rates.iter().map(move |p| format!("r = {r}, p = {p}")));
        pairs.collect()
    },
    start: |size, task| Box::new(move || run(size, task)),
    assemble,
};

/// 10^(k/3) for k = 0, 1, 2.
const THIRDS: [f64; 3] = [1.0, 2.154_435, 4.641_589];

/// Values of r and of p.
fn rates(size: Size) -> Vec<f64> {
    let decades: &[f64] = size.choose(&[1e-3, 1e-2, 1e-1], &[1e-2]);
    let mut rates: Vec<f64> = decades.iter().flat_map(|decade| THIRDS.map(|third| decade * third)).collect();
    if size == Size::Full {
        rates.push(1.0);
    }
    rates
}

fn runs(size: Size) -> u64 {
    size.choose(8, 2)
}

fn scenario(size: Size, r: f64, p: f64, seed: u64) -> Scenario {
    let mut scenario = Scenario {
        lanes: 2,
        start: Start::OneLane(1),
        time_step: 0.05,
        until: size.choose(300.0, 100.0),
        seed,
        ..Scenario::default()
    };
    scenario.driver.frustration_rate = r;
    scenario.driver.pass_frustration = p;
    scenario
}

/// Three columns with a row for each run: flow (veh/s), ΔN, lane changes per vehicle and minute; all from 60 s on.
fn run(size: Size, task: usize) -> TaskResult {
    let rates = rates(size);
    let (r, p) = (rates[task / rates.len()], rates[task % rates.len()]);
    let mut columns = vec![Vec::new(); 3];
    for seed in 1..=runs(size) {
        let scenario = scenario(size, r, p, seed);
        let (tables, _) =
            measured(&scenario, &[Measurement::Lanes { every: 1.0 }, Measurement::Drivers { every: 60.0 }]);
        let time = column(&tables[0], "time_s");
        let start = time.iter().position(|&t| t >= 60.0).expect("the run is longer");
        columns[1].push(mean(&column(&tables[0], "imbalance")[start..]));
        let changes = column(&tables[0], "lane_changes");
        let minutes = (time[time.len() - 1] - time[start]) / 60.0;
        let n = scenario.vehicles as f64;
        columns[2].push((changes[changes.len() - 1] - changes[start]) / n / minutes);
        let distance = column(&tables[1], "distance_per_vehicle_m");
        let at = column(&tables[1], "time_s");
        let (a, b) = (1, at.len() - 1);
        let speed = if b > a { (distance[b] - distance[a]) / (at[b] - at[a]) } else { distance[b] / at[b] };
        columns[0].push(speed * n / scenario.length);
    }
    TaskResult { columns }
}

fn assemble(size: Size, results: &[TaskResult]) -> Outcome {
    let rates = rates(size);
    let k = rates.len();
    let each = |which: usize| -> Vec<Estimate> {
        results.iter().map(|result| Estimate::mean(&result.columns[which])).collect()
    };
    let quantities = [
        ("flow", "_veh_per_s", "veh/s", "flow, mean speed times density, both lanes"),
        ("imbalance", "", "", "ΔN"),
        ("lane_changes", "_per_min", "1/min", "lane changes of a vehicle a minute"),
    ];
    let of_r = rates.iter().flat_map(|&r| std::iter::repeat_n(r, k)).collect();
    let of_p = (0..k).flat_map(|_| rates.clone()).collect();
    let mut columns = vec![
        Column::float("frustration_rate_per_s", "1/s", "r", of_r),
        Column::float("pass_frustration", "", "p", of_p),
    ];
    for (which, (name, suffix, unit, words)) in quantities.into_iter().enumerate() {
        let values = each(which);
        let means = values.iter().map(|e| e.value).collect();
        let halves = values.iter().map(|e| e.uncertainty).collect();
        columns.push(Column::float(format!("{name}_mean{suffix}"), unit, format!("{words}: mean"), means));
        let meaning = format!("{words}: half-width of the 95 % interval of the mean");
        columns.push(Column::float(format!("{name}_half_interval{suffix}"), unit, meaning, halves));
    }
    let how =
        format!("{} runs for each pair of r and p, seeds 1 to {0}; means over 60 s to the end", runs(size));
    let base = scenario(size, 0.1, 0.2, 1);
    let tables = vec![FigureTable::summary("frustration-flow", Table::new(columns), &base, how)];

    let ends = (libm::log10(rates[0]) - 1.0 / 6.0, libm::log10(rates[k - 1]) + 1.0 / 6.0);
    let panel = |which: usize, title: &str, name: &str| {
        let values: Vec<f64> = each(which).iter().map(|e| e.value).collect();
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // The results are in the order of r; the rows of the map are values of p.
        let transposed = (0..k).flat_map(|p| (0..k).map(move |r| r * k + p)).map(|i| values[i]).collect();
        let map = Layer::Map {
            name: name.into(),
            width: k,
            x: ends,
            y: ends,
            values: transposed,
            range: (low, high.max(low + 1e-9)),
            middle: None,
            signed_log: false,
        };
        Panel {
            title: title.into(),
            x: Axis::from_to("log₁₀ r (1/s)", ends.0, ends.1),
            y: Axis::from_to("log₁₀ p", ends.0, ends.1),
            layers: vec![map],
        }
    };
    let plot = Plot {
        id: ID.into(),
        title: FIGURE.title.into(),
        description: "Three maps over r and p on logarithmic axes: flow of both lanes, difference between the lanes, and \
                      lane changes of a vehicle a minute."
            .into(),
        columns: 3,
        panels: vec![panel(0, "Flow", "veh/s"), panel(1, "Difference ΔN", "vehicles"), panel(2, "Lane changes", "per minute")],
    };
    Outcome { tables, plot, claims: claims(size, &each(0)) }
}

fn claims(size: Size, flows: &[Estimate]) -> Vec<Claim> {
    let best = flows.iter().map(|e| e.value).fold(f64::NEG_INFINITY, f64::max);
    let worst = flows.iter().map(|e| e.value).fold(f64::INFINITY, f64::min);
    let half = flows.iter().map(|e| e.uncertainty).fold(0.0, f64::max);
    vec![Claim::new(
        ID,
        "beyond the paper: r and p hardly change the flow of balanced lanes; largest flow over smallest, less one",
        "%",
        Expected::AtMost(10.0),
        Estimate::new(100.0 * (best / worst - 1.0), 100.0 * libm::hypot(half, half) / worst),
        format!(
            "{} pairs of r and p, {1} runs each, seeds 1 to {1}, 95 % interval from the widest interval of a mean; hardly: at most 10 %.",
            flows.len(),
            runs(size)
        ),
    )]
}
