//! A joint that is put together anew for every test, or a specimen of its own in each: a little stiffer, a little more
//! firmly held.

use super::Outsider;
use crate::causes::Scale;
use crate::joint::effect::{Effect, Place, Places, Trajectory};
use crate::joint::parameters::Parameter;

/// The joint of test k answers `U (1 + g_k)` to `F (1 + p_k)`, U and F those of the first test's joint: springs `(1 +
/// p_k)/(1 + g_k)` times as stiff and break-free forces `1 + p_k` times as large, up to the sixth test.
pub struct RemadeJoint;

const fn of_test(name: &'static str, symbol: &'static str, meaning: &'static str) -> Parameter {
    Parameter {
        name,
        symbol,
        unit: "1",
        lower: -0.5,
        upper: 0.5,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning,
    }
}

const FURTHER: &str = "displacements of this test's joint over those of the first's, less one";
const FIRMER: &str = "break-free forces of this test's joint over those of the first's, less one";

static PARAMETERS: [Parameter; 10] = [
    of_test("second_displacement", "g_2", FURTHER),
    of_test("third_displacement", "g_3", FURTHER),
    of_test("fourth_displacement", "g_4", FURTHER),
    of_test("fifth_displacement", "g_5", FURTHER),
    of_test("sixth_displacement", "g_6", FURTHER),
    of_test("second_force", "p_2", FIRMER),
    of_test("third_force", "p_3", FIRMER),
    of_test("fourth_force", "p_4", FIRMER),
    of_test("fifth_force", "p_5", FIRMER),
    of_test("sixth_force", "p_6", FIRMER),
];

/// Tests behind the first that have values of their own.
const TESTS: usize = 5;

/// What joints differ by where a search begins.
const FIRST: f64 = 0.01;

/// Values with a displacement scale for every test behind the first, and a force scale where asked for.
fn begun(scale: &Scale, force: f64) -> Vec<f64> {
    let further = scale.lengths.len().saturating_sub(1).min(TESTS);
    let mut values = vec![0.0; PARAMETERS.len()];
    values[..further].fill(FIRST);
    values[TESTS..TESTS + further].fill(force);
    values
}

impl Effect for RemadeJoint {
    fn name(&self) -> &'static str {
        "remade_joint"
    }
    fn place(&self) -> Place {
        Place::DisplacementChannel
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn places(&self, values: &[f64]) -> Places {
        let moves = |scales: &[f64]| scales.iter().any(|scale| *scale != 0.0);
        [
            moves(&values[..TESTS]).then_some(Place::DisplacementChannel),
            moves(&values[TESTS..]).then_some(Place::ForceChannel),
            None,
        ]
    }
    fn follows_reading(&self) -> bool {
        true
    }
    fn channel(&self, values: &[f64], place: Place, truth: &Trajectory) -> Vec<f64> {
        let first = match place {
            Place::ForceChannel => TESTS,
            _ => 0,
        };
        let of_tests = &values[first..first + TESTS];
        let own = truth.test.checked_sub(1).and_then(|k| of_tests.get(k));
        let own = own.copied().unwrap_or(0.0);
        truth.channel(place).iter().map(|x| own * x).collect()
    }
}

impl Outsider for RemadeJoint {
    /// Only a hum does in every test what no joint does.
    fn passes_for(&self, cause: &str) -> bool {
        cause != "mains_hum"
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        match scale.lengths.len() {
            0 | 1 => Vec::new(),
            _ => vec![begun(scale, 0.0), begun(scale, FIRST)],
        }
    }
    fn plausible(&self, _values: &[f64], _scale: &Scale) -> bool {
        true
    }
    fn is_made_anew(&self) -> bool {
        true
    }
    fn stands_for_one(&self) -> bool {
        true
    }
    fn words(&self) -> &'static str {
        "another joint in every test, of another specimen or put together anew, explains the records better"
    }
    fn effect(&self) -> &'static dyn Effect {
        &RemadeJoint
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_test_has_scales_of_its_own() {
        let channel = |place: Place, test: usize| {
            let truth = Trajectory {
                test,
                time: vec![0.0, 1.0],
                force: vec![100.0, -100.0],
                displacement: vec![2e-6, -1e-6],
                ..Trajectory::default()
            };
            let mut values = vec![0.0; PARAMETERS.len()];
            (values[0], values[6]) = (0.5, -0.25);
            RemadeJoint.channel(&values, place, &truth)
        };
        assert_eq!(channel(Place::DisplacementChannel, 1), [1e-6, -0.5e-6]);
        assert_eq!(channel(Place::ForceChannel, 2), [-25.0, 25.0]);
        // The first test is what the others are compared with, and a seventh is as the first.
        for test in [0, 6, 99] {
            assert_eq!(channel(Place::DisplacementChannel, test), [0.0; 2]);
            assert_eq!(channel(Place::ForceChannel, test), [0.0; 2]);
        }
    }

    #[test]
    fn one_test_has_no_other_joint() {
        let of = |tests: usize| {
            let scale = Scale {
                lengths: vec![1.0; tests],
                ..Scale::default()
            };
            RemadeJoint.starts(&scale)
        };
        assert!(of(1).is_empty());
        let free = |values: &Vec<f64>| values.iter().filter(|v| **v != 0.0).count();
        assert_eq!(of(3).iter().map(free).collect::<Vec<_>>(), [2, 4]);
        assert_eq!(of(9).iter().map(free).collect::<Vec<_>>(), [5, 10]);
    }
}
