//! Looking ahead: what these records can tell apart, which experiment would tell the rest, what a
//! dummy settles, and what can be corrected without a cause.

mod answered;
pub mod correction;
mod design;
pub mod dummy;
mod features;
mod gram;
mod instead;
pub mod limits;
pub mod loading;
mod monolithic;
pub mod next;
pub mod outlook;
mod plan;
pub mod program;
mod purpose;
pub mod separability;
mod shape;
mod standing;

pub use correction::Correction;
pub use dummy::Dummy;
pub use limits::Limits;
pub use next::Experiment;
pub use outlook::{Outlook, look_ahead};
pub use separability::Separable;

use crate::record::Record;

/// What a diagnosis may be told besides the records.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Options {
    /// Limits of the rig for the next experiment.
    pub limits: Limits,
    /// A monolithic specimen measured through the same chain.
    pub dummy: Option<Record>,
}
