//! `sensor_nonlinearity`: the displacement sensor's curve is bent.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Trajectory};
use crate::joint::elementary;
use crate::joint::parameters::Parameter;

/// The sensor reads a bent curve, `U_meas = U + a U² + b U³`, or `U + a U² (1 + c U²) + b U³ (1 + d U²)`.
pub struct SensorNonlinearity;

static PARAMETERS: [Parameter; 4] = [
    Parameter {
        name: "quadratic",
        symbol: "a",
        unit: "1/m",
        lower: -1e12,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "error of the reading per square of the displacement",
    },
    Parameter {
        name: "cubic",
        symbol: "b",
        unit: "1/m2",
        lower: -1e24,
        upper: 1e24,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "error of the reading per cube of the displacement",
    },
    Parameter {
        name: "even_bend",
        symbol: "c",
        unit: "1/m2",
        lower: -1e24,
        upper: 1e24,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "growth of the quadratic error per square of the displacement",
    },
    Parameter {
        name: "odd_bend",
        symbol: "d",
        unit: "1/m2",
        lower: -1e24,
        upper: 1e24,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "growth of the cubic error per square of the displacement",
    },
];

impl Effect for SensorNonlinearity {
    fn name(&self) -> &'static str {
        "sensor_nonlinearity"
    }
    fn place(&self) -> Place {
        Place::DisplacementChannel
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn channel(&self, values: &[f64], truth: &Trajectory) -> Vec<f64> {
        let error = |u: &f64| {
            let square = u * u;
            let even = values[0] * (1.0 + values[2] * square);
            let odd = values[1] * (1.0 + values[3] * square);
            square * (even + odd * u)
        };
        truth.displacement.iter().map(error).collect()
    }
}

impl Cause for SensorNonlinearity {
    fn page(&self) -> Page {
        Page {
            happens: "Gap sensors, strain-gauged beams and optical targets have a curve that is straight only near the middle of their range.",
            sign: "Even and third harmonics that grow with the square and the cube of the displacement and follow it exactly; stiffness seems to depend on where in the range one measures; the same in every cycle and at every rate.",
            mistaken_for: &[
                "joint_opening",
                "cubic_stiffness",
                "pinning",
                "normal_load_variation",
                "sensor_saturation",
            ],
            separated_by: "A dummy specimen, or a second mounting position of the sensor: the bend moves with the sensor's range and not with the joint; contact sets in at a threshold, this from zero.",
            formula: "U_measured = U + a U^2 (1 + c U^2) + b U^3 (1 + d U^2)",
            source: "Polynomial calibration curve of a displacement transducer.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &SensorNonlinearity
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let error = 0.01;
        [[1.0, 0.05], [0.05, 1.0], [1.0, 1.0], [1.0, -1.0]]
            .iter()
            .map(|[square, cube]| {
                vec![
                    error * square / scale.displacement,
                    error * cube / elementary::square(scale.displacement),
                    0.0,
                    0.0,
                ]
            })
            .collect()
    }
    fn refined(&self, values: &[f64], scale: &Scale) -> Vec<f64> {
        let bend = -0.1 / elementary::square(scale.displacement);
        vec![values[0], values[1], bend, bend]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reading_errs_by_square_and_cube() {
        let truth = Trajectory {
            begins: 0.0,
            time: vec![0.0; 3],
            force: vec![],
            displacement: vec![-2.0, 0.0, 3.0],
        };
        assert_eq!(
            SensorNonlinearity.channel(&[0.5, 0.25, 0.0, 0.0], &truth),
            [0.0, 0.0, 11.25]
        );
        assert_eq!(
            SensorNonlinearity.channel(&[0.5, 0.25, 0.125, 0.5], &truth),
            [3.0 - 6.0, 0.0, 4.5 * 2.125 + 6.75 * 5.5]
        );
    }
}
