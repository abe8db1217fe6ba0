//! `preload_loss`: friction decays as the interface works.

use super::wear::{
    ENERGY, PATH_MEMORY, PER_PATH, TAIL, follow_path, late, remaining, shapes, soon, worn,
};
use super::{Cause, Page, Scale};
use crate::joint::effect::{Acting, Effect, Place, Situation, SlipLimit};
use crate::joint::parameters::Parameter;

/// Break-free forces fall with the energy dissipated, `n = 1 − l (1 − exp(−E/E_0))`, or with the path of
/// the slip, see [`worn`].
pub struct PreloadLoss;

const LOSS: Parameter = Parameter {
    name: "loss",
    symbol: "l",
    unit: "1",
    lower: 0.0,
    upper: 0.98,
    vanishes_at: Some(0.0),
    neutral: None,
    meaning: "share of the break-free forces that is lost in the end",
};

static PARAMETERS: [Parameter; 4] = [LOSS, ENERGY, TAIL, PER_PATH];

/// The same law with a tail that stays as it is.
///
/// A record that ends while friction still falls tells how fast it falls and by how much it has fallen, and of what it
/// will have lost in the end only what a tail lets it.
struct Tailed {
    parameters: &'static [Parameter; 4],
}

const fn held(tail: f64) -> [Parameter; 4] {
    let held = Parameter {
        neutral: Some(tail),
        ..TAIL
    };
    [LOSS, ENERGY, held, PER_PATH]
}

static TAILED: [Tailed; 3] = [
    Tailed {
        parameters: &held(0.5),
    },
    Tailed {
        parameters: &held(1.0),
    },
    Tailed {
        parameters: &held(2.0),
    },
];

impl Effect for Tailed {
    fn name(&self) -> &'static str {
        PreloadLoss.name()
    }
    fn place(&self) -> Place {
        PreloadLoss.place()
    }
    fn parameters(&self) -> &'static [Parameter] {
        self.parameters
    }
    fn memory(&self) -> usize {
        PreloadLoss.memory()
    }
    fn lasting(&self) -> usize {
        PreloadLoss.lasting()
    }
    fn remember(&self, values: &[f64], now: &Situation, memory: &mut [f64]) {
        PreloadLoss.remember(values, now, memory);
    }
    fn slip_limit(&self, values: &[f64], last: &Situation, memory: &[f64]) -> SlipLimit {
        PreloadLoss.slip_limit(values, last, memory)
    }
}

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
        let limit = 1.0 - values[0] * (1.0 - left);
        SlipLimit::either_way(limit)
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
            formula: "phi = phi_0 [1 - l (1 - (1 + q w)^(-1/q))], exp(-w) for q = 0, w = E/E_0 or s/L",
            source: "Archard wear over the path of the slip; Fouvry's wear over the dissipated energy.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &PreloadLoss
    }
    fn refined(&self, values: &[f64], _scale: &Scale) -> Vec<f64> {
        vec![values[0], values[1], 0.3, values[3]]
    }
    fn beside(&self, values: &[f64]) -> Vec<Acting> {
        if TAIL.neutral != Some(values[2]) {
            return Vec::new();
        }
        let held = |tailed: &'static Tailed| {
            let tail = tailed.parameters[2].neutral.unwrap_or_default();
            let larger = 1.0 + tail;
            let energy = match ENERGY.neutral == Some(values[1]) {
                true => values[1],
                false => larger * values[1],
            };
            // As fast a fall at first.
            let loss = (larger * values[0]).min(LOSS.upper);
            Acting {
                effect: tailed,
                values: vec![loss, energy, tail, values[3] / larger],
            }
        };
        TAILED.iter().map(held).collect()
    }
    fn plausible(&self, values: &[f64], scale: &Scale) -> bool {
        late(values, scale)
    }
    fn also_called(&self, values: &[f64], scale: &Scale) -> Option<&'static str> {
        soon(values, scale).then_some("running_in")
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        shapes(0.02, &[0.1, 0.2, 0.4, 0.8, 2.0], scale)
    }
}

#[cfg(test)]
mod tests {
    use super::super::wear::ENDLESS;
    use super::*;

    #[test]
    fn wear_goes_with_the_energy_or_with_the_path() {
        let mut memory = [0.0; PATH_MEMORY];
        for slip in [1.0, 3.0, 2.0, -1.0] {
            let now = Situation {
                slip,
                ..Situation::default()
            };
            PreloadLoss.remember(&[], &now, &mut memory);
        }
        assert_eq!(memory, [7.0, -1.0]);
        let last = Situation {
            dissipation: 4.0,
            ..Situation::default()
        };
        let at = |values: [f64; 4]| PreloadLoss.slip_limit(&values, &last, &memory).positive;
        let after = |work: f64| 1.0 - 0.3 * (1.0 - (-work).exp());
        assert!((at([0.3, 8.0, 0.0, 0.0]) - after(0.5)).abs() < 1e-15);
        assert!((at([0.3, ENDLESS, 0.0, 0.1]) - after(0.7)).abs() < 1e-11);
        assert!((at([0.3, ENDLESS, 1.0, 0.1]) - (1.0 - 0.3 * (1.0 - 1.0 / 1.7))).abs() < 1e-11);
    }

    #[test]
    fn tails_that_stay_begin_with_as_fast_a_fall() {
        for (values, by_path) in [
            ([0.2, 8.0, 0.0, 0.0], false),
            ([0.2, ENDLESS, 0.0, 0.1], true),
        ] {
            let beside = PreloadLoss.beside(&values);
            assert_eq!(beside.len(), 3);
            for law in beside {
                let (effect, tailed) = (law.effect, &law.values);
                assert_eq!(effect.name(), "preload_loss");
                assert_eq!(effect.parameters()[2].neutral, Some(tailed[2]));
                let last = Situation {
                    dissipation: if by_path { 0.0 } else { 1e-3 },
                    ..Situation::default()
                };
                let memory = [if by_path { 1e-3 } else { 0.0 }, 0.0];
                let fallen = |effect: &dyn Effect, values: &[f64]| {
                    1.0 - effect.slip_limit(values, &last, &memory).positive
                };
                let (with, without) = (fallen(effect, tailed), fallen(&PreloadLoss, &values));
                assert!(without > 0.0 && (with / without - 1.0).abs() < 1e-3);
            }
        }
        // A tail that the data asked for is fitted, and has its own interval.
        assert_eq!(PreloadLoss.beside(&[0.2, 8.0, 0.7, 0.0]).len(), 0);
    }
}
