//! `rate_dependent_friction`: friction grows with the logarithm of the slip rate.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Situation, SlipLimit};
use crate::joint::elementary::{expm1, log1p};
use crate::joint::parameters::Parameter;

/// Break-free forces grow with the slip rate, `n = 1 + a ln(1 + v/v_0)`, where v follows |u̇| over
/// a memory, see [`follow_rate`].
pub struct RateDependentFriction;

static PARAMETERS: [Parameter; 3] = [
    Parameter {
        name: "gain",
        symbol: "a",
        unit: "1",
        lower: 0.0,
        upper: 10.0,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "relative growth of the break-free forces per e-fold of the slip rate",
    },
    Parameter {
        name: "reference_rate",
        symbol: "v_0",
        unit: "m/s",
        lower: 1e-36,
        upper: 1e12,
        vanishes_at: None,
        neutral: None,
        meaning: "slip rate below which friction no longer falls",
    },
    RATE_MEMORY,
];

/// t_m; third of the values of a cause that follows the rate.
pub(super) const RATE_MEMORY: Parameter = Parameter {
    name: "memory",
    symbol: "t_m",
    unit: "s",
    lower: 1e-9,
    upper: 1e9,
    vanishes_at: None,
    neutral: None,
    meaning: "time in which contacts take on a new slip rate",
};

/// Takes a sample into the history, the rate v: it approaches the slip rate's magnitude within the time
/// `t` that contacts take for it, `v += (|u̇| − v)(1 − exp(−Δt/t))`.
///
/// Contacts renew themselves while they slide and forget while they rest; the limit that a sample
/// answers with is known only in the next one, and without a memory it would swing from step to step.
/// A contact that turns has been sliding a moment ago: a memory of the rate with its sign would pass
/// through rest behind every turn. How low friction falls there, where most of a joint slips, is
/// for the memory to say: it is one of the values to be found.
pub(super) fn follow_rate(now: &Situation, memory_time: f64, memory: &mut [f64]) {
    if let [rate] = memory {
        *rate -= expm1(-now.step / memory_time) * (now.slip_rate.abs() - *rate);
    }
}

/// Memory to start from, in periods: a tenth of a radian.
const MEMORY: f64 = 0.016;

/// Times the fastest motion's period from which the slowest one's tells another memory.
const SLOWER: f64 = 3.0;

/// Memories to start from \[s\], of the fastest motion and of the slowest: one that is shorter than a slow record's
/// samples are apart swings with them, and no slope of the misfit leads from there to a longer one.
pub(super) fn memories(scale: &Scale) -> impl Iterator<Item = f64> + Clone + use<> {
    let slow = (scale.slowest > SLOWER * scale.period).then_some(scale.slowest);
    let periods = std::iter::once(scale.period).chain(slow);
    periods.map(|period| MEMORY * period)
}

/// Periods of the slowest record from which a memory follows what has been slid, and no rate: from a turn to the
/// highest rate it is a quarter. In records of faster motions it may follow as slowly as it will.
pub(super) const LONGEST: f64 = 0.25;

impl Effect for RateDependentFriction {
    fn name(&self) -> &'static str {
        "rate_dependent_friction"
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
        let limit = 1.0 + values[0] * log1p(memory[0] / values[1]);
        SlipLimit::either_way(limit)
    }
}

impl Cause for RateDependentFriction {
    fn page(&self) -> Page {
        Page {
            happens: "Contacts strengthen with the rate at which they are sheared, as polymers, coatings and thin films do: a little for every e-fold of slip rate.",
            sign: "Loops of the same force narrow with frequency by the same step per decade; tips are rounded because slip goes on while the rate falls.",
            mistaken_for: &[
                "viscous_damping",
                "velocity_weakening",
                "creep",
                "sensor_delay",
            ],
            separated_by: "Two decades of frequency: steps are equal per decade here and proportional to frequency with a dashpot, and the effect is absent below slip; weakening has the other sign.",
            formula: "phi = phi_0 [1 + a ln(1 + v/v_0)], dv/dt = (|du/dt| - v)/t_m",
            source: "Direct effect of rate-and-state friction, Dieterich 1979 and Ruina 1983, regularised at rest.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &RateDependentFriction
    }
    fn needs_time(&self) -> bool {
        true
    }
    fn plausible(&self, values: &[f64], scale: &Scale) -> bool {
        values[2] < LONGEST * scale.slowest
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let shares = [1e-3, 0.03, 0.5].into_iter();
        let with = |share| memories(scale).map(move |m| vec![0.005, share * scale.velocity, m]);
        shares.flat_map(with).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slowest_record_tells_whether_a_memory_follows_a_rate() {
        let fastest = 0.05;
        let scale = |slowest| Scale {
            period: fastest,
            slowest,
            ..Scale::default()
        };
        let values = [0.01, 1e-3, 0.5 * fastest];
        assert!(!RateDependentFriction.plausible(&values, &scale(fastest)));
        assert!(RateDependentFriction.plausible(&values, &scale(10.0 * fastest)));
    }

    /// Records of one rate tell one memory, those of several the slowest one's as well.
    #[test]
    fn a_slow_record_has_a_memory_of_its_own() {
        let scale = |slowest| Scale {
            period: 0.05,
            slowest,
            ..Scale::default()
        };
        let one: Vec<f64> = memories(&scale(0.06)).collect();
        let two: Vec<f64> = memories(&scale(5.0)).collect();
        assert_eq!(one, [MEMORY * 0.05]);
        assert_eq!(two, [MEMORY * 0.05, MEMORY * 5.0]);
        assert_eq!(RateDependentFriction.starts(&scale(0.06)).len(), 3);
        assert_eq!(RateDependentFriction.starts(&scale(5.0)).len(), 6);
    }

    #[test]
    fn friction_grows_with_the_logarithm_of_a_rate_held() {
        let (values, mut memory) = ([0.1, 1e-3, 0.05], [0.0]);
        assert_eq!(
            RateDependentFriction.slip_limit(&values, &Situation::default(), &memory),
            SlipLimit::UNCHANGED
        );
        for sample in 1..=2000 {
            let now = Situation {
                step: 0.01,
                slip: 1e-5 * f64::from(sample),
                slip_rate: 1e-3,
                ..Situation::default()
            };
            RateDependentFriction.remember(&values, &now, &mut memory);
        }
        let limit = RateDependentFriction.slip_limit(&values, &Situation::default(), &memory);
        assert!((limit.positive - (1.0 + 0.1 * 2.0_f64.ln())).abs() < 1e-9);
        assert_eq!(limit.positive, limit.negative);
    }

    #[test]
    fn a_contact_that_turns_keeps_the_rate_it_slid_with() {
        let mut memory = [0.0];
        let mut slide = |slip: f64, slip_rate: f64| {
            let now = Situation {
                step: 0.01,
                slip,
                slip_rate,
                ..Situation::default()
            };
            follow_rate(&now, 0.05, &mut memory);
            memory[0]
        };
        let forth = (1..=2000).fold(0.0, |_, i| slide(1e-5 * f64::from(i), 1e-3));
        let back = (1..=200).fold(f64::INFINITY, |least: f64, i| {
            least.min(slide(0.02 - 1e-5 * f64::from(i), -1e-3))
        });
        assert!((forth - 1e-3).abs() < 1e-9 && (back - 1e-3).abs() < 1e-9);
    }
}
