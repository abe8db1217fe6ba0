//! `displacement_drift`: the displacement sensor wanders.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Trajectory};
use crate::joint::parameters::Parameter;

/// The sensor adds a displacement that grows with time, `U_meas = U + v t`.
pub struct DisplacementDrift;

static PARAMETERS: [Parameter; 1] = [Parameter {
    name: "rate",
    symbol: "v",
    unit: "m/s",
    lower: -1.0,
    upper: 1.0,
    vanishes_at: Some(0.0),
    neutral: None,
    meaning: "displacement added by the sensor per second",
}];

impl Effect for DisplacementDrift {
    fn name(&self) -> &'static str {
        "displacement_drift"
    }
    fn place(&self) -> Place {
        Place::DisplacementChannel
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn channel(&self, values: &[f64], truth: &Trajectory) -> Vec<f64> {
        let start = truth.time.first().copied().unwrap_or(0.0);
        truth.time.iter().map(|t| values[0] * (t - start)).collect()
    }
}

impl Cause for DisplacementDrift {
    fn page(&self) -> Page {
        Page {
            happens: "Temperature, amplifier or mounting lets the displacement reading wander while the joint stays where it is.",
            sign: "Loops keep their shape and move along the displacement axis at a steady rate, at rest as well as under load.",
            mistaken_for: &[
                "preload_loss",
                "creep",
                "offset_step",
                "asymmetric_friction",
            ],
            separated_by: "A pause at zero load still drifts; loop area and stiffness stay as they were; a dummy specimen drifts too.",
            formula: "U_measured = U + v t",
            source: "First-order drift of a displacement transducer.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &DisplacementDrift
    }
    fn needs_time(&self) -> bool {
        true
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        vec![vec![0.01 * scale.displacement / scale.duration()]]
    }
}
