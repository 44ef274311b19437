//! The theory of homogeneous drivers, stated and checked.

use super::*;
use crate::numerics::bisection::last_bit;
use crate::numerics::complex::norm;
use crate::scenario::driver::Driver;

fn default_ring(vehicles: usize) -> HomogeneousRing {
    HomogeneousRing { vehicles, slope: Driver::default().slope(1000.0 / vehicles as f64) }
}

/// The values of the model's specification.
#[test]
fn known_values() {
    let ring = default_ring(50);
    assert!((ring.slope - 0.731_616).abs() < 5e-7);
    assert!((ring.critical(Time::Continuous) - 0.683_869).abs() < 5e-7);
    assert!((ring.critical(Time::Steps(0.01)) - 0.678_869).abs() < 5e-7);
    assert!((ring.critical(Time::Steps(0.05)) - 0.658_868).abs() < 5e-7);
    for (vehicles, expected) in [(25, 1.129_738), (100, 0.532_335), (133, 0.500_282)] {
        assert!((default_ring(vehicles).critical(Time::Continuous) - expected).abs() < 5e-7);
    }
    let largest = |steps: f64| ring.fastest(steps * 0.01, Time::Steps(0.01)).unwrap().root.re;
    assert!(largest(67.0) < 0.0 && largest(68.0) > 0.0);
}

#[test]
fn every_root_satisfies_its_equation_and_the_principal_branch_dominates() {
    for vehicles in [2, 3, 4, 7, 25, 50, 133] {
        for slope in [0.05, 0.731_616, 1.0, 6.0] {
            let ring = HomogeneousRing { vehicles, slope };
            for delay in [0.01, 0.1, 0.3, 0.5, 0.683_869, 1.0, 3.0] {
                for q in ring.modes() {
                    let principal = ring.root_on(q, 0, delay);
                    assert!(principal.residual < 1e-10, "{principal:?}");
                    for k in -5..=5 {
                        let root = ring.root_on(q, k, delay);
                        assert!(root.residual < 1e-10, "N = {vehicles}, q = {q}: {root:?}");
                        assert!(root.value.re <= principal.value.re + 1e-9, "{principal:?}, {root:?}");
                        assert!(k == 0 || norm(root.value - principal.value) > 1e-6 || q * 2 == vehicles);
                    }
                }
            }
        }
    }
}

#[test]
fn leading_roots_are_sorted_by_falling_real_part() {
    let ring = default_ring(50);
    for q in ring.modes() {
        let roots = ring.leading_roots(q, 0.75, 6);
        assert_eq!(roots.len(), 6);
        assert_eq!(roots[0].value, ring.root(q, 0.75, Time::Continuous));
        assert!(roots.windows(2).all(|w| w[0].value.re >= w[1].value.re - 1e-12));
        // No root is missing: those of the next branches lie further left.
        for k in [-8, -7, 7, 8] {
            assert!(ring.root_on(q, k, 0.75).value.re <= roots[5].value.re);
        }
    }
    assert_eq!(ring.leading_roots(3, 0.0, 6).len(), 1);
}

/// The reaction time at which the largest real part passes 0, by bisection.
fn critical_by_roots(ring: &HomogeneousRing, time: Time) -> f64 {
    let stable = |delay| ring.modes().all(|q| ring.root(q, delay, time).re <= 0.0);
    last_bit(1e-6, 20.0 / ring.slope, stable).0
}

#[test]
fn the_roots_cross_the_axis_where_the_closed_form_says() {
    for vehicles in [2, 3, 4, 5, 10, 25, 50, 133] {
        for slope in [0.1, 0.731_616, 1.0, 2.0] {
            let ring = HomogeneousRing { vehicles, slope };
            for time in [Time::Continuous, Time::Steps(0.01), Time::Steps(0.1), Time::Steps(0.3)] {
                let (exact, numeric) = (ring.critical(time), critical_by_roots(&ring, time));
                assert!((exact - numeric).abs() < 1e-9, "{ring:?}, {time:?}: {exact} and {numeric}");
            }
        }
    }
}

/// All roots z of z^{m+1} = z^m + dt·d, from the companion matrix.
fn all_z(d: Complex64, m: usize, dt: f64) -> Vec<Complex64> {
    let mut companion = nalgebra::DMatrix::<Complex64>::zeros(m + 1, m + 1);
    companion[(0, 0)] = Complex64::ONE;
    companion[(0, m)] += d * dt;
    for k in 0..m {
        companion[(k + 1, k)] = Complex64::ONE;
    }
    let (_, triangle) = nalgebra::linalg::Schur::try_new(companion, 1e-15, 100_000).unwrap().unpack();
    (0..=m).map(|k| triangle[(k, k)]).collect()
}

#[test]
fn the_dominant_root_in_steps_is_the_largest_of_the_difference_equation() {
    for dt in [0.01, 0.05, 0.2, 0.5] {
        for slope in [0.05, 0.731_616, 2.0, 5.0, 20.0] {
            for vehicles in [2, 3, 5, 50] {
                let ring = HomogeneousRing { vehicles, slope };
                for m in [0, 1, 2, 3, 7, 20] {
                    for q in ring.modes().step_by(7) {
                        let d = ring.eigenvalue(q);
                        let s = ring.root(q, m as f64 * dt, Time::Steps(dt));
                        let z = exp(s * dt);
                        let mut power = Complex64::ONE;
                        (0..m).for_each(|_| power *= z);
                        let residual = norm(power * (z - 1.0) - d * dt) / norm(d * dt);
                        assert!(residual < 1e-10, "{ring:?} q {q} m {m} dt {dt}: {s}, {residual:e}");
                        let largest = all_z(d, m, dt).into_iter().map(norm).fold(0.0, f64::max);
                        // Where two roots meet, either solver keeps half the digits.
                        assert!((norm(z) - largest).abs() < 1e-7, "{ring:?} {q} {m} {dt}: {z} {largest}");
                    }
                }
            }
        }
    }
}

#[test]
fn the_fastest_mode_is_the_fastest_of_all() {
    for vehicles in [2, 3, 4, 5, 9, 50, 133, 400] {
        for slope in [0.02, 0.3, 0.731_616, 1.0, 3.0, 20.0] {
            let ring = HomogeneousRing { vehicles, slope };
            for time in [Time::Continuous, Time::Steps(0.01), Time::Steps(0.1), Time::Steps(0.5)] {
                for steps in 0..40 {
                    let delay = match time {
                        Time::Continuous => f64::from(steps * steps) * 0.004,
                        Time::Steps(dt) => f64::from(steps) * dt,
                    };
                    let all = ring.modes().map(|q| ring.root(q, delay, time).re);
                    let largest = all.fold(f64::NEG_INFINITY, f64::max);
                    let found = ring.fastest(delay, time).unwrap();
                    assert!(
                        found.root.re >= largest - 1e-12 * largest.abs(),
                        "{ring:?} {time:?} {delay}: {found:?}, {largest}"
                    );
                }
            }
        }
    }
}

#[test]
fn limits() {
    // N → L/d: the slope tends to λ and the threshold to Newell's 1/(2λ).
    let dense = default_ring(133);
    assert!((dense.slope - 1.0).abs() < 1e-3);
    assert!((dense.critical(Time::Continuous) - 0.5).abs() < 1e-3);
    let infinite = HomogeneousRing { vehicles: 1_000_000, slope: 1.0 };
    assert!((infinite.critical(Time::Continuous) - infinite.newell_limit()).abs() < 1e-11);
    // N = 2: a = π/2, d = −2c, τ = π/(4c). N = 3: a = π/3, τ = π/(3√3·c).
    let two = HomogeneousRing { vehicles: 2, slope: 0.5 };
    assert_eq!(two.eigenvalue(1), Complex64::new(-1.0, 0.0));
    assert!((two.critical(Time::Continuous) - PI / 2.0).abs() < 1e-15);
    let three = HomogeneousRing { vehicles: 3, slope: 0.5 };
    assert!((three.critical(Time::Continuous) - PI / (3.0 * libm::sqrt(3.0) * 0.5)).abs() < 1e-15);
    // Without delay the roots are the eigenvalues, all on the left.
    for q in dense.modes() {
        assert_eq!(dense.root(q, 0.0, Time::Continuous), dense.eigenvalue(q));
        assert!(dense.eigenvalue(q).re < 0.0);
    }
    // The jam: nothing grows, whatever the delay.
    let jam = default_ring(134);
    assert_eq!(jam.slope, 0.0);
    assert_eq!(jam.critical(Time::Continuous), f64::INFINITY);
    assert_eq!(jam.root(1, 5.0, Time::Steps(0.01)), Complex64::ZERO);
    assert!(jam.fastest(5.0, Time::Continuous).is_none());
    // A vehicle alone has no modes.
    let alone = HomogeneousRing { vehicles: 1, slope: 1.0 };
    assert_eq!(alone.critical(Time::Steps(0.01)), f64::INFINITY);
    assert!(alone.fastest(1.0, Time::Continuous).is_none());
}

#[test]
fn steps_too_long_for_the_slope_are_unstable_at_any_delay() {
    let ring = HomogeneousRing { vehicles: 50, slope: 3.0 };
    assert_eq!(ring.critical(Time::Steps(0.5)), 0.0);
    assert!(ring.fastest(0.0, Time::Steps(0.5)).unwrap().root.re > 0.0);
    assert!(ring.fastest(0.0, Time::Steps(0.3)).unwrap().root.re < 0.0);
}

/// Steps tend to continuous time as they shrink.
#[test]
fn short_steps_tend_to_continuous_time() {
    let ring = default_ring(50);
    for q in [1, 5, 25] {
        let exact = ring.root(q, 0.75, Time::Continuous);
        let error = |dt: f64| norm(ring.root(q, 0.75, Time::Steps(dt)) - exact);
        let ratio = error(0.01) / error(0.005);
        assert!((ratio - 2.0).abs() < 0.05, "q = {q}: {ratio}");
    }
}
