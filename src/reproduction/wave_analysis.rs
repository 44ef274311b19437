//! The waves in a space-time map of speed: how fast the strongest one travels, how large the waves are, and how many
//! stretches of the road are congested.

use super::claim::Estimate;
use crate::numerics::least_squares;
use std::f64::consts::PI;

/// Rows (seconds) left out at the start, until the displacement has become a wave.
pub const SETTLING: usize = 20;
/// Modes among which the strongest is looked for.
const MODES: usize = 12;

/// The waves in a map of speeds with a row for each second.
pub struct WaveAnalysis {
    /// Velocity along the road of the strongest Fourier mode, m/s, with 1.96 standard errors of the slope of its phase.
    pub velocity: Estimate,
    /// The strongest mode: the one with the largest amplitude, summed from [`SETTLING`] on.
    pub mode: usize,
    /// Standard deviation of speed along the road in each row, m/s.
    pub deviation: Vec<f64>,
    /// Congested stretches in the last row: slower than the mean by more than a tenth of the largest deviation.
    pub congested: usize,
}

impl WaveAnalysis {
    /// Of speeds (m/s) row by row, each row with so many cells along a ring of so many metres.
    pub fn of(speeds: &[f64], cells: usize, length: f64) -> Self {
        let rows: Vec<&[f64]> = speeds.chunks_exact(cells).collect();
        let means: Vec<f64> = rows.iter().map(|r| r.iter().sum::<f64>() / cells as f64).collect();
        let deviation = rows.iter().zip(&means).map(|(row, mean)| {
            (row.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / cells as f64).sqrt()
        });
        let (mode, coefficients) = strongest_mode(&rows[rows.len().min(SETTLING)..], cells);
        Self {
            velocity: velocity(&coefficients, mode, length),
            mode,
            deviation: deviation.collect(),
            congested: rows.last().map_or(0, |row| congested_stretches(row, means[rows.len() - 1])),
        }
    }
}

/// The mode with the largest amplitude, summed over the rows, and its coefficient in each row.
fn strongest_mode(rows: &[&[f64]], cells: usize) -> (usize, Vec<(f64, f64)>) {
    // Σ_x v(x)·e^{−2πiqx/L}, real and imaginary part.
    let coefficient = |row: &[f64], q: usize| {
        row.iter().enumerate().fold((0.0, 0.0), |(re, im), (k, v)| {
            let angle = 2.0 * PI * (q * k % cells) as f64 / cells as f64;
            (re + v * libm::cos(angle), im - v * libm::sin(angle))
        })
    };
    let mut modes: Vec<Vec<(f64, f64)>> =
        (1..=MODES).map(|q| rows.iter().map(|row| coefficient(row, q)).collect()).collect();
    let size = |mode: &Vec<(f64, f64)>| mode.iter().map(|&(re, im)| libm::hypot(re, im)).sum::<f64>();
    let strongest = (0..MODES).max_by(|&a, &b| size(&modes[a]).total_cmp(&size(&modes[b]))).unwrap_or(0);
    (strongest + 1, modes.swap_remove(strongest))
}

/// The velocity of a mode from its coefficients, a second apart: a wave v(x − ut) changes the phase of mode q by
/// −2πqu/L each second. The phase is summed from step to step, so that it may pass ±π; its slope is that of least
/// squares.
fn velocity(coefficients: &[(f64, f64)], mode: usize, length: f64) -> Estimate {
    let mut phase = 0.0;
    let mut phases: Vec<(f64, f64)> = Vec::new();
    for (k, pair) in coefficients.windows(2).enumerate() {
        let ((a, b), (c, d)) = (pair[0], pair[1]);
        phase += libm::atan2(a * d - b * c, a * c + b * d);
        phases.push((k as f64, phase));
    }
    least_squares::line(&phases).map_or(Estimate::exact(f64::NAN), |line| {
        let metres = length / (2.0 * PI * mode as f64);
        Estimate::new(-line.slope * metres, 1.96 * line.slope_error * metres)
    })
}

/// Stretches of a row, which closes to a ring, that are slower than the mean by more than a tenth of the largest
/// deviation.
fn congested_stretches(row: &[f64], mean: f64) -> usize {
    let largest = row.iter().map(|v| (v - mean).abs()).fold(0.0, f64::max);
    let slow = |k: usize| row[k % row.len()] < mean - 0.1 * largest;
    (0..row.len()).filter(|&k| slow(k + 1) && !slow(k)).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sine wave with three crests that moves upstream at 5 m/s.
    #[test]
    fn the_velocity_of_a_known_wave_is_found() {
        let (cells, length) = (200, 1000.0);
        let speeds: Vec<f64> = (0..60)
            .flat_map(|t| {
                (0..cells).map(move |k| {
                    let x = f64::from(k) * length / f64::from(cells);
                    10.0 + libm::sin(2.0 * PI * 3.0 * (x + 5.0 * f64::from(t)) / length)
                })
            })
            .collect();
        let waves = WaveAnalysis::of(&speeds, 200, length);
        assert_eq!((waves.mode, waves.congested), (3, 3));
        assert!((waves.velocity.value + 5.0).abs() < 1e-9, "{:?}", waves.velocity);
        assert!(waves.deviation.iter().all(|d| (d - 0.5_f64.sqrt()).abs() < 1e-9));
    }
}
