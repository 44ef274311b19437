//! The same bits everywhere, the native part. Every width of vector gives the same tables; their hashes go to the file
//! that the environment variable `RINGROAD_HASHES` names, where the tests in the browser and in Node find them.
#![cfg(not(target_arch = "wasm32"))]

#[path = "common/bits.rs"]
mod bits;

use ringroad::numerics::simd::Width;
use ringroad::simulation::Simulation;
use std::collections::BTreeMap;

#[test]
fn every_width_gives_the_same_bits() {
    let mut hashes = BTreeMap::new();
    for (name, scenario, measurement) in bits::cases() {
        let by_width: Vec<_> = Width::available()
            .into_iter()
            .map(|width| {
                let mut simulation = Simulation::new(&scenario).unwrap();
                simulation.set_width(width);
                bits::hash(simulation, &measurement)
            })
            .collect();
        assert!(by_width.iter().all(|hash| *hash == by_width[0]), "{name}: {by_width:?}");
        hashes.insert(name, by_width[0].clone());
    }
    hashes.insert("batch", bits::batch());
    let different: std::collections::BTreeSet<_> = hashes.values().collect();
    assert_eq!(different.len(), hashes.len(), "each case has a table of its own");
    let file = std::path::Path::new(env!("RINGROAD_HASHES"));
    // Cargo may build somewhere else, and then the folder `target` is not there.
    std::fs::create_dir_all(file.parent().unwrap()).unwrap();
    std::fs::write(file, serde_json::to_string_pretty(&hashes).unwrap()).unwrap();
}
