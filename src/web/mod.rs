//! The doors of the WebAssembly modules: numbers and texts in, typed arrays and JSON out, and the maps painted on
//! their canvas. They decide nothing; a refusal comes out as the text of [`crate::error::Error`].
//!
//! There are two modules, so that who opens the laboratory does not load the paper's figures: the feature
//! `laboratory` builds the one, `figures` the other, and a module carries only what its doors reach.

// What JavaScript hands over is owned, and errors go where `map_err` wants a function of one.
#![allow(clippy::needless_pass_by_value)]

#[cfg(feature = "figures")]
pub mod figures;
#[cfg(feature = "laboratory")]
pub mod laboratory;
#[cfg(feature = "laboratory")]
pub mod stability;

#[cfg(any(feature = "figures", feature = "laboratory"))]
fn refusal(e: crate::error::Error) -> wasm_bindgen::JsError {
    wasm_bindgen::JsError::new(&e.to_string())
}
