//! Scenarios with names, each with what to notice and what to try next.
//!
//! ```
//! use ringroad::scenario::presets::preset;
//!
//! let jam = preset("phantom-jam").unwrap();
//! assert_eq!(jam.scenario.driver.reaction_time, 0.75);
//! assert!(preset("jam").unwrap_err().to_string().contains("phantom-jam"));
//! ```

use crate::error::{Error, quoted};
use crate::scenario::action::{Action, DriverOverride};
use crate::scenario::{Scenario, Start};
use serde::Serialize;

/// A scenario with a name.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Preset {
    /// Name, as the command and the link write it.
    pub name: &'static str,
    /// Title for people.
    pub title: &'static str,
    /// What to notice.
    pub notice: &'static str,
    /// What to try next.
    pub next: &'static str,
    /// The scenario.
    pub scenario: Scenario,
}

/// Fifty vehicles in one lane, steps of 0.01 s, vehicle 1 pushed ahead by 1 m at t = 0.
fn nudged(reaction_time: f64) -> Scenario {
    let mut scenario = Scenario { actions: vec![action("at=0:1:nudge=1")], ..Scenario::default() };
    scenario.driver.reaction_time = reaction_time;
    scenario
}

/// Two or more lanes in steps of 0.05 s.
fn lanes(vehicles: usize, lanes: usize, start: Start, frustration: (f64, f64)) -> Scenario {
    let mut scenario = Scenario { vehicles, lanes, start, time_step: 0.05, ..Scenario::default() };
    scenario.driver.frustration_rate = frustration.0;
    scenario.driver.pass_frustration = frustration.1;
    scenario
}

fn action(text: &str) -> Action {
    text.parse().unwrap_or_else(|e: Error| panic!("{e}"))
}

fn differing(text: &str) -> DriverOverride {
    text.parse().unwrap_or_else(|e: Error| panic!("{e}"))
}

/// Every preset, in the order in which people read them.
pub fn presets() -> Vec<Preset> {
    let aggressive = Scenario {
        overrides: vec![differing("1:sensitivity=2")],
        ..lanes(50, 2, Start::Staggered, (0.1, 0.1))
    };
    let mut heterogeneous = lanes(60, 2, Start::Uniform, (0.1, 0.1));
    heterogeneous.driver.reaction_time = 0.3;
    heterogeneous.overrides =
        vec![differing("20%:max-speed=25,vehicle-length=8,min-headway=12"), differing("10%:sensitivity=2")];
    vec![
        Preset {
            name: "instant",
            title: "No reaction time",
            notice: "Drivers respond at once: after one round of the ring, 68 s, a wave of millimetres is left of the nudge.",
            next: "Raise the reaction time to 0.5 s and see how much longer the wave lives.",
            scenario: nudged(0.0),
        },
        Preset {
            name: "stable",
            title: "Stable",
            notice: "With a reaction time of 0.5 s, below the critical 0.679 s, the wave travels upstream and fades.",
            next: "Raise the reaction time past 0.679 s. Or leave it and add vehicles: with 126 the ring is still stable, \
                   with 127 it is not.",
            scenario: nudged(0.5),
        },
        Preset {
            name: "marginal",
            title: "At the edge",
            notice: "At 0.68 s, 68 steps of delay, the ring is just unstable: the longest wave grows, but so slowly \
                     that it doubles in 20 hours. At 67 steps it fades.",
            next: "Lower the reaction time by one step to 0.67 s, then raise it to 0.7 s, and compare the growth.",
            scenario: nudged(0.68),
        },
        Preset {
            name: "phantom-jam",
            title: "Phantom jam",
            notice: "At 0.75 s nobody brakes and nothing is in the way, and yet the wave grows, splits into several \
                     jams and ends in a collision.",
            next: "Lower the reaction time while the jam grows: how late is still early enough?",
            scenario: nudged(0.75),
        },
        Preset {
            name: "load-balance",
            title: "Two lanes share the load",
            notice: "All 50 vehicles start in one lane; frustration moves them over until both lanes carry about \
                     the same number, and flow rises.",
            next: "Lower r and p: the lanes balance later, and with fewer lane changes.",
            scenario: lanes(50, 2, Start::OneLane(1), (0.1, 0.2)),
        },
        Preset {
            name: "aggressive",
            title: "One aggressive driver",
            notice: "Vehicle 1 follows twice as sharply as the others (λ = 2). It changes lanes far more often and \
                     hardly gets further.",
            next: "Compare its lane changes with those of its neighbours in the other lane; then make ten drivers \
                   aggressive.",
            scenario: aggressive,
        },
        Preset {
            name: "three-lanes",
            title: "Three lanes",
            notice: "All start in the middle lane, with an empty lane on either side: at first a coin decides which \
                     way to turn.",
            next: "Start all in lane 1 instead, and watch lane 3 fill by way of lane 2.",
            scenario: lanes(60, 3, Start::OneLane(2), (0.1, 0.1)),
        },
        Preset {
            name: "mixed-traffic",
            title: "Mixed traffic",
            notice: "A fifth of the vehicles are lorries, long and at most 25 m/s fast, and a tenth of the drivers are \
                     aggressive: queues form behind the lorries, and who can changes lanes.",
            next: "Add a third lane, or make all drivers patient with p = 0.",
            scenario: heterogeneous,
        },
    ]
}

/// The preset of that name.
pub fn preset(name: &str) -> Result<Preset, Error> {
    let mut all = presets();
    if let Some(k) = all.iter().position(|p| p.name == name) {
        return Ok(all.swap_remove(k));
    }
    let names: Vec<_> = all.iter().map(|p| p.name).collect();
    Err(Error::unknown("preset", quoted(name), names.join(", ")))
}
