//! `sensor_saturation`: a channel runs out of range.

use super::{Cause, Page, Scale, chain};
use crate::joint::effect::{Effect, Place, Places, Trajectory};
use crate::joint::elementary::power;
use crate::joint::parameters::Parameter;

/// Beyond a level the reading falls behind, `U_meas = U − l(U − L₊) + l(−U − L₋)`, first by
/// `l(d) = κ L (d/L)^(p−1) d/p` with L the mean of the levels, by `κ d²/2` where p = 2; from where `dl/dd = 1` on by
/// all of the rest. κ → ∞ is a clip. The load cell may do so instead, at levels of the force.
pub struct SensorSaturation;

static PARAMETERS: [Parameter; 8] = [
    Parameter {
        name: "sharpness",
        symbol: "kappa",
        unit: "1/m",
        lower: 0.0,
        upper: 1e36,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "one over the displacement from the level to where nothing more is read (onset 2); large for a clip",
    },
    Parameter {
        name: "level_positive",
        symbol: "L_+",
        unit: "m",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "displacement towards positive U from which the reading falls behind",
    },
    Parameter {
        name: "level_negative",
        symbol: "L_-",
        unit: "m",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "displacement towards negative U from which the reading falls behind",
    },
    Parameter {
        name: "onset",
        symbol: "p",
        unit: "1",
        // Below 2 the gain falls by a jump: that is a stiffer stage, not the end of a range.
        lower: 2.0,
        upper: 16.0,
        vanishes_at: None,
        neutral: Some(2.0),
        meaning: "power of the depth with which the reading falls behind; 2: the gain falls in proportion",
    },
    Parameter {
        name: "cell_sharpness",
        symbol: "kappa_F",
        unit: "1/N",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "one over the force from the level to where the load cell reads nothing more (onset 2); large for a clip",
    },
    Parameter {
        name: "cell_level_positive",
        symbol: "F_+",
        unit: "N",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "force towards positive F from which the reading falls behind",
    },
    Parameter {
        name: "cell_level_negative",
        symbol: "F_-",
        unit: "N",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "force towards negative F from which the reading falls behind",
    },
    Parameter {
        name: "cell_onset",
        symbol: "p_F",
        unit: "1",
        lower: 2.0,
        upper: 16.0,
        vanishes_at: None,
        neutral: Some(2.0),
        meaning: "power of the depth with which the reading of the load cell falls behind",
    },
];

/// Power from which an onset that is not in proportion is refined.
const LATER: f64 = 3.0;

/// Share of the gain that a channel at the end of its range loses at least: one whose hyperbolic tangent is at 0.7 loses
/// half. Judged: a bend by `U|U|`, which this law holds with levels near zero, was taken for an end with a quarter lost, once.
const ENDS: f64 = 0.5;

/// Share of the range within which a channel that ends reads everything right.
const RIGHT: f64 = 0.5;

/// How the reading falls behind at a depth beyond a level.
struct Knee {
    sharpness: f64,
    level: f64,
    onset: f64,
    /// Depth from which nothing more is read.
    end: f64,
}

impl Knee {
    fn of(values: &[f64]) -> Knee {
        let [sharpness, positive, negative, onset] = [values[0], values[1], values[2], values[3]];
        let level = 0.5 * (positive + negative);
        let end = match onset == 2.0 {
            true => 1.0 / sharpness,
            // Nothing is read of a channel that no level lets through.
            false if level == 0.0 => 0.0,
            false => level * power(sharpness * level, 1.0 / (1.0 - onset)),
        };
        Knee {
            sharpness,
            level,
            onset,
            end,
        }
    }

    /// Share of the gain that is lost at a depth, `dl/dd`.
    fn gain_lost(&self, depth: f64) -> f64 {
        match depth.max(0.0) {
            depth if depth >= self.end => 1.0,
            depth if self.onset == 2.0 => self.sharpness * depth,
            depth => self.sharpness * self.level * power(depth / self.level, self.onset - 1.0),
        }
    }

    /// Displacement that is not read at a depth.
    fn lost(&self, depth: f64) -> f64 {
        if depth <= 0.0 || self.sharpness == 0.0 {
            0.0
        } else if depth >= self.end {
            depth - (1.0 - 1.0 / self.onset) * self.end
        } else if self.onset == 2.0 {
            0.5 * self.sharpness * depth * depth
        } else {
            let relative = power(depth / self.level, self.onset - 1.0);
            self.sharpness * self.level * relative * depth / self.onset
        }
    }
}

impl Effect for SensorSaturation {
    fn name(&self) -> &'static str {
        "sensor_saturation"
    }
    fn place(&self) -> Place {
        Place::DisplacementChannel
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn places(&self, values: &[f64]) -> Places {
        chain::places(values[0] != 0.0, values[4] != 0.0)
    }
    fn follows_reading(&self) -> bool {
        true
    }
    fn channel(&self, values: &[f64], place: Place, truth: &Trajectory) -> Vec<f64> {
        let values = &values[chain::first(place, 4)..];
        let [positive, negative] = [values[1], values[2]];
        let knee = Knee::of(values);
        let samples = truth.channel(place).iter();
        samples
            .map(|x| knee.lost(-x - negative) - knee.lost(x - positive))
            .collect()
    }
}

impl Cause for SensorSaturation {
    fn page(&self) -> Page {
        Page {
            happens: "The gap sensor, load cell, amplifier or converter reaches the end of its range: what lies beyond is read too small or not at all.",
            sign: "Tips of the loops are cut at a fixed reading, loading and unloading branches alike; below the level everything is right, at every rate and in every cycle.",
            mistaken_for: &[
                "pinning",
                "sensor_nonlinearity",
                "cubic_stiffness",
                "clearance",
            ],
            separated_by: "The reading stands still while the force goes on, and leaves the level where it met it, without the hysteresis that a pinned joint keeps; the level belongs to the range of the instrument and shows on a dummy specimen.",
            formula: "U_measured = U - l(U - L_+) + l(-U - L_-), l(d) = kappa d^2/2 up to d = 1/kappa, d - 1/(2 kappa) beyond; where the data ask for another onset kappa L (d/L)^(p - 1) d/p, L the mean of the levels, until dl/dd = 1; or so of the load cell, at levels of F",
            source: "Compression and clipping of an amplifier: gain that falls linearly to nothing.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &SensorSaturation
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let both = [0.5, 0.7, 0.85, 0.95].map(|share| [share, share]);
        let one = [[0.65, 1.5], [0.9, 1.5], [1.5, 0.65], [1.5, 0.9]];
        let mut starts = Vec::new();
        for level in both.iter().chain(&one) {
            let knee = |size: f64| [0.2 / size, level[0] * size, level[1] * size, 2.0];
            let none = [0.0, 0.0, 0.0, 2.0];
            starts.push([knee(scale.displacement), none].concat());
            starts.push([none, knee(scale.force)].concat());
        }
        starts
    }
    fn also_called(&self, values: &[f64], scale: &Scale) -> Option<&'static str> {
        let (first, range) = match values[4] != 0.0 {
            true => (4, scale.force),
            false => (0, scale.displacement),
        };
        let nearest = values[first + 1].min(values[first + 2]);
        let lost = Knee::of(&values[first..first + 4]).gain_lost(range - nearest);
        // A scale that bends from early on, and by little to its end, is no range that ends.
        (lost < ENDS && nearest < RIGHT * range).then_some("sensor_nonlinearity")
    }
    fn refined(&self, values: &[f64], _scale: &Scale) -> Vec<f64> {
        let mut values = values.to_vec();
        let onset = if values[4] != 0.0 { 7 } else { 3 };
        values[onset] = LATER;
        values
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The gain lost is the slope of what is not read, on either side of where nothing more is read.
    #[test]
    fn a_scale_that_bends_early_and_little_is_also_called_not_linear() {
        for onset in [2.0, 4.0] {
            let knee = Knee::of(&[0.25, 2.0, 1.5, onset]);
            for depth in [0.3, 1.0, 1.5] {
                let slope = (knee.lost(depth + 1e-6) - knee.lost(depth - 1e-6)) / 2e-6;
                assert!(
                    (slope - knee.gain_lost(depth)).abs() < 1e-6,
                    "{onset} {depth}"
                );
            }
            assert_eq!(knee.gain_lost(knee.end + 0.1), 1.0);
        }
        let scale = Scale {
            displacement: 10.0,
            force: 100.0,
            ..Scale::default()
        };
        let none = [0.0, 0.0, 0.0, 2.0];
        let called = |own: [f64; 4]| SensorSaturation.also_called(&[own, none].concat(), &scale);
        assert_eq!(called([0.002, 1.0, 8.0, 2.0]), Some("sensor_nonlinearity"));
        assert_eq!(called([0.02, 1.0, 8.0, 2.0]), Some("sensor_nonlinearity"));
        // More than half of the gain is lost in the end, or nothing before the end is near.
        assert_eq!(called([0.06, 1.0, 8.0, 2.0]), None);
        assert_eq!(called([0.002, 7.0, 8.0, 2.0]), None);
        let cell = [none, [0.0002, 10.0, 80.0, 2.0]].concat();
        let of_cell = SensorSaturation.also_called(&cell, &scale);
        assert_eq!(of_cell, Some("sensor_nonlinearity"));
    }

    #[test]
    fn it_clips_beyond_its_levels_and_leaves_the_rest() {
        let truth = Trajectory {
            begins: 0.0,
            test: 0,
            time: vec![0.0; 5],
            force: vec![],
            displacement: vec![-3.0, -1.0, 0.5, 2.0, 4.0],
            ..Trajectory::default()
        };
        let clip = SensorSaturation.channel(
            &[1e12, 2.0, 1.5, 2.0, 0.0, 0.0, 0.0, 2.0],
            Place::DisplacementChannel,
            &truth,
        );
        let expected = [1.5, 0.0, 0.0, 0.0, -2.0];
        assert!(clip.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9));
        // l(1.5) and l(2) with 1/kappa = 4: the knee is not passed.
        let soft = SensorSaturation.channel(
            &[0.25, 2.0, 1.5, 2.0, 0.0, 0.0, 0.0, 2.0],
            Place::DisplacementChannel,
            &truth,
        );
        assert_eq!(soft, [0.125 * 2.25, 0.0, 0.0, 0.0, -0.5]);
        // A later onset loses less within the knee, and goes on straight behind it.
        let later = SensorSaturation.channel(
            &[0.25, 2.0, 1.5, 4.0, 0.0, 0.0, 0.0, 2.0],
            Place::DisplacementChannel,
            &truth,
        );
        let expected = 0.25 * 1.75 * (2.0 / 1.75_f64).powi(3) * 2.0 / 4.0;
        assert!((later[4] + expected).abs() < 1e-15, "{later:?}");
        let knee = Knee::of(&[0.25, 2.0, 1.5, 4.0]);
        let slope = |d: f64| (knee.lost(d + 1e-7) - knee.lost(d - 1e-7)) / 2e-7;
        assert!((slope(knee.end - 1e-6) - 1.0).abs() < 1e-5);
        assert!((slope(knee.end + 1e-6) - 1.0).abs() < 1e-5);
        assert!((slope(knee.end) - 1.0).abs() < 1e-5);
    }
}
