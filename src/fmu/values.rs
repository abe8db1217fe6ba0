//! Values of variables by reference.

use super::calls::Mode;
use super::instance::Instance;
use super::logger::Standard;
use super::refusal::Refusal;
use crate::joint::Output;
use crate::variables::{Causality, Place, Signal, TIME_REFERENCE, Variable};

/// What a reference means.
pub(super) enum Found<'a> {
    Input(&'a Variable),
    Answer(Signal, &'a Variable),
    /// With its place among the parameters.
    Parameter(usize, &'a Variable),
    /// The communication point, which only FMI 3.0 knows as a variable.
    Time,
}

impl Instance {
    /// Values [SI] of the variables with these references, handed to `take` in order; nothing is
    /// handed over where any of them is refused. Allocates nothing.
    pub fn reals(
        &mut self,
        references: &[u32],
        mut take: impl FnMut(usize, f64),
    ) -> Result<(), Refusal> {
        let mut asked = false;
        for &reference in references {
            asked |= matches!(self.find(reference)?, Found::Answer(..));
        }
        // The answer is only asked of the physics where a reference needs it.
        let answer = if asked {
            self.answer()?
        } else {
            Output::default()
        };
        for (place, &reference) in references.iter().enumerate() {
            let value = match self.find(reference)? {
                Found::Parameter(index, _) => self.parameters[index],
                Found::Input(_) => self.motion.input,
                Found::Answer(signal, _) => signal.of(&answer),
                Found::Time => self.motion.time,
            };
            take(place, value);
        }
        Ok(())
    }

    /// Sets inputs, and parameters before the start; all of them or, on a refusal, none.
    pub fn set_reals(&mut self, references: &[u32], values: &[f64]) -> Result<(), Refusal> {
        for (&reference, &value) in references.iter().zip(values) {
            self.check_settable(reference, value)?;
        }
        for (&reference, &value) in references.iter().zip(values) {
            match self.find(reference)? {
                Found::Parameter(index, _) => self.parameters[index] = value,
                _ => self.motion.input = value,
            }
        }
        if self.mode != Mode::Stepping {
            self.motion.simulation = None;
        }
        Ok(())
    }

    fn check_settable(&self, reference: u32, value: f64) -> Result<(), Refusal> {
        let variable = match self.find(reference)? {
            Found::Input(variable) => variable,
            Found::Parameter(_, variable) if self.mode != Mode::Stepping => variable,
            Found::Parameter(_, variable) => {
                return Err(Refusal::Fixed {
                    name: variable.name.clone(),
                });
            }
            Found::Time => {
                return Err(Refusal::NotSettable {
                    name: "time".to_owned(),
                    causality: "independent",
                });
            }
            Found::Answer(_, variable) => {
                let causality = variable.causality.name();
                return Err(Refusal::NotSettable {
                    name: variable.name.clone(),
                    causality,
                });
            }
        };
        let Variable { lower, upper, .. } = *variable;
        if !value.is_finite() || value < lower || value > upper {
            let name = variable.name.clone();
            return Err(Refusal::OutOfRange {
                name,
                lower,
                upper,
                came: value,
            });
        }
        Ok(())
    }

    /// The variable with this reference.
    pub(super) fn find(&self, reference: u32) -> Result<Found<'_>, Refusal> {
        if reference == TIME_REFERENCE && self.standard() == Standard::Three {
            return Ok(Found::Time);
        }
        let is_it = |variable: &&Variable| variable.reference == reference;
        if let Some(variable) = self.variables.signals.iter().find(is_it)
            && let Place::Signal(signal) = variable.place
        {
            return Ok(match variable.causality {
                Causality::Input => Found::Input(variable),
                _ => Found::Answer(signal, variable),
            });
        }
        let mut parameters = self.variables.parameters.iter().enumerate();
        parameters
            .find(|(_, variable)| is_it(variable))
            .map(|(index, variable)| Found::Parameter(index, variable))
            .ok_or(Refusal::UnknownReference {
                expected: self.standard().real(),
                came: reference,
            })
    }

    /// The input, if this is its reference.
    pub(super) fn input_variable(&self, reference: u32) -> Result<&Variable, Refusal> {
        match self.find(reference)? {
            Found::Input(variable) => Ok(variable),
            _ => Err(Refusal::NotInput { came: reference }),
        }
    }

    /// What the joint answers now; before initialization it rests, and every answer is zero.
    fn answer(&mut self) -> Result<Output, Refusal> {
        let output = match self.mode {
            Mode::Initialization => self.initial()?.output(),
            _ => self
                .motion
                .simulation
                .as_ref()
                .map(|s| s.output())
                .unwrap_or_default(),
        };
        Ok(Output {
            dissipation_rate: self.motion.dissipation_rate,
            ..output
        })
    }
}
