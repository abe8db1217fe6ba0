//! `sensor_saturation`: the displacement channel runs out of range.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Trajectory};
use crate::joint::parameters::Parameter;

/// Beyond a level a share of the displacement is lost,
/// `U_meas = U − q (U − L₊)₊ + q (−U − L₋)₊`; all of it, q = 1, is a clip.
pub struct SensorSaturation;

static PARAMETERS: [Parameter; 3] = [
    Parameter {
        name: "lost_share",
        symbol: "q",
        unit: "1",
        lower: 0.0,
        upper: 1.0,
        vanishes_at: Some(0.0),
        meaning: "share of the displacement beyond the level that is not read; 1 is a clip",
    },
    Parameter {
        name: "level_positive",
        symbol: "L_+",
        unit: "m",
        lower: 0.0,
        upper: 1.0,
        vanishes_at: None,
        meaning: "displacement towards positive U at which the range ends",
    },
    Parameter {
        name: "level_negative",
        symbol: "L_-",
        unit: "m",
        lower: 0.0,
        upper: 1.0,
        vanishes_at: None,
        meaning: "displacement towards negative U at which the range ends",
    },
];

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
    fn channel(&self, values: &[f64], truth: &Trajectory) -> Vec<f64> {
        let [share, positive, negative] = [values[0], values[1], values[2]];
        let beyond = |u: &f64| (u - positive).max(0.0) - (-u - negative).max(0.0);
        truth
            .displacement
            .iter()
            .map(|u| -share * beyond(u))
            .collect()
    }
}

impl Cause for SensorSaturation {
    fn page(&self) -> Page {
        Page {
            happens: "The gap sensor, amplifier or converter reaches the end of its range: what lies beyond is read too small or not at all.",
            sign: "Tips of the loops are cut at a fixed reading, loading and unloading branches alike; below the level everything is right, at every rate and in every cycle.",
            mistaken_for: &[
                "pinning",
                "sensor_nonlinearity",
                "cubic_stiffness",
                "clearance",
            ],
            separated_by: "The reading stands still while the force goes on, and leaves the level where it met it, without the hysteresis that a pinned joint keeps; the level belongs to the range of the instrument and shows on a dummy specimen.",
            formula: "U_measured = U - q max(U - L_+, 0) + q max(-U - L_-, 0)",
            source: "Piecewise-linear saturation of an amplifier.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &SensorSaturation
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let away = 1.5 * scale.displacement;
        let both = [0.5, 0.7, 0.85, 0.95].map(|share| [share, share]);
        let one = [[0.65, 1.5], [0.9, 1.5], [1.5, 0.65], [1.5, 0.9]];
        both.iter()
            .chain(&one)
            .map(|level| level.map(|share| (share * scale.displacement).min(away)))
            .map(|[positive, negative]| vec![0.05, positive, negative])
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_clips_beyond_its_levels_and_leaves_the_rest() {
        let truth = Trajectory {
            time: vec![0.0; 5],
            force: vec![],
            displacement: vec![-3.0, -1.0, 0.5, 2.0, 4.0],
        };
        let added = SensorSaturation.channel(&[1.0, 2.0, 1.5], &truth);
        assert_eq!(added, [1.5, 0.0, 0.0, 0.0, -2.0]);
        let half = SensorSaturation.channel(&[0.5, 2.0, 1.5], &truth);
        assert_eq!(half, [0.75, 0.0, 0.0, 0.0, -1.0]);
    }
}
