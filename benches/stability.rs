//! Cost of the linear theory: the report that the page asks for at every move of a slider, the curves of the stability
//! diagram, and its map of growth rates.
//!
//! `cargo bench --bench stability`

#[cfg(target_arch = "wasm32")]
fn main() {}

#[cfg(not(target_arch = "wasm32"))]
mod cases {
    use criterion::Criterion;
    use ringroad::scenario::Scenario;
    use ringroad::stability::report::Report;
    use ringroad::stability::stability_diagram::StabilityDiagram;
    use ringroad::stability::stabilizing_drivers::{parse_changes, stabilizing_drivers};
    use std::hint::black_box;

    fn scenario(vehicles: usize, exceptions: &[&str]) -> Scenario {
        let mut scenario = Scenario { vehicles, ..Scenario::default() };
        scenario.driver.reaction_time = 0.75;
        scenario.overrides = exceptions.iter().map(|text| text.parse().unwrap()).collect();
        scenario
    }

    pub(crate) fn all(criterion: &mut Criterion) {
        for vehicles in [50, 133] {
            let scenario = scenario(vehicles, &[]);
            criterion.bench_function(&format!("report, {vehicles} equal drivers"), |b| {
                b.iter(|| black_box(Report::of(&scenario)));
            });
        }
        let large = Scenario { vehicles: 1_000_000, length: 2e7, ..scenario(50, &[]) };
        criterion
            .bench_function("report, a million equal drivers", |b| b.iter(|| black_box(Report::of(&large))));
        for vehicles in [50, 133] {
            let scenario = scenario(vehicles, &["10%:reaction-time=0"]);
            criterion.bench_function(&format!("report, {vehicles} drivers of two kinds"), |b| {
                b.iter(|| black_box(Report::of(&scenario)));
            });
        }
        let scenario = scenario(50, &[]);
        let diagram = StabilityDiagram::of(&scenario);
        let numbers: Vec<_> = (2..=133).collect();
        criterion.bench_function("curves of the plane, every mode, both times, N = 2 … 133", |b| {
            b.iter(|| {
                let of_mode =
                    |q| [false, true].map(|t| diagram.critical_of_mode(q, &numbers, diagram.time(t)));
                let modes: Vec<_> = (1..=66).map(of_mode).collect();
                black_box((diagram.curves(numbers.iter().copied()), modes))
            });
        });
        for in_steps in [false, true] {
            let name = if in_steps { "in steps" } else { "continuous" };
            criterion.bench_function(&format!("map of growth rates, N = 2 … 133 by 200, {name}"), |b| {
                b.iter(|| {
                    let delays = || (0..200).map(|k| f64::from(black_box(k)) * 0.0075);
                    let row = |&n: &usize| diagram.growth_rates(n, delays(), diagram.time(in_steps));
                    numbers.iter().map(row).collect::<Vec<_>>()
                });
            });
        }
        let changes = parse_changes("reaction-time=0").unwrap();
        criterion.bench_function("how many calm drivers, N = 50", |b| {
            b.iter(|| black_box(stabilizing_drivers(&scenario, &changes).unwrap()));
        });
    }
}

#[cfg(not(target_arch = "wasm32"))]
fn main() {
    let mut criterion = criterion::Criterion::default().sample_size(10).configure_from_args();
    cases::all(&mut criterion);
    criterion.final_summary();
}
