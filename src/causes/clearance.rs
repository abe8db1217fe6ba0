//! `clearance`: free play in the load path.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Response};
use crate::joint::elementary::tanh;
use crate::joint::parameters::Parameter;

/// Free play that the load path crosses whenever the force changes its sign,
/// `s = (g/2) tanh(F/F_s)`.
pub struct Clearance;

static PARAMETERS: [Parameter; 2] = [
    Parameter {
        name: "gap",
        symbol: "g",
        unit: "m",
        lower: 0.0,
        upper: 1.0,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "free play from contact on one side to contact on the other",
    },
    Parameter {
        name: "seating_force",
        symbol: "F_s",
        unit: "N",
        lower: 1e-9,
        upper: 1e9,
        vanishes_at: None,
        neutral: None,
        meaning: "force over which the surfaces come to full contact",
    },
];

/// Share of the largest force by which free play has to be crossed: a law that goes on bending up to
/// the largest force is a spring that softens.
const SEATED: f64 = 0.4;

impl Effect for Clearance {
    fn name(&self) -> &'static str {
        "clearance"
    }
    fn place(&self) -> Place {
        Place::InSeries
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn in_series(&self, values: &[f64], force: f64, _step: f64, _memory: &[f64]) -> Response {
        let shape = tanh(force / values[1]);
        Response {
            value: 0.5 * values[0] * shape,
            slope: 0.5 * values[0] / values[1] * (1.0 - shape * shape),
            damping: 0.0,
        }
    }
}

impl Cause for Clearance {
    fn page(&self) -> Page {
        Page {
            happens: "Pins, threads or a worn linkage in the load path have free play: the displacement jumps by the gap whenever the force changes its sign.",
            sign: "A step of fixed size in displacement at zero force, or a dwell at zero force after each reversal of a prescribed motion; odd harmonics, the same in every cycle and at every amplitude.",
            mistaken_for: &["slack_growth", "static_friction_drop", "pinning"],
            separated_by: "It sits at zero force, not at zero displacement nor at the reversal; its size is fixed while slack growth follows past peaks.",
            formula: "U = u + F/K_1 + (g/2) tanh(F/F_s)",
            source: "Dead-zone of a backlash, smoothed over the seating force; Coble et al. 2022 for a friction damper with backlash.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &Clearance
    }
    fn plausible(&self, values: &[f64], scale: &Scale) -> bool {
        values[1] < SEATED * scale.force
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        [0.005, 0.015, 0.05, 0.12, 0.3]
            .iter()
            .map(|share| vec![0.005 * scale.displacement, share * scale.force])
            .collect()
    }
}
