//! NULL for every pointer of every exported function: an error, and nothing else has happened.

use super::call_table::{Hosted, MODES, Spoiled, Turn};
use super::host::*;
use super::three_host::Three;
use iwan::fmu::*;
use iwan::joint::Drive;
use iwan::variables::guid;
use std::collections::BTreeSet;
use std::ffi::CString;
use std::ptr::{null, null_mut};

/// Each pointer of each function NULL in turn, in the first mode that allows the call.
fn of_each_pointer<U: Hosted>() {
    for json in [BOLT, BOLT_WITH_CAUSES] {
        let resources = Resources::new(json);
        let units = MODES.map(|mode| (mode, U::in_mode(mode, &resources)));
        let states = units.each_ref().map(|(_, unit)| unit.bytes());
        let mut refused = 0;
        for row in U::table() {
            let allowed = |(mode, _): &(char, U)| row.allowed_in(*mode);
            let place = units.iter().position(allowed).unwrap_or(2);
            let (unit, state) = (&units[place].1, &states[place]);
            for pointer in 0.. {
                let turn = Turn::of(pointer);
                let status = (row.call)(unit, &turn);
                let told = unit.told().unwrap_or_default();
                let what = format!("{}, pointer {pointer}: {told}", row.name);
                match turn.spoiled() {
                    Spoiled::Nothing => {
                        // As it should be, the call may have taken the unit on.
                        unit.restore(state);
                        break;
                    }
                    Spoiled::Optional => assert_eq!(status, Status::Ok, "{what}"),
                    Spoiled::Handle => assert_eq!(status, Status::Error, "{what}"),
                    Spoiled::Needed => {
                        assert_eq!(status, Status::Error, "{what}");
                        let by_mode = row.allowed.is_empty();
                        // Where no variable is of a type, that is told whatever the values are.
                        let known = told.contains("NULL") || told.contains(" variable of type ");
                        assert!(by_mode || known, "{what}");
                    }
                }
                assert!(unit.bytes() == *state, "{what}");
                refused += 1;
            }
        }
        println!("{refused} pointers");
        assert!(refused > 60);
    }
}

#[test]
fn is_refused_by_every_function_of_fmi_2() {
    of_each_pointer::<Unit>();
}

#[test]
fn is_refused_by_every_function_of_fmi_3() {
    of_each_pointer::<Three>();
}

/// Text arrays with a NULL among the texts.
#[test]
fn is_refused_within_an_array_of_texts() {
    let resources = Resources::new(BOLT);
    let (two, three) = (
        Unit::stepping(&resources, Drive::Force),
        Three::stepping(&resources, Drive::Force),
    );
    let texts = [c"logEvents".as_ptr(), null()];
    let told = two.error(unsafe { fmi2SetDebugLogging(two.handle, TRUE, 2, texts.as_ptr()) });
    assert!(told.contains("came NULL"), "{told}");
    let told = three.error(unsafe { fmi3SetDebugLogging(three.handle, 1, 2, texts.as_ptr()) });
    assert!(told.contains("came NULL"), "{told}");
}

/// Whether an instance is made with each pointer NULL in turn.
fn instances(call: impl Fn(&Turn) -> Component, free: unsafe extern "C" fn(Component)) {
    for pointer in 0.. {
        let turn = Turn::of(pointer);
        let made = call(&turn);
        match turn.spoiled() {
            Spoiled::Needed => assert!(made.is_null(), "pointer {pointer}"),
            _ => assert!(!made.is_null(), "pointer {pointer}"),
        }
        unsafe { free(made) };
        if turn.spoiled() == Spoiled::Nothing {
            assert!(pointer >= 4);
            return;
        }
    }
}

#[test]
fn makes_no_instance_where_something_must_be() {
    let resources = Resources::new(BOLT);
    let token = CString::new(guid(BOLT, Drive::Force)).unwrap();
    let place = CString::new(resources.folder.display().to_string()).unwrap();
    let (name, token, place) = (c"bolt".as_ptr(), token.as_ptr(), place.as_ptr());
    let callbacks = CallbackFunctions {
        logger: Some(variadic()),
        allocate_memory: None,
        free_memory: None,
        step_finished: None,
        component_environment: null_mut(),
    };
    let silent = CallbackFunctions {
        logger: None,
        ..callbacks
    };
    let two = |turn: &Turn| unsafe {
        let (name, token, place) = (turn.read(name), turn.read(token), turn.read(place));
        fmi2Instantiate(name, 1, token, place, turn.optional(&silent), FALSE, FALSE)
    };
    instances(two, fmi2FreeInstance);
    let three = |turn: &Turn| unsafe {
        fmi3InstantiateCoSimulation(
            turn.read(name),
            turn.read(token),
            turn.read(place),
            0,
            0,
            0,
            0,
            turn.read(&DISPLACEMENT),
            1,
            turn.optional(null::<std::ffi::c_void>()).cast_mut(),
            None,
            turn.optional(c"".as_ptr()).cast(),
        )
    };
    instances(three, fmi3FreeInstance);
    let none = null_mut();
    unsafe {
        let (name, token, place) = (null(), null(), null());
        assert!(fmi3InstantiateModelExchange(name, token, place, 0, 0, none, None).is_null());
        let (update, lock, unlock) = (null(), null(), null());
        let made = fmi3InstantiateScheduledExecution(
            name, token, place, 0, 0, none, None, update, lock, unlock,
        );
        assert!(made.is_null());
        fmi2FreeInstance(none);
        fmi3FreeInstance(none);
    }
}

/// The tables are whole: every function that the sources export is in them, or makes or frees an
/// instance, or takes no argument.
#[test]
fn is_tried_in_every_exported_function() {
    let mut waiting = vec![std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/fmu")];
    let mut exported = BTreeSet::new();
    while let Some(path) = waiting.pop() {
        if path.is_dir() {
            let entries = std::fs::read_dir(path).unwrap();
            waiting.extend(entries.map(|entry| entry.unwrap().path()));
            continue;
        }
        let text = std::fs::read_to_string(path).unwrap();
        let code = text
            .lines()
            .filter(|line| !line.trim_start().starts_with("//"));
        for word in code.flat_map(|line| line.split(|c: char| !c.is_alphanumeric() && c != '(')) {
            // A name is followed by its arguments; another pair may stand before it.
            let mut pieces = word.rsplitn(3, '(').skip(1);
            let name = pieces.next().unwrap_or_default();
            if name.starts_with("fmi2") || name.starts_with("fmi3") {
                exported.insert(name.to_owned());
            }
        }
    }
    assert_eq!(exported.len(), 34 + 75, "{exported:?}");
    let mut tried: BTreeSet<&str> = BTreeSet::from([
        "fmi2GetTypesPlatform",
        "fmi2GetVersion",
        "fmi2Instantiate",
        "fmi2FreeInstance",
        "fmi3GetVersion",
        "fmi3InstantiateCoSimulation",
        "fmi3InstantiateModelExchange",
        "fmi3InstantiateScheduledExecution",
        "fmi3FreeInstance",
    ]);
    tried.extend(Unit::table().iter().map(|row| row.name));
    tried.extend(Three::table().iter().map(|row| row.name));
    tried.extend(Unit::BESIDE.iter().chain(Three::BESIDE));
    assert_eq!(tried, exported.iter().map(String::as_str).collect());
}
