//! `pinning`: the bolt's shank meets the wall of its hole.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Response};
use crate::joint::parameters::Parameter;

/// A stop on either side of the slip after a gap, `F_p = k c(u − g₊) − r k c(−u − g₋)`: contact
/// `c(d) = d²/2w` over a rounding `w`, whose surfaces fit more and more, then `c(d) = d − w/2`.
pub struct Pinning;

static PARAMETERS: [Parameter; 5] = [
    Parameter {
        name: "stiffness",
        symbol: "k_p",
        unit: "N/m",
        lower: 0.0,
        upper: 1e24,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "stiffness of the contact between shank and hole",
    },
    Parameter {
        name: "gap_positive",
        symbol: "g_+",
        unit: "m",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: None,
        neutral: None,
        meaning: "slip towards positive u at which the shank meets the hole",
    },
    Parameter {
        name: "gap_negative",
        symbol: "g_-",
        unit: "m",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: None,
        neutral: None,
        meaning: "slip towards negative u at which the shank meets the hole",
    },
    Parameter {
        name: "rounding",
        symbol: "w",
        unit: "m",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "slip beyond the gap over which the contact comes to its full stiffness",
    },
    Parameter {
        name: "stiffness_ratio",
        symbol: "r",
        unit: "1",
        lower: 0.0,
        upper: 100.0,
        vanishes_at: None,
        neutral: Some(1.0),
        meaning: "stiffness of the contact towards negative u over that towards positive",
    },
];

/// Share of the largest displacement that the shank has to go before it bears: one that bears from
/// the start on one side is a joint that opens.
const MET: f64 = 0.05;

/// The same share of a shank that bears on one side alone, up to which either word fits.
const MET_ALONE: f64 = 0.15;

/// Depth of the contact and its slope.
fn contact(depth: f64, rounding: f64) -> (f64, f64) {
    if depth <= 0.0 {
        (0.0, 0.0)
    } else if depth < rounding {
        (0.5 * depth * depth / rounding, depth / rounding)
    } else {
        (depth - 0.5 * rounding, 1.0)
    }
}

impl Effect for Pinning {
    fn name(&self) -> &'static str {
        "pinning"
    }
    fn place(&self) -> Place {
        Place::BesideSlip
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn beside_slip(&self, values: &[f64], (slip, _): (f64, f64), _memory: &[f64]) -> Response {
        let [stiffness, positive, negative] = [values[0], values[1], values[2]];
        let [rounding, ratio] = [values[3], values[4]];
        let (ahead, ahead_slope) = contact(slip - positive, rounding);
        let (behind, behind_slope) = contact(-slip - negative, rounding);
        Response {
            value: stiffness * (ahead - ratio * behind),
            slope: stiffness * (ahead_slope + ratio * behind_slope),
            damping: 0.0,
        }
    }
}

impl Cause for Pinning {
    fn page(&self) -> Page {
        Page {
            happens: "Slip uses up the clearance between bolt shank and hole; from there on the shank bears and a second, elastic load path stiffens the joint.",
            sign: "Loops stiffen beyond a fixed displacement, at the same displacement in every cycle and amplitude, with no dissipation of its own; unequal gaps give even harmonics.",
            mistaken_for: &[
                "sensor_nonlinearity",
                "cubic_stiffness",
                "sensor_saturation",
                "clearance",
            ],
            separated_by: "An amplitude at which the effect sets in (below it the baseline is exact); a dummy specimen shows a sensor's non-linearity and no pinning.",
            formula: "F_network + k_p c(u - g_+) - r k_p c(-u - g_-), c(d) = d^2/2w for 0 < d < w, d - w/2 beyond",
            source: "Segalman et al., Handbook on Dynamics of Jointed Structures, SAND2009-4164, pinning of macroslip.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &Pinning
    }
    fn plausible(&self, values: &[f64], scale: &Scale) -> bool {
        values[1].min(values[2]) > MET * scale.displacement
    }
    /// One that bears on one side alone, and nearly from the start.
    fn also_called(&self, values: &[f64], scale: &Scale) -> Option<&'static str> {
        let (near, far) = (values[1].min(values[2]), values[1].max(values[2]));
        let one_sided = far > scale.displacement && near < MET_ALONE * scale.displacement;
        one_sided.then_some("joint_opening")
    }
    fn refined(&self, values: &[f64], scale: &Scale) -> Vec<f64> {
        let rounding = 0.05 * scale.displacement;
        vec![values[0], values[1], values[2], rounding, 1.001]
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let stiffness = 0.02 * scale.stiffness;
        let gaps = [0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 1.2].map(|gap| gap * scale.displacement);
        let mut starts = Vec::new();
        for positive in gaps {
            for negative in gaps {
                starts.push(vec![stiffness, positive, negative, 0.0, 1.0]);
            }
        }
        starts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of one that bears on one side from nearly the start nobody can tell a joint that opens.
    #[test]
    fn a_shank_that_bears_on_one_side_at_once_may_be_a_joint_that_opens() {
        let scale = Scale {
            displacement: 1.0,
            ..Scale::default()
        };
        for (positive, negative, either) in [
            (0.1, 2.0, true),
            (2.0, 0.1, true),
            (0.3, 2.0, false),
            (0.1, 0.5, false),
        ] {
            let values = [1.0, positive, negative, 0.0, 1.0];
            let expected = either.then_some("joint_opening");
            assert_eq!(Pinning.also_called(&values, &scale), expected, "{values:?}");
        }
    }
}
