//! `sensor_delay`: one channel lags the other.

use super::{Cause, Page, Scale, chain};
use crate::joint::effect::{Effect, Place, Places, Trajectory};
use crate::joint::parameters::Parameter;
use crate::joint::passed::Passed;

/// The displacement is read late, `U_meas(t) = U(t − τ)`; a negative τ means that the force is. Or a filter of first
/// order lets it follow, `T U̇_meas = U − U_meas`, or so the load cell's reading, with `T_F`.
///
/// Beside a joint that does not slip a filter and a dashpot are the same thing, not to first order only.
pub struct SensorDelay;

static PARAMETERS: [Parameter; 3] = [
    Parameter {
        name: "delay",
        symbol: "tau",
        unit: "s",
        lower: -1e12,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "time by which the displacement channel lags the force channel",
    },
    Parameter {
        name: "lag",
        symbol: "T",
        unit: "s",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "time constant of a filter of first order in the displacement channel",
    },
    Parameter {
        name: "cell_lag",
        symbol: "T_F",
        unit: "s",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "time constant of a filter of first order in the load cell",
    },
];

/// What a filter of first order with this time constant, at rest before the first sample, makes of a channel.
fn filtered(time_constant: f64, time: &[f64], channel: &[f64]) -> Vec<f64> {
    let begins = channel.first().copied().unwrap_or(0.0);
    chain::lagging(1.0 / time_constant, begins, time, channel)
}

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
    fn places(&self, values: &[f64]) -> Places {
        chain::places(values[0] != 0.0 || values[1] != 0.0, values[2] != 0.0)
    }
    fn lateness(&self, values: &[f64]) -> Option<f64> {
        (values[1] == 0.0 && values[2] == 0.0).then_some(values[0])
    }
    fn channel(&self, values: &[f64], place: Place, truth: &Trajectory) -> Vec<f64> {
        let channel = truth.channel(place);
        let time_constant = values[1 + chain::first(place, 1)];
        let mut read = match place == Place::DisplacementChannel && values[0] != 0.0 {
            true => {
                let (course, mut passed) = (truth.course(), Passed::default());
                let times = truth.time.iter();
                times
                    .map(|t| course.at(t - values[0], &mut passed))
                    .collect()
            }
            false => channel.to_vec(),
        };
        if time_constant > 0.0 {
            read = filtered(time_constant, &truth.time, &read);
        }
        read.iter().zip(channel).map(|(r, u)| r - u).collect()
    }
}

impl Cause for SensorDelay {
    fn page(&self) -> Page {
        Page {
            happens: "Filters, multiplexed sampling or a slow amplifier let one channel lag the other.",
            sign: "Loops open or close in proportion to frequency, elastic ones too; a lagging force channel can turn the sense of small loops, which no joint does.",
            mistaken_for: &["viscous_damping", "creep", "fixture_inertia"],
            separated_by: "Deep slip, where the joint's compliance changes and a delay does not; two decades of frequency; swapped channels or a dummy specimen, which has no loss of its own.",
            formula: "U_measured(t) = U(t - tau), or T dU_measured/dt = U - U_measured, or so of the load cell, with T_F",
            source: "Pure time delay, or filter of first order, of a measuring chain; a phase of 0.18 degrees at the drive already moves the slope of dissipation over force from 2.69 to 2.47.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &SensorDelay
    }
    fn needs_time(&self) -> bool {
        true
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let little = 0.002 * scale.period;
        vec![
            vec![little, 0.0, 0.0],
            vec![0.0, little, 0.0],
            vec![0.0, 0.0, little],
        ]
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
            test: 0,
            displacement: time.iter().map(|t| (3.0 * t).sin()).collect(),
            force: vec![],
            time,
            ..Trajectory::default()
        };
        for delay in [0.004, 0.01, 0.037, -0.004, -0.02] {
            let added = SensorDelay.channel(&[delay, 0.0, 0.0], Place::DisplacementChannel, &truth);
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
            test: 0,
            time: vec![1.0, 2.0, 3.0],
            force: vec![],
            displacement: vec![0.5, 1.5, 3.5],
            ..Trajectory::default()
        };
        assert_eq!(
            SensorDelay.channel(&[5.0, 0.0, 0.0], Place::DisplacementChannel, &truth),
            [0.0, -1.0, -3.0]
        );
        assert_eq!(
            SensorDelay.channel(&[-1.0, 0.0, 0.0], Place::DisplacementChannel, &truth)[2],
            2.0
        );
        assert_eq!(
            SensorDelay.channel(&[0.0, 0.0, 0.0], Place::DisplacementChannel, &truth),
            [0.0; 3]
        );
        assert!(
            SensorDelay
                .channel(
                    &[1.0, 0.0, 0.0],
                    Place::DisplacementChannel,
                    &Trajectory::default()
                )
                .is_empty()
        );
    }

    /// A sine that has gone on for long is smaller by cos φ and late by φ = atan ωT, from either sensor.
    #[test]
    fn a_filter_turns_a_sine_by_its_angle() {
        let time: Vec<f64> = (0..4000).map(|i| 0.002 * f64::from(i)).collect();
        let wave: Vec<f64> = time.iter().map(|t| (7.0 * t).sin()).collect();
        let truth = Trajectory {
            begins: 0.0,
            test: 0,
            displacement: wave.clone(),
            force: wave,
            time,
            ..Trajectory::default()
        };
        for (values, place) in [
            ([0.0, 0.05, 0.0], Place::DisplacementChannel),
            ([0.0, 0.0, 0.05], Place::ForceChannel),
        ] {
            assert_eq!(
                SensorDelay.places(&values)[0].or(SensorDelay.places(&values)[1]),
                Some(place)
            );
            assert_eq!(SensorDelay.lateness(&values), None);
            let added = SensorDelay.channel(&values, place, &truth);
            let angle = (7.0_f64 * 0.05).atan();
            for (i, t) in truth.time.iter().enumerate().skip(1000) {
                let exact = angle.cos() * (7.0 * t - angle).sin();
                // Chords of the sine err by (ω Δt)²/8.
                assert!((truth.force[i] + added[i] - exact).abs() < 3e-5, "{t}");
            }
        }
    }
}
