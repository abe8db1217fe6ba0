//! What modelDescription.xml says of the least and the largest value of an answer is so.

use super::bolts::{bolt_with_all_causes, bolts_with_one_cause};
use super::communication::uniform;
use super::host::*;
use iwan::joint::Drive;
use iwan::variables::Variables;

/// Jumps, rests, steps of every size and turns within them: no answer leaves its bounds, and those
/// that have any come down to them.
#[test]
fn no_answer_leaves_its_bounds() {
    let mut joints = bolts_with_one_cause();
    joints.push(("no cause", Resources::new(BOLT)));
    joints.push(("all causes", bolt_with_all_causes()));
    let mut touched = 0;
    for (name, resources) in &joints {
        for (drive, input, largest) in [
            (Drive::Force, FORCE, 600.0),
            (Drive::Displacement, DISPLACEMENT, 1e-4),
        ] {
            let variables = Variables::of(&resources.joint(), drive).unwrap();
            let unit = Unit::stepping(resources, drive);
            let (mut random, mut time) = (20_261_121, 0.0);
            for _ in 0..600 {
                let size = match (5.0 * uniform(&mut random)) as u32 {
                    0 => 0.0,
                    1 => 1e-17,
                    _ => 10.0_f64.powf(-4.0 * uniform(&mut random)),
                };
                let target = largest * (2.0 * uniform(&mut random) - 1.0);
                if uniform(&mut random) < 0.8 {
                    unit.ok(unit.set(input, target));
                }
                if size > 1e-6 && uniform(&mut random) < 0.3 {
                    let bent = 0.3 * largest / size;
                    derive(&unit, input, [bent, -2.0 * bent / size, 0.0]);
                }
                unit.ok(unit.step(time, size));
                time += size;
                for variable in &variables.signals {
                    let value = unit.get(&[variable.reference])[0];
                    touched += usize::from(value == variable.lower);
                    assert!(
                        variable.lower <= value && value <= variable.upper,
                        "{name}, {drive:?}: {} is {value}",
                        variable.name
                    );
                }
            }
        }
    }
    assert!(touched > 1000, "{touched}");
}

/// Energy that is lost does not come back, whatever the joint: these two have a least value, in
/// either drive, and nothing else that is answered has a bound that would always be so.
#[test]
fn what_is_lost_is_never_negative() {
    for drive in [Drive::Force, Drive::Displacement] {
        for resources in [Resources::new(BOLT), bolt_with_all_causes()] {
            let variables = Variables::of(&resources.joint(), drive).unwrap();
            for variable in variables.signals {
                let lost = [DISSIPATION, DISSIPATION_RATE].contains(&variable.reference);
                let lower = if lost { 0.0 } else { f64::NEG_INFINITY };
                assert_eq!((variable.lower, variable.upper), (lower, f64::INFINITY));
            }
        }
    }
}
