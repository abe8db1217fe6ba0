//! The algorithmic tangent on both sides of a reversal, through the functions of both versions.

use super::bolts::{bolt_with_all_causes, bolts_with_one_cause};
use super::call_table::Hosted;
use super::host::*;
use super::three_host::Three;
use iwan::fmu::*;
use iwan::joint::Drive;

const SLIP: u32 = 5;
const STEP: f64 = 1e-3;
/// Width of the differences over the largest input: their error is then some 1e-6 of the slope by
/// curvature and 1e-9 by rounding.
const WIDTH: f64 = 1e-6;
/// Accepted difference over the larger slope of the two sides.
const TOLERANCE: f64 = 2e-5;

/// Slopes of the answers over the input.
fn directional(unit: &Unit, answers: &[u32], input: u32) -> Vec<f64> {
    let mut slopes = vec![f64::NAN; answers.len()];
    let (unknowns, count, places) = (answers.as_ptr(), answers.len(), slopes.as_mut_ptr());
    unit.ok(unsafe {
        fmi2GetDirectionalDerivative(unit.handle, unknowns, count, &input, 1, &1.0, places)
    });
    slopes
}

/// The same by FMI 3.0, and its transposed product with a seed on each answer in turn.
fn both_products(three: &Three, answers: &[u32], input: u32) -> [Vec<f64>; 2] {
    let count = answers.len();
    let mut slopes = vec![f64::NAN; count];
    let (handle, unknowns, places) = (three.handle, answers.as_ptr(), slopes.as_mut_ptr());
    three.ok(unsafe {
        let seed = &1.0;
        fmi3GetDirectionalDerivative(handle, unknowns, count, &input, 1, seed, 1, places, count)
    });
    let transposed = (0..count).map(|place| {
        let mut seeds = vec![0.0; count];
        seeds[place] = 1.0;
        let (seeds, mut sum) = (seeds.as_ptr(), f64::NAN);
        three.ok(unsafe {
            let sum = &mut sum;
            fmi3GetAdjointDerivative(handle, unknowns, count, &input, 1, seeds, count, sum, 1)
        });
        sum
    });
    [transposed.collect(), slopes]
}

/// To the third turning value, within a loop; time and input there.
fn to_a_reversal(unit: &Unit, input: u32, largest: f64) -> (f64, f64) {
    let (mut number, mut now) = (0, 0.0);
    for share in [1.0, -0.7, 0.6] {
        let from = now;
        for piece in 1..=10 {
            now = from + (share * largest - from) * f64::from(piece) / 10.0;
            unit.ok(unit.set(input, now));
            unit.ok(unit.step(STEP * f64::from(number), STEP));
            number += 1;
        }
    }
    (STEP * f64::from(number), now)
}

/// From one turning point a step onwards and a step back, long and hardly any: on either side the
/// slopes are those of differences to one side of the step's end (a corner of the slider set may be
/// there), and both versions and both products say the same.
#[test]
fn slopes_are_differences_on_both_sides_with_every_cause() {
    let mut joints = bolts_with_one_cause();
    joints.push(("no cause", Resources::new(BOLT)));
    joints.push(("all causes", bolt_with_all_causes()));
    assert!(joints.len() >= 17);
    let mut worst = (0.0_f64, String::new());
    for (name, resources) in &joints {
        for (drive, input, output, largest) in [
            (Drive::Force, FORCE, DISPLACEMENT, 500.0),
            (Drive::Displacement, DISPLACEMENT, FORCE, 6e-5),
        ] {
            let answers = [output, SLIP, DISSIPATION, STORED_ENERGY, DISSIPATION_RATE];
            let unit = Unit::stepping(resources, drive);
            let three = Three::stepping(resources, drive);
            let (time, here) = to_a_reversal(&unit, input, largest);
            let state = unit.bytes();
            let at = |value: f64| {
                unit.restore(&state);
                unit.ok(unit.set(input, value));
                unit.ok(unit.step(time, STEP));
                unit.get(&answers)
            };
            for way in [0.1, 1e-3] {
                let sides = [way, -way].map(|way| {
                    let end = here + way * largest;
                    let width = WIDTH * largest;
                    let (right, left) = (at(end + width), at(end - width));
                    let middle = at(end);
                    let slopes = directional(&unit, &answers, input);
                    three.restore(&state);
                    three.ok(three.set(input, end));
                    three.ok(three.step(time, STEP).0);
                    for product in both_products(&three, &answers, input) {
                        assert_eq!(product, slopes, "{name}, {drive:?}, {way}");
                    }
                    let quotients = |there: Vec<f64>, width: f64| -> Vec<f64> {
                        let pairs = there.iter().zip(&middle);
                        pairs
                            .map(|(there, middle)| (there - middle) / width)
                            .collect()
                    };
                    [slopes, quotients(right, width), quotients(left, -width)]
                });
                for place in 0..answers.len() {
                    let scale = f64::max(sides[0][0][place].abs(), sides[1][0][place].abs());
                    for (side, [slopes, right, left]) in ["onwards", "back"].iter().zip(&sides) {
                        let apart = (slopes[place] - right[place])
                            .abs()
                            .min((slopes[place] - left[place]).abs());
                        let what = format!(
                            "{name}, {drive:?}, {way} {side}, answer {}: {} for {} and {}",
                            answers[place], slopes[place], left[place], right[place]
                        );
                        if apart > worst.0 * scale {
                            worst = (apart / scale, what.clone());
                        }
                        assert!(apart <= TOLERANCE * scale, "{what}");
                    }
                }
                // The two sides are two slopes, not one; behind hardly any way a dashpot or creep
                // goes on as it did, whatever the side.
                let [onwards, back] = sides.map(|[slopes, ..]| slopes);
                let differ = |(one, other): (&f64, &f64)| (one / other - 1.0).abs() > 0.01;
                assert!(
                    way < 0.1 || onwards.iter().zip(&back).any(differ),
                    "{name}, {drive:?}: {onwards:?} {back:?}"
                );
            }
        }
    }
    println!("largest difference {:e}: {}", worst.0, worst.1);
}
