//! `cubic_stiffness`: the spring beside the interface softens or hardens.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Response};
use crate::joint::elementary::cube;
use crate::joint::parameters::Parameter;

/// A displacement of the spring beyond F/K_1, `δ = b F³`; positive softens, negative hardens.
///
/// A hardening law holds up to the force where `3 |b| F²` uses up the compliance of joint and
/// spring: beyond it displacement would fall with force, which no spring does.
pub struct CubicStiffness;

static PARAMETERS: [Parameter; 1] = [Parameter {
    name: "cubic_compliance",
    symbol: "b",
    unit: "m/N3",
    lower: -1.0,
    upper: 1.0,
    vanishes_at: Some(0.0),
    neutral: None,
    meaning: "displacement beyond F/K_1 per cube of the force; positive softens, negative hardens",
}];

impl Effect for CubicStiffness {
    fn name(&self) -> &'static str {
        "cubic_stiffness"
    }
    fn place(&self) -> Place {
        Place::Spring
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn spring(&self, values: &[f64], force: f64) -> Response {
        Response {
            value: values[0] * force * force * force,
            slope: 3.0 * values[0] * force * force,
            damping: 0.0,
        }
    }
}

impl Cause for CubicStiffness {
    fn page(&self) -> Page {
        Page {
            happens: "The parts around the joint bend or stretch out of their first shape, or a gasket, washer or elastomer gets stiffer or softer with load.",
            sign: "Backbone of the loops bends with the third power of the force while their area stays as it was; equal in tension and compression, in every cycle and at every rate; third harmonic in phase with the force.",
            mistaken_for: &["pinning", "sensor_nonlinearity", "joint_opening"],
            separated_by: "It sets in from zero force, pinning beyond a gap; unloading branches bend as loading ones do, while microslip bends each branch anew; a dummy specimen shows a sensor's cube and not this one.",
            formula: "U = u + F/K_1 + b F^3; hardening holds while 3 |b| F^2 is less than the compliance of joint and spring",
            source: "First odd term of a non-linear elastic spring (Duffing), written in compliance.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &CubicStiffness
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        vec![vec![0.01 * scale.displacement / cube(scale.force)]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn displacement_is_the_cube_of_the_force() {
        let at = |force| CubicStiffness.spring(&[0.5], force);
        assert_eq!((at(2.0).value, at(-2.0).value), (4.0, -4.0));
        assert_eq!((at(2.0).slope, at(-2.0).slope), (6.0, 6.0));
    }
}
