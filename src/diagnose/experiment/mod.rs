//! Looking ahead: what these records can tell apart, which experiment would tell the rest, what a
//! dummy settles, and what can be corrected without a cause.

mod gram;
pub mod loading;
pub mod outlook;
pub mod separability;
mod shape;

pub use outlook::{Outlook, look_ahead};
pub use separability::Separable;
