//! Every function in every mode, every pair of calls and random sequences, against the tables of both
//! versions of the standard.

use super::call_table::{Hosted, MODES};
use super::communication::uniform;
use super::host::*;
use super::three_host::Three;
use iwan::fmu::*;
use iwan::joint::Drive;
use std::ptr;

/// Every ordered pair of calls from every mode: what the first does, allowed or refused, changes
/// what is allowed for the second exactly as the table says, and what is refused changes nothing.
fn every_pair<U: Hosted>() {
    let resources = Resources::new(BOLT);
    let table = U::table();
    for mode in MODES {
        let unit = U::in_mode(mode, &resources);
        let state = unit.bytes();
        for first in &table {
            for second in &table {
                // Back in the mode of the beginning; the state carries the mode.
                unit.restore(&state);
                let between = unit.obey(mode, first);
                unit.obey(between, second);
            }
        }
    }
}

/// Long sequences in random order, on fresh instances with causes.
fn random_sequences<U: Hosted>() {
    let resources = Resources::new(BOLT_WITH_CAUSES);
    let table = U::table();
    let mut random = 20_260_101;
    let mut visited = [0; 4];
    for _ in 0..100 {
        let unit = U::instantiated(&resources);
        let mut mode = 'I';
        for _ in 0..200 {
            let place = (uniform(&mut random) * table.len() as f64) as usize;
            mode = unit.obey(mode, &table[place]);
            visited[MODES.iter().position(|other| *other == mode).unwrap()] += 1;
        }
    }
    assert!(visited.iter().all(|steps| *steps > 100), "{visited:?}");
}

/// Each on an instance that came there by the calls alone, and told with its mode where refused.
fn every_function<U: Hosted>() {
    let resources = Resources::new(BOLT);
    for row in U::table() {
        for mode in MODES {
            let unit = U::in_mode(mode, &resources);
            unit.obey(mode, &row);
            if !row.allowed.is_empty() && !row.allowed_in(mode) {
                let told = unit.told().unwrap();
                assert!(told.contains("came in mode "), "{told}");
            }
        }
    }
}

#[test]
fn every_pair_of_calls_from_every_mode() {
    every_pair::<Unit>();
}

#[test]
fn every_pair_of_calls_of_fmi_3_from_every_mode() {
    every_pair::<Three>();
}

#[test]
fn random_sequences_of_calls() {
    random_sequences::<Unit>();
}

#[test]
fn random_sequences_of_calls_of_fmi_3() {
    random_sequences::<Three>();
}

#[test]
fn every_function_in_every_mode() {
    every_function::<Unit>();
    every_function::<Three>();
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
