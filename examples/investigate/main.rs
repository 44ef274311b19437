//! Where the numbers of the paper and of Ringroad differ: which readings of the paper would give its numbers?
//!
//! `cargo run --release --example investigate -- crash|growth|balance|maps|search|flow` prints the tables of
//! `docs/reproduction.md`; `maps` also writes its pictures and their numbers into `docs/reproduction/`, or into the
//! folder of its argument. The readings are variants of the model, so they are in small simulators here and not in the
//! core. The variant that follows the paper to the letter is compared with the core first.

#![allow(clippy::disallowed_methods)] // these numbers need not have the same bits on every machine

mod balance;
mod crash;
mod flow;
mod growth;
mod lanes;
mod maps;
mod single;

use std::path::Path;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.first().map_or("", String::as_str) {
        "crash" => crash::main(),
        "growth" => growth::main(),
        "balance" => balance::main(),
        "maps" => maps::main(Path::new(arguments.get(1).map_or("docs/reproduction", String::as_str))),
        "search" => maps::search(),
        "flow" => flow::main(),
        _ => {
            eprintln!("usage: investigate crash|growth|balance|maps [FOLDER]|search|flow");
            std::process::exit(2);
        }
    }
}
