//! The core as the page sees it: functions and classes of the two WebAssembly modules. Numbers and texts go in; typed
//! arrays and JSON come out. Nothing is computed here: each function asks the layers below. An error comes out as an
//! exception with the text of [`crate::error::Error`].
//!
//! There are two modules, so that a visitor does not load what the first screen does not need: the feature `laboratory`
//! builds the first, `figures` the second, with the paper's figures and the export of tables. The linker leaves out what a
//! module does not reach.
//!
//! [`types`] compiles natively too, since a test makes the page's TypeScript declarations from it.

// JavaScript hands over owned values, and `map_err` wants a function of an owned error.
#![allow(clippy::needless_pass_by_value)]

#[cfg(all(target_arch = "wasm32", feature = "figures"))]
pub mod export;
#[cfg(all(target_arch = "wasm32", feature = "figures"))]
pub mod figures;
#[cfg(all(target_arch = "wasm32", feature = "laboratory"))]
pub mod laboratory;
#[cfg(all(target_arch = "wasm32", feature = "laboratory"))]
mod map_painter;
#[cfg(all(target_arch = "wasm32", feature = "laboratory"))]
pub mod run;
#[cfg(all(target_arch = "wasm32", feature = "laboratory"))]
pub mod stability;
pub mod types;

/// The exception that JavaScript sees.
#[cfg(all(target_arch = "wasm32", any(feature = "figures", feature = "laboratory")))]
fn refusal(e: crate::error::Error) -> wasm_bindgen::JsError {
    wasm_bindgen::JsError::new(&e.to_string())
}
