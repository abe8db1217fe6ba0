//! `quadratic_damping`: a drag that grows with the square of the rate.

use super::{Cause, Page, Scale, spring};
use crate::joint::effect::{Effect, Place, Places, Response};
use crate::joint::elementary::square;
use crate::joint::parameters::Parameter;

/// A force proportional to the rate of the total displacement times its magnitude,
/// `F_q = c_q U̇ |U̇|`, or to that of the slip alone, `c_u u̇ |u̇|`, of a gap between the surfaces behind K_1.
pub struct QuadraticDamping;

static PARAMETERS: [Parameter; 2] = [
    Parameter {
        name: "coefficient",
        symbol: "c_q",
        unit: "N.s2/m2",
        lower: 0.0,
        upper: 1e60,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "force per square of the rate of the total displacement",
    },
    Parameter {
        name: "contact_coefficient",
        symbol: "c_u",
        unit: "N.s2/m2",
        lower: 0.0,
        upper: 1e60,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "force per square of the rate of the slip alone, behind K_1",
    },
];

impl Effect for QuadraticDamping {
    fn name(&self) -> &'static str {
        "quadratic_damping"
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
        drag(values[1], rate)
    }
    fn beside_joint(&self, values: &[f64], _displacement: f64, velocity: f64) -> Response {
        drag(values[0], velocity)
    }
}

fn drag(coefficient: f64, rate: f64) -> Response {
    Response {
        value: coefficient * rate * rate.abs(),
        slope: 0.0,
        damping: 2.0 * coefficient * rate.abs(),
    }
}

impl Cause for QuadraticDamping {
    fn page(&self) -> Page {
        Page {
            happens: "Fluid driven through a gap, a port or around an edge separates and resists with the square of its rate, as in a damper with an orifice.",
            sign: "Loops open at mid-stroke as with a dashpot, but the extra dissipation per cycle grows with the square of frequency and the cube of the amplitude; third harmonic in force at high rates, nothing at low ones.",
            mistaken_for: &["viscous_damping", "fixture_inertia", "sensor_delay"],
            separated_by: "A grid of amplitude and frequency: the loss goes with A^3 f^2 where a dashpot has A^2 f, and the stiffness stays while a mass lowers it with f^2.",
            formula: "F = F_joint + c_q |dU/dt| dU/dt, or F_joint = F_network + c_u |du/dt| du/dt",
            source: "Drag and orifice loss at high Reynolds number; equivalent damping of a velocity-squared law (Jacobsen 1930).",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &QuadraticDamping
    }
    fn needs_time(&self) -> bool {
        true
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let coefficient = 0.01 * scale.force / square(scale.velocity);
        vec![vec![coefficient, 0.0], vec![0.0, coefficient]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_force_follows_the_square_and_the_sign_of_the_rate() {
        let across = |velocity| QuadraticDamping.beside_joint(&[3.0, 0.0], 9.0, velocity);
        let contact = |rate| QuadraticDamping.beside_slip(&[0.0, 3.0], (9.0, rate), &[]);
        let laws: [&dyn Fn(f64) -> Response; 2] = [&across, &contact];
        for at in laws {
            assert_eq!((at(2.0).value, at(-2.0).value), (12.0, -12.0));
            assert_eq!((at(2.0).damping, at(-2.0).damping), (12.0, 12.0));
            assert_eq!(at(0.0), Response::default());
        }
    }
}
