//! Linear stability, exact: what becomes of a small disturbance of traffic in equilibrium.
//!
//! | file | what is in it |
//! |---|---|
//! | [`equal`] | equal drivers: eigenvalues, characteristic roots, critical reaction times, the fastest mode |
//! | [`factors`] | equal drivers: all growth factors of the difference equation |
//! | [`jacobian`] | the Jacobian as a matrix and its numerical eigenvalues |
//! | [`lambert`] | the Lambert W function on all branches |
//! | [`ring`] | what the theory asks of drivers: slopes and delays |
//! | [`mixed`] | drivers that differ: roots by continuation, counted by the argument principle |
//! | [`calm`] | how many drivers of another kind calm a ring |
//! | [`inverse`] | which numbers of vehicles, which sensitivities are stable |
//! | [`plane`] | critical reaction times and growth rates over the number of vehicles; sweeps |
//! | [`report`] | the verdict |
//! | `complex` | functions of complex numbers, the same bits everywhere |
//!
//! Two systems are spoken of everywhere ([`equal::Time`]): the differential equation, and the difference equation that a
//! simulation with its steps solves. The verdict is about the second.

pub mod calm;
pub(crate) mod complex;
pub mod equal;
pub mod factors;
pub mod inverse;
pub mod jacobian;
pub mod lambert;
pub mod mixed;
pub mod plane;
pub mod report;
pub mod ring;

pub use num_complex::Complex64;
