//! `displacement_drift`: the displacement sensor wanders.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Trajectory};
use crate::joint::elementary::{expm1, log1p};
use crate::joint::parameters::Parameter;

/// The sensor adds a displacement that grows with time, `U_meas = U + v t`, or comes to rest as a
/// temperature does, `U + v (1 − exp(−λ t))/λ`, or ever more slowly, its rate as `v (1 + q λ t)^(−1/q)`: as a
/// logarithm for q = 1, as a root for q = 2.
pub struct DisplacementDrift;

static PARAMETERS: [Parameter; 3] = [
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
];

/// Samples of the finest record within which no drift comes to rest: what does is a zero that was off, or a jump.
const AT_ONCE: f64 = 5.0;

/// Integral of the rate that is left of 1, `(1 + q λ t)^(−1/q)`.
fn gone(time: f64, fading: f64, tail: f64) -> f64 {
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
        samples
            .map(|t| values[0] * gone(t - start, values[1], values[2]))
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
            formula: "U_measured = U + d, dd/dt = v (1 + q lambda t)^(-1/q), v exp(-lambda t) for q = 0, v for lambda = 0",
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
        let as_a_root = vec![10.0 * rate, 100.0 / scale.duration(), 2.0];
        vec![vec![rate, 0.0, 0.0], as_a_root]
    }
    fn refined(&self, values: &[f64], scale: &Scale) -> Vec<f64> {
        match values[1] > 0.0 {
            true => values.to_vec(),
            false => vec![values[0], 1.0 / scale.duration(), 0.3],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drift_goes_on_or_comes_to_rest() {
        let truth = Trajectory {
            begins: 0.0,
            time: vec![2.0, 3.0, 5.0],
            force: vec![],
            displacement: vec![0.0; 3],
        };
        assert_eq!(
            DisplacementDrift.channel(&[0.5, 0.0, 0.0], Place::DisplacementChannel, &truth),
            [0.0, 0.5, 1.5]
        );
        let settles =
            DisplacementDrift.channel(&[0.5, 2.0, 0.0], Place::DisplacementChannel, &truth);
        assert!((settles[2] - 0.25 * (1.0 - (-6.0_f64).exp())).abs() < 1e-15);
        let slowly =
            DisplacementDrift.channel(&[0.5, 1e-9, 0.0], Place::DisplacementChannel, &truth);
        assert!((slowly[2] - 1.5).abs() < 1e-8);
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
