//! A specimen that settles as its peaks grow beyond what it bore before.

use super::Outsider;
use crate::causes::Scale;
use crate::joint::effect::{Effect, Place, Response, Situation};
use crate::joint::elementary::square;
use crate::joint::parameters::Parameter;

/// A lasting displacement in the load path and a compliance that is lost with it, `s = (w c − b F) max(F_peak − F_0, 0)`,
/// `F_peak` the largest |F| so far, the present one included, and w the side of the first that was beyond `F_0`.
pub struct Settling;

static PARAMETERS: [Parameter; 3] = [
    Parameter {
        name: "set",
        symbol: "c",
        unit: "m/N",
        lower: -1e12,
        upper: 1e12,
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
    Parameter {
        name: "stiffening",
        symbol: "b",
        unit: "m/N2",
        lower: -1e36,
        upper: 1e36,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "compliance that is lost per newton of peak force beyond the threshold, as of surfaces that bed in",
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
        let beyond = (memory[0].max(force.abs()) - values[1]).max(0.0);
        let per_newton = side * values[0] - values[2] * force;
        let grows = force.abs() > memory[0].max(values[1]);
        Response {
            value: per_newton * beyond,
            slope: match grows {
                true => force.signum() * per_newton - values[2] * beyond,
                false => -values[2] * beyond,
            },
            damping: 0.0,
        }
    }
}

impl Outsider for Settling {
    fn passes_for(&self, cause: &str) -> bool {
        [
            "asymmetric_friction",
            "normal_load_variation",
            "joint_opening",
            "slack_growth",
            "displacement_drift",
            "offset_step",
            "running_in",
        ]
        .contains(&cause)
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let start = |share: &f64| {
            vec![
                0.01 * scale.displacement / scale.force,
                share * scale.force,
                0.0,
            ]
        };
        STARTS.iter().map(start).collect()
    }
    fn refined(&self, values: &[f64], scale: &Scale) -> Vec<f64> {
        let stiffening = match values[2] == 0.0 {
            true => 0.01 * scale.displacement / square(scale.force),
            false => values[2],
        };
        vec![values[0], values[1], stiffening]
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
        let values = [1e-6, 10.0, 0.0];
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

    #[test]
    fn what_beds_in_is_stiffer_by_as_much_as_it_settled() {
        let values = [1e-6, 10.0, 1e-8];
        let mut memory = [0.0; 2];
        let bedded = Situation {
            force: 14.0,
            ..Situation::default()
        };
        Settling.remember(&values, &bedded, &mut memory);
        let at = |force: f64| Settling.in_series(&values, force, 0.1, &memory);
        for force in [-13.0, -2.0, 5.0, 13.9] {
            let response = at(force);
            let settled = 4e-6 - 4e-8 * force;
            assert!((response.value - settled).abs() < 1e-18, "{force}");
            assert!((response.slope + 4e-8).abs() < 1e-18, "{force}");
        }
        // Beyond the peak it settles on, with the slope of what it answers.
        let ahead = (at(16.001).value - at(15.999).value) / 0.002;
        assert!((at(16.0).slope - ahead).abs() < 1e-12, "{ahead}");
    }
}
