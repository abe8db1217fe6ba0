//! The tables of modelDescription/, as build.rs makes them into constants.

use super::{Place, Variable};
use crate::joint::{Drive, Output};

/// Role of a variable in the exported unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Causality {
    /// Set by the importer before each step.
    Input,
    /// Answered after each step.
    Output,
    /// Answered too, for watching.
    Local,
    /// Fixed before the start.
    Parameter,
}

impl Causality {
    /// As FMI writes it.
    pub fn name(self) -> &'static str {
        match self {
            Causality::Input => "input",
            Causality::Output => "output",
            Causality::Local => "local",
            Causality::Parameter => "parameter",
        }
    }
}

/// One row of signals.csv.
#[derive(Debug)]
pub struct SignalRow {
    signal: Signal,
    reference: u32,
    name: &'static str,
    unit: &'static str,
    lower: f64,
    force_driven: Causality,
    displacement_driven: Causality,
    description: &'static str,
}

impl SignalRow {
    /// The row as a variable under a drive.
    pub fn variable(&self, drive: Drive) -> Variable {
        Variable {
            reference: self.reference,
            name: self.name.to_owned(),
            unit: self.unit,
            causality: match drive {
                Drive::Force => self.force_driven,
                Drive::Displacement => self.displacement_driven,
            },
            lower: self.lower,
            upper: f64::INFINITY,
            description: self.description.to_owned(),
            place: Place::Signal(self.signal),
        }
    }
}

include!(concat!(env!("OUT_DIR"), "/references.rs"));

impl Signal {
    /// This signal in the answer of a simulation [SI].
    pub fn of(self, output: &Output) -> f64 {
        match self {
            Signal::Force => output.force,
            Signal::Displacement => output.displacement,
            Signal::Dissipation => output.dissipation,
            Signal::DissipationRate => output.dissipation_rate,
            Signal::StoredEnergy => output.stored_energy,
            Signal::SlipDisplacement => output.slip_displacement,
            Signal::TangentStiffness => output.tangent_stiffness,
        }
    }
}
