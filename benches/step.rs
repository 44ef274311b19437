//! Cost of a step, in time per vehicle-update (criterion's "elements" are vehicle-updates).
//!
//! `cargo bench --bench step`; beside the program's own cases a plain scalar Euler step with libm's exponential, so
//! that ratios hold on any machine.

#[cfg(target_arch = "wasm32")]
fn main() {}

#[cfg(not(target_arch = "wasm32"))]
mod cases {
    use criterion::{BenchmarkId, Criterion, Throughput};
    use ringroad::scenario::Scenario;
    use ringroad::simulation::Simulation;
    use ringroad::vector::Width;
    use serde::de::Error;
    use serde::{Deserialize, Deserializer};
    use std::hint::black_box;
    use std::time::Duration;

    /// A scenario to be stepped; the file is read by the bench in the browser too.
    ///
    /// 20 m of road a vehicle in each lane, steps of 0.01 s, a nudge: stable, never at rest. On one lane Δ = 0.5 s, in
    /// stop-and-go traffic 0.69 s, just unstable, from a random start and long after it;
    /// with lane changes no delay, as in the paper, and a tenth of the drivers keep the lanes in motion.
    #[derive(Deserialize)]
    pub(crate) struct Case {
        name: String,
        /// Steps before the clock starts.
        warm_up: u64,
        #[serde(deserialize_with = "scenario")]
        scenario: Scenario,
    }

    fn scenario<'de, D: Deserializer<'de>>(json: D) -> Result<Scenario, D::Error> {
        let json = serde_json::Value::deserialize(json)?.to_string();
        Scenario::from_json(&json).map_err(D::Error::custom)
    }

    fn cases() -> Vec<Case> {
        serde_json::from_str(include_str!("cases.json")).expect("cases.json")
    }

    /// The plain way: one vehicle after the other, libm's exponential, a ring buffer of positions.
    pub(crate) struct Plain {
        rows: Vec<Vec<f64>>,
        head: usize,
        headway: f64,
    }

    impl Plain {
        pub(crate) fn new(vehicles: usize, delay: usize) -> Self {
            let mut rows = vec![vec![0.0; vehicles]; delay + 1];
            for row in &mut rows {
                row[0] = 1.0;
            }
            Self { rows, head: 0, headway: 20.0 }
        }
        pub(crate) fn step(&mut self) {
            let n = self.rows[0].len();
            let count = self.rows.len();
            let next = (self.head + 1) % count;
            // The row to be overwritten is the one of `delay` steps ago.
            let seen = std::mem::take(&mut self.rows[next]);
            let mut row = seen.clone();
            let now = &self.rows[self.head];
            for j in 0..n {
                let lead = if j + 1 == n { 0 } else { j + 1 };
                let h = self.headway + (seen[lead] - seen[j]);
                row[j] = now[j] + (40.0 - 40.0 * libm::exp(-(1.0 / 40.0) * (h - 7.5))).max(0.0) * 0.01;
            }
            self.rows[next] = row;
            self.head = next;
        }
    }

    pub(crate) fn all(c: &mut Criterion) {
        let mut group = c.benchmark_group("step");
        group.warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(3));
        let cases = cases();
        for (mark, width) in [("", Width::widest()), (", 128 bits", Width::NARROWEST)] {
            for Case { name, warm_up, scenario } in &cases {
                let (name, n) = (format!("{name}{mark}"), scenario.vehicles);
                let mut simulation = Simulation::new(scenario).unwrap();
                simulation.set_width(width);
                simulation.run_to(*warm_up);
                group.throughput(Throughput::Elements(n as u64));
                group.bench_function(BenchmarkId::new(&name, n), |b| b.iter(|| simulation.step()));
                assert!(
                    simulation.collision().is_none(),
                    "{name} N = {n}: a bench must not end in a collision"
                );
            }
        }
        for n in [50, 1000, 100_000] {
            let mut plain = Plain::new(n, 50);
            group.throughput(Throughput::Elements(n as u64));
            group.bench_function(BenchmarkId::new("plain scalar with libm", n), |b| b.iter(|| plain.step()));
        }
        group.finish();
        let mut group = c.benchmark_group("runs");
        group.sample_size(10);
        let (runs, steps) = (1000_u64, 200_u64);
        let small = &cases[0].scenario;
        group.throughput(Throughput::Elements(50 * runs * steps));
        group.bench_function("1000 runs of N = 50, 200 steps each", |b| {
            b.iter(|| {
                use rayon::prelude::*;
                let total: f64 = (0..runs)
                    .into_par_iter()
                    .map(|seed| {
                        let mut simulation = Simulation::new(&Scenario { seed, ..small.clone() }).unwrap();
                        simulation.run_to(steps);
                        simulation.speed(0)
                    })
                    .sum();
                black_box(total)
            });
        });
        group.finish();
    }
}

#[cfg(not(target_arch = "wasm32"))]
criterion::criterion_group!(benches, cases::all);
#[cfg(not(target_arch = "wasm32"))]
criterion::criterion_main!(benches);
