//! `creep`: a viscoelastic layer in the load path.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Response, Situation};
use crate::joint::elementary::expm1;
use crate::joint::parameters::Parameter;

/// A Kelvin element in series, `τ ṡ = J F − s`, solved exactly for a force that goes straight
/// through each step.
pub struct Creep;

static PARAMETERS: [Parameter; 2] = [
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
];

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
    /// Displacement of the element and force, at the last sample.
    fn memory(&self) -> usize {
        2
    }
    fn remember(&self, values: &[f64], now: &Situation, memory: &mut [f64]) {
        memory[0] = self.in_series(values, now.force, now.step, memory).value;
        memory[1] = now.force;
    }
    fn in_series(&self, values: &[f64], force: f64, step: f64, memory: &[f64]) -> Response {
        let [compliance, time_constant] = [values[0], values[1]];
        let [kept, old, new] = lag(step / time_constant);
        Response {
            value: kept * memory[0] + compliance * (old * memory[1] + new * force),
            slope: compliance * new,
            damping: 0.0,
        }
    }
    /// The element's spring, `s²/(2J)`; its dashpot has the rest.
    fn stored_energy(&self, values: &[f64], _now: &Situation, memory: &[f64]) -> Option<f64> {
        let stored = 0.5 * memory[0] * memory[0] / values[0];
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
            formula: "U = u + F/K_1 + s, tau ds/dt = J F - s",
            source: "Kelvin-Voigt element in series, the standard linear solid.",
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
            .map(|time_constant| vec![compliance, *time_constant])
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_held_force_creeps_to_its_end_by_the_exponential() {
        let (values, mut memory) = ([0.5, 2.0], [0.0; 2]);
        for step in [0.0, 0.3, 0.7, 1.0] {
            let now = Situation {
                step,
                force: 4.0,
                ..Situation::default()
            };
            Creep.remember(&values, &now, &mut memory);
        }
        assert!((memory[0] - 2.0 * (1.0 - (-1.0_f64).exp())).abs() < 1e-15);
        assert_eq!(Creep.in_series(&values, 9.0, 0.0, &memory).value, memory[0]);
    }

    #[test]
    fn a_ramp_lags_by_its_rate_times_the_time_constant() {
        let (values, mut memory) = ([0.5, 0.01], [0.0; 2]);
        for sample in 1..=100 {
            let now = Situation {
                step: 0.01,
                force: 0.01 * f64::from(sample),
                ..Situation::default()
            };
            Creep.remember(&values, &now, &mut memory);
        }
        assert!((memory[0] - 0.5 * (1.0 - 0.01)).abs() < 1e-14);
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
