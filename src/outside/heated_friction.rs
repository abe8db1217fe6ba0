//! Friction that its own heat weakens, and that comes back as the contact cools.

use super::Outsider;
use crate::causes::Scale;
use crate::joint::effect::{Effect, Place, Situation, SlipLimit};
use crate::joint::elementary::exp;
use crate::joint::parameters::Parameter;

/// Break-free forces fall with the heat that is in the contact, `n = exp(−h q)` with `q̇ = Ė − q/t_c`.
pub struct HeatedFriction;

static PARAMETERS: [Parameter; 2] = [
    Parameter {
        name: "softening",
        symbol: "h",
        unit: "1/J",
        lower: 0.0,
        upper: 1e60,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "relative fall of the break-free forces per energy that has become heat and is still there",
    },
    Parameter {
        name: "cooling_time",
        symbol: "t_c",
        unit: "s",
        lower: 1e-12,
        upper: 1e12,
        vanishes_at: None,
        neutral: None,
        meaning: "time over which the contact cools",
    },
];

/// Share of the longest record from which heat that stays cannot be told from wear.
const STAYS: f64 = 0.3;

/// Share of the longest period below which what warms the contact cannot be told from its rate.
const LEAVES: f64 = 0.1;

/// Shares of the longest record from which a cooling time is looked for.
const STARTS: [f64; 4] = [0.01, 0.03, 0.08, 0.2];

/// Part of the break-free forces that the heat of the whole record takes at the start.
const FIRST: f64 = 0.02;

impl Effect for HeatedFriction {
    fn name(&self) -> &'static str {
        "heated_friction"
    }
    fn place(&self) -> Place {
        Place::SlipLimit
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    /// Heat in the contact, and the energy dissipated so far.
    fn memory(&self) -> usize {
        2
    }
    fn remember(&self, values: &[f64], now: &Situation, memory: &mut [f64]) {
        // A record begins cold, whatever was dissipated before it.
        let heat = match memory[1] > 0.0 {
            true => now.dissipation - memory[1],
            false => 0.0,
        };
        memory[0] = memory[0] * exp(-now.step / values[1]) + heat;
        memory[1] = now.dissipation;
    }
    fn slip_limit(&self, values: &[f64], _last: &Situation, memory: &[f64]) -> SlipLimit {
        let limit = exp(-values[0] * memory[0]);
        SlipLimit::either_way(limit)
    }
}

impl Outsider for HeatedFriction {
    fn passes_for(&self, cause: &str) -> bool {
        [
            "preload_loss",
            "velocity_weakening",
            "static_friction_drop",
            "running_in",
        ]
        .contains(&cause)
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let start = |share: &f64| {
            let softening = FIRST / (share * scale.dissipation);
            vec![softening, share * scale.duration()]
        };
        STARTS.iter().map(start).collect()
    }
    fn plausible(&self, values: &[f64], scale: &Scale) -> bool {
        values[1] < STAYS * scale.duration() && values[1] > LEAVES * scale.slowest
    }
    fn words(&self) -> &'static str {
        "friction that its own heat weakens and that comes back as the contact cools explains the records better"
    }
    fn effect(&self) -> &'static dyn Effect {
        &HeatedFriction
    }
    fn needs_time(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heat_weakens_and_is_gone_when_it_has_cooled() {
        let values = [0.5, 2.0];
        let mut memory = [0.0; 2];
        for (dissipation, step) in [(1.0, 0.1), (1.4, 0.1), (1.4, 2.0)] {
            let now = Situation {
                dissipation,
                step,
                ..Situation::default()
            };
            HeatedFriction.remember(&values, &now, &mut memory);
        }
        // What was lost before the record is cold; 0.4 J have cooled for one cooling time.
        let left = 0.4 * (-1.0_f64).exp();
        assert!((memory[0] - left).abs() < 1e-15);
        let limit = HeatedFriction.slip_limit(&values, &Situation::default(), &memory);
        assert!((limit.positive - (-0.5 * left).exp()).abs() < 1e-15);
        assert_eq!(limit.positive, limit.negative);
    }
}
