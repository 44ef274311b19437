//! The times of the collisions at Δ = 0.75 s and 0.8 s under every choice that the paper leaves open.

use crate::single::{Past, Reading, Update, collision};
use rayon::prelude::*;
use ringroad::scenario::Scenario;
use ringroad::simulation::Simulation;

/// A reading, and its collisions at 0.75 s and at 0.8 s.
type Collisions = (Reading, (Option<f64>, Option<f64>));

/// The paper to the letter.
const LITERAL: Reading = Reading {
    displacement: 1.0,
    reaction_time: 0.75,
    extra_steps: 0,
    dt: 0.01,
    past: Past::Displaced,
    update: Update::Together,
};
/// End of a run without a collision, s.
const UNTIL: f64 = 600.0;
/// A round trip of the disturbance, N/c, s.
const CYCLE: f64 = 68.34;

/// The times of the collisions at 0.75 s and at 0.8 s.
fn both(reading: Reading) -> (Option<f64>, Option<f64>) {
    let at = |reaction_time| collision(Reading { reaction_time, ..reading }, UNTIL);
    (at(0.75), at(0.8))
}

fn words(time: Option<f64>) -> String {
    time.map_or_else(|| "none".into(), |t| format!("{t:.1}"))
}

fn row(name: &str, reading: Reading) {
    let (a, b) = both(reading);
    println!("| {name} | {} | {} |", words(a), words(b));
}

/// Prints the collisions with one choice changed, the readings that meet the paper's two statements, and a finer search
/// over the displacement.
pub fn main() {
    for reaction_time in [0.75, 0.8] {
        let mut scenario = Scenario { until: UNTIL, ..Scenario::default() };
        scenario.driver.reaction_time = reaction_time;
        scenario.actions.push("at=0:1:nudge=1".parse().expect("an action"));
        let mut core = Simulation::new(&scenario).expect("a valid scenario");
        core.run_to(u64::MAX);
        let here = collision(Reading { reaction_time, ..LITERAL }, UNTIL);
        assert_eq!(core.collision().map(|c| (c.time * 100.0).round()), here.map(|t| (t * 100.0).round()));
    }
    println!("The literal reading gives the collision times of the core at both delays.\n");
    println!("| one thing changed | collision at 0.75 s (s) | at 0.8 s (s) |\n|---|---|---|");
    row("none: 1 m, 75 and 80 steps of 0.01 s", LITERAL);
    for displacement in [0.5, 1.5, 2.0, 3.0, 5.0, 8.0, -1.0, -3.0] {
        row(&format!("displacement {displacement} m"), Reading { displacement, ..LITERAL });
    }
    for extra_steps in [-2, -1, 1, 2] {
        row(&format!("{extra_steps:+} steps of delay"), Reading { extra_steps, ..LITERAL });
    }
    for dt in [0.001, 0.002, 0.005, 0.025, 0.05] {
        row(&format!("dt = {dt} s"), Reading { dt, ..LITERAL });
    }
    for past in [Past::Equal, Past::NoDelayYet] {
        row(&format!("past: {past:?}"), Reading { past, ..LITERAL });
    }
    for update in [Update::InTurn, Update::OneStepLate] {
        row(&format!("update: {update:?}"), Reading { update, ..LITERAL });
    }

    let mut readings = Vec::new();
    for displacement in (-12..=60).filter(|&k| k != 0).map(|k| f64::from(k) * 0.25) {
        for extra_steps in -1..=2 {
            for dt in [0.005, 0.01, 0.05] {
                for past in [Past::Displaced, Past::Equal, Past::NoDelayYet] {
                    for update in [Update::Together, Update::InTurn, Update::OneStepLate] {
                        readings.push(Reading { displacement, extra_steps, dt, past, update, ..LITERAL });
                    }
                }
            }
        }
    }
    let results: Vec<Collisions> = readings.par_iter().map(|&r| (r, both(r))).collect();
    let fits_75 = |t: Option<f64>| t.is_some_and(|t| (t - 217.0).abs() <= 1.0);
    let fits_80 = |t: Option<f64>| t.is_some_and(|t| t <= CYCLE);
    let count = |f: &dyn Fn(&Collisions) -> bool| results.iter().filter(|r| f(r)).count();
    println!(
        "\nReadings tried: {}, all combinations of 72 displacements from −3 to 15 m, −1 to +2 steps, dt of 0.005, 0.01 and 0.05 s, three pasts, three updates.\n",
        results.len()
    );
    println!("| statement of the paper | readings that meet it |\n|---|---|");
    println!("| collision at 217 ± 1 s for 0.75 s | {} |", count(&|r| fits_75(r.1.0)));
    println!("| collision within a round trip of {CYCLE} s for 0.8 s | {} |", count(&|r| fits_80(r.1.1)));
    println!("| both | {} |", count(&|r| fits_75(r.1.0) && fits_80(r.1.1)));
    let literal = |r: &Reading| r.dt == 0.01 && r.past == Past::Displaced && r.update == Update::Together;
    println!(
        "| both, with dt, past and update literal | {} |",
        count(&|r| literal(&r.0) && fits_75(r.1.0) && fits_80(r.1.1))
    );
    println!(
        "\nFiner over the displacement, from 0.5 to 10 m by 0.05 m, all else literal; those that meet the first:\n"
    );
    println!(
        "| displacement | steps added | at 0.75 s (s) | at 0.8 s (s) | round trips at 0.8 s |\n|---|---|---|---|---|"
    );
    let fine: Vec<Reading> = (10..=200)
        .flat_map(|k| {
            [-1, 0, 1].map(|extra_steps| Reading {
                displacement: f64::from(k) * 0.05,
                extra_steps,
                ..LITERAL
            })
        })
        .collect();
    let results_fine: Vec<_> = fine.par_iter().map(|&r| (r, both(r))).collect();
    for (r, (a, b)) in results_fine.iter().filter(|r| fits_75(r.1.0)) {
        let trips = b.map_or_else(|| "none".into(), |b| format!("{:.2}", b / CYCLE));
        println!(
            "| {:.2} m | {:+} | {} | {} | {trips} |",
            r.displacement,
            r.extra_steps,
            words(*a),
            words(*b)
        );
    }
    println!("\nReadings that meet both (at most 20 shown):\n");
    println!(
        "| displacement | steps added | dt | past | update | at 0.75 s (s) | at 0.8 s (s) |\n|---|---|---|---|---|---|---|"
    );
    for (r, (a, b)) in results.iter().filter(|r| fits_75(r.1.0) && fits_80(r.1.1)).take(20) {
        println!("| {r} | {} | {} |", words(*a), words(*b));
    }
}
