//! `displacement_drift`: the displacement sensor wanders.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Trajectory};
use crate::joint::elementary::expm1;
use crate::joint::parameters::Parameter;

/// The sensor adds a displacement that grows with time, `U_meas = U + v t`, or comes to rest as a
/// temperature does, `U + v (1 − exp(−λ t))/λ`.
pub struct DisplacementDrift;

static PARAMETERS: [Parameter; 2] = [
    Parameter {
        name: "rate",
        symbol: "v",
        unit: "m/s",
        lower: -1.0,
        upper: 1.0,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "displacement added by the sensor per second, at first",
    },
    Parameter {
        name: "fading",
        symbol: "lambda",
        unit: "1/s",
        lower: 0.0,
        upper: 1e9,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "how fast the drift comes to rest; 0: it goes on",
    },
];

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
    fn channel(&self, values: &[f64], _place: Place, truth: &Trajectory) -> Vec<f64> {
        let start = truth.time.first().copied().unwrap_or(0.0);
        let (rate, fading) = (values[0], values[1]);
        let gone = |time: f64| match fading > 0.0 {
            true => -expm1(-fading * time) / fading,
            false => time,
        };
        truth.time.iter().map(|t| rate * gone(t - start)).collect()
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
            formula: "U_measured = U + v t, or U + v (1 - exp(-lambda t))/lambda",
            source: "First-order drift of a displacement transducer; thermal drift that settles.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &DisplacementDrift
    }
    fn needs_time(&self) -> bool {
        true
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        vec![vec![0.01 * scale.displacement / scale.duration(), 0.0]]
    }
    fn refined(&self, values: &[f64], scale: &Scale) -> Vec<f64> {
        vec![values[0], 1.0 / scale.duration()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drift_goes_on_or_comes_to_rest() {
        let truth = Trajectory {
            begins: 0.0,
            time: vec![2.0, 3.0, 5.0],
            force: vec![],
            displacement: vec![0.0; 3],
        };
        assert_eq!(
            DisplacementDrift.channel(&[0.5, 0.0], Place::DisplacementChannel, &truth),
            [0.0, 0.5, 1.5]
        );
        let settles = DisplacementDrift.channel(&[0.5, 2.0], Place::DisplacementChannel, &truth);
        assert!((settles[2] - 0.25 * (1.0 - (-6.0_f64).exp())).abs() < 1e-15);
        let slowly = DisplacementDrift.channel(&[0.5, 1e-9], Place::DisplacementChannel, &truth);
        assert!((slowly[2] - 1.5).abs() < 1e-8);
    }
}
