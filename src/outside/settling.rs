//! A specimen that settles as its peaks grow beyond what it bore before.

use super::Outsider;
use crate::causes::Scale;
use crate::joint::effect::{Effect, Place, Response, Situation};
use crate::joint::parameters::Parameter;

/// A lasting displacement in the load path, `s = w c max(F_peak − F_0, 0)`, `F_peak` the largest |F| so far, the
/// present one included, and w the side of the first that was beyond `F_0`.
pub struct Settling;

static PARAMETERS: [Parameter; 2] = [
    Parameter {
        name: "set",
        symbol: "c",
        unit: "m/N",
        lower: -1.0,
        upper: 1.0,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "lasting displacement per newton of peak force beyond the threshold, towards the first such peak",
    },
    Parameter {
        name: "threshold",
        symbol: "F_0",
        unit: "N",
        lower: 0.0,
        upper: 1e9,
        vanishes_at: None,
        neutral: None,
        meaning: "peak force that the specimen bears without settling",
    },
];

/// Shares of the largest force from which a threshold is looked for.
const STARTS: [f64; 3] = [0.5, 0.7, 0.85];

/// Share of the largest force from which a threshold is that of high peaks alone.
const HIGH: f64 = 0.3;

impl Effect for Settling {
    fn name(&self) -> &'static str {
        "settling"
    }
    fn place(&self) -> Place {
        Place::InSeries
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    /// The largest |F| so far, and the side of the first beyond the threshold.
    fn memory(&self) -> usize {
        2
    }
    fn remember(&self, values: &[f64], now: &Situation, memory: &mut [f64]) {
        memory[0] = memory[0].max(now.force.abs());
        if memory[1] == 0.0 && now.force.abs() > values[1] {
            memory[1] = now.force.signum();
        }
    }
    fn in_series(&self, values: &[f64], force: f64, _step: f64, memory: &[f64]) -> Response {
        let side = match memory[1] == 0.0 {
            true => force.signum(),
            false => memory[1],
        };
        let set = |peak: f64| side * values[0] * (peak - values[1]).max(0.0);
        let grows = force.abs() > memory[0].max(values[1]);
        Response {
            value: set(memory[0].max(force.abs())),
            slope: match grows {
                true => side * force.signum() * values[0],
                false => 0.0,
            },
            damping: 0.0,
        }
    }
}

impl Outsider for Settling {
    fn passes_for(&self) -> &'static [&'static str] {
        &[
            "asymmetric_friction",
            "normal_load_variation",
            "joint_opening",
            "slack_growth",
            "displacement_drift",
            "offset_step",
            "running_in",
        ]
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let start =
            |share: &f64| vec![0.01 * scale.displacement / scale.force, share * scale.force];
        STARTS.iter().map(start).collect()
    }
    fn plausible(&self, values: &[f64], scale: &Scale) -> bool {
        values[1] > HIGH * scale.force
    }
    fn words(&self) -> &'static str {
        "a specimen that settles under its highest peaks explains the records better"
    }
    fn effect(&self) -> &'static dyn Effect {
        &Settling
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_specimen_settles_with_its_highest_peak_and_stays() {
        let values = [1e-6, 10.0];
        let mut memory = [0.0; 2];
        let at = |force: f64, memory: &[f64]| Settling.in_series(&values, force, 0.1, memory);
        assert_eq!(at(9.0, &memory).value, 0.0);
        // Towards the side of the first peak beyond the threshold, however it is loaded after.
        for (force, set, slope) in [
            (-12.0, -2e-6, 1e-6),
            (-3.0, -2e-6, 0.0),
            (12.0, -2e-6, 0.0),
            (14.0, -4e-6, -1e-6),
            (0.0, -4e-6, 0.0),
        ] {
            let response = at(force, &memory);
            assert!(
                (response.value - set).abs() < 1e-18,
                "{force}: {response:?}"
            );
            assert_eq!(response.slope, slope, "{force}");
            let now = Situation {
                force,
                ..Situation::default()
            };
            Settling.remember(&values, &now, &mut memory);
        }
    }
}
