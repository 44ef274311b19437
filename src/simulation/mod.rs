//! The simulation: the only state of a run. Built from a scenario, it steps, and it can be read and cloned; its randomness
//! comes from the scenario's seed alone.
//!
//! ```
//! use ringroad::scenario::Scenario;
//! use ringroad::simulation::Simulation;
//!
//! let scenario = Scenario { vehicles: 20, length: 400.0, ..Scenario::default() };
//! let mut simulation = Simulation::new(&scenario)?;
//! simulation.act("at=0:1:nudge=1".parse()?)?;
//! simulation.run_to(500);
//! assert_eq!((simulation.time(), simulation.leader(0)), (5.0, 1));
//! let total: f64 = (0..20).map(|j| simulation.headway(j)).sum();
//! assert!((total - 400.0).abs() < 1e-9);
//!
//! // A copy goes on independently, and takes the same course.
//! let mut copy = simulation.clone();
//! simulation.step();
//! copy.step();
//! assert_eq!(copy.speeds(), simulation.speeds());
//! # Ok::<(), ringroad::error::Error>(())
//! ```
//!
//! # One step, in the paper's order
//!
//! 1. Lane changing, vehicle by vehicle in order of number, each change taking effect at once: `lane_changing`.
//! 2. Collision, from true headways: `collision`. The first ends the run; the state stays readable.
//! 3. Forward: all positions at once, x += v·dt. Then the actions due at the new time are applied (`intervention`), and all
//!    speeds are found from the headways perceived there (`perception`, `car_following`): between two steps everything can
//!    be read as it is at time t = i·dt.
//!
//! `step` has this sequence and `state` what is kept between two steps. The delay is applied in `perception`; where
//! positions and speeds are found in one go, in `step`; and for the comparison of lanes in `lane_changing`: with the delays in force from `delays` and the positions of the past from `history`. `lane_order` knows the vehicles ahead in
//! each lane and in the adjacent ones; `pass_detection` finds the vehicles for which that may have changed.
//!
//! # Choices
//!
//! - Where a forward move has carried a vehicle through its leader (headway ≤ 0), the order in the lane is lost
//!   already: stage 1 is left out in that step, and stage 2 reports the collision. So vehicles of one lane never change
//!   order without a reported collision.
//! - Two headways are equal when they differ by no more than rounding may: see [`frustration::EQUAL`].
//! - A tie between two adjacent lanes is broken by a random draw, made at an attempt only.
//! - Nudges move a vehicle past others as driving does: in its own lane that is a collision, in an adjacent one a
//!   pass.
//!
//! # Memory
//!
//! A vehicle takes 8 bytes for every step of the longest delay in use, and for two steps more; beside that 215
//! bytes at most, 275 with several lanes. A step allocates no memory.

pub mod attempt_sampler;
mod car_following;
mod collision;
mod delays;
pub mod frustration;
mod history;
mod intervention;
mod lane_changing;
mod lane_order;
mod padding;
mod pass_detection;
mod perception;
mod state;
mod step;
mod travel_bounds;

pub use lane_order::Side;
pub use state::{Collision, Event, Simulation};
