//! Probes: the only way to measure. A probe looks at the simulation after every step, keeps what it needs, and gives a
//! [`Table`] at any time.
//!
//! The rows of a probe depend on the states that it has seen and on nothing else. So a table taken in mid-run is the one
//! that a run with `until` at that time gives. (Only the table `outcome` has no row before the end.)
//!
//! [`crate::measurement`] has an example of a probe of one's own.
//!
//! ```
//! use ringroad::measurement::{Measurement, act, measure};
//! use ringroad::scenario::Scenario;
//! use ringroad::simulation::Simulation;
//!
//! let scenario = Scenario { until: 2.0, ..Scenario::default() };
//! let mut simulation = Simulation::new(&scenario)?;
//! let mut probes = [Measurement::named("speeds")?.probe(&scenario)?];
//! // Vehicle 1 stands for one second.
//! act(&mut simulation, &mut probes, "at=0:1:brake=1".parse()?)?;
//! measure(&mut simulation, &mut probes, &mut |_| true);
//! let table = probes[0].table();
//! let speeds = table.floats("v_1_m_per_s").unwrap();
//! assert!(speeds[0] == 0.0 && speeds[2] > 0.0);
//! # Ok::<(), ringroad::error::Error>(())
//! ```

use crate::error::Error;
use crate::format::table::Table;
use crate::scenario::action::Action;
use crate::simulation::Simulation;

/// Something that measures.
///
/// [`Probe::observe`] is called on the initial state, then once after every call of `Simulation::step` (also after the
/// one that ends in a collision and does not advance the time), and again after an action made by hand. When a time is
/// shown twice, the second look replaces the first.
pub trait Probe: Send {
    /// Looks at the present state.
    fn observe(&mut self, simulation: &Simulation);
    /// What has been measured so far.
    fn table(&self) -> Table;
}

/// Runs the simulation from its present state to its end, with probes. About every 10 ms of computing time, and at the end,
/// `progress` gets the number of steps reached; it returns whether to go on. Returns whether the end was reached.
pub fn measure(
    simulation: &mut Simulation,
    probes: &mut [Box<dyn Probe>],
    progress: &mut dyn FnMut(u64) -> bool,
) -> bool {
    // About 10 ms of work between two calls.
    let stride = (1_000_000 / simulation.vehicles() as u64).clamp(1, 10_000);
    observe(simulation, probes);
    while !simulation.is_finished() {
        simulation.step();
        observe(simulation, probes);
        if simulation.step_index() % stride == 0 && !progress(simulation.step_index()) {
            return false;
        }
    }
    progress(simulation.step_index());
    true
}

/// Applies an action at the present time and shows the state to the probes again, as a replay does: a row of a time is the
/// state after the actions of that time.
///
/// # Errors
/// What is wrong with the action; then nothing has changed.
pub fn act(simulation: &mut Simulation, probes: &mut [Box<dyn Probe>], action: Action) -> Result<(), Error> {
    simulation.act(action)?;
    observe(simulation, probes);
    Ok(())
}

fn observe(simulation: &Simulation, probes: &mut [Box<dyn Probe>]) {
    for probe in probes {
        probe.observe(simulation);
    }
}
