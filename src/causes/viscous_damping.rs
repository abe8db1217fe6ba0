//! `viscous_damping`: a dashpot across the joint.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Response};
use crate::joint::parameters::Parameter;

/// A force proportional to the rate of the total displacement, `F_v = c U̇`.
pub struct ViscousDamping;

static PARAMETERS: [Parameter; 1] = [Parameter {
    name: "coefficient",
    symbol: "c",
    unit: "N.s/m",
    lower: 0.0,
    upper: 1e36,
    vanishes_at: Some(0.0),
    neutral: None,
    meaning: "force per rate of the total displacement",
}];

impl Effect for ViscousDamping {
    fn name(&self) -> &'static str {
        "viscous_damping"
    }
    fn place(&self) -> Place {
        Place::BesideJoint
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn beside_joint(&self, values: &[f64], _displacement: f64, velocity: f64) -> Response {
        Response {
            value: values[0] * velocity,
            slope: 0.0,
            damping: values[0],
        }
    }
}

impl Cause for ViscousDamping {
    fn page(&self) -> Page {
        Page {
            happens: "Oil, sealant, squeeze film or air pumped through the gap resists motion with a force proportional to its rate.",
            sign: "Loops open further at higher frequency and round off at their tips; the extra dissipation per cycle grows with frequency and with the square of the amplitude.",
            mistaken_for: &["sensor_delay", "creep", "quadratic_damping"],
            separated_by: "Deep slip (compliance changes there, a channel delay does not), two decades of frequency, a dummy specimen or swapped channels.",
            formula: "F = F_joint + c dU/dt",
            source: "Kelvin-Voigt element; the linear damping term of SAND2001-0811, Eq. 55 ff.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &ViscousDamping
    }
    fn needs_time(&self) -> bool {
        true
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        vec![vec![0.01 * scale.force / scale.velocity]]
    }
}
