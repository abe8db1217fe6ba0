//! `mains_hum`: a channel picks up the mains.

use super::{Cause, Page, Scale, chain};
use crate::joint::effect::{Effect, Place, Places, Trajectory};
use crate::joint::elementary::sincos;
use crate::joint::parameters::Parameter;

/// A sine of the mains' frequency is added, `U_meas = U + a sin(2πf t) + b cos(2πf t)`, with some of its
/// third harmonic; of several records the clocks are set so that one phase serves all. The load cell may have it instead, with `A` and `B`.
pub struct MainsHum;

static PARAMETERS: [Parameter; 7] = [
    Parameter {
        name: "sine",
        symbol: "a",
        unit: "m",
        lower: -1.0,
        upper: 1.0,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "amplitude of the part that is zero at time zero of the first record",
    },
    Parameter {
        name: "cosine",
        symbol: "b",
        unit: "m",
        lower: -1.0,
        upper: 1.0,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "amplitude of the part that is largest at time zero of the first record",
    },
    Parameter {
        name: "frequency",
        symbol: "f",
        unit: "Hz",
        lower: 49.0,
        upper: 61.0,
        vanishes_at: None,
        neutral: None,
        meaning: "frequency of the mains; shows at its alias where the record is sampled too slowly",
    },
    Parameter {
        name: "third_sine",
        symbol: "p",
        unit: "1",
        lower: -1.0,
        upper: 1.0,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "third harmonic over the amplitude, the part that is zero at time zero of the first record",
    },
    Parameter {
        name: "third_cosine",
        symbol: "q",
        unit: "1",
        lower: -1.0,
        upper: 1.0,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "third harmonic over the amplitude, the part that is largest at time zero of the first record",
    },
    Parameter {
        name: "cell_sine",
        symbol: "A",
        unit: "N",
        lower: -1e9,
        upper: 1e9,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "amplitude on the load cell of the part that is zero at time zero of the first record",
    },
    Parameter {
        name: "cell_cosine",
        symbol: "B",
        unit: "N",
        lower: -1e9,
        upper: 1e9,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "amplitude on the load cell of the part that is largest at time zero of the first record",
    },
];

/// Share of a nominal frequency within which the mains may be.
const NEAR: f64 = 0.01;

impl Effect for MainsHum {
    fn name(&self) -> &'static str {
        "mains_hum"
    }
    fn place(&self) -> Place {
        Place::DisplacementChannel
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn places(&self, values: &[f64]) -> Places {
        chain::places(
            values[0] != 0.0 || values[1] != 0.0,
            values[5] != 0.0 || values[6] != 0.0,
        )
    }
    fn channel(&self, values: &[f64], place: Place, truth: &Trajectory) -> Vec<f64> {
        let third = values[3] != 0.0 || values[4] != 0.0;
        let sine_part = chain::first(place, 5);
        let (a, b) = (values[sine_part], values[sine_part + 1]);
        let amplitude = (a * a + b * b).sqrt();
        let hum = |t: &f64| {
            let angle = std::f64::consts::TAU * values[2] * t;
            let (sine, cosine) = sincos(angle);
            let first = a * sine + b * cosine;
            if !third {
                return first;
            }
            let (sine, cosine) = sincos(3.0 * angle);
            first + amplitude * (values[3] * sine + values[4] * cosine)
        };
        truth.time.iter().map(hum).collect()
    }
}

impl Cause for MainsHum {
    fn page(&self) -> Page {
        Page {
            happens: "A ground loop or an unshielded cable lets the mains into the displacement channel or the load cell.",
            sign: "A sine of 50 or 60 Hz, or of its alias, under everything: in holds too, whatever the load; loops ripple and their ripples do not repeat from cycle to cycle.",
            mistaken_for: &["displacement_drift", "offset_step"],
            separated_by: "Its spectrum is one line that stays where it is when the drive changes; an alias near the cycle's own rate looks like drift until the record is sampled faster.",
            formula: "U_measured = U + a sin(w t) + b cos(w t) + sqrt(a^2 + b^2) (p sin(3 w t) + q cos(3 w t)), w = 2 pi f; or so of the load cell, with A and B",
            source: "Interference of the mains, nominally 50 or 60 Hz; transformers and rectifiers add odd harmonics, the third above all.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &MainsHum
    }
    fn is_exact(&self) -> bool {
        true
    }
    fn needs_time(&self) -> bool {
        true
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        // A phase between two of these is 30 degrees from the nearer: three quarters of its fall.
        let small = 0.002;
        let mut starts = Vec::new();
        for nominal in [50.0_f64, 60.0] {
            // Over half a minute, a tenth of a hertz away is out of step three times.
            let near = |f: &&f64| (**f / nominal - 1.0).abs() < NEAR;
            let frequency = scale.mains.iter().find(near).copied();
            let frequency = frequency.unwrap_or(nominal);
            for degrees in [15.0_f64, 75.0, 135.0] {
                let (sine, cosine) = sincos(degrees.to_radians());
                let hum = |size: f64| [size * sine, size * cosine];
                let [a, b] = hum(small * scale.displacement);
                starts.push(vec![a, b, frequency, 0.0, 0.0, 0.0, 0.0]);
                if scale.judges_force {
                    let [a, b] = hum(small * scale.force);
                    starts.push(vec![0.0, 0.0, frequency, 0.0, 0.0, a, b]);
                }
            }
        }
        starts
    }
    fn refined(&self, values: &[f64], _scale: &Scale) -> Vec<f64> {
        let mut values = values.to_vec();
        values[3..5].fill(0.05);
        values
    }
    fn begun_anew(&self, values: &[f64], scale: &Scale) -> Option<Vec<f64>> {
        chain::on_the_cell(values, (2, 5), scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_sine_of_its_frequency_over_time() {
        let truth = Trajectory {
            begins: 0.0,
            test: 0,
            time: (0..=40).map(|i| -0.02 + 0.001 * f64::from(i)).collect(),
            force: vec![],
            displacement: vec![0.0; 41],
            ..Trajectory::default()
        };
        let added = MainsHum.channel(
            &[2.0, 0.5, 50.0, 0.0, 0.0, 0.0, 0.0],
            Place::DisplacementChannel,
            &truth,
        );
        // Time zero, a quarter and a half period of 20 ms later.
        for (sample, expected) in [(20, 0.5), (25, 2.0), (30, -0.5)] {
            assert!((added[sample] - expected).abs() < 1e-9);
        }
        // The third harmonic has gone three quarters of its own period where the first has one.
        let both = MainsHum.channel(
            &[2.0, 0.0, 50.0, 0.1, 0.2, 0.0, 0.0],
            Place::DisplacementChannel,
            &truth,
        );
        for (sample, expected) in [(20, 0.4), (25, 1.8), (30, -0.4)] {
            assert!((both[sample] - expected).abs() < 1e-9);
        }
        assert!(
            MainsHum
                .channel(
                    &[2.0, 0.5, 50.0, 0.0, 0.0, 0.0, 0.0],
                    Place::DisplacementChannel,
                    &Trajectory::default()
                )
                .is_empty()
        );
    }
}
