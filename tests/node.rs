//! The core in Node: the same bits as natively.
#![cfg(target_arch = "wasm32")]

#[path = "common/bits.rs"]
mod bits;

use wasm_bindgen_test::wasm_bindgen_test;

#[wasm_bindgen_test]
fn tables_have_the_same_bits_as_natively() {
    bits::are_native();
}
