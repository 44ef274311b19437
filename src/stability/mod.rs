//! Linear stability, exact.

pub(crate) mod complex;
pub mod equal;
pub mod jacobian;
pub mod lambert;
pub mod mixed;
pub mod ring;
