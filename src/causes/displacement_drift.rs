//! `displacement_drift`: the displacement sensor wanders.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Trajectory};
use crate::joint::elementary::{expm1, log1p};
use crate::joint::parameters::Parameter;

/// The sensor adds a displacement that grows with time, `U_meas = U + v t`, or comes to rest as a
/// temperature does, `U + v (1 − exp(−λ t))/λ`, or ever more slowly, its rate as `v (1 + q λ t)^(−1/q)`: as a
/// logarithm for q = 1, as a root for q = 2. Tests of one joint may each have a rate of their own, up to the sixth.
pub struct DisplacementDrift;

static PARAMETERS: [Parameter; 8] = [
    Parameter {
        name: "rate",
        symbol: "v",
        unit: "m/s",
        lower: -1e12,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "displacement added by the sensor per second, at first",
    },
    Parameter {
        name: "fading",
        symbol: "lambda",
        unit: "1/s",
        lower: 0.0,
        upper: 1e15,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "how fast the drift comes to rest; 0: it goes on",
    },
    Parameter {
        name: "tail",
        symbol: "q",
        unit: "1",
        lower: 0.0,
        upper: 5.0,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "how slowly the drift comes to rest: as an exponential for 0, as a logarithm for 1, as a root for 2",
    },
    Parameter {
        name: "second_test",
        symbol: "v_2",
        unit: "m/s",
        lower: -1e12,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "rate in the second test less that in the first",
    },
    Parameter {
        name: "third_test",
        symbol: "v_3",
        unit: "m/s",
        lower: -1e12,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "rate in the third test less that in the first",
    },
    Parameter {
        name: "fourth_test",
        symbol: "v_4",
        unit: "m/s",
        lower: -1e12,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "rate in the fourth test less that in the first",
    },
    Parameter {
        name: "fifth_test",
        symbol: "v_5",
        unit: "m/s",
        lower: -1e12,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "rate in the fifth test less that in the first",
    },
    Parameter {
        name: "sixth_test",
        symbol: "v_6",
        unit: "m/s",
        lower: -1e12,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "rate in the sixth test less that in the first",
    },
];

/// Place of the rate of the second test among the values; later ones stand behind it.
const SECOND: usize = 3;

/// Rate of a test, by its place among all \[m/s\].
fn rate(values: &[f64], test: usize) -> f64 {
    let further = test.checked_sub(1).and_then(|k| values.get(SECOND + k));
    values[0] + further.copied().unwrap_or(0.0)
}

/// Samples of the finest record within which no drift comes to rest: what does is a zero that was off, or a jump.
const AT_ONCE: f64 = 5.0;

/// Share of the first test's rate by which that of another begins to differ.
const APART: f64 = -0.1;

/// Integral of the rate that is left of 1, `(1 + q λ t)^(−1/q)`.
pub(crate) fn gone(time: f64, fading: f64, tail: f64) -> f64 {
    if fading <= 0.0 {
        return time;
    }
    if tail <= 0.0 {
        return -expm1(-fading * time) / fading;
    }
    let (slowed, power) = (log1p(tail * fading * time), 1.0 - 1.0 / tail);
    match power == 0.0 {
        true => slowed / fading,
        false => expm1(power * slowed) / (power * tail * fading),
    }
}

impl Effect for DisplacementDrift {
    fn name(&self) -> &'static str {
        "displacement_drift"
    }
    fn place(&self) -> Place {
        Place::DisplacementChannel
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn channel(&self, values: &[f64], _place: Place, truth: &Trajectory) -> Vec<f64> {
        let start = truth.time.first().copied().unwrap_or(0.0);
        let samples = truth.time.iter();
        let rate = rate(values, truth.test);
        samples
            .map(|t| rate * gone(t - start, values[1], values[2]))
            .collect()
    }
}

impl Cause for DisplacementDrift {
    fn page(&self) -> Page {
        Page {
            happens: "Temperature, amplifier or mounting lets the displacement reading wander while the joint stays where it is.",
            sign: "Loops keep their shape and move along the displacement axis at a steady rate, at rest as well as under load.",
            mistaken_for: &[
                "preload_loss",
                "creep",
                "offset_step",
                "asymmetric_friction",
            ],
            separated_by: "A pause at zero load still drifts; loop area and stiffness stay as they were; a dummy specimen drifts too.",
            formula: "U_measured = U + d, dd/dt = v (1 + q lambda t)^(-1/q), v exp(-lambda t) for q = 0, v for lambda = 0; v + v_k in test k",
            source: "First-order drift of a displacement transducer; thermal drift that settles; drift with the logarithm or the root of time, of strain gauges and diffusion.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &DisplacementDrift
    }
    fn needs_time(&self) -> bool {
        true
    }
    fn plausible(&self, values: &[f64], scale: &Scale) -> bool {
        // Logarithm and root never come to rest.
        let comes_to_rest = values[1] * (1.0 - values[2]);
        comes_to_rest * AT_ONCE * scale.finest <= 1.0
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let rate = 0.01 * scale.displacement / scale.duration();
        let of = |shape: [f64; 3], further: &dyn Fn(usize) -> f64| {
            let tests = 1..PARAMETERS.len() - SECOND + 1;
            let further = tests.map(|k| {
                if k < scale.lengths.len() {
                    further(k)
                } else {
                    0.0
                }
            });
            shape.into_iter().chain(further).collect::<Vec<f64>>()
        };
        let steady = [rate, 0.0, 0.0];
        let as_a_root = [10.0 * rate, 100.0 / scale.duration(), 2.0];
        let alike = |_: usize| 0.0;
        let mut starts = vec![of(steady, &alike), of(as_a_root, &alike)];
        // As far in every test, and there and back.
        let as_far = |k: usize| rate * (scale.lengths[0] / scale.lengths[k] - 1.0);
        let back = |k: usize| if k % 2 == 1 { -2.0 * rate } else { 0.0 };
        if scale.lengths.iter().any(|l| *l != scale.lengths[0]) {
            starts.push(of(steady, &as_far));
        }
        if scale.lengths.len() > 1 {
            starts.push(of(steady, &back));
        }
        starts
    }
    fn refined(&self, values: &[f64], scale: &Scale) -> Vec<f64> {
        let mut refined = values.to_vec();
        if values[1] <= 0.0 {
            (refined[1], refined[2]) = (1.0 / scale.duration(), 0.3);
        }
        refined
    }
    /// Tests with a rate each, unless they have.
    fn begun_anew(&self, values: &[f64], scale: &Scale) -> Option<Vec<f64>> {
        let tests = scale.lengths.len().min(PARAMETERS.len() - SECOND + 1);
        let further = SECOND..SECOND + tests - 1;
        if tests < 2 || values[further.clone()].iter().all(|v| *v != 0.0) {
            return None;
        }
        let mut apart = values.to_vec();
        for value in &mut apart[further] {
            if *value == 0.0 {
                *value = APART * values[0];
            }
        }
        Some(apart)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All values, those that are not given as zero.
    fn of(given: &[f64]) -> Vec<f64> {
        let mut values = given.to_vec();
        values.resize(PARAMETERS.len(), 0.0);
        values
    }

    #[test]
    fn a_drift_goes_on_or_comes_to_rest() {
        let truth = Trajectory {
            begins: 0.0,
            test: 0,
            time: vec![2.0, 3.0, 5.0],
            force: vec![],
            displacement: vec![0.0; 3],
            ..Trajectory::default()
        };
        assert_eq!(
            DisplacementDrift.channel(&of(&[0.5, 0.0, 0.0]), Place::DisplacementChannel, &truth),
            [0.0, 0.5, 1.5]
        );
        let settles =
            DisplacementDrift.channel(&of(&[0.5, 2.0, 0.0]), Place::DisplacementChannel, &truth);
        assert!((settles[2] - 0.25 * (1.0 - (-6.0_f64).exp())).abs() < 1e-15);
        let slowly =
            DisplacementDrift.channel(&of(&[0.5, 1e-9, 0.0]), Place::DisplacementChannel, &truth);
        assert!((slowly[2] - 1.5).abs() < 1e-8);
    }

    #[test]
    fn tests_have_rates_of_their_own() {
        let at = |test: usize| {
            let truth = Trajectory {
                begins: 0.0,
                test,
                time: vec![0.0, 2.0],
                force: vec![],
                displacement: vec![0.0; 2],
                ..Trajectory::default()
            };
            let values = of(&[0.5, 0.0, 0.0, 0.25, -0.5]);
            DisplacementDrift.channel(&values, Place::DisplacementChannel, &truth)[1]
        };
        // A seventh test drifts as the first.
        assert_eq!([0, 1, 2, 3, 9].map(at), [1.0, 1.5, 0.0, 1.0, 1.0]);
        let scale = Scale {
            force: 1.0,
            displacement: 6.0,
            lengths: vec![1.0, 4.0, 2.0],
            ..Scale::default()
        };
        let starts = DisplacementDrift.starts(&scale);
        let gone = [0, 1, 2].map(|k| rate(&starts[2], k) * scale.lengths[k]);
        assert!(
            gone.iter().all(|g| (g / gone[0] - 1.0).abs() < 1e-12),
            "{gone:?}"
        );
        assert_eq!(rate(&starts[3], 1), -rate(&starts[3], 0));
        let alike = of(&[0.5]);
        let apart = DisplacementDrift.begun_anew(&alike, &scale).unwrap();
        assert!(
            apart[3] != 0.0 && apart[4] != 0.0 && apart[5] == 0.0,
            "{apart:?}"
        );
        assert_eq!(DisplacementDrift.begun_anew(&apart, &scale), None);
    }

    #[test]
    fn what_comes_to_rest_at_once_is_no_drift() {
        let scale = Scale {
            finest: 0.01,
            ..Scale::default()
        };
        let plausible =
            |fading: f64, tail: f64| DisplacementDrift.plausible(&[-0.1, fading, tail], &scale);
        assert!(plausible(0.0, 0.0) && plausible(10.0, 0.0) && plausible(1e7, 2.0));
        assert!(!plausible(100.0, 0.0) && !plausible(1e7, 0.7));
    }

    #[test]
    fn a_drift_slows_down_as_a_logarithm_or_a_root() {
        assert!((gone(3.0, 2.0, 1.0) - 7.0_f64.ln() / 2.0).abs() < 1e-15);
        // (√(1 + 2λt) − 1)/λ.
        assert!((gone(3.0, 4.0, 2.0) - 1.0).abs() < 1e-15);
        for tail in [1e-9_f64, 1.0 - 1e-9, 1.0 + 1e-9] {
            let nearby = gone(3.0, 2.0, tail.round());
            assert!((gone(3.0, 2.0, tail) / nearby - 1.0).abs() < 1e-7, "{tail}");
        }
    }
}
