//! Linear stability, exact: what becomes of a small disturbance of traffic in equilibrium.
//!
//! | file | what is in it |
//! |---|---|
//! | [`homogeneous`] | equal drivers: eigenvalues, characteristic roots, critical reaction times, the fastest mode |
//! | [`discrete_roots`] | equal drivers: all growth factors of the difference equation |
//! | [`jacobian`] | the Jacobian as a matrix and its numerical eigenvalues |
//! | [`driver_classes`] | what the theory asks of drivers: slopes and delays |
//! | [`heterogeneous`] | drivers that differ: roots by continuation, counted by the argument principle |
//! | [`stabilizing_drivers`] | how many drivers of another kind calm a ring |
//! | [`stable_ranges`] | which numbers of vehicles, which sensitivities are stable |
//! | [`stability_diagram`] | critical reaction times and growth rates over the number of vehicles |
//! | [`sweep`] | what theory says while a parameter is varied |
//! | [`report`] | everything the theory says of a lane |
//! | [`summary`] | the few numbers of the page's sentence |
//!
//! Two systems are spoken of everywhere ([`homogeneous::Time`]): the differential equation, and the difference equation that a
//! simulation with its steps solves. The verdict is about the second.

pub mod discrete_roots;
pub mod driver_classes;
pub mod heterogeneous;
pub mod homogeneous;
pub mod jacobian;
pub mod report;
pub mod stability_diagram;
pub mod stabilizing_drivers;
pub mod stable_ranges;
pub mod summary;
pub mod sweep;

pub use num_complex::Complex64;
