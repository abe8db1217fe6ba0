//! `pinning`: the bolt's shank meets the wall of its hole.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Response};
use crate::joint::parameters::Parameter;

/// A stop on either side of the slip after a gap, `F_p = k (u − g₊)₊ − k (−u − g₋)₊`.
pub struct Pinning;

static PARAMETERS: [Parameter; 3] = [
    Parameter {
        name: "stiffness",
        symbol: "k_p",
        unit: "N/m",
        lower: 0.0,
        upper: 1e13,
        vanishes_at: Some(0.0),
        meaning: "stiffness of the contact between shank and hole",
    },
    Parameter {
        name: "gap_positive",
        symbol: "g_+",
        unit: "m",
        lower: 0.0,
        upper: 1.0,
        vanishes_at: None,
        meaning: "slip towards positive u at which the shank meets the hole",
    },
    Parameter {
        name: "gap_negative",
        symbol: "g_-",
        unit: "m",
        lower: 0.0,
        upper: 1.0,
        vanishes_at: None,
        meaning: "slip towards negative u at which the shank meets the hole",
    },
];

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
    fn beside_slip(&self, values: &[f64], slip: f64, _memory: &[f64]) -> Response {
        let [stiffness, positive, negative] = [values[0], values[1], values[2]];
        let depth = (slip - positive).max(0.0) - (-slip - negative).max(0.0);
        let touching = slip > positive || slip < -negative;
        Response {
            value: stiffness * depth,
            slope: if touching { stiffness } else { 0.0 },
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
            formula: "F_network + k_p max(u - g_+, 0) - k_p max(-u - g_-, 0)",
            source: "Segalman et al., Handbook on Dynamics of Jointed Structures, SAND2009-4164, pinning of macroslip.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &Pinning
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let stiffness = 0.02 * scale.stiffness;
        let mut starts = Vec::new();
        for gap in [0.2, 0.35, 0.5, 0.65, 0.8, 0.9] {
            let gap = gap * scale.displacement;
            let away = scale.displacement * 1.2;
            starts.push(vec![stiffness, gap, gap]);
            starts.push(vec![stiffness, gap, away]);
            starts.push(vec![stiffness, away, gap]);
        }
        starts
    }
}
