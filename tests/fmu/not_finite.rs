//! NaN and infinity in everything that takes a number: refused with the number named, and nothing
//! else has happened.

use super::call_table::{Hosted, MODES};
use super::host::*;
use super::three_host::Three;
use iwan::fmu::*;

/// Function, modes in which the number alone is wrong, and the call with that number.
type Row<U> = (&'static str, &'static str, fn(&U, f64) -> Status);

fn of_each_number<U: Hosted>(table: &[Row<U>]) {
    for json in [BOLT, BOLT_WITH_CAUSES] {
        let resources = Resources::new(json);
        for mode in MODES {
            let unit = U::in_mode(mode, &resources);
            let state = unit.bytes();
            for (name, allowed, call) in table {
                for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                    assert_eq!(
                        call(&unit, number),
                        Status::Error,
                        "{name} in {mode}: {number}"
                    );
                    let told = unit.told().expect("a refusal is told");
                    assert!(told.starts_with(&format!("{name}: ")), "{told}");
                    if allowed.contains(mode) {
                        assert!(told.contains(&number.to_string()), "{told}");
                    }
                    assert!(unit.bytes() == state, "{name} in {mode}: {number}");
                }
            }
        }
    }
}

#[rustfmt::skip]
#[test]
fn in_fmi_2() {
    of_each_number::<Unit>(&[
        ("fmi2SetReal", "INS", |u, x| u.set(FORCE, x)),
        ("fmi2SetReal", "IN", |u, x| u.set(SLIP_FORCE, x)),
        ("fmi2SetReal", "IN", |u, x| u.set(SERIES_STIFFNESS, x)),
        ("fmi2SetupExperiment", "I", |u, x| unsafe { fmi2SetupExperiment(u.handle, FALSE, 0.0, x, FALSE, 0.0) }),
        ("fmi2SetupExperiment", "I", |u, x| unsafe { fmi2SetupExperiment(u.handle, FALSE, 0.0, 0.0, TRUE, x) }),
        ("fmi2SetRealInputDerivatives", "INS", |u, x| unsafe { fmi2SetRealInputDerivatives(u.handle, &FORCE, 1, &1, &x) }),
        ("fmi2SetRealInputDerivatives", "INS", |u, x| unsafe { fmi2SetRealInputDerivatives(u.handle, &FORCE, 1, &2, &x) }),
        ("fmi2SetRealInputDerivatives", "INS", |u, x| unsafe { fmi2SetRealInputDerivatives(u.handle, &FORCE, 1, &3, &x) }),
        ("fmi2DoStep", "S", |u, x| u.step(x, 0.1)),
        ("fmi2DoStep", "S", |u, x| u.step(0.0, x)),
        ("fmi2GetDirectionalDerivative", "NST", |u, x| unsafe { fmi2GetDirectionalDerivative(u.handle, &DISPLACEMENT, 1, &FORCE, 1, &x, &mut 0.0) }),
    ]);
}

#[rustfmt::skip]
#[test]
fn in_fmi_3() {
    of_each_number::<Three>(&[
        ("fmi3SetFloat64", "INS", |u, x| u.set(FORCE, x)),
        ("fmi3SetFloat64", "IN", |u, x| u.set(SLIP_FORCE, x)),
        ("fmi3SetFloat64", "IN", |u, x| u.set(SERIES_STIFFNESS, x)),
        ("fmi3EnterInitializationMode", "I", |u, x| unsafe { fmi3EnterInitializationMode(u.handle, 0, 0.0, x, 0, 0.0) }),
        ("fmi3EnterInitializationMode", "I", |u, x| unsafe { fmi3EnterInitializationMode(u.handle, 0, 0.0, 0.0, 1, x) }),
        ("fmi3DoStep", "S", |u, x| u.step(x, 0.1).0),
        ("fmi3DoStep", "S", |u, x| u.step(0.0, x).0),
        ("fmi3GetDirectionalDerivative", "NST", |u, x| unsafe { fmi3GetDirectionalDerivative(u.handle, &DISPLACEMENT, 1, &FORCE, 1, &x, 1, &mut 0.0, 1) }),
        ("fmi3GetAdjointDerivative", "NST", |u, x| unsafe { fmi3GetAdjointDerivative(u.handle, &DISPLACEMENT, 1, &FORCE, 1, &x, 1, &mut 0.0, 1) }),
        // Refused for another reason, whatever the number.
        ("fmi3SetFloat32", "", |u, x| unsafe { fmi3SetFloat32(u.handle, &FORCE, 1, &(x as f32), 1) }),
        ("fmi3SetTime", "", |u, x| unsafe { fmi3SetTime(u.handle, x) }),
        ("fmi3SetContinuousStates", "", |u, x| unsafe { fmi3SetContinuousStates(u.handle, &x, 1) }),
        ("fmi3SetIntervalDecimal", "", |u, x| unsafe { fmi3SetIntervalDecimal(u.handle, &FORCE, 1, &x) }),
        ("fmi3SetShiftDecimal", "", |u, x| unsafe { fmi3SetShiftDecimal(u.handle, &FORCE, 1, &x) }),
        ("fmi3ActivateModelPartition", "", |u, x| unsafe { fmi3ActivateModelPartition(u.handle, 0, x) }),
    ]);
}
