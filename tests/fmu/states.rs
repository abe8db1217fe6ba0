//! Saved states: round trips, fresh instances, damaged bytes.

use super::host::*;
use iwan::fmu::*;
use iwan::joint::Drive;
use std::ptr;

/// Drives a unit over a part of the history; row 0 is the start.
fn run(unit: &Unit, rows: std::ops::Range<usize>) -> Vec<Vec<f64>> {
    let all: Vec<_> = history().collect();
    let steps = rows.map(|row| {
        let ((before, _), (t, force)) = (all[row - 1], all[row]);
        unit.drive(FORCE, force, before, t - before)
    });
    steps.collect()
}

#[test]
fn a_saved_state_continues_to_the_last_bit() {
    for json in [BOLT, BOLT_WITH_CAUSES] {
        let resources = Resources::new(json);
        let unit = Unit::stepping(&resources, Drive::Force);
        run(&unit, 1..150);
        let state = unit.save();
        let first = run(&unit, 150..390);
        unit.ok(unsafe { fmi2SetFMUstate(unit.handle, state) });
        assert_eq!(run(&unit, 150..390), first);
        unit.free_state(state);
    }
}

/// No initialization calls: the state carries mode, time, parameters and input.
#[test]
fn serialized_it_continues_in_a_fresh_instance() {
    for json in [BOLT, BOLT_WITH_CAUSES] {
        let resources = Resources::new(json);
        let old = Unit::initializing(&resources, Drive::Force);
        old.ok(old.set(SLIP_FORCE, 1100.0));
        old.ok(unsafe { fmi2ExitInitializationMode(old.handle) });
        run(&old, 1..150);
        let state = old.save();
        let bytes = old.serialize(state);
        old.free_state(state);
        let first = run(&old, 150..390);
        drop(old);
        let fresh = Unit::instantiated(&resources, Drive::Force);
        let mut state = ptr::null_mut();
        fresh.ok(fresh.deserialize(&bytes, &mut state));
        fresh.ok(unsafe { fmi2SetFMUstate(fresh.handle, state) });
        assert_eq!(fresh.get(&[SLIP_FORCE]), [1100.0]);
        assert_eq!(run(&fresh, 150..390), first);
        fresh.free_state(state);
    }
}

#[test]
fn a_state_of_any_mode_brings_that_mode_back() {
    let resources = Resources::new(BOLT);
    let unit = Unit::initializing(&resources, Drive::Force);
    let initializing = unit.save();
    unit.ok(unsafe { fmi2ExitInitializationMode(unit.handle) });
    unit.ok(unsafe { fmi2Terminate(unit.handle) });
    let terminated = unit.save();
    unit.ok(unsafe { fmi2SetFMUstate(unit.handle, initializing) });
    unit.ok(unsafe { fmi2ExitInitializationMode(unit.handle) });
    unit.ok(unit.step(0.0, 1.0));
    unit.ok(unsafe { fmi2SetFMUstate(unit.handle, terminated) });
    unit.error(unit.step(0.0, 1.0));
    unit.free_state(initializing);
    unit.free_state(terminated);
}

/// The state holds the turning points in memory, so its length follows the history; a handle that
/// holds a state already is used again.
#[test]
fn length_follows_the_memory_and_a_handle_is_used_again() {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, Drive::Force);
    let mut state = unit.save();
    let short = unit.serialize(state).len();
    let place = state;
    for (number, force) in [800.0, -600.0, 400.0, -200.0, 100.0]
        .into_iter()
        .enumerate()
    {
        unit.drive(FORCE, force, number as f64, 1.0);
    }
    unit.ok(unsafe { fmi2GetFMUstate(unit.handle, &mut state) });
    assert_eq!(state, place);
    assert!(unit.serialize(state).len() > short);
    unit.free_state(state);
}

#[test]
fn damaged_bytes_are_refused() {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, Drive::Force);
    run(&unit, 1..50);
    let state = unit.save();
    let bytes = unit.serialize(state);
    let mut place = ptr::null_mut();
    for length in 0..bytes.len() {
        let told = unit.error(unit.deserialize(&bytes[..length], &mut place));
        assert!(told.contains("erializedState"), "{length}: {told}");
    }
    let longer = [&bytes[..], &[0]].concat();
    assert!(
        unit.error(unit.deserialize(&longer, &mut place))
            .contains("bytes, came")
    );
    let spoil = |at: usize, value: u8| {
        let mut spoiled = bytes.clone();
        spoiled[at] = value;
        spoiled
    };
    let told = |bytes: Vec<u8>| {
        let mut place = ptr::null_mut();
        let told = unit.error(unit.deserialize(&bytes, &mut place));
        assert!(place.is_null(), "outputs are written only on success");
        told
    };
    assert!(told(spoil(0, b'?')).contains("came other bytes"));
    assert!(told(spoil(8, 9)).contains("layout version 2, came 9"));
    assert!(told(spoil(20, b'?')).contains("expected one of joint"));
    assert!(told(spoil(56, 77)).contains("mode is damaged"));
    assert!(told(spoil(57, 0xff)).contains("flags is damaged"));
    // A joint in Step Mode that does not move would answer zero to everything, and say OK.
    assert_eq!(bytes[57], 0b10);
    assert!(told(spoil(57, 0)).contains("flags is damaged"));
    // Time, input and its first derivative that are no numbers: 0x7ff8….
    for (place, field) in [(58, "time"), (74, "input"), (82, "derivatives")] {
        let mut spoiled = bytes.clone();
        spoiled[place..place + 8].copy_from_slice(&f64::NAN.to_le_bytes());
        let damaged = format!("{field} is damaged");
        assert!(told(spoiled).contains(&damaged), "{damaged}");
    }
    assert!(told(spoil(177, 0xff)).contains("parameters is damaged"));
    unit.free_state(state);
    // Nor is what a joint with effects remembers: its last number.
    let resources = Resources::new(BOLT_WITH_CAUSES);
    let unit = Unit::stepping(&resources, Drive::Force);
    run(&unit, 1..50);
    let state = unit.save();
    let mut bytes = unit.serialize(state);
    let last = bytes.len() - 8;
    bytes[last..].copy_from_slice(&f64::NAN.to_le_bytes());
    let told = unit.error(unit.deserialize(&bytes, &mut place));
    assert!(told.contains("simulation is damaged"), "{told}");
    unit.free_state(state);
}

/// Every byte flipped in turn: refused or taken, never a crash, and what is refused changes
/// nothing.
#[test]
fn no_flipped_byte_breaks_anything() {
    for json in [BOLT, BOLT_WITH_CAUSES] {
        let resources = Resources::new(json);
        let unit = Unit::stepping(&resources, Drive::Force);
        run(&unit, 1..50);
        let state = unit.save();
        let bytes = unit.serialize(state);
        let mut refused = 0;
        for at in 0..bytes.len() {
            let mut flipped = bytes.clone();
            flipped[at] ^= 0x80;
            let mut other = ptr::null_mut();
            if unit.deserialize(&flipped, &mut other) == Status::Ok {
                let before = unit.get(&ANSWERS);
                if unsafe { fmi2SetFMUstate(unit.handle, other) } == Status::Ok {
                    // Whatever it says now, it must step or refuse.
                    let _ = unit.step(0.049, 1e-3);
                    unit.ok(unsafe { fmi2SetFMUstate(unit.handle, state) });
                } else {
                    refused += 1;
                    assert_eq!(unit.get(&ANSWERS), before);
                }
                unit.free_state(other);
            } else {
                refused += 1;
            }
        }
        assert!(refused >= 58, "all of the head but a stop time is checked");
        assert!(
            unit.log()
                .iter()
                .all(|message| !message.text.contains("defect"))
        );
        unit.free_state(state);
    }
}

#[test]
fn a_state_of_another_joint_or_drive_is_refused() {
    let (bolt, other) = (Resources::new(BOLT), Resources::new(BOLT_WITH_CAUSES));
    let unit = Unit::stepping(&bolt, Drive::Force);
    for stranger in [
        Unit::stepping(&bolt, Drive::Displacement),
        Unit::stepping(&other, Drive::Force),
    ] {
        let state = stranger.save();
        let status = unsafe { fmi2SetFMUstate(unit.handle, state) };
        assert!(unit.error(status).contains("expected one of joint"));
        stranger.free_state(state);
    }
}

#[test]
fn null_states_are_refused_and_freeing_them_is_legal() {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, Drive::Force);
    let handle = unit.handle;
    unsafe {
        unit.error(fmi2GetFMUstate(handle, ptr::null_mut()));
        unit.error(fmi2SetFMUstate(handle, ptr::null_mut()));
        unit.error(fmi2SerializedFMUstateSize(handle, ptr::null_mut(), &mut 0));
        unit.ok(fmi2FreeFMUstate(handle, ptr::null_mut()));
        unit.ok(fmi2FreeFMUstate(handle, &mut ptr::null_mut()));
        let state = unit.save();
        unit.error(fmi2SerializedFMUstateSize(handle, state, ptr::null_mut()));
        let mut small = [0_u8; 8];
        let status = fmi2SerializeFMUstate(handle, state, small.as_mut_ptr().cast(), 8);
        assert!(unit.error(status).contains("bytes, came 8"));
        assert_eq!(small, [0; 8], "outputs are written only on success");
        unit.error(fmi2DeSerializeFMUstate(
            handle,
            ptr::null(),
            100,
            &mut ptr::null_mut(),
        ));
        unit.free_state(state);
    }
}
