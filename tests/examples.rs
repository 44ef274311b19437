//! The examples for users give what their comments promise.
#![cfg(not(target_arch = "wasm32"))]

// Their `main` functions print and are not called here.
#[allow(dead_code)]
#[path = "../examples/own_probe.rs"]
mod own_probe;
#[allow(dead_code)]
#[path = "../examples/stabilizing_drivers.rs"]
mod stabilizing_drivers;
#[allow(dead_code)]
#[path = "../examples/sweep.rs"]
mod sweep;
#[allow(dead_code)]
#[path = "../examples/theory_beside_run.rs"]
mod theory_beside_run;

#[test]
fn the_sweep_has_a_row_for_each_reaction_time_and_quantity() {
    let csv = sweep::sweep().unwrap();
    let rows: Vec<_> = csv.lines().filter(|line| !line.starts_with('#')).collect();
    assert!(rows[0].starts_with("reaction_time"), "{}", rows[0]);
    for reaction_time in ["0.55", "0.6", "0.65", "0.7", "0.75", "0.8"] {
        let of_this = |row: &&&str| row.starts_with(&format!("{reaction_time},"));
        assert!(rows.iter().filter(of_this).count() > 1, "{csv}");
    }
}

#[test]
fn ones_own_probe_finds_the_smallest_headway_of_every_step() {
    let table = own_probe::smallest_headways().unwrap();
    let (times, headways) = (table.floats("time_s").unwrap(), table.floats("headway_m").unwrap());
    assert_eq!((times[0], *times.last().unwrap(), table.rows()), (0.0, 60.0, 6001));
    // Vehicle 1 starts 1 m further downstream than in equilibrium, 20 m behind the vehicle ahead.
    assert_eq!((table.wholes("vehicle").unwrap()[0], headways[0]), (1, 19.0));
    assert!(headways.iter().all(|&headway| headway < 20.0));
}

#[test]
fn so_many_quick_drivers_stabilize_the_ring_and_one_fewer_does_not() {
    let ring = stabilizing_drivers::ring();
    let number = stabilizing_drivers::by_theory(&ring).unwrap().unwrap();
    assert_eq!(number, 5);
    let range = |quick| stabilizing_drivers::by_run(&ring, quick).unwrap();
    assert!(range(number) < 1e-3, "{}", range(number));
    assert!(range(number - 1) > 1e-2, "{}", range(number - 1));
}

#[test]
fn the_growth_rate_of_a_run_is_that_of_the_theory() {
    for reaction_time in [0.5, 0.6, 0.65, 0.7] {
        let rates = theory_beside_run::growth_rates(reaction_time).unwrap();
        assert_eq!(rates.theory > 0.0, reaction_time > 0.67);
        let difference = (rates.measured - rates.theory).abs();
        assert!(difference < 1e-4, "Δ = {reaction_time} s: {} and {}", rates.measured, rates.theory);
    }
}
