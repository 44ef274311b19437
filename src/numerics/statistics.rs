//! Summaries of a sample: mean, standard deviation, quantiles, and a 95 % confidence interval of the mean.
//!
//! ```
//! use ringroad::numerics::statistics::{Statistics, Student};
//!
//! let sample = Statistics::of([1.0, 2.0, 3.0, 4.0], &mut Student::default());
//! assert_eq!((sample.count, sample.mean), (4, 2.5));
//! // 2.5 ± 3.182·1.291/√4
//! assert!((sample.interval[1] - 4.554).abs() < 1e-3);
//! ```

use crate::numerics::bisection::last_bit;
use std::f64::consts::FRAC_2_PI;

/// The 0.975 quantile of the normal distribution.
const NORMAL_975: f64 = 1.959_963_984_540_054;

/// The quantiles that a summary gives.
pub const QUANTILES: [f64; 5] = [0.05, 0.25, 0.5, 0.75, 0.95];

/// The summary of a sample. What the sample is too small for is NaN: all numbers without values, the standard deviation
/// and the interval with one value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// Number of values.
    pub count: usize,
    /// Mean.
    pub mean: f64,
    /// Standard deviation, with n − 1 in the denominator.
    pub deviation: f64,
    /// At [`QUANTILES`].
    pub quantiles: [f64; QUANTILES.len()],
    /// 95 % confidence interval of the mean.
    pub interval: [f64; 2],
}

impl Statistics {
    /// The summary of these values without the NaN among them; the last bits depend on their order. The interval is Student's,
    /// mean ± t·s/√n with the 0.975 quantile t of n − 1 degrees of freedom.
    pub fn of(values: impl IntoIterator<Item = f64>, student: &mut Student) -> Self {
        let mut values: Vec<f64> = values.into_iter().filter(|v| !v.is_nan()).collect();
        let count = values.len();
        let n = count as f64;
        let mean = mean(&values);
        let squares: f64 = values.iter().map(|v| (v - mean) * (v - mean)).sum();
        let deviation = if count > 1 { (squares / (n - 1.0)).sqrt() } else { f64::NAN };
        values.sort_unstable_by(f64::total_cmp);
        let half = if count > 1 { student.quantile_975(count - 1) * deviation / n.sqrt() } else { f64::NAN };
        Self {
            count,
            mean,
            deviation,
            quantiles: QUANTILES.map(|p| quantile(&values, p)),
            interval: [mean - half, mean + half],
        }
    }

    /// The summary of values that are 0 or 1: their mean is a share, and the interval is Wilson's score interval (Journal of
    /// the American Statistical Association 22, 1927), which has a width also where all values are equal.
    pub fn of_share(values: impl IntoIterator<Item = bool>) -> Self {
        let values = values.into_iter().map(|v| f64::from(u8::from(v)));
        let mut statistics = Self::of(values, &mut Student::default());
        let (n, p) = (statistics.count as f64, statistics.mean);
        let z2 = NORMAL_975 * NORMAL_975;
        // The lower end; the upper end is 1 minus the lower end for the share of zeros.
        let low = |p: f64| {
            let centre = p + z2 / (2.0 * n);
            let half = NORMAL_975 * (p * (1.0 - p) / n + z2 / (4.0 * n * n)).sqrt();
            ((centre - half) / (1.0 + z2 / n)).max(0.0)
        };
        statistics.interval = [low(p), 1.0 - low(1.0 - p)];
        statistics
    }
}

/// The mean of the values; NaN without values or where one is NaN. It is computed as a difference from the first
/// value, so that the mean of equal values is exactly that value.
pub fn mean(values: &[f64]) -> f64 {
    let origin = values.first().copied().unwrap_or(f64::NAN);
    origin + values.iter().map(|v| v - origin).sum::<f64>() / values.len() as f64
}

/// Quantile `p` of ascending values, by linear interpolation between the order statistics at (n − 1)·p: type 7 of
/// Hyndman and Fan (American Statistician 50, 1996), the default of R and `NumPy`.
fn quantile(sorted: &[f64], p: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else {
        return f64::NAN;
    };
    let place = p * last as f64;
    let below = place.floor();
    let (low, high) = (sorted[below as usize], sorted[(below as usize + 1).min(last)]);
    low + (place - below) * (high - low)
}

/// P(|T| ≤ t) of Student's distribution with a whole number ν of degrees of freedom: the finite sums of Abramowitz
/// and Stegun, 26.7.3 and 26.7.4, with θ = arctan(t/√ν). All terms are positive, so that no digits cancel.
fn student_central(t: f64, freedom: usize) -> f64 {
    let nu = freedom as f64;
    let squared_cos = nu / (nu + t * t);
    let sin = t / (nu + t * t).sqrt();
    let odd = freedom % 2 == 1;
    let (mut term, mut numerator) = if odd { (squared_cos.sqrt(), 2.0) } else { (1.0, 1.0) };
    let mut sum = 0.0;
    for _ in 0..freedom / 2 {
        sum += term;
        term *= squared_cos * numerator / (numerator + 1.0);
        numerator += 2.0;
        if term < 1e-18 * sum {
            break;
        }
    }
    if odd { FRAC_2_PI * (libm::atan(t / nu.sqrt()) + sin * sum) } else { sin * sum }
}

/// 0.975 quantiles of Student's distribution; each is computed once and kept.
#[derive(Clone, Debug, Default)]
pub struct Student(std::collections::BTreeMap<usize, f64>);

impl Student {
    /// The t with P(|T| ≤ t) = 0.95 for so many degrees of freedom, by bisection to the last bit.
    pub fn quantile_975(&mut self, freedom: usize) -> f64 {
        *self.0.entry(freedom).or_insert_with(|| {
            let (low, high) = last_bit(1.0, 13.0, |t| student_central(t, freedom) < 0.95);
            0.5 * (low + high)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quantiles as textbooks print them (Fisher and Yates; NIST/SEMATECH handbook, 1.3.6.7.2).
    #[test]
    fn students_quantiles_are_those_of_the_textbooks() {
        let mut student = Student::default();
        for (freedom, t) in [
            (1, 12.706),
            (2, 4.303),
            (3, 3.182),
            (4, 2.776),
            (5, 2.571),
            (9, 2.262),
            (10, 2.228),
            (19, 2.093),
            (20, 2.086),
            (29, 2.045),
            (30, 2.042),
            (60, 2.000),
            (100, 1.984),
            (120, 1.980),
        ] {
            assert!((student.quantile_975(freedom) - t).abs() < 5.1e-4, "{freedom} degrees of freedom");
        }
        // For one degree: tan(0.475 π); for two: 0.95·√(2/(1 − 0.95²)).
        assert!((student.quantile_975(1) - libm::tan(0.475 * std::f64::consts::PI)).abs() < 1e-12);
        assert!((student.quantile_975(2) - 0.95 * (2.0_f64 / (1.0 - 0.95 * 0.95)).sqrt()).abs() < 1e-13);
        // Towards the normal distribution like z + (z³ + z)/(4ν).
        let z = NORMAL_975;
        for freedom in [1_000, 99_999, 1_000_000] {
            let nearly = z + (z * z * z + z) / (4.0 * freedom as f64);
            let second = 5.0 / (freedom as f64 * freedom as f64);
            assert!((student.quantile_975(freedom) - nearly).abs() < second + 1e-9, "{freedom}");
        }
    }

    #[test]
    fn quantiles_interpolate_as_r_and_numpy_do() {
        // numpy.quantile([1, 2, 3, 4, 10], [0.05, 0.25, 0.5, 0.75, 0.95])
        let sample = Statistics::of([10.0, 1.0, 3.0, f64::NAN, 2.0, 4.0], &mut Student::default());
        for (found, known) in sample.quantiles.iter().zip([1.2, 2.0, 3.0, 4.0, 8.8]) {
            assert!((found - known).abs() < 1e-12, "{sample:?}");
        }
        assert_eq!(quantile(&[7.0], 0.95), 7.0);
        assert!(quantile(&[], 0.5).is_nan());
    }

    /// Student's own data (Biometrika 6, 1908): the additional hours of sleep of ten patients; R's `t.test(extra)` of
    /// the first group gives 0.75 with the interval from −0.5297804 to 2.0297804.
    #[test]
    fn an_interval_is_that_of_the_t_test() {
        let sleep = [0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0];
        let statistics = Statistics::of(sleep, &mut Student::default());
        assert!((statistics.mean - 0.75).abs() < 1e-12);
        assert!((statistics.deviation - 1.789_010).abs() < 5e-7);
        assert!((statistics.interval[0] + 0.529_780_4).abs() < 5e-7, "{statistics:?}");
        assert!((statistics.interval[1] - 2.029_780_4).abs() < 5e-7, "{statistics:?}");
    }

    #[test]
    fn a_sample_that_is_too_small_says_so() {
        let one = Statistics::of([2.0], &mut Student::default());
        assert_eq!((one.count, one.mean), (1, 2.0));
        assert!(one.deviation.is_nan() && one.interval[0].is_nan());
        let none = Statistics::of([f64::NAN], &mut Student::default());
        assert!(none.count == 0 && none.mean.is_nan() && none.quantiles[0].is_nan());
    }

    /// Wilson's interval of 0 of 10 is [0, z²/(n + z²)], that of 10 of 10 its mirror image.
    #[test]
    fn a_share_has_a_width_also_where_all_values_are_equal() {
        let bound = NORMAL_975 * NORMAL_975 / (10.0 + NORMAL_975 * NORMAL_975);
        let none = Statistics::of_share([false; 10]);
        assert!(none.interval[0] == 0.0 && (none.interval[1] - bound).abs() < 1e-15, "{none:?}");
        let all = Statistics::of_share([true; 10]);
        assert!(all.interval[1] == 1.0 && (all.interval[0] - (1.0 - bound)).abs() < 1e-15, "{all:?}");
    }
}
