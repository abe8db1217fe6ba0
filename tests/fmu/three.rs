//! FMI 3.0: the same physics under its functions, its own refusals.

use super::host::{ANSWERS, BOLT, BOLT_WITH_CAUSES, DISPLACEMENT, FORCE, Resources, Unit, history};
use super::three_host::Three;
use iwan::fmu::*;
use iwan::joint::Drive;
use iwan::variables::{TIME_REFERENCE, Variables, guid};
use std::ffi::CStr;
use std::ptr;

#[test]
fn the_answers_are_those_of_fmi_2_to_the_last_bit() {
    for json in [BOLT, BOLT_WITH_CAUSES] {
        let resources = Resources::new(json);
        for (drive, input, scale) in [
            (Drive::Force, FORCE, 1.0),
            (Drive::Displacement, DISPLACEMENT, 1e-7),
        ] {
            let two = Unit::stepping(&resources, drive);
            let three = Three::stepping(&resources, drive);
            let mut before = 0.0;
            for (t, force) in history().skip(1) {
                two.ok(two.set(input, scale * force));
                two.ok(two.step(before, t - before));
                three.ok(three.set(input, scale * force));
                let (status, flags, time) = three.step(before, t - before);
                three.ok(status);
                assert_eq!((flags, time), ([0; 3], before + (t - before)));
                assert_eq!(three.get(&ANSWERS), two.get(&ANSWERS));
                assert_eq!(three.get(&[TIME_REFERENCE]), [time]);
                before = t;
            }
        }
    }
}

/// Parameters and the input as they start or were set; what is calculated is that of a joint at rest.
#[test]
fn start_values_are_read_before_initialization() {
    for json in [BOLT, BOLT_WITH_CAUSES] {
        let resources = Resources::new(json);
        let joint = resources.joint();
        let variables = Variables::of(&joint, Drive::Force).unwrap();
        let references = variables.parameters.iter().map(|one| one.reference);
        let references: Vec<_> = references.collect();
        let three = Three::new(&resources, Drive::Force);
        let at_start = || {
            assert_eq!(three.get(&references), variables.values(&joint));
            assert_eq!(three.get(&[TIME_REFERENCE, FORCE]), [0.0; 2]);
            assert_eq!(three.get(&ANSWERS), [0.0; ANSWERS.len()]);
        };
        at_start();
        three.ok(three.set(FORCE, 100.0));
        assert_eq!(three.get(&[FORCE, DISPLACEMENT]), [100.0, 0.0]);
        three.ok(unsafe { fmi3Reset(three.handle) });
        at_start();
    }
}

#[test]
fn instances_that_cannot_be_are_refused() {
    let resources = Resources::new(BOLT);
    let path = resources.folder.display().to_string();
    let token = guid(BOLT, Drive::Force);
    let refused = |token: &str, path: Option<&str>, event: bool, expected: &str| {
        let told = Three::try_new(&resources, token, path, event)
            .err()
            .unwrap();
        assert!(told.starts_with("fmi3InstantiateCoSimulation: "), "{told}");
        assert!(told.contains(expected), "{told}");
    };
    let another = format!(": instantiationToken: expected {token} or ");
    refused("another", Some(&path), false, &another);
    refused("another", Some(&path), false, "came another");
    refused("#1# 50 %", Some(&path), false, "came ##1## 50 %");
    refused(&token, None, false, ": resourcePath: expected where ");
    let uri = Some("http://a/b");
    refused(&token, uri, false, ": resourcePath: expected a file: URI");
    refused(&token, Some("/nowhere/at/all/"), false, "/nowhere/at/all");
    refused(&token, Some(&path), true, "hasEventMode");
    let slash = format!("{path}/");
    assert!(Three::try_new(&resources, &token, Some(&slash), false).is_ok());
    unsafe {
        let null = ptr::null();
        let name = c"x".as_ptr();
        let none = fmi3InstantiateModelExchange(name, null, null, 0, 0, ptr::null_mut(), None);
        assert!(none.is_null());
        assert_eq!(CStr::from_ptr(fmi3GetVersion()), c"3.0");
    }
}

#[test]
fn wrong_counts_references_and_pointers_are_refused() {
    let resources = Resources::new(BOLT);
    let three = Three::stepping(&resources, Drive::Force);
    let handle = three.handle;
    let mut value = 7.0;
    unsafe {
        let told = three.error(fmi3GetFloat64(handle, &DISPLACEMENT, 1, &mut value, 2));
        assert!(told.contains("nValues: expected 1 items, came 2"), "{told}");
        three.error(fmi3SetFloat64(handle, &FORCE, 1, &1.0, 0));
        three.error(fmi3GetFloat64(handle, ptr::null(), 1, &mut value, 1));
        three.error(fmi3GetFloat64(handle, &DISPLACEMENT, 1, ptr::null_mut(), 1));
        let told = three.error(fmi3GetFloat64(handle, &4711, 1, &mut value, 1));
        assert!(
            told.contains("variable of type Float64, came 4711"),
            "{told}"
        );
        let told = three.error(fmi3SetFloat64(handle, &TIME_REFERENCE, 1, &1.0, 1));
        assert!(told.contains("independent `time`"), "{told}");
        let told = three.error(fmi3GetString(handle, &1, 1, ptr::null_mut(), 1));
        assert!(told.contains("variable of type String, came 1"), "{told}");
        let (known, unknown) = (&FORCE, &DISPLACEMENT);
        let slope = |seeds, slopes, place: *mut f64| {
            fmi3GetDirectionalDerivative(handle, unknown, 1, known, 1, &1.0, seeds, place, slopes)
        };
        let adjoint = |seeds, slopes, place: *mut f64| {
            fmi3GetAdjointDerivative(handle, unknown, 1, known, 1, &1.0, seeds, place, slopes)
        };
        three.error(slope(2, 1, &mut value));
        three.error(slope(1, 0, &mut value));
        three.error(slope(1, 1, ptr::null_mut()));
        three.error(adjoint(2, 1, &mut value));
        three.error(adjoint(1, 0, &mut value));
        three.error(adjoint(1, 1, ptr::null_mut()));
        // What is seeded for the one product is answered by the other.
        let (twice, mut two) = ([FORCE; 2], [7.0; 2]);
        let (seeds, places) = ([1.0; 2], two.as_mut_ptr());
        let (knowns, seeds) = (twice.as_ptr(), seeds.as_ptr());
        three.error(fmi3GetDirectionalDerivative(
            handle, unknown, 1, knowns, 2, seeds, 1, places, 2,
        ));
        three.error(fmi3GetAdjointDerivative(
            handle, unknown, 1, knowns, 2, seeds, 2, places, 1,
        ));
        assert_eq!(two, [7.0; 2]);
        three.ok(fmi3GetAdjointDerivative(
            handle, unknown, 1, knowns, 2, seeds, 1, places, 2,
        ));
        assert!(two[0] > 0.0 && two[0] == two[1], "{two:?}");
        let mut sum = 0.0;
        three.ok(fmi3GetDirectionalDerivative(
            handle, unknown, 1, knowns, 2, seeds, 2, &mut sum, 1,
        ));
        assert_eq!(sum, two[0] + two[1]);
        // A step whose answers find no place is not taken.
        let null = ptr::null_mut();
        let mut flag = 7;
        three.error(fmi3DoStep(
            handle, 0.0, 0.1, 1, null, &mut flag, &mut flag, &mut value,
        ));
        three.error(fmi3DoStep(
            handle,
            0.0,
            0.1,
            1,
            &mut flag,
            &mut flag,
            &mut flag,
            null.cast(),
        ));
        assert_eq!(
            (value, flag),
            (7.0, 7),
            "outputs are written only on success"
        );
        assert_eq!(three.get(&[TIME_REFERENCE]), [0.0]);
        assert_eq!(
            fmi3GetFloat64(ptr::null_mut(), known, 1, &mut value, 1),
            Status::Error
        );
        fmi3FreeInstance(ptr::null_mut());
    }
    for size in [f64::NAN, f64::INFINITY, -1e-17] {
        let (status, flags, time) = three.step(0.0, size);
        assert!(three.error(status).contains("communicationStepSize"));
        assert!(
            flags == [7; 3] && time.is_nan(),
            "outputs are written only on success"
        );
    }
}

#[test]
fn a_seed_that_is_no_finite_number_is_refused() {
    let resources = Resources::new(BOLT);
    let three = Three::stepping(&resources, Drive::Force);
    for seed in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for product in [fmi3GetDirectionalDerivative, fmi3GetAdjointDerivative] {
            let mut value = 7.0;
            let told = three.error(unsafe {
                let (unknown, known) = (&DISPLACEMENT, &FORCE);
                product(three.handle, unknown, 1, known, 1, &seed, 1, &mut value, 1)
            });
            let expected = format!("seed[0]: expected a finite number, came {seed}");
            assert!(told.contains(&expected), "{told}");
            assert_eq!(value, 7.0, "written only on success");
        }
    }
}
