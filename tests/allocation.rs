//! A step allocates no memory, and a simulation takes as much memory a vehicle as its documentation states.
#![allow(unsafe_code)] // an allocator that counts is an `unsafe impl`

use ringroad::scenario::{Scenario, Start};
use ringroad::simulation::{Event, Simulation};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

/// Counts the allocations of each thread and the bytes it holds.
struct Counting;

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
    static BYTES: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: every call is passed on unchanged to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        BYTES.with(|bytes| bytes.set(bytes.get().wrapping_add(layout.size())));
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        BYTES.with(|bytes| bytes.set(bytes.get().wrapping_sub(layout.size())));
        unsafe { System.dealloc(pointer, layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        BYTES.with(|bytes| bytes.set(bytes.get().wrapping_add(size).wrapping_sub(layout.size())));
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Allocations during 2000 steps after 500, and the lane changes made in them.
fn measure(scenario: &Scenario) -> (u64, usize) {
    let mut simulation = Simulation::new(scenario).unwrap();
    simulation.run_to(500);
    let before = ALLOCATIONS.with(Cell::get);
    let mut changes = 0;
    for _ in 0..2000 {
        simulation.step();
        changes += simulation.events().iter().filter(|e| matches!(e, Event::LaneChange { .. })).count();
    }
    // Many steps at once, too.
    simulation.run_to(4500);
    assert_eq!(simulation.step_index(), 4500, "the run did not end before");
    (ALLOCATIONS.with(Cell::get) - before, changes)
}

#[test]
fn the_allocator_counts() {
    let before = ALLOCATIONS.with(Cell::get);
    drop(std::hint::black_box(vec![1_u8; 10]));
    assert!(ALLOCATIONS.with(Cell::get) > before);
}

#[test]
fn a_step_allocates_nothing() {
    let mut scenario = Scenario { vehicles: 50, ..Scenario::default() };
    scenario.driver.reaction_time = 0.5;
    scenario.actions.push("at=0:1:nudge=1".parse().unwrap());
    assert_eq!(measure(&scenario).0, 0, "one lane");

    scenario.overrides.push("20%:sensitivity=1.5,reaction-time=0.2".parse().unwrap());
    assert_eq!(measure(&scenario).0, 0, "heterogeneous drivers");

    scenario = Scenario { vehicles: 50, lanes: 2, time_step: 0.05, start: Start::OneLane(1), ..scenario };
    scenario.driver.reaction_time = 0.0;
    let (allocations, changes) = measure(&scenario);
    assert!(changes > 20, "{changes} lane changes");
    assert_eq!(allocations, 0, "two lanes");
}

/// As the documentation of `simulation` says.
#[test]
fn memory_per_vehicle_is_what_is_stated() {
    let per_vehicle = |lanes: usize, delay: usize| {
        let n = 10_000;
        let length = 20.0 * n as f64 / lanes as f64;
        let mut scenario = Scenario { vehicles: n, lanes, length, ..Scenario::default() };
        scenario.driver.reaction_time = delay as f64 * scenario.time_step;
        let before = BYTES.with(Cell::get);
        let mut simulation = Simulation::new(&scenario).unwrap();
        simulation.run_to(200);
        let bytes = BYTES.with(Cell::get).wrapping_sub(before);
        drop(simulation);
        bytes as f64 / n as f64
    };
    let measured = [(1, 0), (1, 50), (1, 150), (2, 0), (2, 50)].map(|(lanes, delay)| {
        let rest = per_vehicle(lanes, delay) - 8.0 * (delay + 2) as f64;
        println!("{lanes} lanes, {delay} steps: {rest:.1} bytes beside the history");
        (lanes, rest)
    });
    for (lanes, rest) in measured {
        let stated = if lanes == 1 { 215.0 } else { 275.0 };
        assert!(rest <= stated && rest > 0.9 * stated, "{lanes} lanes: {rest}");
    }
}
