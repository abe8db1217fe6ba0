//! What a joint shows to the outside as FMI variables: one list, from which the shared library
//! answers and from which modelDescription.xml is written, so that the two cannot disagree.

mod guid;
mod places;
mod table;

pub use guid::{drive_of, guid};
pub use places::{Place, VariableError};
pub use table::{Causality, STAMP, Signal, TIME_REFERENCE};

use crate::joint::{Drive, Joint, JointError};
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

/// Every variable of a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Variables {
    /// Input, outputs and locals, in the order of their table.
    pub signals: Vec<Variable>,
    /// The joint's own parameters, then those of its causes.
    pub parameters: Vec<Variable>,
}

impl Variables {
    /// The variables of a joint under a drive.
    ///
    /// # Errors
    /// A name without a value reference, a cause that stands twice, a measurement cause.
    pub fn of(joint: &Joint, drive: Drive) -> Result<Variables, VariableError> {
        Ok(Variables {
            signals: SIGNALS.iter().map(|row| row.variable(drive)).collect(),
            parameters: places::parameters(joint)?,
        })
    }

    /// Signals, then parameters.
    pub fn iter(&self) -> impl Iterator<Item = &Variable> {
        self.signals.iter().chain(&self.parameters)
    }

    /// Values of the parameters in this joint [SI], in order.
    pub fn values(&self, joint: &Joint) -> Vec<f64> {
        self.parameters
            .iter()
            .filter_map(|variable| variable.place.read(joint))
            .collect()
    }

    /// This joint with other values of its parameters [SI], in order. With its own values it is
    /// the same joint to the last bit.
    ///
    /// # Errors
    /// [`JointError::OutOfRange`] where the density cannot be with these values together.
    pub fn apply(&self, joint: &Joint, values: &[f64]) -> Result<Joint, JointError> {
        let places = self.parameters.iter().map(|variable| variable.place);
        places::apply(joint, places.zip(values.iter().copied()))
    }
}
