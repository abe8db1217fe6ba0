//! `creep`: a viscoelastic layer in the load path.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Response, Situation};
use crate::joint::elementary::{exp, expm1};
use crate::joint::parameters::Parameter;

/// A Kelvin element in series, `τ ṡ = J F − s`, or a chain of [`CHAIN`] whose time constants are spread
/// evenly over decades; solved exactly for a force that goes straight through each step.
pub struct Creep;

static PARAMETERS: [Parameter; 3] = [
    Parameter {
        name: "compliance",
        symbol: "J",
        unit: "m/N",
        lower: 0.0,
        upper: 1.0,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "displacement per force that creep adds in the end",
    },
    Parameter {
        name: "time_constant",
        symbol: "tau",
        unit: "s",
        lower: 1e-9,
        upper: 1e12,
        vanishes_at: None,
        neutral: None,
        meaning: "time in which the rest of the creep falls to 1/e",
    },
    Parameter {
        name: "spread",
        symbol: "d",
        unit: "1",
        lower: 0.0,
        upper: 3.0,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "decades by which the fastest and the slowest part lie off the time constant; 0: one time constant",
    },
];

/// Elements of a chain with spread time constants: two in a decade where it is one to each side.
const CHAIN: usize = 5;

/// Compliance and time constant of every element.
fn elements(values: &[f64]) -> impl Iterator<Item = (f64, f64)> {
    let [compliance, time_constant, spread] = [values[0], values[1], values[2]];
    let (count, ratio) = match spread > 0.0 {
        true => (CHAIN, exp(DECADE * spread / (CHAIN / 2) as f64)),
        false => (1, 1.0),
    };
    let fastest = (0..count / 2).fold(time_constant, |time, _| time / ratio);
    let times = std::iter::successors(Some(fastest), move |time| Some(time * ratio));
    times
        .take(count)
        .map(move |time| (compliance / count as f64, time))
}

/// ln 10.
const DECADE: f64 = std::f64::consts::LN_10;

/// What a first-order lag keeps of its value, and takes of its input's old and new value, over a
/// step of `x` time constants in which the input goes straight; the three add up to 1.
pub(super) fn lag(x: f64) -> [f64; 3] {
    let gone = -expm1(-x);
    // 1 − (1 − exp(−x))/x, by its series where the difference would lose its digits.
    let new = if x < 1e-4 {
        x / 2.0 - x * x / 6.0
    } else {
        1.0 - gone / x
    };
    [1.0 - gone, gone - new, new]
}

/// Displacement of an element (J, τ) after a step in which the force goes straight, and its slope over
/// the force at the end.
fn after(
    (compliance, time_constant): (f64, f64),
    crept: f64,
    (from, to): (f64, f64),
    step: f64,
) -> Response {
    let [kept, old, new] = lag(step / time_constant);
    Response {
        value: kept * crept + compliance * (old * from + new * to),
        slope: compliance * new,
        damping: 0.0,
    }
}

impl Effect for Creep {
    fn name(&self) -> &'static str {
        "creep"
    }
    fn place(&self) -> Place {
        Place::InSeries
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    /// Force at the last sample, and the displacement of every element.
    fn memory(&self) -> usize {
        1 + CHAIN
    }
    fn remember(&self, values: &[f64], now: &Situation, memory: &mut [f64]) {
        if let [last, crept @ ..] = memory {
            for (element, crept) in elements(values).zip(crept) {
                *crept = after(element, *crept, (*last, now.force), now.step).value;
            }
            *last = now.force;
        }
    }
    fn in_series(&self, values: &[f64], force: f64, step: f64, memory: &[f64]) -> Response {
        let mut sum = Response::default();
        if let [last, crept @ ..] = memory {
            for (element, crept) in elements(values).zip(crept) {
                let one = after(element, *crept, (*last, force), step);
                sum.value += one.value;
                sum.slope += one.slope;
            }
        }
        sum
    }
    /// The elements' springs, `Σ s²/(2J)`; their dashpots have the rest.
    fn stored_energy(&self, values: &[f64], _now: &Situation, memory: &[f64]) -> Option<f64> {
        let crept = memory.iter().skip(1);
        let each = elements(values).zip(crept);
        let stored: f64 = each
            .map(|((compliance, _), s)| 0.5 * s * s / compliance)
            .sum();
        Some(if values[0] > 0.0 { stored } else { 0.0 })
    }
}

impl Cause for Creep {
    fn page(&self) -> Page {
        Page {
            happens: "A coating, gasket, adhesive or the contacts themselves go on giving way under a force that is held, and come back when it is taken away.",
            sign: "Displacement goes on under a held force; stiffness rises with frequency, loss has its greatest value at one frequency; under a mean load the first cycles wander and settle.",
            mistaken_for: &[
                "viscous_damping",
                "displacement_drift",
                "running_in",
                "ac_coupling",
            ],
            separated_by: "Two decades of frequency: the loss of a dashpot goes on growing, that of creep turns; a hold under load against one at zero force: drift knows no difference.",
            formula: "U = u + F/K_1 + s, tau ds/dt = J F - s; with a spread, five such parts of J/5 and tau 10^(-d) to tau 10^d",
            source: "Kelvin-Voigt element in series, the standard linear solid; a chain of them for a spectrum of retardation times (Ferry 1980).",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &Creep
    }
    fn needs_time(&self) -> bool {
        true
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let compliance = 0.01 * scale.displacement / scale.force;
        let by_period = [0.05, 0.2, 1.0].map(|share| share * scale.period);
        let by_duration = [0.03, 0.1, 0.3, 1.0].map(|share| share * scale.duration());
        by_period
            .iter()
            .chain(&by_duration)
            .map(|time_constant| vec![compliance, *time_constant, 0.0])
            .collect()
    }
    fn refined(&self, values: &[f64], _scale: &Scale) -> Vec<f64> {
        vec![values[0], values[1], 0.5]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_held_force_creeps_to_its_end_by_the_exponential() {
        let (values, mut memory) = ([0.5, 2.0, 0.0], [0.0; 1 + CHAIN]);
        for step in [0.0, 0.3, 0.7, 1.0] {
            let now = Situation {
                step,
                force: 4.0,
                ..Situation::default()
            };
            Creep.remember(&values, &now, &mut memory);
        }
        assert!((memory[1] - 2.0 * (1.0 - (-1.0_f64).exp())).abs() < 1e-15);
        assert_eq!(Creep.in_series(&values, 9.0, 0.0, &memory).value, memory[1]);
    }

    #[test]
    fn a_spread_creeps_sooner_and_ends_later_and_to_the_same() {
        let crept = |spread: f64, after: f64| {
            let values = [0.5, 2.0, spread];
            let mut memory = [0.0; 1 + CHAIN];
            for step in [0.0, after] {
                let now = Situation {
                    step,
                    force: 4.0,
                    ..Situation::default()
                };
                Creep.remember(&values, &now, &mut memory);
            }
            Creep.in_series(&values, 4.0, 0.0, &memory).value
        };
        assert!(crept(1.0, 0.2) > 2.0 * crept(0.0, 0.2));
        assert!(crept(1.0, 6.0) < 0.95 * crept(0.0, 6.0));
        assert!((crept(1.0, 1e4) - 2.0).abs() < 1e-12);
        assert!((crept(1e-9, 3.0) - crept(0.0, 3.0)).abs() < 1e-8);
    }

    #[test]
    fn a_ramp_lags_by_its_rate_times_the_time_constant() {
        let (values, mut memory) = ([0.5, 0.01, 0.0], [0.0; 1 + CHAIN]);
        for sample in 1..=100 {
            let now = Situation {
                step: 0.01,
                force: 0.01 * f64::from(sample),
                ..Situation::default()
            };
            Creep.remember(&values, &now, &mut memory);
        }
        assert!((memory[1] - 0.5 * (1.0 - 0.01)).abs() < 1e-14);
    }

    #[test]
    fn shares_of_a_lag_add_up_and_join_their_series() {
        for x in [0.0, 1e-9, 9.9999e-5, 1.0001e-4, 0.3, 50.0] {
            assert!((lag(x).iter().sum::<f64>() - 1.0).abs() < 1e-15);
        }
        let x: f64 = 1.0001e-4;
        let series = x / 2.0 - x.powi(2) / 6.0 + x.powi(3) / 24.0;
        assert!((lag(x)[2] - series).abs() < 1e-11);
    }
}
