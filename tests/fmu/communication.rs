//! The answer does not depend on where the communication points lie.

use super::bolts::bolts_with_one_cause;
use super::host::*;
use iwan::fmu::*;
use iwan::joint::Drive;

/// SplitMix64, uniform in [0, 1).
pub fn uniform(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

const ENERGIES: [u32; 2] = [DISSIPATION, STORED_ENERGY];

/// Turning values of a history with nested loops \[N\].
fn turning_values() -> Vec<f64> {
    let mut random = 7;
    (0..60)
        .map(|_| 900.0 * (2.0 * uniform(&mut random) - 1.0))
        .collect()
}

fn close(found: &[f64], expected: &[f64], largest: &mut [f64], what: &str) {
    for ((found, expected), largest) in found.iter().zip(expected).zip(largest) {
        *largest = largest.max(expected.abs());
        // Rounding of the sums of energy, and of the input where it is interpolated.
        let apart = (found - expected).abs();
        assert!(apart <= 1e-11 * *largest, "{what}: {found} {expected}");
    }
}

/// From one turning value to the next in one step, or in random pieces with steps of zero, of
/// 1e-17 s and of a thousand years between them, and communication points that are off by rounding.
#[test]
fn random_step_sequences_give_the_same_answer() {
    let resources = Resources::new(BOLT);
    for (drive, input, output, scale) in [
        (Drive::Force, FORCE, DISPLACEMENT, 1.0),
        (Drive::Displacement, DISPLACEMENT, FORCE, 1.2e-7),
    ] {
        let answers = [output, ENERGIES[0], ENERGIES[1], 5, 6];
        let coarse = Unit::stepping(&resources, drive);
        let mut expected = Vec::new();
        for (leg, value) in turning_values().into_iter().enumerate() {
            coarse.ok(coarse.set(input, scale * value));
            coarse.ok(coarse.step(leg as f64, 1.0));
            expected.push(coarse.get(&answers));
        }
        for seed in 0..20 {
            let mut random = 1000 + seed;
            let fine = Unit::stepping(&resources, drive);
            let (mut time, mut from) = (0.0, 0.0);
            let mut largest = [0.0; 5];
            for (value, expected) in turning_values().into_iter().zip(&expected) {
                let mut share = 0.0;
                while share < 1.0 {
                    let size = match (6.0 * uniform(&mut random)) as u32 {
                        0 => 0.0,
                        1 => 1e-17,
                        2 if uniform(&mut random) < 0.02 => 3e10,
                        _ => 0.3 * uniform(&mut random),
                    };
                    // A step in which no time passes may be a jump of the input, too.
                    share = if uniform(&mut random) < 0.05 {
                        1.0
                    } else {
                        f64::min(1.0, share + 0.3 * uniform(&mut random))
                    };
                    let now = scale * (from + (value - from) * share);
                    fine.ok(fine.set(input, now));
                    let off = 1e-9 * f64::max(1.0, time) * (2.0 * uniform(&mut random) - 1.0);
                    fine.ok(fine.step(time + off, size));
                    let mut told = f64::NAN;
                    fine.ok(unsafe { fmi2GetRealStatus(fine.handle, 2, &mut told) });
                    assert!(told >= time, "time never runs back");
                    time = told;
                }
                from = value;
                let found = fine.get(&answers);
                close(
                    &found,
                    expected,
                    &mut largest,
                    &format!("{drive:?}, {seed}"),
                );
            }
        }
    }
}

/// The state taken and put back in the middle of anything, the answers are the same to the last bit.
#[test]
fn rollback_in_the_middle_of_anything_is_bit_identical() {
    let mut joints = bolts_with_one_cause();
    joints.extend([BOLT, BOLT_WITH_CAUSES].map(|json| ("bolt", Resources::new(json))));
    let drives = [
        (Drive::Force, FORCE, DISPLACEMENT, 1.0),
        (Drive::Displacement, DISPLACEMENT, FORCE, 1e-7),
    ];
    let each = joints
        .iter()
        .flat_map(|joint| drives.map(|drive| (joint, drive)));
    for ((name, resources), (drive, input, output, scale)) in each {
        let (straight, rolled) = (
            Unit::stepping(resources, drive),
            Unit::stepping(resources, drive),
        );
        let mut random = 99;
        let mut before = 0.0;
        for (t, force) in history().skip(1) {
            let derivatives = uniform(&mut random) < 0.3;
            let lead = |unit: &Unit| {
                unit.ok(unit.set(input, scale * force));
                if derivatives {
                    let (r, o, v) = ([input; 2], [1, 2], [4e4 * scale, -8e7 * scale]);
                    unit.ok(unsafe {
                        let (r, o, v) = (r.as_ptr(), o.as_ptr(), v.as_ptr());
                        fmi2SetRealInputDerivatives(unit.handle, r, 2, o, v)
                    });
                }
            };
            lead(&straight);
            straight.ok(straight.step(before, t - before));
            // An attempt elsewhere, taken back after the input and its derivatives are set.
            lead(&rolled);
            let state = rolled.save();
            rolled.ok(rolled.set(input, -0.9 * scale * force));
            rolled.ok(rolled.step(before, 3.0 * (t - before)));
            rolled.ok(unsafe { fmi2SetFMUstate(rolled.handle, state) });
            rolled.free_state(state);
            rolled.ok(rolled.step(before, t - before));
            let answers = [output, DISSIPATION, DISSIPATION_RATE, STORED_ENERGY, 5, 6];
            let (found, expected) = (rolled.get(&answers), straight.get(&answers));
            assert_eq!(found, expected, "{name}, {drive:?} at {t}");
            before = t;
        }
        let (one, other) = (straight.save(), rolled.save());
        assert_eq!(straight.serialize(one), rolled.serialize(other));
        straight.free_state(one);
        rolled.free_state(other);
    }
}

/// Steps that rounding leaves over, of 1e-17 s or of two units in the last place, in which the input
/// nevertheless moves by a millionth of its range: over so short a time that is any rate at all.
#[test]
fn steps_left_over_by_rounding_are_no_time() {
    let (mut worst, mut names) = (0.0_f64, Vec::new());
    for (name, resources) in bolts_with_one_cause() {
        for (drive, input, scale) in [
            (Drive::Force, FORCE, 1.0),
            (Drive::Displacement, DISPLACEMENT, 1e-7),
        ] {
            let answers = [
                FORCE,
                DISPLACEMENT,
                DISSIPATION,
                STORED_ENERGY,
                DISSIPATION_RATE,
            ];
            let plain = Unit::stepping(&resources, drive);
            let left_over = Unit::stepping(&resources, drive);
            let mut random = 3;
            let (mut time, mut before, mut rows) = (0.0, 0.0, Vec::new());
            for (t, force) in history().skip(1) {
                plain.ok(plain.set(input, scale * force));
                plain.ok(plain.step(before, t - before));
                left_over.ok(left_over.set(input, scale * force));
                left_over.ok(left_over.step(time, t - time));
                time = t;
                rows.push([plain.get(&answers), left_over.get(&answers)]);
                if uniform(&mut random) < 0.5 {
                    let size = if uniform(&mut random) < 0.5 {
                        1e-17
                    } else {
                        2.0 * f64::EPSILON
                    };
                    let moved = 1e-6 * 700.0 * (2.0 * uniform(&mut random) - 1.0);
                    left_over.ok(left_over.set(input, scale * (force + moved)));
                    left_over.ok(left_over.step(time, size));
                    time += size;
                    rows.push([plain.get(&answers), left_over.get(&answers)]);
                }
                before = t;
            }
            // The power of a step that ends elsewhere, or in no time, is another.
            for place in 0..4 {
                let largest = rows
                    .iter()
                    .fold(0.0_f64, |a, [plain, _]| a.max(plain[place].abs()));
                let apart = rows.iter().fold(0.0_f64, |a, [plain, left_over]| {
                    a.max((plain[place] - left_over[place]).abs())
                });
                if apart > 1e-4 * largest {
                    names.push((name, drive, place, apart / largest));
                }
                worst = worst.max(apart / largest);
            }
            let finite = |row: &[Vec<f64>; 2]| row[1].iter().all(|value| value.is_finite());
            assert!(rows.iter().all(finite), "{name}, {drive:?}");
        }
    }
    println!("largest difference {worst:e} of the range");
    assert!(names.is_empty(), "{names:?}");
}
