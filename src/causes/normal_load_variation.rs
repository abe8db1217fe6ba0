//! `normal_load_variation`: the clamping follows the load or the displacement.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Situation, SlipLimit};
use crate::joint::parameters::Parameter;

/// Break-free forces that follow force and displacement, `n = max(1 + a (F + k U), 0)`, both ways
/// alike.
pub struct NormalLoadVariation;

static PARAMETERS: [Parameter; 2] = [
    Parameter {
        name: "sensitivity",
        symbol: "a",
        unit: "1/N",
        lower: -1e6,
        upper: 1e6,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "relative change of the break-free forces per newton of load",
    },
    Parameter {
        name: "displacement_weight",
        symbol: "k",
        unit: "N/m",
        lower: 0.0,
        upper: 1e13,
        vanishes_at: None,
        neutral: None,
        meaning: "load that counts per metre of displacement; 0 where the clamping follows the force alone",
    },
];

impl Effect for NormalLoadVariation {
    fn name(&self) -> &'static str {
        "normal_load_variation"
    }
    fn place(&self) -> Place {
        Place::SlipLimit
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn slip_limit(&self, values: &[f64], last: &Situation, _memory: &[f64]) -> SlipLimit {
        let load = last.force + values[1] * last.displacement;
        let limit = (1.0 + values[0] * load).max(0.0);
        SlipLimit {
            positive: limit,
            negative: limit,
        }
    }
}

impl Cause for NormalLoadVariation {
    fn page(&self) -> Page {
        Page {
            happens: "The applied load also presses the surfaces together or pulls them apart, by eccentric loading, a wedge or a taper: friction is high at one end of the stroke and low at the other.",
            sign: "Loops fatter and steeper towards one end than the other, in steady symmetric cycles too; even harmonics in the dissipative part; a mean load changes the dissipation.",
            mistaken_for: &[
                "asymmetric_friction",
                "joint_opening",
                "sensor_nonlinearity",
            ],
            separated_by: "Small loops about a positive mean load against the same about a negative one: their areas differ here, while friction that depends on direction gives both the same; an opening joint changes stiffness and no area.",
            formula: "phi = phi_0 max(1 + a (F + k U), 0)",
            source: "Friction contact with variable normal load: Menq, Griffin and Bielak 1986; Yang, Chu and Menq 1998.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &NormalLoadVariation
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        [0.0, 1.0, 10.0]
            .iter()
            .map(|weight| {
                vec![
                    0.02 / (scale.force * (1.0 + weight)),
                    weight * scale.force / scale.displacement,
                ]
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limit_follows_force_and_displacement_and_stays_a_limit() {
        let at = |values: [f64; 2], force, displacement| {
            let last = Situation {
                force,
                displacement,
                ..Situation::default()
            };
            NormalLoadVariation.slip_limit(&values, &last, &[])
        };
        assert_eq!(at([0.25, 0.0], 2.0, 7.0).positive, 1.5);
        assert_eq!(at([0.25, 2.0], 2.0, -3.0).negative, 0.0);
        assert_eq!(at([0.25, 2.0], 2.0, -1.5).negative, 0.75);
        assert_eq!(at([0.25, 0.0], -20.0, 0.0).positive, 0.0);
    }
}
