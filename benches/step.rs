//! Cost of a step, in time per vehicle-update: an iteration of criterion's is one update of one vehicle.
//!
//! `cargo bench --bench step`; to compare, beside the program's own cases: a plain scalar Euler step with libm's exponential, so
//! that ratios hold on any machine, and runs side by side in one vector.

#[cfg(target_arch = "wasm32")]
fn main() {}

#[cfg(not(target_arch = "wasm32"))]
mod cases {
    use criterion::{Bencher, BenchmarkId, Criterion};
    use ringroad::numerics::simd::Width;
    use ringroad::scenario::Scenario;
    use ringroad::simulation::Simulation;
    use serde::de::Error;
    use serde::{Deserialize, Deserializer};
    use std::hint::black_box;
    use std::time::{Duration, Instant};

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
            let perceived = std::mem::take(&mut self.rows[next]);
            let mut row = perceived.clone();
            let now = &self.rows[self.head];
            for j in 0..n {
                let lead = if j + 1 == n { 0 } else { j + 1 };
                let h = self.headway + (perceived[lead] - perceived[j]);
                row[j] = now[j] + (40.0 - 40.0 * libm::exp(-(1.0 / 40.0) * (h - 7.5))).max(0.0) * 0.01;
            }
            self.rows[next] = row;
            self.head = next;
        }
    }

    /// `RUNS` runs of equal drivers side by side, vehicle j of all of them in one array: the step of the core in its most
    /// common case only.
    pub(crate) struct SideBySide<const RUNS: usize> {
        rows: Vec<Vec<[f64; RUNS]>>,
        head: usize,
        relative: Vec<[f64; RUNS]>,
        deficit: Vec<[f64; RUNS]>,
        speed: Vec<[f64; RUNS]>,
    }

    impl<const RUNS: usize> SideBySide<RUNS> {
        pub(crate) fn new(vehicles: usize, delay: usize) -> Self {
            let deficit = 40.0 * libm::exp(-(20.0 - 7.5) / 40.0);
            let all = |value: f64| vec![[value; RUNS]; vehicles];
            let (mut rows, mut relative) = (vec![all(0.0); delay + 1], all(0.0));
            // Small enough for the polynomial.
            for row in &mut rows {
                row[0] = [1e-3; RUNS];
            }
            (relative[0], relative[vehicles - 1]) = ([-1e-3; RUNS], [1e-3; RUNS]);
            Self { rows, head: 0, relative, deficit: all(deficit), speed: all(40.0 - deficit) }
        }

        pub(crate) fn step(&mut self) {
            let n = self.relative.len();
            let next = (self.head + 1) % self.rows.len();
            let mut row = std::mem::take(&mut self.rows[next]);
            let now = &self.rows[self.head];
            let (first, mut own, mut little) = (row[0], row[0], true);
            for j in 0..n {
                let lead = if j + 1 == n { first } else { row[j + 1] };
                let (relative, deficit, speed) =
                    (&mut self.relative[j], &mut self.deficit[j], &mut self.speed[j]);
                for k in 0..RUNS {
                    row[j][k] = now[j][k] + speed[k] * 0.01;
                    let perceived = lead[k] - own[k];
                    let a = -(1.0 / 40.0) * (perceived - relative[k]);
                    let a2 = a * a;
                    little &= a2 <= 1.0 / 1_048_576.0;
                    let high = (0.5 + a * (1.0 / 6.0)) + a2 * (1.0 / 24.0);
                    deficit[k] *= (1.0 + a) + high * a2;
                    relative[k] = perceived;
                    let v = 40.0 - deficit[k];
                    speed[k] = if v > 0.0 { v } else { 0.0 };
                }
                own = lead;
            }
            assert!(little);
            self.rows[next] = row;
            self.head = next;
        }
    }

    /// Times as many whole steps of so many updates as hold the iterations asked for.
    fn time(b: &mut Bencher<'_>, updates: u64, mut run: impl FnMut(u64)) {
        b.iter_custom(|iterations| {
            let steps = iterations.div_ceil(updates);
            let start = Instant::now();
            run(steps);
            start.elapsed().mul_f64(iterations as f64 / (steps * updates) as f64)
        });
    }

    pub(crate) fn settings() -> Criterion {
        Criterion::default().warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(3))
    }

    pub(crate) fn all(c: &mut Criterion) {
        let mut group = c.benchmark_group("step");
        let cases = cases();
        for (mark, width) in [("", Width::widest()), (", 128 bits", Width::NARROWEST)] {
            for Case { name, warm_up, scenario } in &cases {
                let (name, n) = (format!("{name}{mark}"), scenario.vehicles);
                let mut simulation = Simulation::new(scenario).unwrap();
                simulation.set_width(width);
                simulation.run_to(*warm_up);
                group.bench_function(BenchmarkId::new(&name, n), |b| {
                    time(b, n as u64, |steps| simulation.run_to(simulation.step_index() + steps));
                });
                assert!(
                    simulation.collision().is_none(),
                    "{name} N = {n}: a bench must not end in a collision"
                );
            }
        }
        for n in [50, 1000, 100_000] {
            let mut plain = Plain::new(n, 50);
            group.bench_function(BenchmarkId::new("plain scalar with libm", n), |b| {
                time(b, n as u64, |steps| (0..steps).for_each(|_| plain.step()));
            });
        }
        group.finish();
        let mut group = c.benchmark_group("runs");
        group.sample_size(10);
        let (runs, steps) = (1000_u64, 200_u64);
        let small = &cases[0].scenario;
        group.bench_function("1000 runs of N = 50, 200 steps each", |b| {
            time(b, 50 * runs * steps, |batches| {
                use rayon::prelude::*;
                for _ in 0..batches {
                    let total: f64 = (0..runs)
                        .into_par_iter()
                        .map(|seed| {
                            let mut simulation =
                                Simulation::new(&Scenario { seed, ..small.clone() }).unwrap();
                            simulation.run_to(steps);
                            simulation.speed(0)
                        })
                        .sum();
                    black_box(total);
                }
            });
        });
        let mut two = SideBySide::<2>::new(50, 50);
        group.bench_function("2 runs of N = 50 side by side, 128 bits", |b| {
            time(b, 100, |steps| (0..steps).for_each(|_| two.step()));
        });
        let mut eight = SideBySide::<8>::new(50, 50);
        group.bench_function("8 runs of N = 50 side by side, 128 bits", |b| {
            time(b, 400, |steps| (0..steps).for_each(|_| eight.step()));
        });
        group.finish();
    }
}

#[cfg(not(target_arch = "wasm32"))]
criterion::criterion_group! {
    name = benches;
    // What the command line says goes before this.
    config = cases::settings();
    targets = cases::all
}
#[cfg(not(target_arch = "wasm32"))]
criterion::criterion_main!(benches);
