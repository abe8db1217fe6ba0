//! `sensor_delay`: the displacement channel lags or leads the force channel.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Trajectory};
use crate::joint::parameters::Parameter;
use crate::joint::passed::Passed;

/// The displacement is read late, `U_meas(t) = U(t − τ)`; a negative τ means that the force is.
pub struct SensorDelay;

static PARAMETERS: [Parameter; 1] = [Parameter {
    name: "delay",
    symbol: "tau",
    unit: "s",
    lower: -10.0,
    upper: 10.0,
    vanishes_at: Some(0.0),
    neutral: None,
    meaning: "time by which the displacement channel lags the force channel",
}];

impl Effect for SensorDelay {
    fn name(&self) -> &'static str {
        "sensor_delay"
    }
    fn place(&self) -> Place {
        Place::DisplacementChannel
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn lateness(&self, values: &[f64]) -> Option<f64> {
        Some(values[0])
    }
    fn channel(&self, values: &[f64], _place: Place, truth: &Trajectory) -> Vec<f64> {
        let course = truth.course();
        let mut passed = Passed::default();
        let samples = truth.time.iter().zip(&truth.displacement);
        samples
            .map(|(t, u)| course.at(t - values[0], &mut passed) - u)
            .collect()
    }
}

impl Cause for SensorDelay {
    fn page(&self) -> Page {
        Page {
            happens: "Filters, multiplexed sampling or a slow amplifier let one channel lag the other.",
            sign: "Loops open or close in proportion to frequency, elastic ones too; a lagging force channel can turn the sense of small loops, which no joint does.",
            mistaken_for: &["viscous_damping", "creep", "fixture_inertia"],
            separated_by: "Deep slip, where the joint's compliance changes and a delay does not; two decades of frequency; swapped channels or a dummy specimen, which has no loss of its own.",
            formula: "U_measured(t) = U(t - tau)",
            source: "Pure time delay of a measuring chain; a phase of 0.18 degrees at the drive already moves the slope of dissipation over force from 2.69 to 2.47.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &SensorDelay
    }
    fn needs_time(&self) -> bool {
        true
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        vec![vec![0.002 * scale.period]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sine_is_read_late_or_early_by_parts_of_a_sample() {
        let time: Vec<f64> = (0..1000).map(|i| 0.01 * f64::from(i)).collect();
        let truth = Trajectory {
            begins: 0.0,
            displacement: time.iter().map(|t| (3.0 * t).sin()).collect(),
            force: vec![],
            time,
        };
        for delay in [0.004, 0.01, 0.037, -0.004, -0.02] {
            let added = SensorDelay.channel(&[delay], Place::DisplacementChannel, &truth);
            for (i, t) in truth.time.iter().enumerate().skip(5).take(990) {
                let exact = (3.0 * (t - delay)).sin() - (3.0 * t).sin();
                // Cubic pieces with slopes by differences err by (ω Δt)³/8 of the amplitude.
                assert!((added[i] - exact).abs() < 4e-6, "{delay} at {t}");
            }
        }
    }

    #[test]
    fn nothing_is_known_before_the_record() {
        let truth = Trajectory {
            begins: 0.0,
            time: vec![1.0, 2.0, 3.0],
            force: vec![],
            displacement: vec![0.5, 1.5, 3.5],
        };
        assert_eq!(
            SensorDelay.channel(&[5.0], Place::DisplacementChannel, &truth),
            [0.0, -1.0, -3.0]
        );
        assert_eq!(
            SensorDelay.channel(&[-1.0], Place::DisplacementChannel, &truth)[2],
            2.0
        );
        assert_eq!(
            SensorDelay.channel(&[0.0], Place::DisplacementChannel, &truth),
            [0.0; 3]
        );
        assert!(
            SensorDelay
                .channel(&[1.0], Place::DisplacementChannel, &Trajectory::default())
                .is_empty()
        );
    }
}
