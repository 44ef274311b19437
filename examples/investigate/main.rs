//! Where the paper and Ringroad differ: which readings of the paper would give its numbers?
//!
//! `cargo run --release --example investigate -- crash|growth|balance|flow` prints the tables of
//! `docs/reproduction.md`. The readings are variants of the model, so they live here, in small simulators of
//! their own with plain loops over all pairs, and not in the core; the literal variant is held against the core
//! first.

#![allow(clippy::disallowed_methods)] // nothing here must have the same bits everywhere

mod balance;
mod crash;
mod flow;
mod growth;
mod lanes;
mod single;

fn main() {
    let name = std::env::args().nth(1).unwrap_or_default();
    match name.as_str() {
        "crash" => crash::main(),
        "growth" => growth::main(),
        "balance" => balance::main(),
        "flow" => flow::main(),
        _ => {
            eprintln!("usage: investigate crash|growth|balance|flow");
            std::process::exit(2);
        }
    }
}
