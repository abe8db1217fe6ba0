//! `preload_loss`: friction decays as the interface works.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Situation, SlipLimit};
use crate::joint::elementary::{exp, log1p};
use crate::joint::parameters::Parameter;

/// Break-free forces fall with the energy dissipated, `n = 1 − l (1 − exp(−E/E_0))`.
pub struct PreloadLoss;

static PARAMETERS: [Parameter; 3] = [
    Parameter {
        name: "loss",
        symbol: "l",
        unit: "1",
        lower: 0.0,
        upper: 0.98,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "share of the break-free forces that is lost in the end",
    },
    Parameter {
        name: "energy",
        symbol: "E_0",
        unit: "J",
        lower: 1e-15,
        upper: 1e12,
        vanishes_at: None,
        neutral: None,
        meaning: "dissipated energy over which the loss happens",
    },
    Parameter {
        name: "tail",
        symbol: "q",
        unit: "1",
        lower: 0.0,
        upper: 5.0,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "how slowly the loss dies out: exponentially for 0, as 1/(1 + E/E_0) for 1",
    },
];

/// What is left of a change after the work `x` in units of its energy, `(1 + q x)^(−1/q)`.
pub(super) fn remaining(work: f64, tail: f64) -> f64 {
    if tail > 0.0 {
        exp(-log1p(tail * work) / tail)
    } else {
        exp(-work)
    }
}

/// Share of a record's dissipated energy below which a loss that is over is running in.
const LATE: f64 = 0.08;

impl Effect for PreloadLoss {
    fn name(&self) -> &'static str {
        "preload_loss"
    }
    fn place(&self) -> Place {
        Place::SlipLimit
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn slip_limit(&self, values: &[f64], last: &Situation, _memory: &[f64]) -> SlipLimit {
        let limit = 1.0 - values[0] * (1.0 - remaining(last.dissipation / values[1], values[2]));
        SlipLimit {
            positive: limit,
            negative: limit,
        }
    }
}

impl Cause for PreloadLoss {
    fn page(&self) -> Page {
        Page {
            happens: "The clamped parts embed, wear or the bolt turns loose: normal load falls as the interface works, and all break-free forces with it.",
            sign: "Loops of the same load grow wider and softer from cycle to cycle and do not come back.",
            mistaken_for: &[
                "running_in",
                "displacement_drift",
                "offset_step",
                "slack_growth",
            ],
            separated_by: "Repeated equal blocks: drift moves the loop without widening it, running-in settles within the first cycles, slack growth follows new peaks.",
            formula: "phi = phi_0 [1 - l (1 - (1 + q E/E_0)^(-1/q))], exp(-E/E_0) for q = 0",
            source: "Archard wear with the dissipated energy as the measure of work; Fouvry's energy-based wear.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &PreloadLoss
    }
    fn refined(&self, values: &[f64], _scale: &Scale) -> Vec<f64> {
        vec![values[0], values[1], 0.3]
    }
    fn plausible(&self, values: &[f64], scale: &Scale) -> bool {
        values[1] > LATE * scale.dissipation
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        [0.1, 0.2, 0.4, 0.8, 2.0]
            .iter()
            .map(|share| vec![0.02, share * scale.dissipation, 0.0])
            .collect()
    }
}
