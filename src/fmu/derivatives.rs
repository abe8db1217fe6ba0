//! Derivatives of the answer: over the input, and over time.

use super::calls::Mode;
use super::instance::{Instance, Motion};
use super::refusal::Refusal;
use super::values::Found;
use crate::joint::{Output, Sensitivity, time_passing};
use crate::variables::{Signal, Variable};

/// Time derivatives of what the last step answered, at its end [SI per s].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Rates {
    /// Of the force.
    pub force: f64,
    /// Of the displacement.
    pub displacement: f64,
    /// Of the network's displacement.
    pub slip_displacement: f64,
    /// Of the energy dissipated: the power at the end of the step.
    pub dissipation: f64,
    /// Of that power, as one that grows evenly from the step's middle.
    pub dissipation_rate: f64,
    /// Of the energy stored.
    pub stored_energy: f64,
}

/// The last monotone leg of a step.
#[derive(Debug, Clone, Copy)]
pub struct Leg {
    /// Answers where it begins and where it ends.
    pub ends: [Output; 2],
    /// Input where it begins and where it ends.
    pub inputs: [f64; 2],
    /// Time derivative of the input at the end, where the host has told it.
    pub input_rate: Option<f64>,
}

impl Rates {
    /// By the chain rule from slopes over the input. A joint with effects also moves under an
    /// input that rests; there the mean rate over the leg is taken, and the slope only for the
    /// difference of the input's rate at the end from its mean.
    pub fn of(leg: &Leg, slopes: &Sensitivity, effects: bool) -> Rates {
        let [from, to] = leg.ends;
        let duration = time_passing(from.time, to.time);
        if duration <= 0.0 {
            return Rates::default(); // a jump takes no time
        }
        let mean_input = (leg.inputs[1] - leg.inputs[0]) / duration;
        let at_end = leg.input_rate.unwrap_or(mean_input);
        let rate = |slope: f64, from: f64, to: f64| {
            if effects {
                (to - from) / duration + slope * (at_end - mean_input)
            } else {
                slope * at_end
            }
        };
        Rates {
            force: rate(slopes.force, from.force, to.force),
            displacement: rate(slopes.displacement, from.displacement, to.displacement),
            slip_displacement: rate(
                slopes.slip_displacement,
                from.slip_displacement,
                to.slip_displacement,
            ),
            dissipation: rate(slopes.dissipation, from.dissipation, to.dissipation),
            dissipation_rate: 0.0,
            stored_energy: rate(slopes.stored_energy, from.stored_energy, to.stored_energy),
        }
    }

    fn signal(&self, signal: Signal) -> Option<f64> {
        Some(match signal {
            Signal::Force => self.force,
            Signal::Displacement => self.displacement,
            Signal::SlipDisplacement => self.slip_displacement,
            Signal::Dissipation => self.dissipation,
            Signal::DissipationRate => self.dissipation_rate,
            Signal::StoredEnergy => self.stored_energy,
            Signal::TangentStiffness => return None,
        })
    }
}

impl Instance {
    /// d(unknown)/d(input) [SI] for each unknown, handed to `take` in order; nothing is handed over
    /// where any of them is refused.
    pub fn slopes(
        &mut self,
        unknowns: &[u32],
        mut take: impl FnMut(usize, f64),
    ) -> Result<(), Refusal> {
        if self.mode == Mode::Initialization {
            self.initial()?;
        }
        for pass in [false, true] {
            for (place, &reference) in unknowns.iter().enumerate() {
                let slope = self.slope(reference)?;
                if pass {
                    take(place, slope);
                }
            }
        }
        Ok(())
    }

    fn slope(&self, reference: u32) -> Result<f64, Refusal> {
        let (signal, variable) = self.answered(reference)?;
        let Motion {
            simulation, step, ..
        } = &self.motion;
        let slopes = simulation.as_ref().map(|s| s.sensitivity());
        let slope = slopes.map_or(Some(0.0), |slopes| match signal {
            Signal::Force => Some(slopes.force),
            Signal::Displacement => Some(slopes.displacement),
            Signal::SlipDisplacement => Some(slopes.slip_displacement),
            Signal::Dissipation => Some(slopes.dissipation),
            Signal::StoredEnergy => Some(slopes.stored_energy),
            // Mean power over the step; a jump takes no time and has none.
            Signal::DissipationRate if *step > 0.0 => Some(slopes.dissipation / step),
            Signal::DissipationRate => Some(0.0),
            Signal::TangentStiffness => None,
        });
        slope
            .filter(|slope| slope.is_finite())
            .ok_or_else(|| without_slope(variable))
    }

    /// Holds every known against the input, the only variable with respect to which answers are
    /// differentiated.
    pub fn check_knowns(&self, knowns: &[u32]) -> Result<(), Refusal> {
        knowns
            .iter()
            .try_for_each(|&known| self.input_variable(known).map(|_| ()))
    }

    /// Refuses seeds of which one is no finite number: they would make every answer none.
    pub fn check_seeds(argument: &'static str, seeds: &[f64]) -> Result<(), Refusal> {
        let place = seeds.iter().position(|seed| !seed.is_finite());
        place.map_or(Ok(()), |place| {
            Err(Refusal::Seed {
                argument,
                place,
                came: seeds[place],
            })
        })
    }

    /// First time derivatives of answers at the end of the last step [SI per s], handed to `take`
    /// in order; none is handed over where any is refused.
    pub fn output_derivatives(
        &self,
        references: &[u32],
        orders: &[i32],
        mut take: impl FnMut(usize, f64),
    ) -> Result<(), Refusal> {
        for pass in [false, true] {
            for (place, (&reference, &order)) in references.iter().zip(orders).enumerate() {
                let (signal, variable) = self.answered(reference)?;
                if order != 1 {
                    return Err(Refusal::Order {
                        largest: 1,
                        came: order,
                    });
                }
                let rate = self.motion.rates.signal(signal);
                let rate = rate.ok_or_else(|| without_slope(variable))?;
                if pass {
                    take(place, rate);
                }
            }
        }
        Ok(())
    }

    /// The answer with this reference.
    fn answered(&self, reference: u32) -> Result<(Signal, &Variable), Refusal> {
        match self.find(reference)? {
            Found::Answer(signal, variable) => Ok((signal, variable)),
            _ => Err(Refusal::NotAnswer { came: reference }),
        }
    }
}

fn without_slope(variable: &Variable) -> Refusal {
    Refusal::NoDerivative {
        name: variable.name.clone(),
    }
}
