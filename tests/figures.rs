//! The figures of the paper at small size: shape and units of their tables, their pictures, and the claims that must
//! hold whatever the number of runs.
#![cfg(not(target_arch = "wasm32"))]

use ringroad::measurement::provenance::Provenance;
use ringroad::reproduction::claim::{Claim, ClaimVerdict};
use ringroad::reproduction::{FIGURES, Figure, Outcome, Size, TaskResult};
use std::sync::LazyLock;

static OUTCOMES: LazyLock<Vec<(&'static Figure, Outcome)>> =
    LazyLock::new(|| FIGURES.iter().map(|f| (f, f.outcome(Size::Small, &|| {}))).collect());

fn outcome(id: &str) -> &'static Outcome {
    &OUTCOMES.iter().find(|(f, _)| f.id == id).expect("a figure of that name").1
}

fn claim<'a>(claims: &'a [Claim], words: &str) -> &'a Claim {
    let mut found = claims.iter().filter(|c| c.claim.contains(words));
    let claim = found.next().unwrap_or_else(|| panic!("no claim “{words}”"));
    assert!(found.next().is_none(), "two claims “{words}”");
    claim
}

#[test]
fn tables_have_rows_units_and_a_header_that_says_how_they_were_made() {
    for (figure, outcome) in OUTCOMES.iter() {
        assert!(!outcome.tables.is_empty(), "{}", figure.id);
        for table in &outcome.tables {
            assert!(table.name.starts_with(figure.id), "{} of {}", table.name, figure.id);
            assert!(table.table.rows() > 0, "{} is empty", table.name);
            for column in table.table.columns() {
                let suffixes = [
                    ("_s", "s"),
                    ("_m", "m"),
                    ("_percent", "%"),
                    ("_m_per_s", "m/s"),
                    ("_veh_per_s", "veh/s"),
                    ("_veh_per_h", "veh/h"),
                    ("_veh_per_km", "veh/km"),
                    ("_per_s", "1/s"),
                    ("_per_min", "1/min"),
                ];
                let longest =
                    suffixes.iter().filter(|s| column.name.ends_with(s.0)).max_by_key(|s| s.0.len());
                assert_eq!(column.unit, longest.map_or("", |s| s.1), "{} of {}", column.name, table.name);
                assert!(!column.meaning.is_empty());
            }
            let csv = table.to_csv();
            assert!(csv.starts_with("# ringroad ") && csv.contains("\n# scenario {"), "{csv:.200}");
            if csv.contains("\n# measurement ") {
                Provenance::from_csv(&csv).expect("the table of one run can be replayed");
            } else {
                assert!(csv.contains("\n# made from "), "{csv:.200}");
            }
        }
    }
}

#[test]
fn shapes_are_those_of_the_figures() {
    let rows = |id: &str, table: &str| {
        outcome(id).tables.iter().find(|t| t.name == table).unwrap_or_else(|| panic!("{table}")).table.rows()
    };
    assert_eq!(rows("waves", "waves-speeds-0.5"), 601);
    assert_eq!(rows("waves", "waves-flow-0.5"), 61 * 50);
    assert_eq!(rows("load-balance", "load-balance"), 201);
    assert_eq!(rows("aggressive-driver", "aggressive-driver"), 41);
    assert_eq!(rows("stability", "stability-critical"), 132);
    assert_eq!(rows("frustration-flow", "frustration-flow"), 9);
}

#[test]
fn pictures_are_well_formed_and_described_in_words() {
    for (figure, outcome) in OUTCOMES.iter() {
        let svg = outcome.plot.to_svg();
        assert!(
            !svg.contains("NaN") && !svg.contains("inf\"") && !svg.contains("undefined"),
            "{}",
            figure.id
        );
        assert!(svg.contains("<title id=") && svg.contains("<desc id=") && svg.contains("role=\"img\""));
        for panel in &outcome.plot.panels {
            assert!(!panel.x.label.is_empty() && !panel.y.label.is_empty() && !panel.layers.is_empty());
        }
        let opened = svg.matches("<g ").count();
        assert_eq!(opened, svg.matches("</g>").count(), "{}", figure.id);
        let ids: Vec<_> = svg.split(" id=\"").skip(1).map(|s| s.split('"').next()).collect();
        let mut unique = ids.clone();
        unique.sort_unstable();
        unique.dedup();
        assert_eq!(ids.len(), unique.len(), "identifiers of {} repeat", figure.id);
    }
}

#[test]
fn tasks_may_run_in_any_order_and_their_results_cross_as_arrays() {
    let figure = Figure::named("load-balance").unwrap();
    let count = figure.tasks(Size::Small).len();
    let mut results: Vec<Option<TaskResult>> = vec![None; count];
    for k in (0..count).rev() {
        let crossed = figure.run(Size::Small, k).flat();
        results[k] = Some(TaskResult::from_flat(&crossed).unwrap());
    }
    let results: Vec<TaskResult> = results.into_iter().map(Option::unwrap).collect();
    let again = figure.assemble(Size::Small, &results).unwrap();
    let first = outcome("load-balance");
    assert_eq!(again.plot.to_svg(), first.plot.to_svg());
    assert_eq!(again.tables[0].to_csv(), first.tables[0].to_csv());
}

#[test]
fn a_task_in_slices_gives_the_same_as_a_task_at_once() {
    let figure = Figure::named("stability").unwrap();
    let last = figure.tasks(Size::Small).len() - 1;
    let mut task = figure.start(Size::Small, last);
    let mut slices = 0;
    let result = loop {
        slices += 1;
        if let Some(result) = task.advance(100_000) {
            break result;
        }
    };
    assert!(slices > 100, "only {slices} slices");
    assert_eq!(result, figure.run(Size::Small, last));
}

/// These follow from theory or from the model, whatever the number of runs.
#[test]
fn claims_that_must_hold_do() {
    for (id, words) in [
        ("fundamental-diagram", "largest equilibrium flow q*"),
        ("fundamental-diagram", "critical density"),
        ("fundamental-diagram", "at N = 50, per hour"),
        ("fundamental-diagram", "flow rises with density"),
        ("waves", "travels upstream at Δ = 0 s"),
        ("waves", "travels upstream at Δ = 0.5 s"),
        ("waves", "travels upstream at Δ = 0.75 s"),
        ("waves", "dissipates at Δ = 0 s"),
        ("waves", "dissipates at Δ = 0.5 s"),
        ("waves", "grows at Δ = 0.75 s"),
        ("waves", "splits into several"),
        ("waves", "more slowly at 0.5 s"),
        ("stability", "linear theory"),
        ("stability", "where the longest wave begins to grow"),
        ("stability", "τ falls with the number of vehicles"),
        ("stability", "τ at N = 133"),
        ("stability", "Newell’s"),
        ("stability", "stable at 0.65 s and unstable at 0.75 s"),
        ("load-balance", "the lanes become balanced"),
        ("load-balance", "lower the rate of balancing"),
        ("aggressive-driver", "without an aggressive driver there are no"),
        ("aggressive-driver", "lane 1 is faster"),
        ("aggressive-driver", "first rises when it passes"),
        ("aggressive-driver", "driver that is passed jumps"),
    ] {
        let claim = claim(&outcome(id).claims, words);
        assert_eq!(claim.verdict(), ClaimVerdict::Agrees, "{} — {}", claim.claim, claim.ours_in_words());
    }
}

/// The formula and the table of the paper itself contradict this number.
#[test]
fn a_number_that_contradicts_the_papers_own_formula_differs() {
    let claim = claim(&outcome("fundamental-diagram").claims, "at 25 veh/km");
    assert_eq!(claim.verdict(), ClaimVerdict::Differs);
    assert!((claim.ours().value - 2002.6).abs() < 0.1, "{}", claim.ours_in_words());
}

#[test]
fn every_claim_of_the_specification_is_checked() {
    let all: Vec<&Claim> = OUTCOMES.iter().flat_map(|(_, o)| &o.claims).collect();
    for words in [
        "q*",
        "ρ*",
        "ρ_jam",
        "at N = 50",
        "at 25 veh/km",
        "k at Δ = 0 s",
        "k at Δ = 0.5 s",
        "k at Δ = 0.75 s",
        "time of the collision at Δ = 0.75 s",
        "collision within one cycle at Δ = 0.8 s",
        "upstream",
        "dissipates",
        "splits into several",
        "τ at N = 50, linear theory",
        "τ at N = 50, simulation",
        "τ falls",
        "τ at N = 133",
        "ΔN is about 5 at 30 s",
        "within about 30 s",
        "keeps oscillating around 5",
        "about 1.0 veh/s",
        "about 1800 veh/h",
        "lower the rate of balancing",
        "lower the late ΔN",
        "lane changes of the aggressive driver",
        "lane changes of a control driver",
        "less than 2 %",
        "raises the lane changes of its neighbours",
        "lane 1 is faster",
        "first rises when it passes",
        "not every lane change enlarges",
        "marginally",
    ] {
        assert!(all.iter().any(|c| c.claim.contains(words)), "no claim speaks of “{words}”");
    }
    for claim in all {
        assert!(FIGURES.iter().any(|f| f.id == claim.figure));
        assert!(!claim.method.is_empty() && !claim.paper().is_empty());
    }
}

#[test]
fn a_perturbed_value_flips_its_verdict() {
    let figure = Figure::named("load-balance").unwrap();
    let mut results: Vec<TaskResult> =
        (0..figure.tasks(Size::Small).len()).map(|k| figure.run(Size::Small, k)).collect();
    let verdict = |results: &[TaskResult]| {
        let outcome = figure.assemble(Size::Small, results).unwrap();
        claim(&outcome.claims, "the lanes become balanced").verdict()
    };
    assert_eq!(verdict(&results), ClaimVerdict::Agrees);
    for result in &mut results {
        result.columns[1].iter_mut().for_each(|imbalance| *imbalance = 20.0);
    }
    assert_eq!(verdict(&results), ClaimVerdict::Differs);
}
