//! A gain of the displacement sensor that changes with time, as of an amplifier that warms up.

use super::Outsider;
use crate::causes::Scale;
use crate::causes::displacement_drift::gone;
use crate::joint::effect::{Effect, Place, Trajectory};
use crate::joint::parameters::Parameter;

/// The sensor reads `U_meas = U (1 + g)`, `ġ = v exp(−λ t)` over all records, one after the other.
pub struct WarmingGain;

static PARAMETERS: [Parameter; 2] = [
    Parameter {
        name: "rate",
        symbol: "v",
        unit: "1/s",
        lower: -1e12,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "relative change of the gain per second, at first",
    },
    Parameter {
        name: "fading",
        symbol: "lambda",
        unit: "1/s",
        lower: 0.0,
        upper: 1e15,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "how fast the gain comes to rest; 0: it goes on",
    },
];

/// Change of the gain over all records that a search begins with.
const FIRST: f64 = 0.01;

/// Rates at which the gain comes to rest that are looked for, in lengths of all records.
const STARTS: [f64; 3] = [0.0, 3.0, 12.0];

/// Slowest periods within which no gain comes to rest.
const AT_ONCE: f64 = 1.0;

impl Effect for WarmingGain {
    fn name(&self) -> &'static str {
        "warming_gain"
    }
    fn place(&self) -> Place {
        Place::DisplacementChannel
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn channel(&self, values: &[f64], _place: Place, truth: &Trajectory) -> Vec<f64> {
        let start = truth.time.first().copied().unwrap_or(0.0) - truth.begins;
        let gain = |t: &f64| values[0] * gone(t - start, values[1], 0.0);
        let samples = truth.time.iter().zip(&truth.displacement);
        samples.map(|(t, u)| u * gain(t)).collect()
    }
}

impl Outsider for WarmingGain {
    fn passes_for(&self, cause: &str) -> bool {
        ["preload_loss", "running_in", "displacement_drift"].contains(&cause)
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let whole: f64 = scale.lengths.iter().sum();
        let start = |fading: &f64| vec![FIRST * fading.max(1.0) / whole, fading / whole];
        STARTS.iter().map(start).collect()
    }
    fn plausible(&self, values: &[f64], scale: &Scale) -> bool {
        values[1] * AT_ONCE * scale.slowest < 1.0
    }
    fn words(&self) -> &'static str {
        "a gain of the displacement sensor that changes with time, as of an amplifier that warms up, explains the records better"
    }
    fn effect(&self) -> &'static dyn Effect {
        &WarmingGain
    }
    fn needs_time(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gain_goes_on_from_record_to_record_and_comes_to_rest() {
        let record = |begins: f64| Trajectory {
            time: vec![10.0, 11.0, 12.0],
            displacement: vec![2e-6, -2e-6, 2e-6],
            begins,
            ..Trajectory::default()
        };
        let channel = |values: &[f64], begins: f64| {
            let place = Place::DisplacementChannel;
            WarmingGain.channel(values, place, &record(begins))
        };
        // Its own clock begins at 10 s; four seconds were recorded before it.
        assert_eq!(channel(&[0.01, 0.0], 0.0), [0.0, -2e-8, 4e-8]);
        assert_eq!(channel(&[0.01, 0.0], 4.0)[0], 2e-6 * 0.04);
        for (added, time) in channel(&[0.01, 0.5], 4.0).iter().zip([4.0, 5.0, 6.0_f64]) {
            let gain = 0.02 * (1.0 - (-0.5 * time).exp());
            assert!((added.abs() - 2e-6 * gain).abs() < 1e-20, "{added}");
        }
        let rested = channel(&[0.01, 0.5], 1e6);
        assert!((rested[2] - 2e-6 * 0.02).abs() < 1e-20, "{rested:?}");
    }
}
