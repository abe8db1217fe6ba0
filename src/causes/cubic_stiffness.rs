//! `cubic_stiffness`: a spring before the interface, across the joint or across the contact softens or hardens.

use super::{Cause, Page, Scale, spring};
use crate::joint::effect::{Effect, Place, Places, Response};
use crate::joint::elementary::{cube, square};
use crate::joint::parameters::Parameter;

/// A displacement of the spring beyond F/K_1, `δ = b F³ / (1 + c F²)`, for a negative c
/// `b F³ (1 − c F²)`; a positive b softens, a negative one hardens.
///
/// A hardening law with c = 0 holds up to the force where `3 |b| F²` uses up the compliance of joint and
/// spring: beyond it displacement would fall with force, which no spring does. A spring that hardens
/// goes over to a stiffness of its own instead, which is what c is for; with b it is the
/// first odd terms of the spring's law as a quotient.
///
/// Or a force across the whole joint, `f = k_3 U³ / (1 + d U²)`, for a negative d `k_3 U³ (1 − d U²)`, of parts
/// that bend or stretch with it; or the same over the slip u alone, `f = k_u u³ / (1 + e u²)`, of what lies
/// between the surfaces, behind K_1.
pub struct CubicStiffness;

static PARAMETERS: [Parameter; 6] = [
    Parameter {
        name: "cubic_compliance",
        symbol: "b",
        unit: "m/N3",
        lower: -1e60,
        upper: 1e60,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "displacement beyond F/K_1 per cube of the force; positive softens, negative hardens",
    },
    Parameter {
        name: "levelling",
        symbol: "c",
        unit: "1/N2",
        lower: -1e36,
        upper: 1e36,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "how the cube levels off: to half of it where c F^2 = 1; negative: it grows as a fifth power",
    },
    Parameter {
        name: "across",
        symbol: "k_3",
        unit: "N/m3",
        lower: -1e60,
        upper: 1e60,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "force across the joint per cube of its displacement; negative softens",
    },
    Parameter {
        name: "across_levelling",
        symbol: "d",
        unit: "1/m2",
        lower: -1e36,
        upper: 1e36,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "how the cube across levels off: to half of it where d U^2 = 1; negative: it grows as a fifth power",
    },
    Parameter {
        name: "across_contact",
        symbol: "k_u",
        unit: "N/m3",
        lower: -1e60,
        upper: 1e60,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "force across the contact per cube of its slip; negative softens",
    },
    Parameter {
        name: "across_contact_levelling",
        symbol: "e",
        unit: "1/m2",
        lower: -1e36,
        upper: 1e36,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "how the cube across the contact levels off: to half of it where e u^2 = 1; negative: it grows as a fifth power",
    },
];

/// Levelling from which it is refined, at the largest force or displacement.
const LEVELLING: f64 = 0.3;

/// `a x³ / (1 + l x²)`, for a negative l `a x³ (1 − l x²)`, and its slope.
fn levelled_cube(a: f64, l: f64, x: f64) -> Response {
    let levelled = l * square(x);
    let (value, slope) = match levelled > 0.0 {
        true => {
            let whole = 1.0 + levelled;
            (1.0 / whole, (3.0 + levelled) / square(whole))
        }
        false => (1.0 - levelled, 3.0 - 5.0 * levelled),
    };
    Response {
        value: a * cube(x) * value,
        slope: a * square(x) * slope,
        damping: 0.0,
    }
}

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
    fn places(&self, values: &[f64]) -> Places {
        spring::places(values[2], values[4])
    }
    fn beside_slip(&self, values: &[f64], (slip, _): (f64, f64), _memory: &[f64]) -> Response {
        levelled_cube(values[4], values[5], slip)
    }
    fn beside_joint(&self, values: &[f64], displacement: f64, _velocity: f64) -> Response {
        levelled_cube(values[2], values[3], displacement)
    }
    fn spring(&self, values: &[f64], force: f64) -> Response {
        levelled_cube(values[0], values[1], force)
    }
}

impl Cause for CubicStiffness {
    fn page(&self) -> Page {
        Page {
            happens: "The parts around the joint bend or stretch out of their first shape, or a gasket, washer or elastomer gets stiffer or softer with load.",
            sign: "Backbone of the loops bends with the third power of the force or of the displacement while their area stays as it was; equal in tension and compression, in every cycle and at every rate; third harmonic in phase with the force.",
            mistaken_for: &["pinning", "sensor_nonlinearity", "joint_opening"],
            separated_by: "It sets in from zero force, pinning beyond a gap; unloading branches bend as loading ones do, while microslip bends each branch anew; a dummy specimen shows a sensor's cube and not this one.",
            formula: "F = F_j + k_3 U^3 / (1 + d U^2), or F_j = F_network + k_u u^3 / (1 + e u^2), or U = u + F/K_1 + b F^3 / (1 + c F^2), for c < 0 b F^3 (1 - c F^2), likewise d and e; with c = 0 hardening holds while 3 |b| F^2 is less than the compliance of joint and spring",
            source: "First odd term of a non-linear elastic spring (Duffing), across the joint, across its contact or, written in compliance, in its load path.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &CubicStiffness
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let compliance = 0.01 * scale.displacement / cube(scale.force);
        let across = 0.01 * scale.force / cube(scale.displacement);
        vec![
            vec![compliance, 0.0, 0.0, 0.0, 0.0, 0.0],
            vec![0.0, 0.0, across, 0.0, 0.0, 0.0],
            vec![0.0, 0.0, 0.0, 0.0, across, 0.0],
        ]
    }
    fn refined(&self, values: &[f64], scale: &Scale) -> Vec<f64> {
        let from = |value: f64, largest: f64| match value == 0.0 {
            true => 0.0,
            false => LEVELLING / square(largest),
        };
        let levelling = from(values[0], scale.force);
        let across_levelling = from(values[2], scale.displacement);
        let contact_levelling = from(values[4], scale.displacement);
        vec![
            values[0],
            levelling,
            values[2],
            across_levelling,
            values[4],
            contact_levelling,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn displacement_is_the_cube_of_the_force() {
        let at = |force| CubicStiffness.spring(&[0.5, 0.0, 0.0, 0.0, 0.0, 0.0], force);
        assert_eq!((at(2.0).value, at(-2.0).value), (4.0, -4.0));
        assert_eq!((at(2.0).slope, at(-2.0).slope), (6.0, 6.0));
    }

    #[test]
    fn force_across_is_the_cube_of_the_displacement() {
        let at = |u| CubicStiffness.beside_joint(&[0.0, 0.0, 0.5, 0.0, 0.7, 0.0], u, 1.0);
        assert_eq!((at(2.0).value, at(-2.0).value), (4.0, -4.0));
        assert_eq!((at(2.0).slope, at(-2.0).slope), (6.0, 6.0));
        let at = |u| CubicStiffness.beside_slip(&[0.0, 0.0, 0.7, 0.0, 0.5, 0.0], (u, 0.0), &[]);
        assert_eq!((at(2.0).value, at(-2.0).value), (4.0, -4.0));
        assert_eq!((at(2.0).slope, at(-2.0).slope), (6.0, 6.0));
    }

    #[test]
    fn the_cube_levels_off_or_grows_on_smoothly() {
        let spring = |l, x| CubicStiffness.spring(&[0.5, l, 0.0, 0.0, 0.0, 0.0], x);
        let across = |l, x| CubicStiffness.beside_joint(&[0.0, 0.0, 0.5, l, 0.0, 0.0], x, 1.0);
        let contact =
            |l, x| CubicStiffness.beside_slip(&[0.0, 0.0, 0.0, 0.0, 0.5, l], (x, 0.0), &[]);
        for at in [spring, across, contact] {
            assert_eq!((at(0.25, 2.0).value, at(-0.25, 2.0).value), (2.0, 8.0));
            for (levelling, x) in [(0.25, 2.0), (-0.25, 2.0), (0.7, -0.3), (-0.7, -0.3)] {
                let step = 1e-6;
                let (above, below) = (at(levelling, x + step), at(levelling, x - step));
                let slope = (above.value - below.value) / (2.0 * step);
                assert!((at(levelling, x).slope - slope).abs() < 1e-8);
            }
        }
    }
}
