//! `creep`: a viscoelastic layer in the load path.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Response, Situation};
use crate::joint::elementary::expm1;
use crate::joint::parameters::Parameter;

/// A Kelvin element in series, `τ ṡ = J F − s`, and one a decade faster and one a decade slower beside it
/// (a Prony series); solved exactly for a force that goes straight through each step.
pub struct Creep;

static PARAMETERS: [Parameter; 4] = [
    Parameter {
        name: "compliance",
        symbol: "J",
        unit: "m/N",
        lower: 0.0,
        upper: 1e12,
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
        name: "faster",
        symbol: "q_-",
        unit: "1",
        lower: 0.0,
        upper: 1e3,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "further compliance that creeps ten times as fast, over J",
    },
    Parameter {
        name: "slower",
        symbol: "q_+",
        unit: "1",
        lower: 0.0,
        upper: 1e3,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "further compliance that creeps ten times as slowly, over J",
    },
];

/// Elements of the series.
const CHAIN: usize = 3;

/// Ratio of the time constants of two elements.
const DECADE: f64 = 10.0;

/// Share of the compliance from which the faster and the slower part are refined, and below which a side has nothing.
const BESIDE: f64 = 0.3;

/// Compliance and time constant of every element.
fn elements(values: &[f64]) -> [(f64, f64); CHAIN] {
    let [compliance, time_constant] = [values[0], values[1]];
    [
        (compliance, time_constant),
        (values[2] * compliance, time_constant / DECADE),
        (values[3] * compliance, time_constant * DECADE),
    ]
}

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
    if compliance == 0.0 {
        // A part that is not there has not crept.
        return Response::default();
    }
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
            for (element, crept) in elements(values).into_iter().zip(crept) {
                *crept = after(element, *crept, (*last, now.force), now.step).value;
            }
            *last = now.force;
        }
    }
    fn in_series(&self, values: &[f64], force: f64, step: f64, memory: &[f64]) -> Response {
        let mut sum = Response::default();
        if let [last, crept @ ..] = memory {
            for (element, crept) in elements(values).into_iter().zip(crept) {
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
        let each = elements(values).into_iter().zip(crept);
        // A part without compliance has not crept.
        let parts = each.filter(|((compliance, _), _)| *compliance > 0.0);
        Some(
            parts
                .map(|((compliance, _), s)| 0.5 * s * s / compliance)
                .sum(),
        )
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
            formula: "U = u + F/K_1 + s, tau ds/dt = J F - s; beside it, where the data ask for them, q_- J with tau/10 and q_+ J with 10 tau",
            source: "Kelvin-Voigt element in series, the standard linear solid; a series of one element a decade for a spectrum of retardation times (Ferry 1980).",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &Creep
    }
    fn needs_time(&self) -> bool {
        true
    }
    /// An element that has settled within a sample of the finest record is a spring that lags: a delay's or a dashpot's.
    fn plausible(&self, values: &[f64], scale: &Scale) -> bool {
        values[1] >= scale.finest
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let compliance = 0.01 * scale.displacement / scale.force;
        let by_period = [0.05, 0.2, 1.0].map(|share| share * scale.period);
        let by_duration = [0.03, 0.1, 0.3, 1.0].map(|share| share * scale.duration());
        by_period
            .iter()
            .chain(&by_duration)
            .map(|time_constant| vec![compliance, *time_constant, 0.0, 0.0])
            .collect()
    }
    fn refined(&self, values: &[f64], _scale: &Scale) -> Vec<f64> {
        vec![values[0], values[1], BESIDE, BESIDE]
    }
    /// A decade on, where one side has nothing: the time constant slides in small steps only. Where both have some, half
    /// a decade towards the middle of what the records show: three elements stand between those of another series as well.
    fn begun_anew(&self, values: &[f64], scale: &Scale) -> Option<Vec<f64>> {
        let [compliance, time_constant, faster, slower] = *values else {
            return None;
        };
        if faster < BESIDE && slower > BESIDE {
            let time_constant = time_constant * DECADE;
            Some(vec![slower * compliance, time_constant, 1.0 / slower, 1.0])
        } else if slower < BESIDE && faster > BESIDE {
            let time_constant = time_constant / DECADE;
            Some(vec![faster * compliance, time_constant, 1.0, 1.0 / faster])
        } else if slower > BESIDE && faster > BESIDE {
            let up = time_constant * time_constant < scale.period * scale.duration();
            let (ahead, behind) = if up {
                (slower, faster)
            } else {
                (faster, slower)
            };
            let middle = 0.5 * (1.0 + ahead);
            let (of_behind, of_ahead) = (0.5 * (1.0 + behind) / middle, 0.5 * ahead / middle);
            let (shift, faster, slower) = match up {
                true => (DECADE.sqrt(), of_behind, of_ahead),
                false => (1.0 / DECADE.sqrt(), of_ahead, of_behind),
            };
            let compliance = middle * compliance;
            Some(vec![compliance, time_constant * shift, faster, slower])
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What two neighbours share the element between them has; the outermost one is halfway to none.
    #[test]
    fn a_series_that_both_sides_have_begins_anew_half_a_decade_on() {
        let scale = |duration: f64| Scale {
            period: 0.1,
            lengths: vec![duration],
            ..Scale::default()
        };
        let begun = |duration: f64| {
            Creep
                .begun_anew(&[2.0, 1.0, 0.5, 1.5], &scale(duration))
                .unwrap()
        };
        let compliances = |values: &[f64]| elements(values).map(|(compliance, _)| compliance);
        for (duration, time_constant, expected) in [
            (1e3, 10.0_f64.sqrt(), [2.5, 1.5, 1.5]),
            (1.0, 1.0 / 10.0_f64.sqrt(), [1.5, 0.5, 2.5]),
        ] {
            let values = begun(duration);
            assert!((values[1] - time_constant).abs() < 1e-12, "{values:?}");
            let found = compliances(&values);
            let both = found.iter().zip(expected);
            assert!(
                both.clone().all(|(c, e)| (c - e).abs() < 1e-12),
                "{found:?}"
            );
        }
    }

    #[test]
    fn a_held_force_creeps_to_its_end_by_the_exponential() {
        let (values, mut memory) = ([0.5, 2.0, 0.0, 0.0], [0.0; 1 + CHAIN]);
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
    fn the_parts_beside_creep_a_decade_sooner_and_later() {
        let values = [0.5, 2.0, 0.2, 0.6];
        let mut memory = [0.0; 1 + CHAIN];
        for step in [0.0, 3.0] {
            let now = Situation {
                step,
                force: 4.0,
                ..Situation::default()
            };
            Creep.remember(&values, &now, &mut memory);
        }
        let part = |compliance: f64, time: f64| 4.0 * compliance * (1.0 - (-3.0 / time).exp());
        let expected = part(0.5, 2.0) + part(0.1, 0.2) + part(0.3, 20.0);
        let crept = Creep.in_series(&values, 4.0, 0.0, &memory).value;
        assert!((crept - expected).abs() < 1e-14);
        let now = Situation::default();
        let stored = |values: &[f64]| Creep.stored_energy(values, &now, &memory);
        let parts = memory[1..].iter().zip([0.5, 0.1, 0.3]);
        let expected: f64 = parts
            .map(|(s, compliance)| s * s / (2.0 * compliance))
            .sum();
        assert!((stored(&values).unwrap() - expected).abs() < 1e-14);
        assert_eq!(
            stored(&[0.5, 2.0, 0.0, 0.0]),
            Some(memory[1] * memory[1]),
            "parts that are absent store nothing",
        );
    }

    /// A slow record beside a fast one does not rule out what the fast one resolves.
    #[test]
    fn the_finest_record_tells_whether_creep_settles_within_a_sample() {
        let scale = |finest| Scale {
            step: 0.19,
            finest,
            ..Scale::default()
        };
        let values = [1e-8, 0.15, 0.0, 0.0];
        assert!(Creep.plausible(&values, &scale(0.004)));
        assert!(!Creep.plausible(&values, &scale(0.19)));
    }

    #[test]
    fn a_ramp_lags_by_its_rate_times_the_time_constant() {
        let (values, mut memory) = ([0.5, 0.01, 0.0, 0.0], [0.0; 1 + CHAIN]);
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
