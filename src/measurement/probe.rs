//! Probes: the only way to measure. Each looks at the simulation after a step, keeps what it needs, and gives a
//! [`Table`] at any time.
//!
//! A probe's rows depend on the states that it saw and on nothing else; so a table taken in mid-run is the one
//! that a run with `until` at that time gives. (An outcome alone waits for the end.)

use crate::error::Error;
use crate::format::table::Table;
use crate::scenario::action::Action;
use crate::simulation::Simulation;

/// Something that measures.
///
/// [`Probe::observe`] is called on the initial state, then once after every call of `Simulation::step` (also the
/// one that ends in a collision and does not advance the time), and again after an action made by hand. Seeing a
/// time twice replaces what was seen of it before.
pub trait Probe: Send {
    /// Looks at the present state.
    fn observe(&mut self, simulation: &Simulation);
    /// What was measured so far.
    fn table(&self) -> Table;
}

/// Runs the simulation to its end, from the present state on, with probes. Every so many steps `progress` gets
/// the number of the step reached and says whether to go on. Returns whether the end was reached.
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

/// An action made by hand at the present time, seen by the probes as a replay will see it: a row at a time is the
/// state after the actions of that time.
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
