//! What a joint shows to the outside as FMI variables: one list, from which the shared library
//! answers and from which modelDescription.xml is written, so that the two cannot disagree.

mod guid;
mod places;
mod table;

pub use guid::{drive_of, guid};
pub use places::{Place, VariableError};
pub use table::{Causality, Signal};

use crate::joint::{Drive, Joint};
use table::SIGNALS;

/// FMI model identifier: name of the library in the archive, and of its function prefix.
pub const MODEL_IDENTIFIER: &str = "IwanJoint";

/// One FMI variable of type Real.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// FMI value reference; means the same in every export.
    pub reference: u32,
    /// Name in words, e.g. `force` or `pinning.stiffness`.
    pub name: String,
    /// SI unit as FMI writes it.
    pub unit: &'static str,
    /// Role in the exported unit.
    pub causality: Causality,
    /// Smallest admissible value; infinite where there is none.
    pub lower: f64,
    /// Largest admissible value; infinite where there is none.
    pub upper: f64,
    /// One sentence.
    pub description: String,
    /// Where the value lives.
    pub place: Place,
}

impl Variable {
    /// Start value for the XML: inputs start at zero, parameters at the joint's own values, and
    /// calculated variables have none. SI units.
    pub fn start(&self, joint: &Joint) -> Option<f64> {
        match self.causality {
            Causality::Input => Some(0.0),
            Causality::Parameter => self.place.read(joint),
            Causality::Output | Causality::Local => None,
        }
    }
}

/// Every variable of a joint under a drive: the signals first, in the order of their table, then
/// the parameters of the joint, then those of its causes.
///
/// # Errors
/// A name without a value reference, a cause that stands twice, a measurement cause.
pub fn variables(joint: &Joint, drive: Drive) -> Result<Vec<Variable>, VariableError> {
    let mut list: Vec<_> = SIGNALS.iter().map(|row| row.variable(drive)).collect();
    list.extend(places::parameters(joint)?);
    Ok(list)
}
