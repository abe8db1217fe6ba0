//! `running_in`: friction settles to its lasting value within the first cycles.

use super::wear::{ENERGY, PATH_MEMORY, PER_PATH, TAIL, follow_path, remaining, shapes, worn};
use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Situation, SlipLimit};
use crate::joint::parameters::Parameter;

/// Break-free forces settle with the energy dissipated, `n = 1 − a exp(−E/E_0)`, or with the path of the
/// slip, see [`worn`].
pub struct RunningIn;

static PARAMETERS: [Parameter; 4] = [
    Parameter {
        name: "deficit",
        symbol: "a",
        unit: "1",
        lower: -0.98,
        upper: 0.98,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "share of the lasting break-free forces that the fresh surfaces lack; negative where they have more",
    },
    ENERGY,
    TAIL,
    PER_PATH,
];

/// Share of a record's dissipated energy or path over which friction that falls has to settle: what takes
/// longer is lost preload. The span of lost preload begins below it: between the two either word
/// fits.
const SOON: f64 = 0.2;

impl Effect for RunningIn {
    fn name(&self) -> &'static str {
        "running_in"
    }
    fn place(&self) -> Place {
        Place::SlipLimit
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn memory(&self) -> usize {
        PATH_MEMORY
    }
    /// The path.
    fn lasting(&self) -> usize {
        1
    }
    fn remember(&self, _values: &[f64], now: &Situation, memory: &mut [f64]) {
        follow_path(now, memory);
    }
    fn slip_limit(&self, values: &[f64], last: &Situation, memory: &[f64]) -> SlipLimit {
        let left = remaining(worn(last.dissipation, memory[0], values), values[2]);
        let limit = 1.0 - values[0] * left;
        SlipLimit {
            positive: limit,
            negative: limit,
        }
    }
}

impl Cause for RunningIn {
    fn page(&self) -> Page {
        Page {
            happens: "Films and peaks of fresh surfaces wear off in the first cycles; contact spreads, friction grows and then stays.",
            sign: "The first loops are wider and softer than the later ones of the same load; the change dies out and does not come back after a pause.",
            mistaken_for: &["preload_loss", "creep", "displacement_drift", "offset_step"],
            separated_by: "Repeated equal blocks: loops grow narrower and stiffer here and wider and softer with lost preload; creep and drift move a loop and leave its area. Friction that falls within the first part of the work and then stays counts as running in, one that goes on falling as lost preload.",
            formula: "phi = phi_0 [1 - a (1 + q w)^(-1/q)], exp(-w) for q = 0, w = E/E_0 or s/L",
            source: "Growth of fretting friction to its steady value over the first cycles, with the dissipated energy (Fouvry; Schwingshackl et al. 2012) or the path of the slip as the measure of work.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &RunningIn
    }
    fn refined(&self, values: &[f64], _scale: &Scale) -> Vec<f64> {
        vec![values[0], values[1], 0.3, values[3]]
    }
    fn plausible(&self, values: &[f64], scale: &Scale) -> bool {
        values[0] > 0.0 || worn(SOON * scale.dissipation, SOON * scale.path, values) > 1.0
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        shapes(0.05, &[0.01, 0.05, 0.2, 0.8], scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn friction_grows_from_its_deficit_to_one() {
        let at = |dissipation| {
            let last = Situation {
                dissipation,
                ..Situation::default()
            };
            RunningIn
                .slip_limit(&[0.4, 2.0, 0.0, 0.0], &last, &[0.0; 2])
                .positive
        };
        assert_eq!(at(0.0), 0.6);
        assert!((at(2.0) - (1.0 - 0.4 / std::f64::consts::E)).abs() < 1e-15);
        assert_eq!(at(2000.0), 1.0);
    }
}
