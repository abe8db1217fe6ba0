//! `asymmetric_friction`: the slip limit depends on direction.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Situation, SlipLimit};
use crate::joint::parameters::Parameter;

/// Break-free forces larger in one direction, `n± = 1 ± a`.
pub struct AsymmetricFriction;

static PARAMETERS: [Parameter; 1] = [Parameter {
    name: "asymmetry",
    symbol: "a",
    unit: "1",
    lower: -0.95,
    upper: 0.95,
    vanishes_at: Some(0.0),
    neutral: None,
    meaning: "share by which break-free forces are larger towards positive slip and smaller towards negative",
}];

/// Asymmetry that a further search begins with at most.
const FARTHEST: f64 = 0.8;

impl Effect for AsymmetricFriction {
    fn name(&self) -> &'static str {
        "asymmetric_friction"
    }
    fn place(&self) -> Place {
        Place::SlipLimit
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn sees_energy(&self) -> bool {
        false
    }
    fn slip_limit(&self, values: &[f64], _last: &Situation, _memory: &[f64]) -> SlipLimit {
        SlipLimit {
            positive: 1.0 + values[0],
            negative: 1.0 - values[0],
        }
    }
}

impl Cause for AsymmetricFriction {
    fn page(&self) -> Page {
        Page {
            happens: "Wear marks, lay of the surface or a wedge make the interface hold more in one direction than in the other.",
            sign: "Invisible in symmetric steady loops; the virgin leg, changes of amplitude and loops about a bias shift to one side.",
            mistaken_for: &[
                "normal_load_variation",
                "joint_opening",
                "displacement_drift",
            ],
            separated_by: "Loops about a positive bias against loops about a negative one; a normal load that follows the force gives even harmonics in steady loops, this does not.",
            formula: "phi_+ = (1 + a) phi, phi_- = (1 - a) phi",
            source: "Non-Masing extension of Iwan's parallel-series model with direction-dependent yield.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &AsymmetricFriction
    }
    fn starts(&self, _scale: &Scale) -> Vec<Vec<f64>> {
        vec![vec![0.02]]
    }
    fn begun_anew(&self, values: &[f64], _scale: &Scale) -> Option<Vec<f64>> {
        // Contacts let go one by one, and a refit ends where the next one would have to: half way, as a rule.
        Some(vec![(2.0 * values[0]).clamp(-FARTHEST, FARTHEST)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_begun_once_more_farther_out_on_the_same_side() {
        let anew = |a: f64| AsymmetricFriction.begun_anew(&[a], &Scale::default());
        assert_eq!(anew(-0.2), Some(vec![-0.4]));
        assert_eq!(anew(0.5), Some(vec![FARTHEST]));
    }
}
