//! `joint_opening`: the joint is softer on one side of a force.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Response};
use crate::joint::parameters::Parameter;

/// A compliance that acts beyond a force on one side only: `δ = c max(F − F_o, 0)` for `F_o ≥ 0`,
/// `δ = −c max(F_o − F, 0)` for `F_o < 0`.
pub struct JointOpening;

static PARAMETERS: [Parameter; 2] = [
    Parameter {
        name: "compliance",
        symbol: "c_o",
        unit: "m/N",
        lower: 0.0,
        upper: 1.0,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "compliance that the opened joint has beyond that of the closed one",
    },
    Parameter {
        name: "opening_force",
        symbol: "F_o",
        unit: "N",
        lower: -1e9,
        upper: 1e9,
        vanishes_at: None,
        neutral: None,
        meaning: "force at which the surfaces part; its sign tells the side that opens",
    },
];

impl Effect for JointOpening {
    fn name(&self) -> &'static str {
        "joint_opening"
    }
    fn place(&self) -> Place {
        Place::Spring
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn keeps_side(&self, parameter: usize) -> bool {
        PARAMETERS[parameter].name == "opening_force"
    }
    fn spring(&self, values: &[f64], force: f64) -> Response {
        let [compliance, opens] = [values[0], values[1]];
        let beyond = if opens >= 0.0 {
            (force - opens).max(0.0)
        } else {
            (force - opens).min(0.0)
        };
        Response {
            value: compliance * beyond,
            slope: if beyond == 0.0 { 0.0 } else { compliance },
            damping: 0.0,
        }
    }
}

impl Cause for JointOpening {
    fn page(&self) -> Page {
        Page {
            happens: "Under tension the clamped surfaces part once the force exceeds the clamping; from there the bolt alone carries it and the joint is softer than in compression.",
            sign: "A kink in the backbone at one force on one side; stiffness differs in tension and compression, the mean displacement moves with amplitude; even harmonics, the same in every cycle and at every rate.",
            mistaken_for: &[
                "sensor_nonlinearity",
                "normal_load_variation",
                "asymmetric_friction",
                "pinning",
            ],
            separated_by: "The kink sits at a force, not at a displacement, and adds no area; below the opening force the baseline is exact; a normal load that follows the force changes the area of the loops too.",
            formula: "U = u + F/K_1 + c_o max(F - F_o, 0); mirrored for F_o < 0",
            source: "Preloaded bolted joint beyond separation, VDI 2230; bilinear spring.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &JointOpening
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let compliance = 0.01 * scale.displacement / scale.force;
        [0.02, -0.02, 0.25, -0.25, 0.5, -0.5, 0.75, -0.75]
            .iter()
            .map(|share| vec![compliance, share * scale.force])
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_softer_beyond_the_opening_force_and_there_only() {
        let at = |opens, force| JointOpening.spring(&[2.0, opens], force);
        assert_eq!((at(3.0, 5.0).value, at(3.0, 5.0).slope), (4.0, 2.0));
        assert_eq!(at(3.0, -5.0), Response::default());
        assert_eq!((at(-3.0, -5.0).value, at(-3.0, -5.0).slope), (-4.0, 2.0));
        assert_eq!(at(-3.0, 5.0), Response::default());
        assert_eq!(at(0.0, 1.0).value, 2.0);
        assert_eq!(at(0.0, -1.0).value, 0.0);
    }
}
