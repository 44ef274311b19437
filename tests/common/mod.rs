//! What several tests need: Fourier modes of a run, and the theory that they are held against.
#![allow(dead_code)] // each test uses its part

#[cfg(not(target_arch = "wasm32"))] // proptest is not there
pub mod scenarios;
pub mod twin;

use ringroad::scenario::Scenario;
use ringroad::simulation::Simulation;
use std::f64::consts::PI;

/// Amplitude of Fourier mode `q` of the headways: |Σ_j h_j·e^{−2πi·q·j/N}|.
pub fn amplitude(simulation: &Simulation, q: usize) -> f64 {
    let n = simulation.vehicles();
    let (mut re, mut im) = (0.0, 0.0);
    for j in 0..n {
        let angle = 2.0 * PI * (q * j % n) as f64 / n as f64;
        re += simulation.headway(j) * libm::cos(angle);
        im -= simulation.headway(j) * libm::sin(angle);
    }
    libm::hypot(re, im)
}

/// Slope (1/s) of ln amplitude of mode `q` between two times, by least squares over samples 1 s apart.
pub fn growth_of_mode(scenario: &Scenario, q: usize, from: f64, to: f64) -> f64 {
    let mut simulation = Simulation::new(scenario).unwrap();
    let mut samples = Vec::new();
    let every = scenario.steps(1.0);
    while simulation.time() < to && !simulation.is_finished() {
        simulation.run_to(simulation.step_index() + every);
        if simulation.time() >= from {
            samples.push((simulation.time(), libm::log(amplitude(&simulation, q))));
        }
    }
    let n = samples.len() as f64;
    let (mean_t, mean_y) =
        (samples.iter().map(|s| s.0).sum::<f64>() / n, samples.iter().map(|s| s.1).sum::<f64>() / n);
    let covariance: f64 = samples.iter().map(|s| (s.0 - mean_t) * (s.1 - mean_y)).sum();
    covariance / samples.iter().map(|s| (s.0 - mean_t) * (s.0 - mean_t)).sum::<f64>()
}

/// Written for the tests alone, from the equations, for the default driver on 1 km.
pub mod theory {
    use super::PI;

    /// c = λ·exp(−(λ/V)(L/N − d)).
    pub fn slope(n: usize) -> f64 {
        libm::exp(-(1.0 / 40.0) * (1000.0 / n as f64 - 7.5))
    }

    /// m* = (a/arcsin(dt·c·sin a) − 1)/2 of mode 1.
    pub fn critical_steps(n: usize, dt: f64) -> f64 {
        let a = PI / n as f64;
        (a / libm::asin(dt * slope(n) * libm::sin(a)) - 1.0) / 2.0
    }

    /// ln|z|/dt of the dominant root of z^{m+1} = z^m + dt·d_q, by Newton's method from z = 1 + dt·d_q.
    pub fn growth(n: usize, q: usize, m: u32, dt: f64) -> f64 {
        let angle = 2.0 * PI * q as f64 / n as f64;
        let d = (dt * -slope(n) * (1.0 - libm::cos(angle)), dt * slope(n) * libm::sin(angle));
        let multiply = |a: (f64, f64), b: (f64, f64)| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
        let power = |z, k| (0..k).fold((1.0, 0.0), |p, _| multiply(p, z));
        let mut z = (1.0 + d.0, d.1);
        for _ in 0..100 {
            // f = z^{m+1} − z^m − d, f' = (m+1)·z^m − m·z^{m−1}
            let zm = power(z, m);
            let zm1 = multiply(zm, z);
            let f = (zm1.0 - zm.0 - d.0, zm1.1 - zm.1 - d.1);
            let below = if m == 0 { (0.0, 0.0) } else { power(z, m - 1) };
            let (k, l) = (f64::from(m + 1), f64::from(m));
            let g = (k * zm.0 - l * below.0, k * zm.1 - l * below.1);
            let norm = g.0 * g.0 + g.1 * g.1;
            let step = multiply(f, (g.0 / norm, -g.1 / norm));
            z = (z.0 - step.0, z.1 - step.1);
        }
        libm::log(libm::hypot(z.0, z.1)) / dt
    }
}
