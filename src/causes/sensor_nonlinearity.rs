//! `sensor_nonlinearity`: a sensor's curve is bent.

use super::{Cause, Page, Scale, chain};
use crate::joint::effect::{Effect, Place, Places, Trajectory};
use crate::joint::elementary;
use crate::joint::parameters::Parameter;

/// The sensor reads a bent curve, `U_meas = U + a U² + b U³`, or `U + a U² (1 + c U²) + b U³ (1 + d U²)`; or
/// the load cell does, with `A` to `D` and the force.
pub struct SensorNonlinearity;

static PARAMETERS: [Parameter; 8] = [
    Parameter {
        name: "quadratic",
        symbol: "a",
        unit: "1/m",
        lower: -1e12,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "error of the reading per square of the displacement",
    },
    Parameter {
        name: "cubic",
        symbol: "b",
        unit: "1/m2",
        lower: -1e24,
        upper: 1e24,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
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
    Parameter {
        name: "cell_quadratic",
        symbol: "A",
        unit: "1/N",
        lower: -1e12,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "error of the load cell per square of the force",
    },
    Parameter {
        name: "cell_cubic",
        symbol: "B",
        unit: "1/N2",
        lower: -1e24,
        upper: 1e24,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "error of the load cell per cube of the force",
    },
    Parameter {
        name: "cell_even_bend",
        symbol: "C",
        unit: "1/N2",
        lower: -1e24,
        upper: 1e24,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "growth of its quadratic error per square of the force",
    },
    Parameter {
        name: "cell_odd_bend",
        symbol: "D",
        unit: "1/N2",
        lower: -1e24,
        upper: 1e24,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "growth of its cubic error per square of the force",
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
    fn places(&self, values: &[f64]) -> Places {
        chain::places(
            values[0] != 0.0 || values[1] != 0.0,
            values[4] != 0.0 || values[5] != 0.0,
        )
    }
    fn follows_reading(&self) -> bool {
        true
    }
    fn channel(&self, values: &[f64], place: Place, truth: &Trajectory) -> Vec<f64> {
        let values = &values[chain::first(place, 4)..];
        let error = |x: &f64| {
            let square = x * x;
            let even = values[0] * (1.0 + values[2] * square);
            let odd = values[1] * (1.0 + values[3] * square);
            square * (even + odd * x)
        };
        truth.channel(place).iter().map(error).collect()
    }
}

impl Cause for SensorNonlinearity {
    fn page(&self) -> Page {
        Page {
            happens: "Gap sensors, strain-gauged beams, load cells and optical targets have a curve that is straight only near the middle of their range.",
            sign: "Even and third harmonics that grow with the square and the cube of the reading and follow it exactly; stiffness seems to depend on where in the range one measures; the same in every cycle and at every rate.",
            mistaken_for: &[
                "joint_opening",
                "cubic_stiffness",
                "pinning",
                "normal_load_variation",
                "sensor_saturation",
            ],
            separated_by: "A dummy specimen, or a second mounting position of the sensor: the bend moves with the sensor's range and not with the joint; contact sets in at a threshold, this from zero.",
            formula: "U_measured = U + a U^2 (1 + c U^2) + b U^3 (1 + d U^2); or so of the load cell, with A to D and the force",
            source: "Polynomial calibration curve of a displacement transducer.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &SensorNonlinearity
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let error = 0.01;
        let mut starts = Vec::new();
        for [square, cube] in [[1.0, 0.05], [0.05, 1.0], [1.0, 1.0], [1.0, -1.0]] {
            let bent = |size: f64| {
                [
                    error * square / size,
                    error * cube / elementary::square(size),
                ]
            };
            let [a, b] = bent(scale.displacement);
            starts.push(vec![a, b, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
            let [a, b] = bent(scale.force);
            starts.push(vec![0.0, 0.0, 0.0, 0.0, a, b, 0.0, 0.0]);
        }
        starts
    }
    fn refined(&self, values: &[f64], scale: &Scale) -> Vec<f64> {
        let of_cell = values[4] != 0.0 || values[5] != 0.0;
        let (size, bends) = match of_cell {
            true => (scale.force, 6..8),
            false => (scale.displacement, 2..4),
        };
        let mut values = values.to_vec();
        values[bends].fill(-0.1 / elementary::square(size));
        values
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reading_errs_by_square_and_cube() {
        let truth = Trajectory {
            begins: 0.0,
            test: 0,
            time: vec![0.0; 3],
            force: vec![],
            displacement: vec![-2.0, 0.0, 3.0],
            ..Trajectory::default()
        };
        assert_eq!(
            SensorNonlinearity.channel(
                &[0.5, 0.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
                Place::DisplacementChannel,
                &truth
            ),
            [0.0, 0.0, 11.25]
        );
        assert_eq!(
            SensorNonlinearity.channel(
                &[0.5, 0.25, 0.125, 0.5, 0.0, 0.0, 0.0, 0.0],
                Place::DisplacementChannel,
                &truth
            ),
            [3.0 - 6.0, 0.0, 4.5 * 2.125 + 6.75 * 5.5]
        );
    }
}
