//! `joint_opening`: the joint is softer on one side of a force.

use super::{Cause, Page, Scale, spring};
use crate::joint::effect::{Effect, Place, Places, Response};
use crate::joint::elementary::square;
use crate::joint::parameters::Parameter;

/// A compliance that acts beyond a force on one side only: `δ = c max(F − F_o, 0)` for `F_o ≥ 0`,
/// `δ = −c max(F_o − F, 0)` for `F_o < 0`; where the surfaces part little by little, max(x, 0) is rounded to
/// `g(x) = (x + √(x² + r²))/2`, less what it is at no force. With `c < 0` the joint is open at rest and the surfaces meet
/// at `F_o`.
///
/// Or a stiffness across the whole joint on one side of rest, of surfaces that meet there:
/// `f = k_c max(U, 0)`, and for `k_c < 0`, on the other side, `f = −|k_c| max(−U, 0)`; where they meet
/// little by little, rounded over `u_c` likewise. Surfaces that are closed at rest part at `u_o` on the other side:
/// `f = k_c (max(U + u_o, 0) − u_o)`, mirrored for `k_c < 0`. Or the same across the contact alone, over the slip u behind
/// K_1, with `k_s`, `u_s` and `u_p`.
pub struct JointOpening;

static PARAMETERS: [Parameter; 9] = [
    Parameter {
        name: "compliance",
        symbol: "c_o",
        unit: "m/N",
        // Of a joint that is open at rest, and closes at the force.
        lower: -1e12,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "compliance that the opened joint has beyond that of the closed one; negative where the surfaces meet at the force instead of parting",
    },
    Parameter {
        name: "opening_force",
        symbol: "F_o",
        unit: "N",
        lower: -1e9,
        upper: 1e9,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "force at which the surfaces part; its sign tells the side that opens",
    },
    Parameter {
        name: "rounding",
        symbol: "r",
        unit: "N",
        lower: 0.0,
        upper: 1e9,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "force over which the surfaces part; 0: at once",
    },
    Parameter {
        name: "closed_stiffness",
        symbol: "k_c",
        unit: "N/m",
        lower: -1e15,
        upper: 1e15,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "stiffness that the joint has more on one side of rest; its sign tells the side",
    },
    Parameter {
        name: "closing",
        symbol: "u_c",
        unit: "m",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "displacement over which the surfaces meet; 0: at once",
    },
    Parameter {
        name: "contact_stiffness",
        symbol: "k_s",
        unit: "N/m",
        lower: -1e15,
        upper: 1e15,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "stiffness that the contact has more on one side of rest; its sign tells the side",
    },
    Parameter {
        name: "contact_closing",
        symbol: "u_s",
        unit: "m",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "slip over which its surfaces meet; 0: at once",
    },
    Parameter {
        name: "opening_displacement",
        symbol: "u_o",
        unit: "m",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "displacement to the other side at which the surfaces part that closed_stiffness says to be closed; 0: at rest",
    },
    Parameter {
        name: "contact_opening",
        symbol: "u_p",
        unit: "m",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "slip to the other side at which the surfaces part that contact_stiffness says to be closed; 0: at rest",
    },
];

/// Shares of the largest displacement at which surfaces may part that are closed at rest.
const PART: [f64; 2] = [0.15, 0.4];

/// Share of the largest force or displacement from which a rounding is refined.
const LITTLE_BY_LITTLE: f64 = 0.05;

/// max(x, 0) rounded over `r`, and its slope.
fn rounded(x: f64, r: f64) -> (f64, f64) {
    if r == 0.0 {
        return (x.max(0.0), if x > 0.0 { 1.0 } else { 0.0 });
    }
    let root = (square(x) + square(r)).sqrt();
    (0.5 * (x + root), 0.5 * (1.0 + x / root))
}

/// `size` times what x is beyond `edge` to one side, rounded over `r`, less what that is at rest.
fn one_sided(size: f64, side: f64, edge: f64, r: f64, x: f64) -> Response {
    let (beyond, slope) = rounded(side * (x - edge), r);
    let (at_rest, _) = rounded(-side * edge, r);
    Response {
        value: side * size * (beyond - at_rest),
        slope: size * slope,
        damping: 0.0,
    }
}

/// Force of surfaces that meet on the side of the stiffness's sign, from where they part on the other one.
fn bearing(stiffness: f64, (closing, opening): (f64, f64), displacement: f64) -> Response {
    let side = stiffness.signum();
    one_sided(
        stiffness.abs(),
        side,
        -side * opening,
        closing,
        displacement,
    )
}

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
    fn places(&self, values: &[f64]) -> Places {
        spring::places(values[3], values[5])
    }
    fn beside_slip(&self, values: &[f64], (slip, _): (f64, f64), _memory: &[f64]) -> Response {
        bearing(values[5], (values[6], values[8]), slip)
    }
    fn beside_joint(&self, values: &[f64], displacement: f64, _velocity: f64) -> Response {
        bearing(values[3], (values[4], values[7]), displacement)
    }
    fn spring(&self, values: &[f64], force: f64) -> Response {
        let [compliance, opens, rounding] = [values[0], values[1], values[2]];
        let side = if opens >= 0.0 { 1.0 } else { -1.0 };
        one_sided(compliance, side, opens, rounding, force)
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
            separated_by: "The kink sits at one force, or one displacement, on one side, the joint is softer beyond it, and it adds no area; below the opening force the baseline is exact; a normal load that follows the force changes the area of the loops too.",
            formula: "F = F_j + k_c (max(U + u_o, 0) - u_o), or F_j = F_network + k_s (max(u + u_p, 0) - u_p), or U = u + F/K_1 + c_o max(F - F_o, 0); mirrored for F_o < 0; with a rounding g(F - F_o) - g(-F_o), g(x) = (x + sqrt(x^2 + r^2))/2, likewise max(U + u_o, 0) - u_o over u_c and max(u + u_p, 0) - u_p over u_s",
            source: "Preloaded bolted joint beyond separation, VDI 2230; bilinear spring.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &JointOpening
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let compliance = 0.01 * scale.displacement / scale.force;
        let stiffness = 0.01 * scale.force / scale.displacement;
        let with = |pairs: &[(usize, f64)]| {
            let mut values = vec![0.0; PARAMETERS.len()];
            pairs.iter().for_each(|&(at, value)| values[at] = value);
            values
        };
        let opens = [0.02, -0.02, 0.25, -0.25, 0.5, -0.5, 0.75, -0.75];
        let in_series = opens.map(|share| with(&[(0, compliance), (1, share * scale.force)]));
        let at_rest = [3, 5].map(|size| with(&[(size, stiffness)]));
        let part = PART.into_iter().flat_map(|share| {
            let opening = share * scale.displacement;
            [(3, 7), (5, 8)].into_iter().flat_map(move |(size, at)| {
                [stiffness, -stiffness].map(|side| with(&[(size, side), (at, opening)]))
            })
        });
        in_series.into_iter().chain(at_rest).chain(part).collect()
    }
    fn refined(&self, values: &[f64], scale: &Scale) -> Vec<f64> {
        let mut finer = values.to_vec();
        if values[0] != 0.0 {
            finer[2] = LITTLE_BY_LITTLE * scale.force;
        }
        if values[3] != 0.0 {
            finer[4] = LITTLE_BY_LITTLE * scale.displacement;
            finer[7] = finer[7].max(LITTLE_BY_LITTLE * scale.displacement);
        }
        if values[5] != 0.0 {
            finer[6] = LITTLE_BY_LITTLE * scale.displacement;
            finer[8] = finer[8].max(LITTLE_BY_LITTLE * scale.displacement);
        }
        finer
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Law = fn(f64, f64, f64) -> Response;

    fn across(stiffness: f64, closing: f64, displacement: f64) -> Response {
        let values = [0.0, 0.0, 0.0, stiffness, closing, 1.0, 0.0, 0.0, 0.0];
        JointOpening.beside_joint(&values, displacement, 1.0)
    }

    fn contact(stiffness: f64, closing: f64, slip: f64) -> Response {
        let values = [0.0, 0.0, 0.0, 1.0, 0.0, stiffness, closing, 0.0, 0.0];
        JointOpening.beside_slip(&values, (slip, 0.0), &[])
    }

    #[test]
    fn it_is_softer_beyond_the_opening_force_and_there_only() {
        let at = |opens, force| {
            JointOpening.spring(&[2.0, opens, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], force)
        };
        assert_eq!((at(3.0, 5.0).value, at(3.0, 5.0).slope), (4.0, 2.0));
        assert_eq!(at(3.0, -5.0), Response::default());
        assert_eq!((at(-3.0, -5.0).value, at(-3.0, -5.0).slope), (-4.0, 2.0));
        assert_eq!(at(-3.0, 5.0), Response::default());
        assert_eq!(at(0.0, 1.0).value, 2.0);
        assert_eq!(at(0.0, -1.0).value, 0.0);
        // Open at rest: stiffer from where the surfaces meet.
        let closes = JointOpening.spring(&[-2.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], 5.0);
        assert_eq!((closes.value, closes.slope), (-4.0, -2.0));
    }

    #[test]
    fn it_is_stiffer_across_on_the_side_of_the_sign() {
        let laws: [Law; 2] = [across, contact];
        for law in laws {
            let at = |stiffness, u| law(stiffness, 0.0, u);
            assert_eq!((at(3.0, 2.0).value, at(3.0, 2.0).slope), (6.0, 3.0));
            assert_eq!((at(-3.0, -2.0).value, at(-3.0, -2.0).slope), (-6.0, 3.0));
            assert_eq!(at(3.0, -2.0), Response::default());
            assert_eq!(at(-3.0, 2.0), Response::default());
        }
    }

    #[test]
    fn a_rounding_parts_the_surfaces_little_by_little() {
        let at = |opens, force| {
            JointOpening.spring(&[2.0, opens, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], force)
        };
        for opens in [3.0, -3.0] {
            assert_eq!(at(opens, 0.0).value, 0.0);
            let far = at(opens, 1e6 * opens).value - 2.0 * (1e6 - 1.0) * opens;
            assert!(far.abs() < 2.1, "{far}");
            for force in [-7.0, -0.1, 2.0, 9.0] {
                let step = 1e-6;
                let rise = at(opens, force + step).value - at(opens, force - step).value;
                assert!((rise / (2.0 * step) - at(opens, force).slope).abs() < 1e-8);
            }
        }
        // g(0) = r/2 at the opening force, less g(-3) = (5 - 3)/2.
        assert_eq!(at(3.0, 3.0).value, 2.0 * (2.0 - 1.0));
    }

    #[test]
    fn surfaces_meet_little_by_little() {
        let laws: [Law; 2] = [across, contact];
        for (law, stiffness) in laws.into_iter().flat_map(|law| [(law, 3.0), (law, -3.0)]) {
            let at = |u| law(stiffness, 4.0, u);
            assert_eq!(at(0.0).value, 0.0);
            // g(3) - g(0) = (3 + 5)/2 - 2.
            assert_eq!(at(stiffness).value, stiffness * 2.0);
            for u in [-7.0, -0.1, 2.0, 9.0] {
                let step = 1e-6;
                let rise = at(u + step).value - at(u - step).value;
                assert!((rise / (2.0 * step) - at(u).slope).abs() < 1e-8);
            }
        }
    }
    /// Closed at rest and up to an opening on the other side, by either law.
    #[test]
    fn it_is_softer_beyond_the_opening_displacement() {
        for side in [1.0, -1.0] {
            let values = [0.0, 0.0, 0.0, 3.0 * side, 0.0, 3.0 * side, 0.0, 0.5, 0.5];
            let laws: [&dyn Fn(f64) -> Response; 2] =
                [&|u| JointOpening.beside_joint(&values, u, 1.0), &|u| {
                    JointOpening.beside_slip(&values, (u, 0.0), &[])
                }];
            for at in laws {
                for u in [2.0, 0.0, -0.4] {
                    assert_eq!(
                        (at(side * u).value, at(side * u).slope),
                        (3.0 * side * u, 3.0)
                    );
                }
                let open = at(-2.0 * side);
                assert_eq!((open.value, open.slope), (-1.5 * side, 0.0));
            }
        }
    }
}
