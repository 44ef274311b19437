//! The theory of heterogeneous drivers against eigenvalues of the whole system's matrix, which use none of it.

use super::*;
use crate::numerics::random::{Generator, Stream};
use crate::scenario::driver::Driver;
use crate::stability::jacobian;
use nalgebra::DMatrix;

const DT: f64 = 0.01;

fn default_slope() -> f64 {
    Driver::default().slope(20.0)
}

/// `quick` drivers without delay among 50 with 0.75 s.
fn with_quick_drivers(quick: usize) -> DriverClasses {
    let c = default_slope();
    DriverClasses::new((0..50).map(|j| (c, if j < quick { 0.0 } else { 0.75 })))
}

/// Largest |z| ≠ 1 of the whole difference system, drivers in the order given: x_j(n + 1) =
/// x_j(n) + dt·c_j·(x_{j+1}(n − m_j) − x_j(n − m_j)), as one matrix on all positions of the last steps.
fn largest_of_matrix(drivers: &[(f64, usize)], dt: f64) -> f64 {
    let n = drivers.len();
    let depth = drivers.iter().map(|d| d.1).max().unwrap() + 1;
    let mut matrix = DMatrix::<f64>::zeros(n * depth, n * depth);
    for (j, &(slope, m)) in drivers.iter().enumerate() {
        matrix[(j, j)] += 1.0;
        matrix[(j, m * n + j)] -= dt * slope;
        matrix[(j, m * n + (j + 1) % n)] += dt * slope;
    }
    for k in n..n * depth {
        matrix[(k, k - n)] = 1.0;
    }
    let mut sizes: Vec<f64> = jacobian::eigenvalues(matrix)
        .unwrap()
        .into_iter()
        .filter(|z| norm(z - 1.0) > 1e-9)
        .map(norm)
        .collect();
    sizes.sort_by(f64::total_cmp);
    *sizes.last().unwrap()
}

fn random_drivers(seed: u64, vehicles: usize, most_steps: u64) -> Vec<(f64, usize)> {
    let mut draw = Generator::new(seed, Stream::Start);
    (0..vehicles).map(|_| (0.2 + 1.8 * draw.uniform(), draw.below(most_steps + 1) as usize)).collect()
}

#[test]
fn followed_roots_dominate_the_whole_system_in_any_order() {
    let dt = 0.2;
    for seed in 0..40 {
        let vehicles = 2 + seed as usize % 7;
        let mut drivers = random_drivers(seed, vehicles, 6);
        let ring = DriverClasses::new(drivers.iter().map(|&(c, m)| (c, m as f64 * dt)));
        let fastest = ring.fastest(Time::Steps(dt)).unwrap();
        let size = crate::numerics::exp::exp(fastest.root.re * dt);
        for order in 0..3 {
            let expected = largest_of_matrix(&drivers, dt);
            assert!((size - expected).abs() < 1e-9, "seed {seed}, order {order}: {size} and {expected}");
            drivers.swap(0, vehicles / 2);
            drivers.reverse();
            drivers.rotate_left(1);
        }
    }
}

#[test]
fn without_delay_the_roots_are_the_eigenvalues_of_the_jacobian() {
    for seed in 0..10 {
        let slopes: Vec<_> = random_drivers(seed, 12, 0).into_iter().map(|d| d.0).collect();
        let numeric = jacobian::eigenvalues(jacobian::jacobian(&slopes)).unwrap();
        let ring = DriverClasses::new(slopes.iter().map(|&c| (c, 0.0)));
        let followed = ring.followed(Time::Continuous);
        assert_eq!(followed.modes.len(), 6);
        for mode in followed.modes {
            assert!(numeric.iter().any(|z| norm(z - mode.root) < 1e-9), "{mode:?}");
        }
    }
}

#[test]
fn homogeneous_drivers_are_a_special_case() {
    // Slopes that differ by 1e-13 are solved by the general method.
    for delay in [0.0, 0.3, 0.75, 1.2] {
        let c = default_slope();
        let nearly = DriverClasses::new((0..50).map(|j| (c * (1.0 + f64::from(j % 2) * 1e-13), delay)));
        let exact = HomogeneousRing { vehicles: 50, slope: c };
        for time in [Time::Continuous, Time::Steps(DT)] {
            assert!(nearly.homogeneous().is_none());
            let mut modes = nearly.followed(time).modes;
            // Beyond the first of a mode come unstable roots of other branches.
            modes.dedup_by_key(|m| m.mode);
            for mode in modes {
                let root = exact.root(mode.mode, delay, time);
                assert!(
                    norm(mode.root - root) < 1e-10 || mode.mode == 25 && same(mode.root, root),
                    "{mode:?} {root}"
                );
            }
            if delay > 0.0 {
                assert!((nearly.critical(time) - exact.critical(time)).abs() < 1e-9);
            }
        }
    }
}

/// The argument principle counts, for homogeneous drivers, exactly the unstable roots on the branches of W.
#[test]
fn the_count_finds_every_unstable_root() {
    for (vehicles, slope, delay) in
        [(2, 1.0, 5.0), (7, 0.8, 3.0), (50, 0.731_616, 0.75), (50, 0.7, 0.6), (50, 1.0, 9.0)]
    {
        let ring = HomogeneousRing { vehicles, slope };
        let mut expected = 0;
        for q in 1..vehicles {
            let d = ring.eigenvalue(q);
            expected += (-60..=60).filter(|&k| lambert_w(k, d * delay).re > 0.0).count();
        }
        let counted = DriverClasses::new(vec![(slope, delay); vehicles]).unstable_roots(Time::Continuous);
        assert_eq!(counted, Some(expected), "{ring:?} {delay}");
    }
}

#[test]
fn no_unstable_root_is_lost() {
    for seed in 0..60 {
        let drivers = random_drivers(seed, 3 + 2 * seed as usize % 48, 90);
        let ring = DriverClasses::new(drivers.iter().map(|&(c, m)| (c, m as f64 * DT)));
        for time in [Time::Continuous, Time::Steps(DT)] {
            let followed = ring.followed(time);
            assert_eq!(Some(followed.unstable), followed.counted, "seed {seed}, {time:?}");
            for mode in &followed.modes {
                assert!(ring.residual(mode.root, time) < 1e-10, "seed {seed}, {mode:?}");
            }
        }
    }
}

/// The model's specification: at N = 50, Δ = 0.75 s, dt = 0.01 s four drivers without delay do not stabilize the ring, five do.
#[test]
fn five_drivers_without_delay_stabilize_the_ring_and_four_do_not() {
    for (quick, stable) in [(0, false), (4, false), (5, true), (50, true)] {
        let fastest = with_quick_drivers(quick).fastest(Time::Steps(DT)).unwrap();
        assert_eq!(fastest.root.re < 0.0, stable, "{quick}: {fastest:?}");
    }
}

/// At the critical mean delay the largest real part is 0, just below negative, just above positive.
#[test]
fn the_critical_delay_is_where_the_largest_real_part_vanishes() {
    let rings = (0..20).map(|seed| {
        let drivers = random_drivers(seed, 3 + seed as usize, 90);
        DriverClasses::new(drivers.iter().map(|&(c, m)| (c, m as f64 * DT)))
    });
    for ring in rings.chain([3, 10, 40].map(with_quick_drivers)) {
        for time in [Time::Continuous, Time::Steps(DT)] {
            let critical = ring.critical(time);
            let at = |factor: f64| ring.at_mean_delay(critical * factor).followed(time);
            assert_eq!(at(1.0 - 1e-6).counted, Some(0), "{ring:?} {critical}");
            assert!(at(1.0 + 1e-6).counted > Some(0), "{ring:?} {critical}");
            assert!(at(1.0).fastest().unwrap().root.re.abs() < 1e-9);
        }
    }
}

/// For long waves and equal slopes it is the mean delay that must stay below 1/(2c).
#[test]
fn the_mean_delay_decides_for_long_waves() {
    let ring = DriverClasses::new((0..2000).map(|j| (1.0, if j % 4 == 0 { 0.0 } else { 0.6 })));
    assert!((ring.crossing(1, Time::Continuous).unwrap() - 0.5).abs() < 1e-6);
    // With delays so different, shorter waves are even less stable.
    assert!(ring.critical(Time::Continuous) < 0.49);
}

/// The longest wave of a large ring is critical at Newell's limit, also where slopes and delays differ.
#[test]
fn long_waves_have_newells_limit() {
    let ring = DriverClasses::new((0..4000).map(|j| if j % 3 == 0 { (1.4, 0.9) } else { (0.6, 0.5) }));
    let limit = ring.newell_limit();
    assert!((ring.crossing(1, Time::Continuous).unwrap() - limit).abs() < 1e-5, "{limit}");
    assert_eq!(DriverClasses::new([(0.8, 1.0); 9]).newell_limit(), 0.625);
}

#[test]
fn large_rings_find_the_fastest_mode_from_some_modes() {
    let drivers = |n: usize| (0..n).map(move |j| (0.9, if j * 10 < n { 0.0 } else { 0.8 }));
    let ring = DriverClasses::new(drivers(3000));
    let (paths, slope, tau) = ring.paths();
    let all = (1..=1500).filter_map(|q| ring.follow_along(&paths, slope, tau, q, 0, Time::Steps(DT)));
    let largest = all.map(|s| s.re).fold(f64::NEG_INFINITY, f64::max);
    assert_eq!(ring.fastest(Time::Steps(DT)).unwrap().root.re, largest);
}

#[test]
fn behind_a_slow_vehicle_on_a_long_road_no_mode_grows() {
    let mut drivers = vec![Driver::default(); 10];
    drivers[0].max_speed = 5.0;
    let ring = DriverClasses::of(&drivers, vec![0.3; 10], 1000.0);
    let followed = ring.followed(Time::Continuous);
    assert_eq!(followed.counted, Some(0));
    assert_eq!(followed.unstable, 0);
}
