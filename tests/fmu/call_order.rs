//! Every function in every mode, against the standard's table.

use super::host::*;
use iwan::fmu::*;
use iwan::joint::Drive;
use std::ptr;

/// A function called so that nothing but the mode could be wrong.
type Call = fn(&Unit) -> Status;

const INSTANTIATED: usize = 0;
const INITIALIZATION: usize = 1;
const STEPPING: usize = 2;

fn unit_in(mode: usize, resources: &Resources) -> Unit {
    match mode {
        INSTANTIATED => Unit::instantiated(resources, Drive::Force),
        INITIALIZATION => Unit::initializing(resources, Drive::Force),
        STEPPING => Unit::stepping(resources, Drive::Force),
        _ => {
            let unit = Unit::stepping(resources, Drive::Force);
            unit.ok(unsafe { fmi2Terminate(unit.handle) });
            unit
        }
    }
}

/// FMI 2.0.4, section 4.2.4: columns instantiated, initialization, step complete, terminated (3).
#[rustfmt::skip]
const TABLE: &[(&str, [bool; 4], Call)] = {
    const Y: bool = true;
    const N: bool = false;
    &[
        ("fmi2SetDebugLogging", [Y, Y, Y, Y], |u| unsafe { fmi2SetDebugLogging(u.handle, TRUE, 0, ptr::null()) }),
        ("fmi2SetupExperiment", [Y, N, N, N], |u| unsafe { fmi2SetupExperiment(u.handle, FALSE, 0.0, 0.0, FALSE, 0.0) }),
        ("fmi2EnterInitializationMode", [Y, N, N, N], |u| unsafe { fmi2EnterInitializationMode(u.handle) }),
        ("fmi2ExitInitializationMode", [N, Y, N, N], |u| unsafe { fmi2ExitInitializationMode(u.handle) }),
        ("fmi2Terminate", [N, N, Y, N], |u| unsafe { fmi2Terminate(u.handle) }),
        ("fmi2Reset", [Y, Y, Y, Y], |u| unsafe { fmi2Reset(u.handle) }),
        ("fmi2GetReal", [N, Y, Y, Y], |u| unsafe { fmi2GetReal(u.handle, &DISPLACEMENT, 1, &mut 0.0) }),
        ("fmi2GetInteger", [N, Y, Y, Y], |u| unsafe { fmi2GetInteger(u.handle, ptr::null(), 0, ptr::null_mut()) }),
        ("fmi2GetBoolean", [N, Y, Y, Y], |u| unsafe { fmi2GetBoolean(u.handle, ptr::null(), 0, ptr::null_mut()) }),
        ("fmi2GetString", [N, Y, Y, Y], |u| unsafe { fmi2GetString(u.handle, ptr::null(), 0, ptr::null_mut()) }),
        ("fmi2SetReal", [Y, Y, Y, N], |u| unsafe { fmi2SetReal(u.handle, &FORCE, 1, &0.0) }),
        ("fmi2SetInteger", [Y, Y, Y, N], |u| unsafe { fmi2SetInteger(u.handle, ptr::null(), 0, ptr::null()) }),
        ("fmi2SetBoolean", [Y, Y, Y, N], |u| unsafe { fmi2SetBoolean(u.handle, ptr::null(), 0, ptr::null()) }),
        ("fmi2SetString", [Y, Y, Y, N], |u| unsafe { fmi2SetString(u.handle, ptr::null(), 0, ptr::null()) }),
        ("fmi2GetFMUstate", [Y, Y, Y, Y], state_round_trip),
        ("fmi2SetRealInputDerivatives", [Y, Y, Y, N], |u| unsafe { fmi2SetRealInputDerivatives(u.handle, &FORCE, 1, &1, &0.0) }),
        ("fmi2GetRealOutputDerivatives", [N, N, Y, Y], |u| unsafe { fmi2GetRealOutputDerivatives(u.handle, ptr::null(), 0, ptr::null(), ptr::null_mut()) }),
        ("fmi2GetDirectionalDerivative", [N, Y, Y, Y], |u| unsafe { fmi2GetDirectionalDerivative(u.handle, &DISPLACEMENT, 1, &FORCE, 1, &1.0, &mut 0.0) }),
        ("fmi2DoStep", [N, N, Y, N], step_on),
        ("fmi2CancelStep", [N, N, N, N], |u| unsafe { fmi2CancelStep(u.handle) }),
        ("fmi2GetStatus", [N, N, Y, Y], |u| unsafe { fmi2GetStatus(u.handle, 0, &mut Status::Error) }),
        ("fmi2GetRealStatus", [N, N, Y, Y], |u| unsafe { fmi2GetRealStatus(u.handle, 2, &mut 0.0) }),
        ("fmi2GetBooleanStatus", [N, N, Y, Y], |u| unsafe { fmi2GetBooleanStatus(u.handle, 3, &mut 7) }),
        ("fmi2GetStringStatus", [N, N, Y, Y], |u| unsafe { fmi2GetStringStatus(u.handle, 1, &mut ptr::null()) }),
    ]
};

/// A step from wherever the instance stands.
fn step_on(unit: &Unit) -> Status {
    let mut time = 0.0;
    // Refused where no step would be allowed either.
    let _ = unsafe { fmi2GetRealStatus(unit.handle, 2, &mut time) };
    unit.step(time, 1e-3)
}

/// Mode after a call that was allowed.
fn after(name: &str, mode: usize) -> usize {
    match name {
        "fmi2EnterInitializationMode" => INITIALIZATION,
        "fmi2ExitInitializationMode" => STEPPING,
        "fmi2Terminate" => 3,
        "fmi2Reset" => INSTANTIATED,
        _ => mode,
    }
}

/// Makes a call and holds its answer against the table; returns the mode afterwards.
#[track_caller]
fn obey(unit: &Unit, mode: usize, (name, allowed, call): &(&str, [bool; 4], Call)) -> usize {
    let status = call(unit);
    let expected = if allowed[mode] {
        Status::Ok
    } else {
        Status::Error
    };
    assert_eq!(
        status,
        expected,
        "{name} in mode {mode}: {:?}",
        unit.log().last()
    );
    if allowed[mode] {
        after(name, mode)
    } else {
        mode
    }
}

/// Every ordered pair of calls from every mode: what the first does, allowed or refused, changes
/// what is allowed for the second exactly as the table says.
#[test]
fn every_pair_of_calls_from_every_mode() {
    let resources = Resources::new(BOLT);
    let mut pairs = 0;
    for first in TABLE {
        for mode in 0..4 {
            let unit = unit_in(mode, &resources);
            let state = unit.save();
            for second in TABLE {
                // Back in the mode of the beginning; the state carries the mode.
                unit.ok(unsafe { fmi2SetFMUstate(unit.handle, state) });
                let between = obey(&unit, mode, first);
                obey(&unit, between, second);
                pairs += 1;
            }
            unit.free_state(state);
        }
    }
    assert_eq!(pairs, 4 * TABLE.len() * TABLE.len());
}

/// Long sequences in random order, on fresh instances.
#[test]
fn random_sequences_of_calls() {
    let resources = Resources::new(BOLT_WITH_CAUSES);
    let mut random = 20260101_u64;
    for _ in 0..100 {
        let unit = Unit::instantiated(&resources, Drive::Force);
        let mut mode = INSTANTIATED;
        for _ in 0..200 {
            random = random
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            let place = (random >> 33) as usize % TABLE.len();
            mode = obey(&unit, mode, &TABLE[place]);
        }
    }
}

/// fmi2GetFMUstate, and with its state the five functions that need one.
fn state_round_trip(unit: &Unit) -> Status {
    let mut state = ptr::null_mut();
    let status = unsafe { fmi2GetFMUstate(unit.handle, &mut state) };
    if status != Status::Ok {
        return status;
    }
    let bytes = unit.serialize(state);
    let mut copy = ptr::null_mut();
    unit.ok(unit.deserialize(&bytes, &mut copy));
    unit.ok(unsafe { fmi2SetFMUstate(unit.handle, copy) });
    unit.free_state(copy);
    unit.free_state(state);
    Status::Ok
}

#[test]
fn every_function_in_every_mode() {
    let resources = Resources::new(BOLT);
    for (name, allowed, call) in TABLE {
        for (mode, allowed) in allowed.iter().enumerate() {
            let unit = unit_in(mode, &resources);
            let status = call(&unit);
            if *allowed {
                assert_eq!(
                    status,
                    Status::Ok,
                    "{name} in mode {mode}: {:?}",
                    unit.log()
                );
            } else {
                let told = unit.error(status);
                assert!(told.starts_with(&format!("{name}: expected ")), "{told}");
                assert!(told.contains("came in mode "), "{told}");
            }
        }
    }
}

#[test]
fn what_is_not_offered_is_refused_with_its_reason() {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, Drive::Force);
    let mut sentinel = 7.0;
    let mut number = 7;
    let status = unsafe { fmi2GetIntegerStatus(unit.handle, 0, &mut number) };
    assert!(unit.error(status).contains("status kind"));
    let status = unsafe { fmi2GetRealStatus(unit.handle, 0, &mut sentinel) };
    assert!(unit.error(status).contains("fmi2LastSuccessfulTime"));
    assert_eq!(
        (sentinel, number),
        (7.0, 7),
        "outputs are written only on success"
    );
}

#[test]
fn status_answers_what_it_is_asked() {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, Drive::Force);
    unit.ok(unit.step(0.0, 0.25));
    let (mut status, mut time, mut terminated) = (Status::Error, 0.0, 7);
    let mut text = ptr::null();
    unit.ok(unsafe { fmi2GetStatus(unit.handle, 0, &mut status) });
    unit.ok(unsafe { fmi2GetRealStatus(unit.handle, 2, &mut time) });
    unit.ok(unsafe { fmi2GetBooleanStatus(unit.handle, 3, &mut terminated) });
    unit.ok(unsafe { fmi2GetStringStatus(unit.handle, 1, &mut text) });
    assert_eq!((status, time, terminated), (Status::Ok, 0.25, FALSE));
    assert_eq!(unsafe { std::ffi::CStr::from_ptr(text) }, c"");
}

#[test]
fn version_and_types() {
    let text = |pointer| unsafe { std::ffi::CStr::from_ptr(pointer) };
    assert_eq!(text(fmi2GetVersion()), c"2.0");
    assert_eq!(text(fmi2GetTypesPlatform()), c"default");
}
