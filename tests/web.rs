//! The core in a real browser: the threshold of stability, and the same bits as natively.
#![cfg(target_arch = "wasm32")]

#[path = "common/bits.rs"]
mod bits;
mod common;

use common::{growth_of_mode, theory};
use ringroad::scenario::Scenario;
use wasm_bindgen_test::{wasm_bindgen_test, wasm_bindgen_test_configure};

wasm_bindgen_test_configure!(run_in_browser);

#[wasm_bindgen_test]
fn at_50_vehicles_67_steps_are_stable_and_68_are_not() {
    for steps in [67, 68] {
        let mut scenario = Scenario { until: 3000.0, ..Scenario::default() };
        scenario.driver.reaction_time = f64::from(steps) * 0.01;
        scenario.actions.push("at=0:1:nudge=0.001".parse().unwrap());
        let predicted = theory::growth(50, 1, steps, 0.01);
        let measured = growth_of_mode(&scenario, 1, 500.0, 3000.0);
        assert_eq!(predicted > 0.0, steps == 68);
        assert!(
            (measured / predicted - 1.0).abs() < 0.02,
            "{steps} steps: measured {measured}, theory {predicted}"
        );
    }
}

#[wasm_bindgen_test]
fn tables_have_the_same_bits_as_natively() {
    bits::are_native();
}
