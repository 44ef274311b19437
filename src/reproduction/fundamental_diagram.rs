//! The speed law and the fundamental diagram: curves from the formulas, and points from runs of uniform rings.

use super::claim::{Claim, Estimate, Expected};
use super::figure::{Figure, FigureTable, Outcome};
use super::shared::{column, measured};
use super::task::{Size, TaskResult};
use crate::format::table::{Column, Table};
use crate::measurement::Measurement;
use crate::plot::{Axis, Layer, Panel, Plot};
use crate::scenario::Scenario;
use crate::scenario::driver::Driver;

const ID: &str = "fundamental-diagram";

pub(super) const FIGURE: Figure = Figure {
    id: ID,
    title: "Speed law and fundamental diagram",
    caption: "Speed against headway, and flow against density in equilibrium, from the formulas; the points are \
              uniform rings of 1 km that were run for 60 s, their mean speed times their density.",
    beyond: false,
    tasks: |size| rings(size).iter().map(|n| format!("ring of {n} vehicles")).collect(),
    start: |size, task| Box::new(move || run(size, task)),
    assemble,
};

/// Numbers of vehicles of the rings that are run.
fn rings(size: Size) -> Vec<usize> {
    size.choose((5..=130).step_by(5).chain([134, 140]).collect(), vec![25, 50, 134])
}

fn scenario(vehicles: usize) -> Scenario {
    Scenario { vehicles, until: 60.0, ..Scenario::default() }
}

/// The flow of a ring, veh/s.
fn run(size: Size, task: usize) -> TaskResult {
    let scenario = scenario(rings(size)[task]);
    let (tables, _) = measured(&scenario, &[Measurement::Drivers { every: 60.0 }]);
    let speed = *column(&tables[0], "mean_speed_m_per_s").last().expect("a row at the end");
    TaskResult { columns: vec![vec![speed * scenario.vehicles as f64 / scenario.length]] }
}

fn assemble(size: Size, results: &[TaskResult]) -> Outcome {
    let driver = Driver::default();
    let headways: Vec<f64> = (0..=400).map(|i| f64::from(i) * 0.5).collect();
    let speeds: Vec<f64> = headways.iter().map(|&h| driver.speed(h)).collect();
    let densities: Vec<f64> = (0..=600).map(|i| f64::from(i) * 0.25).collect();
    let flows: Vec<f64> = densities.iter().map(|&rho| 3600.0 * driver.flow(rho / 1000.0)).collect();
    let counts = rings(size);
    let measured_density: Vec<f64> = counts.iter().map(|&n| n as f64).collect();
    let measured_flow: Vec<f64> = results.iter().map(|p| 3600.0 * p.columns[0][0]).collect();
    let top = driver.capacity();

    let law = Table::new(vec![
        Column::float("headway_m", "m", "headway h", headways.clone()),
        Column::float("speed_m_per_s", "m/s", "v(h) = max(V − V·exp(−(λ/V)(h − d)), 0)", speeds.clone()),
    ]);
    let diagram = Table::new(vec![
        Column::float("density_veh_per_km", "veh/km", "density ρ", densities.clone()),
        Column::float("flow_veh_per_h", "veh/h", "flow in equilibrium, q = ρ·v(1/ρ)", flows.clone()),
    ]);
    let points = Table::new(vec![
        Column::float("density_veh_per_km", "veh/km", "density of a ring of 1 km", measured_density.clone()),
        Column::float("flow_veh_per_h", "veh/h", "density times mean speed over 60 s", measured_flow.clone()),
    ]);
    let base = scenario(50);
    let tables = vec![
        FigureTable::summary("fundamental-diagram-speed", law, &base, "the formula"),
        FigureTable::summary("fundamental-diagram-flow", diagram, &base, "the formula"),
        FigureTable::summary(
            "fundamental-diagram-rings",
            points,
            &base,
            "one run for each number of vehicles",
        ),
    ];
    let plot = Plot {
        id: ID.into(),
        title: FIGURE.title.into(),
        description: format!(
            "Left: speed rises from 0 at a headway of 7.5 m towards 40 m/s. Right: flow rises with density to {:.0} \
             vehicles an hour at {:.0} vehicles a kilometre, then falls to 0 at 133; rings that were run lie on the \
             curve.",
            top.flow * 3600.0,
            top.density * 1000.0
        ),
        columns: 2,
        panels: vec![
            Panel {
                title: "Speed law".into(),
                x: Axis::from_to("headway (m)", 0.0, 200.0),
                y: Axis::from_to("speed (m/s)", 0.0, 42.0),
                layers: vec![
                    Layer::Rule { name: "V".into(), vertical: false, at: driver.max_speed, left: false },
                    Layer::Rule { name: "d".into(), vertical: true, at: driver.min_headway, left: false },
                    Layer::Curve { name: String::new(), style: 0, x: headways, y: speeds },
                ],
            },
            Panel {
                title: "Fundamental diagram of one lane".into(),
                x: Axis::from_to("density (veh/km)", 0.0, 150.0),
                y: Axis::from_to("flow (veh/h)", 0.0, 2200.0),
                layers: vec![
                    Layer::Rule { name: "ρ*".into(), vertical: true, at: top.density * 1000.0, left: false },
                    Layer::Curve { name: "equilibrium".into(), style: 0, x: densities, y: flows },
                    Layer::Points {
                        name: "rings that were run".into(),
                        style: 1,
                        x: measured_density,
                        y: measured_flow.clone(),
                        error: Vec::new(),
                    },
                ],
            },
        ],
    };
    let flow_at = |n: usize| counts.iter().position(|&c| c == n).map_or(f64::NAN, |k| measured_flow[k]);
    Outcome { tables, plot, claims: claims(&driver, &flow_at) }
}

fn claims(driver: &Driver, flow_at: &dyn Fn(usize) -> f64) -> Vec<Claim> {
    let top = driver.capacity();
    let about = |claim: &str, unit, paper: f64, tolerance: f64, ours: f64, method: &str| {
        Claim::new(ID, claim, unit, Expected::About(paper, tolerance), Estimate::exact(ours), method)
    };
    let first_jam =
        (1..200_u32).find(|&n| driver.flow(f64::from(n) / 1000.0) <= 0.0).map_or(f64::NAN, f64::from);
    vec![
        about(
            "largest equilibrium flow q*",
            "veh/h",
            2065.0,
            0.5,
            top.flow * 3600.0,
            "From the speed law by Newton's method; tolerance: half a unit of the last digit printed.",
        ),
        about(
            "critical density ρ*",
            "veh/km",
            34.0,
            0.5,
            top.density * 1000.0,
            "Density of the largest flow; tolerance: half a unit of the last digit printed.",
        ),
        about(
            "jam density ρ_jam",
            "veh/km",
            134.0,
            0.5,
            1000.0 / driver.min_headway,
            "1/d; tolerance: half a unit of the last digit printed.",
        )
        .or("smallest whole number of vehicles on 1 km that stands still", Estimate::exact(first_jam)),
        about(
            "equilibrium flow q at N = 50",
            "veh/s",
            0.54,
            0.005,
            flow_at(50) / 3600.0,
            "Density times mean speed of a uniform ring over 60 s; tolerance: half a unit of the last digit printed.",
        ),
        about(
            "equilibrium flow q at N = 50, per hour",
            "veh/h",
            1944.0,
            18.0,
            flow_at(50),
            "The same, times 3600; the paper multiplies the rounded 0.54, so the tolerance is 0.005·3600.",
        ),
        about(
            "equilibrium flow at 25 veh/km",
            "veh/h",
            1668.0,
            0.5,
            flow_at(25),
            "Density times mean speed of a uniform ring of 25 vehicles over 60 s, which is the paper's own formula \
             with the values of its table (it gives 1668 at 15 veh/km); tolerance: half a unit of the last digit printed.",
        ),
        Claim::new(
            ID,
            "flow rises with density up to ρ*, then falls",
            "",
            Expected::AtMost(0.0),
            Estimate::exact(steps_against_the_shape(driver, top.density) as f64),
            "Number of steps of 0.1 veh/km between 0 and 1/d at which flow changes in the other direction.",
        ),
        about(
            "flow of a ring of 134 vehicles, in the jam",
            "veh/h",
            0.0,
            0.0,
            flow_at(134),
            "Density times mean speed of a uniform ring over 60 s.",
        ),
    ]
}

/// Steps of 0.1 veh/km at which the flow does not rise below the critical density (veh/m) or does not fall above it.
fn steps_against_the_shape(driver: &Driver, critical: f64) -> usize {
    (0..1333)
        .map(|i| (f64::from(i) * 1e-4, f64::from(i + 1) * 1e-4))
        .filter(|&(a, b)| {
            let rise = driver.flow(b) - driver.flow(a);
            (b <= critical && rise <= 0.0) || (a >= critical && rise >= 0.0)
        })
        .count()
}
