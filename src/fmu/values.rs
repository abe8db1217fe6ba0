//! Values of variables by reference.

use super::calls::Mode;
use super::instance::Instance;
use super::refusal::Refusal;
use crate::joint::Output;
use crate::variables::{Causality, Place, Signal, Variable};

impl Instance {
    /// Values [SI] of the variables with these references, in order.
    pub fn reals(&mut self, references: &[u32]) -> Result<Vec<f64>, Refusal> {
        // The answer is only asked of the physics where a reference needs it.
        let mut answer = None;
        let mut values = Vec::with_capacity(references.len());
        for &reference in references {
            let Variable { place, causality, .. } = *self.variable(reference)?;
            let value = match (place, causality) {
                (Place::Signal(_), Causality::Input) => self.motion.input,
                (Place::Signal(signal), _) => {
                    let output = match answer {
                        Some(output) => output,
                        None => *answer.insert(self.answer()?),
                    };
                    signal_of(&output, signal)
                }
                (place, _) => place
                    .read(&self.joint)
                    .ok_or(Refusal::UnknownReference { expected: "Real", came: reference })?,
            };
            values.push(value);
        }
        Ok(values)
    }

    /// Sets inputs, and parameters before the start; all of them or, on a refusal, none.
    pub fn set_reals(&mut self, references: &[u32], values: &[f64]) -> Result<(), Refusal> {
        let mut places = Vec::with_capacity(references.len());
        for (&reference, &value) in references.iter().zip(values) {
            let variable = self.variable(reference)?;
            self.check_settable(variable, value)?;
            places.push((variable.place, value));
        }
        for (place, value) in places {
            match place {
                Place::Signal(_) => self.motion.input = value,
                place => place.write(&mut self.joint, value),
            }
        }
        if self.mode != Mode::Stepping {
            self.motion.simulation = None;
        }
        Ok(())
    }

    /// The variable with this reference.
    pub(super) fn variable(&self, reference: u32) -> Result<&Variable, Refusal> {
        self.variables
            .iter()
            .find(|variable| variable.reference == reference)
            .ok_or(Refusal::UnknownReference { expected: "Real", came: reference })
    }

    fn check_settable(&self, variable: &Variable, value: f64) -> Result<(), Refusal> {
        let name = || variable.name.clone();
        match variable.causality {
            Causality::Input => {}
            Causality::Parameter if self.mode == Mode::Stepping => {
                return Err(Refusal::Fixed { name: name() });
            }
            Causality::Parameter => {}
            Causality::Output | Causality::Local => {
                let causality = variable.causality.name();
                return Err(Refusal::NotSettable { name: name(), causality });
            }
        }
        let Variable { lower, upper, .. } = *variable;
        if !value.is_finite() || value < lower || value > upper {
            return Err(Refusal::OutOfRange { name: name(), lower, upper, came: value });
        }
        Ok(())
    }

    /// What the joint answers now.
    fn answer(&mut self) -> Result<Output, Refusal> {
        let output = match self.mode {
            Mode::Initialization => self.initial()?.output(),
            _ => self.motion.simulation.as_ref().map(|s| s.output()).unwrap_or_default(),
        };
        Ok(Output { dissipation_rate: self.motion.dissipation_rate, ..output })
    }
}

fn signal_of(output: &Output, signal: Signal) -> f64 {
    match signal {
        Signal::Force => output.force,
        Signal::Displacement => output.displacement,
        Signal::Dissipation => output.dissipation,
        Signal::DissipationRate => output.dissipation_rate,
        Signal::StoredEnergy => output.stored_energy,
        Signal::SlipDisplacement => output.slip_displacement,
        Signal::TangentStiffness => output.tangent_stiffness,
    }
}
