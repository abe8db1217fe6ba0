//! `slack_growth`: free play that grows with the largest force so far.

use super::free_play::{DRAG, crossed, drag, on_seat, stored};
use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Response, Situation};
use crate::joint::parameters::Parameter;

/// Free play in the load path that past peaks have opened,
/// `s = (g/2) tanh(y/F_s)` with `g = γ max(F_peak − F_0, 0)`, `F_peak` the largest |F| so far, the
/// present one included; y is the force, or what is left of it when parts that cross the play drag, see [`on_seat`].
pub struct SlackGrowth;

static PARAMETERS: [Parameter; 4] = [
    Parameter {
        name: "growth",
        symbol: "gamma",
        unit: "m/N",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "free play opened per newton of peak force beyond the threshold",
    },
    Parameter {
        name: "threshold",
        symbol: "F_0",
        unit: "N",
        lower: 0.0,
        upper: 1e9,
        vanishes_at: None,
        neutral: None,
        meaning: "peak force up to which the bearing surfaces take no damage",
    },
    Parameter {
        name: "seating_force",
        symbol: "F_s",
        unit: "N",
        lower: 1e-36,
        upper: 1e9,
        vanishes_at: None,
        neutral: None,
        meaning: "force over which the surfaces come to full contact",
    },
    DRAG,
];

/// Free play \[m\] after a peak \[N\], and its growth with a further peak \[m/N\].
fn gap(values: &[f64], peak: f64) -> (f64, f64) {
    if peak > values[1] {
        (values[0] * (peak - values[1]), values[0])
    } else {
        (0.0, 0.0)
    }
}

impl Effect for SlackGrowth {
    fn name(&self) -> &'static str {
        "slack_growth"
    }
    fn place(&self) -> Place {
        Place::InSeries
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    /// The largest |F| so far, the force on the seat.
    fn memory(&self) -> usize {
        2
    }
    /// The peaks.
    fn lasting(&self) -> usize {
        1
    }
    fn remember(&self, values: &[f64], now: &Situation, memory: &mut [f64]) {
        memory[0] = now.force.abs().max(memory[0]);
        memory[1] = on_seat(now.force, memory[1], values[3]);
    }
    fn in_series(&self, values: &[f64], force: f64, _step: f64, memory: &[f64]) -> Response {
        let (gap, growth) = gap(values, force.abs().max(memory[0]));
        let way = |gap: f64| crossed(gap, values[2], force, (memory[1], values[3]));
        let response = way(gap);
        let opening = if force.abs() > memory[0] {
            way(growth).value.abs()
        } else {
            0.0
        };
        Response {
            slope: response.slope + opening,
            ..response
        }
    }
    /// The seating springs back, `∫ y ds` at the present gap; opening the gap is lost, and drag.
    fn stored_energy(&self, values: &[f64], _now: &Situation, memory: &[f64]) -> Option<f64> {
        Some(stored(gap(values, memory[0]).0, values[2], memory[1]))
    }
}

impl Cause for SlackGrowth {
    fn page(&self) -> Page {
        Page {
            happens: "Holes, pins or threads are crushed or worn by every new peak of force and leave free play that the load path must cross from then on.",
            sign: "Pinched loops: a flat stretch around zero force that is wider after each higher peak and never narrows; loops of the same amplitude differ before and after the peak, and agree otherwise.",
            mistaken_for: &["clearance", "preload_loss", "static_friction_drop"],
            separated_by: "The same small loop before and after a large one: play of fixed size and friction show no difference; repeated equal cycles: lost preload goes on, this stays.",
            formula: "U = u + F/K_1 + (g/2) tanh(y/F_s), y = F or within F_d of it, g = gamma max(F_peak - F_0, 0)",
            source: "Pinching with damage by peak load, as in the slip and degradation parts of hysteresis models for nailed and bolted joints (Baber and Noori 1985; Foliente 1995).",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &SlackGrowth
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let growth = 0.005 * scale.displacement / scale.force;
        let mut starts = Vec::new();
        for threshold in [0.0, 0.4] {
            for seating in [0.005, 0.02, 0.08, 0.3] {
                starts.push(vec![
                    growth,
                    threshold * scale.force,
                    seating * scale.force,
                    0.0,
                ]);
            }
        }
        starts
    }
    fn refined(&self, values: &[f64], _scale: &Scale) -> Vec<f64> {
        vec![values[0], values[1], values[2], drag(values[2])]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn play_opens_with_a_new_peak_and_stays() {
        let values = [2e-3, 10.0, 1e-3, 0.0];
        let mut memory = [0.0; 2];
        let at = |force, memory: &[f64]| SlackGrowth.in_series(&values, force, 0.1, memory).value;
        assert_eq!(at(9.0, &memory), 0.0);
        assert!((at(30.0, &memory) - 0.02).abs() < 1e-15);
        let peak = Situation {
            force: -30.0,
            ..Situation::default()
        };
        SlackGrowth.remember(&values, &peak, &mut memory);
        assert!((at(5.0, &memory) - 0.02).abs() < 1e-15);
        assert!((at(-5.0, &memory) + 0.02).abs() < 1e-15);
        assert!((at(60.0, &memory) - 0.05).abs() < 1e-15);
    }

    #[test]
    fn stored_energy_is_the_area_beside_the_law() {
        let (values, memory) = ([1e-3, 0.0, 4.0, 0.0], [20.0, 12.0]);
        let at = |force| SlackGrowth.in_series(&values, force, 0.1, &memory).value;
        let steps = 2000;
        let area: f64 = (0..steps)
            .map(|i| 12.0 * (f64::from(i) + 0.5) / f64::from(steps))
            .map(|force| force * (at(force + 0.003) - at(force - 0.003)))
            .sum();
        let now = Situation {
            force: 12.0,
            ..Situation::default()
        };
        let told = SlackGrowth.stored_energy(&values, &now, &memory);
        assert!(told.is_some_and(|told| (told - area).abs() < 1e-6 * area));
    }
}
