//! Fits by least squares: a straight line with the standard error of its slope, and an exponential.
//!
//! ```
//! use ringroad::numerics::least_squares::line;
//!
//! let fit = line(&[(0.0, 1.0), (1.0, 3.1), (2.0, 4.9), (3.0, 7.0)]).expect("points with different x");
//! assert!((fit.slope - 1.98).abs() < 1e-12);
//! assert!(fit.slope_error < 0.1);
//! ```

use crate::numerics::exp::exp;

/// A straight line through points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Slope.
    pub slope: f64,
    /// Value at 0.
    pub intercept: f64,
    /// Standard error of the slope; NaN for two points.
    pub slope_error: f64,
}

/// The straight line of least squares through at least two points (x, y) with different x; none for fewer.
///
/// The standard error allows for residuals that are correlated with their successors, as those of a time series are: the number of
/// independent points is taken as n(1 − ρ)/(1 + ρ), ρ being the residuals' correlation with their successors
/// (Santer et al., Journal of Geophysical Research 105, 2000), within 3 … n.
pub fn line(points: &[(f64, f64)]) -> Option<Line> {
    let n = points.len() as f64;
    let mean_x = points.iter().map(|p| p.0).sum::<f64>() / n;
    let mean_y = points.iter().map(|p| p.1).sum::<f64>() / n;
    let spread: f64 = points.iter().map(|p| (p.0 - mean_x) * (p.0 - mean_x)).sum();
    if points.len() < 2 || spread == 0.0 {
        return None;
    }
    let slope = points.iter().map(|p| (p.0 - mean_x) * (p.1 - mean_y)).sum::<f64>() / spread;
    let residual = |p: &(f64, f64)| (p.1 - mean_y) - slope * (p.0 - mean_x);
    let squares: f64 = points.iter().map(|p| residual(p) * residual(p)).sum();
    let successors: f64 = points.windows(2).map(|w| residual(&w[0]) * residual(&w[1])).sum();
    let correlation = if squares > 0.0 { (successors / squares).clamp(0.0, 1.0) } else { 0.0 };
    let independent = (n * (1.0 - correlation) / (1.0 + correlation)).clamp(3.0, n.max(3.0));
    let slope_error =
        if points.len() > 2 { (squares / (independent - 2.0) / spread).sqrt() } else { f64::NAN };
    Some(Line { slope, intercept: mean_y - slope * mean_x, slope_error })
}

/// a·exp(k·x).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponential {
    /// a.
    pub amplitude: f64,
    /// k.
    pub rate: f64,
    /// Standard error of k; NaN for two points.
    pub rate_error: f64,
}

/// a·exp(k·x) by least squares of the logarithms: every point has the same relative weight.
pub fn log_linear(points: &[(f64, f64)]) -> Option<Exponential> {
    let logarithms: Vec<_> = points.iter().map(|&(x, y)| (x, libm::log(y))).collect();
    let line = line(&logarithms).filter(|l| l.slope.is_finite())?;
    Some(Exponential { amplitude: exp(line.intercept), rate: line.slope, rate_error: line.slope_error })
}

/// a·exp(k·x) by non-linear least squares of positive values: the Gauss–Newton method, started at the log-linear fit. A
/// step that does not reduce the sum of squares is halved until it does; where none does, the fit is done.
pub fn exponential(points: &[(f64, f64)]) -> Option<Exponential> {
    let start = log_linear(points)?;
    let squares = |a: f64, k: f64| -> f64 {
        points.iter().map(|&(x, y)| (y - a * exp(k * x)) * (y - a * exp(k * x))).sum()
    };
    // JᵀJ and Jᵀ·residual with J = (e^{kx}, a·x·e^{kx}).
    let normal = |a: f64, k: f64| {
        points.iter().fold([0.0; 5], |s, &(x, y)| {
            let e = exp(k * x);
            let (by_a, by_k, r) = (e, a * x * e, y - a * e);
            [s[0] + by_a * by_a, s[1] + by_a * by_k, s[2] + by_k * by_k, s[3] + by_a * r, s[4] + by_k * r]
        })
    };
    let (mut a, mut k) = (start.amplitude, start.rate);
    let mut best = squares(a, k);
    'fit: for _ in 0..200 {
        let [aa, ak, kk, ra, rk] = normal(a, k);
        let determinant = aa * kk - ak * ak;
        let (step_a, step_k) = ((kk * ra - ak * rk) / determinant, (aa * rk - ak * ra) / determinant);
        let mut part = 1.0;
        while part > 1e-10 {
            let (next_a, next_k) = (a + part * step_a, k + part * step_k);
            let next = squares(next_a, next_k);
            if next < best {
                (a, k, best) = (next_a, next_k, next);
                continue 'fit;
            }
            part *= 0.5;
        }
        break;
    }
    let [aa, ak, kk, ..] = normal(a, k);
    let rate_error = if points.len() > 2 {
        (best / (points.len() as f64 - 2.0) * aa / (aa * kk - ak * ak)).sqrt()
    } else {
        f64::NAN
    };
    Some(Exponential { amplitude: a, rate: k, rate_error })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_data_give_exact_answers() {
        let points: Vec<_> = (0..20).map(|i| (f64::from(i), 3.0 - 0.5 * f64::from(i))).collect();
        let fitted = line(&points).unwrap();
        assert!((fitted.slope + 0.5).abs() < 1e-14 && (fitted.intercept - 3.0).abs() < 1e-13);
        assert!(fitted.slope_error < 1e-14);
        for rate in [-1.1, 0.44, 0.0] {
            let points: Vec<_> = (1..8).map(|n| (f64::from(n), 0.3 * exp(rate * f64::from(n)))).collect();
            for fit in [log_linear(&points).unwrap(), exponential(&points).unwrap()] {
                assert!((fit.rate - rate).abs() < 1e-12 && (fit.amplitude - 0.3).abs() < 1e-12, "{fit:?}");
            }
        }
        assert!(line(&[(1.0, 2.0)]).is_none() && line(&[(1.0, 2.0), (1.0, 3.0)]).is_none());
        assert!(exponential(&[]).is_none());
    }

    /// At the optimum the gradient of the sum of squares vanishes, and no neighbour is better.
    #[test]
    fn the_exponential_is_the_one_of_least_squares() {
        let points = [(1.0, 1.0), (2.0, 0.31), (3.0, 0.2), (4.0, 0.02), (5.0, 0.05)];
        let fit = exponential(&points).unwrap();
        let squares = |a: f64, k: f64| -> f64 {
            points.iter().map(|&(x, y)| (y - a * exp(k * x)) * (y - a * exp(k * x))).sum()
        };
        let best = squares(fit.amplitude, fit.rate);
        for (da, dk) in [(1e-4, 0.0), (-1e-4, 0.0), (0.0, 1e-4), (0.0, -1e-4), (1e-4, 1e-4), (1e-4, -1e-4)] {
            assert!(squares(fit.amplitude + da, fit.rate + dk) > best);
        }
        // The log-linear fit weighs the small values as much as the large ones, and differs.
        assert!((log_linear(&points).unwrap().rate - fit.rate).abs() > 0.1);
    }

    /// The spread of slopes over many noisy series is what the standard error says, also for correlated noise.
    #[test]
    fn the_standard_error_is_right_for_correlated_noise() {
        let mut generator =
            crate::numerics::random::Generator::new(3, crate::numerics::random::Stream::Start);
        for memory in [0.0, 0.7] {
            let (mut slopes, mut errors) = (Vec::new(), 0.0);
            for _ in 0..400 {
                let mut noise = 0.0;
                let points: Vec<_> = (0..200)
                    .map(|i| {
                        noise = memory * noise + generator.uniform() - 0.5;
                        (f64::from(i), noise)
                    })
                    .collect();
                let fitted = line(&points).unwrap();
                slopes.push(fitted.slope);
                errors += fitted.slope_error / 400.0;
            }
            let spread = (slopes.iter().map(|s| s * s).sum::<f64>() / 400.0).sqrt();
            assert!((0.8..1.25).contains(&(errors / spread)), "memory {memory}: {errors} against {spread}");
        }
    }
}
