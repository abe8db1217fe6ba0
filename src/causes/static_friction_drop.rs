//! `static_friction_drop`: breakaway above kinetic friction.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Situation, SlipLimit};
use crate::joint::elementary::{exp, power};
use crate::joint::parameters::Parameter;

/// Break-free forces that are higher until the surfaces have slid: of each contact by itself, until its
/// own breakaway (d = 0, see [`sticking`](crate::joint::sticking)), or of all of them together,
/// `n = 1 + a exp(−(s/d)^p)` with s the slip since the last reversal.
pub struct StaticFrictionDrop;

static PARAMETERS: [Parameter; 3] = [
    Parameter {
        name: "excess",
        symbol: "a",
        unit: "1",
        lower: 0.0,
        upper: 3.0,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "share by which static friction exceeds kinetic friction",
    },
    Parameter {
        name: "breakaway_distance",
        symbol: "d",
        unit: "m",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "slip after a reversal over which all contacts lose the excess together; 0: each at its own breakaway",
    },
    Parameter {
        name: "sharpness",
        symbol: "p",
        unit: "1",
        lower: 0.5,
        upper: 4.0,
        vanishes_at: None,
        neutral: Some(BELL),
        meaning: "how suddenly all contacts lose the excess at that distance: 2 as a bell, 1 from the first slip on",
    },
];

/// Sharpness of a bell, and of an excess that goes with the first slip.
const BELL: f64 = 2.0;
const GRADUAL: f64 = 1.0;

/// Excess of the contacts' own that a search starts from: what it does is far from proportional.
const OWN_EXCESS: f64 = 0.15;

/// Distances over which contacts are tried as letting go together, as shares of the largest displacement: a search
/// finds one from within a factor of three.
const DISTANCES: [f64; 4] = [0.02, 0.08, 0.3, LONG];
const LONG: f64 = 1.2;

/// Way back that counts as a reversal, as a share of the widest slip so far: noise turns back all
/// the time.
const REVERSAL: f64 = 0.02;

impl Effect for StaticFrictionDrop {
    fn name(&self) -> &'static str {
        "static_friction_drop"
    }
    fn place(&self) -> Place {
        Place::SlipLimit
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    /// Together or each by itself: no small step leads from one to the other.
    fn keeps_side(&self, parameter: usize) -> bool {
        parameter == 1
    }
    fn jumps_with(&self, parameter: usize) -> bool {
        parameter == 0
    }
    /// Slip at the last reversal, direction since, farthest slip since, lowest and highest slip.
    fn memory(&self) -> usize {
        5
    }
    fn remember(&self, _values: &[f64], now: &Situation, memory: &mut [f64]) {
        if let [reversal, direction, farthest, low, high] = memory {
            *low = low.min(now.slip);
            *high = high.max(now.slip);
            let onwards = (now.slip - *farthest) * *direction;
            if *direction == 0.0 {
                *direction = if now.slip == 0.0 {
                    0.0
                } else {
                    now.slip.signum()
                };
                *farthest = now.slip;
            } else if onwards >= 0.0 {
                *farthest = now.slip;
            } else if -onwards > REVERSAL * (*high - *low) {
                *reversal = *farthest;
                *direction = -*direction;
                *farthest = now.slip;
            }
        }
    }
    fn sticking(&self, values: &[f64]) -> f64 {
        if values[1] > 0.0 { 0.0 } else { values[0] }
    }
    fn sees_energy(&self) -> bool {
        false
    }
    fn slip_limit(&self, values: &[f64], last: &Situation, memory: &[f64]) -> SlipLimit {
        if values[1] <= 0.0 {
            return SlipLimit::UNCHANGED;
        }
        let slid = ((last.slip - memory[0]) / values[1]).abs();
        let fallen = match values[2] == BELL {
            true => slid * slid,
            false => power(slid, values[2]),
        };
        let limit = 1.0 + values[0] * exp(-fallen);
        SlipLimit::either_way(limit)
    }
}

impl Cause for StaticFrictionDrop {
    fn page(&self) -> Page {
        Page {
            happens: "Contacts that rest hold more than contacts that slide: after each reversal the joint holds up to a breakaway force and lets go once it has slid a little way.",
            sign: "A hump after each reversal and a lower plateau behind it, the same at every frequency; large loops fall below what small loops predict.",
            mistaken_for: &[
                "velocity_weakening",
                "clearance",
                "slack_growth",
                "preload_loss",
            ],
            separated_by: "Several frequencies: weakening follows the rate, this the slid distance; minor loops inside a major one are not congruent; a macroslip test in displacement shows the peak above the plateau.",
            formula: "each contact holds (1 + a) phi_0 at rest and phi_0 once it slides (d = 0), or phi = phi_0 [1 + a exp(-(s/d)^p)], s the slip since the last reversal",
            source: "Static against kinetic friction with a breakaway distance; Rabinowicz 1951; slip-weakening law.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &StaticFrictionDrop
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let together = DISTANCES.map(|share| vec![0.02, share * scale.displacement, BELL]);
        let own = std::iter::once(vec![OWN_EXCESS, 0.0, BELL]);
        own.chain(together).collect()
    }
    fn refined(&self, values: &[f64], scale: &Scale) -> Vec<f64> {
        match *values {
            [excess, distance, BELL] if distance > 0.0 => vec![excess, distance, GRADUAL],
            [excess, 0.0, _] => vec![excess, LONG * scale.displacement, GRADUAL],
            _ => values.to_vec(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_excess_is_lost_with_slip_and_back_after_a_reversal() {
        let (values, mut memory) = ([0.5, 0.1, BELL], [0.0; 5]);
        let mut go = |slip: f64| {
            let now = Situation {
                slip,
                ..Situation::default()
            };
            StaticFrictionDrop.remember(&values, &now, &mut memory);
            StaticFrictionDrop
                .slip_limit(&values, &now, &memory)
                .positive
        };
        assert_eq!(go(0.0), 1.5);
        assert!((go(0.1) - (1.0 + 0.5 / std::f64::consts::E)).abs() < 1e-15);
        assert!(go(1.0) < 1.0 + 1e-15);
        assert!(go(0.99) < 1.0 + 1e-15, "a wiggle is no reversal");
        assert!(go(1.2) < 1.0 + 1e-15);
        let turned = 1.0 + 0.5 * (-0.25_f64).exp();
        assert!((go(1.15) - turned).abs() < 1e-15);
        assert!(go(0.2) < 1.0 + 1e-15);
    }

    #[test]
    fn a_gradual_excess_goes_with_the_first_slip() {
        let limit = |slip: f64, sharpness: f64| {
            let now = Situation {
                slip,
                ..Situation::default()
            };
            let values = [0.5, 0.1, sharpness];
            StaticFrictionDrop
                .slip_limit(&values, &now, &[0.0; 5])
                .negative
        };
        for slip in [-0.02, 0.02] {
            assert!((limit(slip, GRADUAL) - 1.0 - 0.5 * (-0.2_f64).exp()).abs() < 1e-12);
            assert!((limit(slip, BELL) - 1.0 - 0.5 * (-0.04_f64).exp()).abs() < 1e-12);
        }
        assert_eq!(limit(0.0, GRADUAL), 1.5);
    }
}
