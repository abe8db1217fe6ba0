//! `viscous_damping`: a dashpot across the joint, or across its contact.

use super::{Cause, Page, Scale, spring};
use crate::joint::effect::{Effect, Place, Places, Response};
use crate::joint::parameters::Parameter;

/// A force proportional to the rate of the total displacement, `F_v = c U̇`, or to that of the slip alone, `c_s u̇`, of what
/// lies between the surfaces behind K_1: with U̇ in its place, a delay of `c_s/K_1` of the load cell seems to be beside it.
pub struct ViscousDamping;

static PARAMETERS: [Parameter; 2] = [
    Parameter {
        name: "coefficient",
        symbol: "c",
        unit: "N.s/m",
        lower: 0.0,
        upper: 1e36,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "force per rate of the total displacement",
    },
    Parameter {
        name: "contact_coefficient",
        symbol: "c_s",
        unit: "N.s/m",
        lower: 0.0,
        upper: 1e36,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "force per rate of the slip alone, behind K_1",
    },
];

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
    fn places(&self, values: &[f64]) -> Places {
        spring::beside(values[0], values[1])
    }
    fn beside_slip(&self, values: &[f64], (_, rate): (f64, f64), _memory: &[f64]) -> Response {
        dashpot(values[1], rate)
    }
    fn beside_joint(&self, values: &[f64], _displacement: f64, velocity: f64) -> Response {
        dashpot(values[0], velocity)
    }
}

fn dashpot(coefficient: f64, rate: f64) -> Response {
    Response {
        value: coefficient * rate,
        slope: 0.0,
        damping: coefficient,
    }
}

impl Cause for ViscousDamping {
    fn page(&self) -> Page {
        Page {
            happens: "Oil, sealant, squeeze film or air pumped through the gap resists motion with a force proportional to its rate.",
            sign: "Loops open further at higher frequency and round off at their tips; the extra dissipation per cycle grows with frequency and with the square of the amplitude.",
            mistaken_for: &["sensor_delay", "creep", "quadratic_damping"],
            separated_by: "Deep slip (compliance changes there, a channel delay does not), two decades of frequency, a dummy specimen or swapped channels.",
            formula: "F = F_joint + c dU/dt, or F_joint = F_network + c_s du/dt",
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
        let coefficient = 0.01 * scale.force / scale.velocity;
        vec![vec![coefficient, 0.0], vec![0.0, coefficient]]
    }
}
