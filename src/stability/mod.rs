//! Linear stability, exact: what becomes of a small disturbance of traffic in equilibrium.
//!
//! | file | what is in it |
//! |---|---|
//! | [`homogeneous`] | homogeneous drivers: eigenvalues, characteristic roots, critical reaction times, the fastest mode |
//! | [`discrete_roots`] | homogeneous drivers: all growth factors of the difference equation |
//! | [`jacobian`] | the Jacobian as a matrix and its numerical eigenvalues |
//! | [`driver_classes`] | what the theory needs of drivers: slopes and delays |
//! | [`heterogeneous`] | heterogeneous drivers: roots by continuation, counted by the argument principle |
//! | [`lane`] | the drivers of a lane with their delays |
//! | [`roots`] | the leading roots of every mode of a lane |
//! | [`report`] | everything that the theory says of the least stable lane |
//! | [`summary`] | the few numbers of the page's sentence |
//! | [`stability_diagram`] | critical reaction times and growth rates over the number of vehicles |
//! | [`sweep`] | the report for every value of one parameter |
//! | [`stable_ranges`] | which numbers of vehicles and which sensitivities are stable |
//! | [`stabilizing_drivers`] | how many changed drivers stabilize a ring |
//!
//! Two systems are treated everywhere ([`homogeneous::Time`]): the differential equation, and the difference equation that a
//! simulation with its steps solves. *Stable* and *unstable* without a further word are about the second.
//!
//! ```
//! use ringroad::stability::homogeneous::{HomogeneousRing, Time};
//!
//! // The slope of speed against headway at 20 m, 1/s.
//! let slope = ringroad::scenario::driver::Driver::default().slope(20.0);
//! let ring = HomogeneousRing { vehicles: 50, slope };
//! assert!((ring.critical(Time::Continuous) - 0.683_869).abs() < 1e-6);
//! assert!((ring.critical(Time::Steps(0.01)) - 0.678_869).abs() < 1e-6);
//! ```

pub mod discrete_roots;
pub mod driver_classes;
pub mod heterogeneous;
pub mod homogeneous;
pub mod jacobian;
pub mod lane;
pub mod report;
pub mod roots;
pub mod stability_diagram;
pub mod stabilizing_drivers;
pub mod stable_ranges;
pub mod summary;
pub mod sweep;

pub use num_complex::Complex64;
