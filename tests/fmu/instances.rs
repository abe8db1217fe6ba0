//! Instantiation, resource locations, NULL handles, many instances.

use super::host::*;
use super::three_host::Three;
use iwan::fmu::*;
use iwan::joint::{Drive, Simulation};
use std::ffi::CString;
use std::ptr;

#[track_caller]
fn refused(call: &Instantiate, expected: &str) {
    let log = call.call().err().expect("refused");
    let told = &log.last().expect("a refusal is told").text;
    assert!(told.starts_with("fmi2Instantiate: "), "{told}");
    assert!(told.contains(expected), "{told}");
}

#[test]
fn every_wrong_argument_is_told() {
    let resources = Resources::new(BOLT);
    let fine = || Instantiate::of(&resources, Drive::Force);
    assert!(fine().call().is_ok());
    refused(
        &Instantiate {
            name: None,
            ..fine()
        },
        "instanceName: expected a pointer, came NULL",
    );
    refused(
        &Instantiate {
            fmu_type: 0,
            ..fine()
        },
        "expected 1 (co-simulation), came 0",
    );
    refused(
        &Instantiate {
            guid: None,
            ..fine()
        },
        "fmuGUID: expected a pointer, came NULL",
    );
    let guid = Some(c"another".to_owned());
    let expected = format!(
        "fmuGUID: expected {} or ",
        iwan::variables::guid(BOLT, Drive::Force)
    );
    refused(&Instantiate { guid, ..fine() }, &expected);
    refused(
        &Instantiate {
            location: None,
            ..fine()
        },
        "the joint is in resources/joint.json",
    );
    let location = Some(c"file:///nowhere/at/all".to_owned());
    refused(
        &Instantiate { location, ..fine() },
        "/nowhere/at/all/joint.json",
    );
    let location = Some(c"http://a/b".to_owned());
    refused(
        &Instantiate { location, ..fine() },
        "fmuResourceLocation: expected a file: URI",
    );
    let location = Some(CString::new([0xff_u8, 0xfe]).unwrap());
    refused(&Instantiate { location, ..fine() }, "expected UTF-8");
}

#[test]
fn a_damaged_joint_is_told_with_its_place() {
    for json in [
        "{",
        "{}",
        r#"{"format": "iwan-joint/1", "units": "SI", "density": 7}"#,
    ] {
        let resources = Resources::new(json);
        refused(&Instantiate::of(&resources, Drive::Force), "joint.json");
    }
}

/// As a URI has it: what is no letter, digit or slash of ASCII by the bytes of UTF-8.
fn encoded(path: &str) -> String {
    let kept = |byte: u8| byte.is_ascii_alphanumeric() || b"/-._".contains(&byte);
    let each = path.bytes().map(|byte| match byte {
        byte if kept(byte) => char::from(byte).to_string(),
        byte => format!("%{byte:02X}"),
    });
    each.collect()
}

#[test]
fn every_form_of_the_location_is_understood() {
    let resources = Resources::named(BOLT, "res with space & 100% prüf 関節");
    let raw = resources.folder.display().to_string();
    let encoded = encoded(&raw);
    let token = iwan::variables::guid(BOLT, Drive::Force);
    for location in [
        format!("file://{encoded}"),
        format!("file://{encoded}/"),
        format!("file:///{encoded}"),
        format!("file:{encoded}"),
        format!("file://localhost{encoded}"),
        format!("file://{raw}"),
        format!("file://{raw}/"),
        format!("file:{raw}"),
        raw.clone(),
    ] {
        let location = CString::new(location).ok();
        let call = Instantiate {
            location,
            ..Instantiate::of(&resources, Drive::Force)
        };
        let location = call.location.clone();
        assert!(call.call().is_ok(), "{location:?}");
        let text = location.unwrap().into_string().unwrap();
        let three = Three::try_new(&resources, &token, Some(&text), false);
        assert!(three.is_ok(), "FMI 3.0: {text}");
    }
}

#[test]
fn a_host_without_logger_or_callbacks_is_served() {
    let resources = Resources::new(BOLT);
    let guid = CString::new(iwan::variables::guid(BOLT, Drive::Force)).unwrap();
    let location = CString::new(resources.uri()).unwrap();
    let silent = CallbackFunctions {
        logger: None,
        allocate_memory: None,
        free_memory: None,
        step_finished: None,
        component_environment: ptr::null_mut(),
    };
    for callbacks in [ptr::null(), &silent as *const _] {
        unsafe {
            let (name, place) = (c"quiet".as_ptr(), location.as_ptr());
            let unit = fmi2Instantiate(name, 1, guid.as_ptr(), place, callbacks, TRUE, TRUE);
            assert!(!unit.is_null());
            assert_eq!(fmi2DoStep(unit, 0.0, 1.0, TRUE), Status::Error);
            fmi2FreeInstance(unit);
            let wrong = c"wrong".as_ptr();
            assert!(fmi2Instantiate(name, 1, wrong, place, callbacks, TRUE, TRUE).is_null());
        }
    }
}

#[test]
fn a_null_handle_is_an_error_and_freeing_it_is_legal() {
    let null = ptr::null_mut();
    unsafe {
        fmi2FreeInstance(null);
        assert_eq!(fmi2Reset(null), Status::Error);
        assert_eq!(fmi2DoStep(null, 0.0, 1.0, TRUE), Status::Error);
        assert_eq!(fmi2GetReal(null, &FORCE, 1, &mut 0.0), Status::Error);
        assert_eq!(fmi2FreeFMUstate(null, ptr::null_mut()), Status::Error);
    }
}

/// Instances share nothing: each gives what it gives alone, whatever the others do meanwhile, and
/// may change threads between calls.
#[test]
fn many_instances_on_many_threads() {
    let resources = Resources::new(BOLT_WITH_CAUSES);
    let expected = |scale: f64| -> Vec<f64> {
        let mut simulation = Simulation::new(&resources.joint(), Drive::Force).unwrap();
        simulation.step(0.0, 0.0).unwrap();
        let rows = history()
            .skip(1)
            .map(|(t, force)| simulation.step(t, scale * force).unwrap());
        rows.map(|output| output.displacement).collect()
    };
    let run = |unit: Unit, scale: f64| -> (Unit, Vec<f64>) {
        let mut before = 0.0;
        let rows = history().skip(1).map(|(t, force)| {
            unit.ok(unit.set(FORCE, scale * force));
            unit.ok(unit.step(before, t - before));
            before = t;
            unit.get(&[DISPLACEMENT])[0]
        });
        let answers = rows.collect();
        (unit, answers)
    };
    std::thread::scope(|scope| {
        let threads: Vec<_> = (1..=8)
            .map(|number| {
                let unit = Unit::stepping(&resources, Drive::Force);
                let scale = f64::from(number) / 8.0;
                let (run, expected) = (&run, &expected);
                scope.spawn(move || {
                    let (unit, answers) = run(unit, scale);
                    assert_eq!(answers, expected(scale));
                    unit
                })
            })
            .collect();
        for thread in threads {
            let unit = thread.join().unwrap();
            unit.ok(unsafe { fmi2Terminate(unit.handle) });
        }
    });
}
