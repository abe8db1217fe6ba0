//! A step that the physics refuses, in every joint: everything stays as it was.

use super::bolts::{bolt_with_all_causes, bolts_with_one_cause};
use super::call_table::Hosted;
use super::communication::uniform;
use super::host::*;
use iwan::fmu::*;
use iwan::joint::Drive;

/// Between the steps of a calm history: inputs beyond all that a joint answers, at once and behind a
/// turn within the step, in no time, in a step and in a thousand years. What is refused leaves the
/// state as it was to the last bit; what is taken is taken back.
#[test]
fn with_every_cause_it_leaves_everything_as_before() {
    let mut joints = bolts_with_one_cause();
    joints.push(("no cause", Resources::new(BOLT)));
    joints.push(("all causes", bolt_with_all_causes()));
    for (name, resources) in &joints {
        for (drive, input, scale) in [
            (Drive::Force, FORCE, 0.6),
            (Drive::Displacement, DISPLACEMENT, 6e-8),
        ] {
            let (calm, troubled) = (
                Unit::stepping(resources, drive),
                Unit::stepping(resources, drive),
            );
            let (mut random, mut refused, mut behind_a_turn) = (20_261_122, 0, 0);
            let mut before = 0.0;
            for (t, force) in history().skip(1).step_by(3) {
                let state = troubled.bytes();
                let draw = |random: &mut u64, from: &[f64]| {
                    from[(uniform(random) * from.len() as f64) as usize]
                };
                let beyond = scale * draw(&mut random, &[2e3, 3e3, -2.5e3, -1e5, 1e300]);
                let size = draw(&mut random, &[0.0, 1e-3, 1.0, 3e10]);
                let turns = size > 0.0 && uniform(&mut random) < 0.5;
                if turns {
                    // From the last input a tenth of the way to the other side, then far beyond.
                    let (first, second) = (-0.4 * beyond / size, 2.4 * beyond / (size * size));
                    derive(&troubled, input, [first, second, 0.0]);
                } else {
                    troubled.ok(troubled.set(input, beyond));
                }
                let asked = troubled.bytes();
                if troubled.step(before, size) == Status::Error {
                    assert!(troubled.bytes() == asked, "{name}, {drive:?} at {t}");
                    let told = &troubled.log().last().unwrap().text;
                    assert!(
                        told.contains("full slip") || told.contains("is beyond all"),
                        "{name}, {drive:?}: {told}"
                    );
                    refused += 1;
                    behind_a_turn += usize::from(turns);
                    derive(&troubled, input, [0.0; 3]);
                } else {
                    troubled.restore(&state);
                }
                for unit in [&calm, &troubled] {
                    unit.ok(unit.set(input, scale * force));
                    unit.ok(unit.step(before, t - before));
                }
                let same = calm.bytes() == troubled.bytes();
                assert!(same, "{name}, {drive:?} at {t}");
                before = t;
            }
            println!("{name}, {drive:?}: {refused} refused, {behind_a_turn} behind a turn");
            // A displacement has an answer as long as there are numbers for it.
            assert!(drive == Drive::Displacement || behind_a_turn > 10);
        }
    }
}

/// Inputs whose work no number holds are refused, with causes or without, at once and behind a turn:
/// an infinite dissipation would stay for ever, and no saved state could hold it.
#[test]
fn an_input_beyond_numbers_is_refused() {
    for resources in [Resources::new(BOLT), bolt_with_all_causes()] {
        let unit = Unit::stepping(&resources, Drive::Displacement);
        unit.ok(unit.set(DISPLACEMENT, 1e-8));
        unit.ok(unit.step(0.0, 0.1));
        for beyond in [1e305, -1e305, 1e160, f64::MAX] {
            for turns in [false, true] {
                if turns {
                    unit.ok(unit.set(DISPLACEMENT, 1e-8));
                    derive(&unit, DISPLACEMENT, [-1.0, beyond, 0.0]);
                } else {
                    unit.ok(unit.set(DISPLACEMENT, beyond));
                }
                let asked = unit.bytes();
                assert_eq!(unit.step(0.1, 1.0), Status::Error, "{beyond} {turns}");
                assert!(unit.bytes() == asked, "{beyond} {turns}");
                let told = &unit.log().last().unwrap().text;
                assert!(told.contains("is beyond all"), "{told}");
                derive(&unit, DISPLACEMENT, [0.0; 3]);
            }
        }
        unit.ok(unit.set(DISPLACEMENT, -1e-8));
        unit.ok(unit.step(0.1, 0.1));
    }
}

/// A slider of 500 N beside a spring, softened across the whole joint: it carries 3479 N.
const SOFTENING: &str = r#"{
  "format": "iwan-joint/1", "units": "SI",
  "density": {"family": "sliders", "weight": [5e7], "slip_at": [1e-5], "elastic": 5e7},
  "series_stiffness": 2e8,
  "causes": [{"name": "cubic_stiffness", "parameters": {"cubic_compliance": 0, "across": -1e15}}]
}"#;

#[test]
fn a_force_that_a_softening_joint_does_not_carry_is_an_error() {
    let unit = Unit::stepping(&Resources::new(SOFTENING), Drive::Force);
    let answers = unit.drive(FORCE, 2970.0, 0.0, 0.1);
    for force in [3960.0, 4950.0, 9900.0, -4950.0] {
        unit.ok(unit.set(FORCE, force));
        let told = unit.error(unit.step(0.1, 0.1));
        assert!(
            told.contains("`cubic_stiffness` lets the joint carry"),
            "{told}"
        );
    }
    unit.ok(unit.set(FORCE, 2970.0));
    unit.ok(unit.step(0.1, 0.1));
    assert_eq!(unit.get(&[DISPLACEMENT]), answers[..1]);
}
