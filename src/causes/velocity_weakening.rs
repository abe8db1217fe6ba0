//! `velocity_weakening`: friction falls with the slip rate (Stribeck).

use super::rate_dependent_friction::{LONGEST, RATE_MEMORY, follow_rate, memories};
use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Situation, SlipLimit};
use crate::joint::elementary::{expm1, power};
use crate::joint::parameters::Parameter;

/// Break-free forces fall with the slip rate, `n = 1 − a [1 − exp(−(v/v_s)^δ)]`, where v follows |u̇|
/// over a memory.
pub struct VelocityWeakening;

static PARAMETERS: [Parameter; 4] = [
    Parameter {
        name: "drop",
        symbol: "a",
        unit: "1",
        lower: 0.0,
        upper: 0.95,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "share of the break-free forces that is lost at high slip rate",
    },
    Parameter {
        name: "stribeck_rate",
        symbol: "v_s",
        unit: "m/s",
        lower: 1e-36,
        upper: 1e12,
        vanishes_at: None,
        neutral: None,
        meaning: "slip rate over which friction falls",
    },
    RATE_MEMORY,
    Parameter {
        name: "exponent",
        symbol: "delta",
        unit: "1",
        lower: 0.2,
        upper: 3.0,
        vanishes_at: None,
        neutral: Some(1.0),
        meaning: "how sharply friction falls about the Stribeck rate; below 1 over decades of the rate",
    },
];

/// Exponent from which a fall over decades of the rate is refined.
const GRADUAL: f64 = 0.8;

/// Exponent, share of the drop and of the Stribeck rate from which one is looked for that is far from a sharp one.
const OVER_DECADES: f64 = 0.65;
const DEEPER: f64 = 1.5;
const SLOWER: f64 = 0.5;

impl VelocityWeakening {
    /// Break-free factor at a slip rate.
    fn factor(values: &[f64], rate: f64) -> f64 {
        let relative = rate / values[1];
        let reached = match values[3] == 1.0 {
            true => relative,
            false => power(relative, values[3]),
        };
        1.0 + values[0] * expm1(-reached)
    }
}

impl Effect for VelocityWeakening {
    fn name(&self) -> &'static str {
        "velocity_weakening"
    }
    fn place(&self) -> Place {
        Place::SlipLimit
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn memory(&self) -> usize {
        1
    }
    fn remember(&self, values: &[f64], now: &Situation, memory: &mut [f64]) {
        follow_rate(now, values[2], memory);
    }
    fn sees_energy(&self) -> bool {
        false
    }
    fn slip_limit(&self, values: &[f64], _last: &Situation, memory: &[f64]) -> SlipLimit {
        let limit = VelocityWeakening::factor(values, memory[0]);
        SlipLimit::either_way(limit)
    }
}

impl Cause for VelocityWeakening {
    fn page(&self) -> Page {
        Page {
            happens: "Sliding surfaces lose contact time or float on a film: the faster they slide, the less they hold.",
            sign: "Loops of the same force widen with frequency; friction is low at mid-stroke and comes back at the tips, which stay sharp; at slow rates the baseline is exact.",
            mistaken_for: &[
                "static_friction_drop",
                "rate_dependent_friction",
                "viscous_damping",
                "creep",
            ],
            separated_by: "The same stroke at several frequencies: a drop after breakaway follows slid distance and stays the same, weakening follows the rate; growth with rate has the other sign.",
            formula: "phi = phi_0 [1 - a (1 - exp(-(v/v_s)^delta))], dv/dt = (|du/dt| - v)/t_m",
            source: "Stribeck curve as in Bo and Pavelescu 1982; Armstrong-Helouvry, Dupont and Canudas de Wit 1994.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &VelocityWeakening
    }
    fn needs_time(&self) -> bool {
        true
    }
    fn plausible(&self, values: &[f64], scale: &Scale) -> bool {
        values[2] < LONGEST * scale.slowest
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let shares = [0.03, 0.15, 0.6].into_iter();
        let with = |share| memories(scale).map(move |m| vec![0.02, share * scale.velocity, m, 1.0]);
        shares.flat_map(with).collect()
    }
    fn refined(&self, values: &[f64], _scale: &Scale) -> Vec<f64> {
        let mut gradual = values.to_vec();
        if gradual[3] == 1.0 {
            gradual[3] = GRADUAL;
        }
        gradual
    }
    /// A fall over decades of the rate is deeper than what was seen of it, and begins at slower rates: from a sharp
    /// one its fit does not find there.
    fn begun_anew(&self, values: &[f64], _scale: &Scale) -> Option<Vec<f64>> {
        let [drop, rate, memory, _] = *values else {
            return None;
        };
        let most = PARAMETERS[0].upper;
        Some(vec![
            (DEEPER * drop).min(most),
            SLOWER * rate,
            memory,
            OVER_DECADES,
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn friction_falls_with_the_rate_to_what_is_left() {
        let at = |rate| {
            VelocityWeakening.slip_limit(&[0.4, 2.0, 0.01, 1.0], &Situation::default(), &[rate])
        };
        assert_eq!(at(0.0), SlipLimit::UNCHANGED);
        let expected = 1.0 - 0.4 * (1.0 - (-0.5_f64).exp());
        assert!((at(1.0).positive - expected).abs() < 1e-15);
        assert_eq!(at(1.0).positive, at(1.0).negative);
        assert!((at(1e9).negative - 0.6).abs() < 1e-15);
    }

    #[test]
    fn an_exponent_spreads_the_fall_about_the_stribeck_rate() {
        let factor =
            |exponent: f64, rate| VelocityWeakening::factor(&[0.4, 2.0, 0.01, exponent], rate);
        let expected = |exponent: f64, rate: f64| 0.6 + 0.4 * (-(rate / 2.0).powf(exponent)).exp();
        for (exponent, rate) in [
            (0.5, 0.02),
            (0.5, 200.0),
            (2.0, 0.02),
            (2.0, 3.0),
            (1.0, 0.7),
        ] {
            assert!((factor(exponent, rate) - expected(exponent, rate)).abs() < 1e-14);
        }
        assert_eq!(factor(0.5, 0.0), 1.0);
    }
}
