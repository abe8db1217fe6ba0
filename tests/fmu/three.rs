//! FMI 3.0: the same physics under its functions, its own call order, its refusals.

use super::host::{ANSWERS, BOLT, BOLT_WITH_CAUSES, DISPLACEMENT, FORCE, Resources, Unit, history};
use iwan::fmu::*;
use iwan::joint::Drive;
use iwan::variables::{TIME_REFERENCE, guid};
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr;

/// One FMI 3.0 instance with the last message of its log.
struct Three {
    handle: Component,
    log: Box<Option<String>>,
}

unsafe extern "C" fn logger(
    environment: *mut c_void,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
) {
    let text = |text| {
        unsafe { CStr::from_ptr(text) }
            .to_string_lossy()
            .into_owned()
    };
    assert_eq!((status, text(category).as_str()), (3, "logStatusError"));
    let log = unsafe { &mut *environment.cast::<Option<String>>() };
    *log = Some(text(message));
}

impl Three {
    fn try_new(
        resources: &Resources,
        token: &str,
        path: Option<&str>,
        event_mode: bool,
    ) -> Result<Three, String> {
        let mut log = Box::new(None);
        let token = CString::new(token).unwrap();
        let path = path.map(|path| CString::new(path).unwrap());
        let environment = ptr::from_mut(&mut *log).cast();
        let handle = unsafe {
            fmi3InstantiateCoSimulation(
                c"bolt".as_ptr(),
                token.as_ptr(),
                path.as_ref().map_or(ptr::null(), |path| path.as_ptr()),
                0,
                0,
                event_mode.into(),
                1,
                ptr::null(),
                0,
                environment,
                Some(logger),
                ptr::null(),
            )
        };
        if handle.is_null() {
            return Err(log.expect("a refusal is told"));
        }
        assert!(resources.folder.exists());
        Ok(Three { handle, log })
    }

    fn new(resources: &Resources, drive: Drive) -> Three {
        let path = resources.folder.display().to_string();
        Three::try_new(resources, &guid(resources.json, drive), Some(&path), false).unwrap()
    }

    fn stepping(resources: &Resources, drive: Drive) -> Three {
        let three = Three::new(resources, drive);
        unsafe {
            three.ok(fmi3EnterInitializationMode(
                three.handle,
                0,
                0.0,
                0.0,
                0,
                0.0,
            ));
            three.ok(fmi3ExitInitializationMode(three.handle));
        }
        three
    }

    #[track_caller]
    fn ok(&self, status: Status) {
        assert_eq!(status, Status::Ok, "{:?}", self.told());
    }

    #[track_caller]
    fn error(&self, status: Status) -> String {
        assert_eq!(status, Status::Error);
        self.told().expect("a refusal is told")
    }

    fn told(&self) -> Option<String> {
        // Written through the callback's pointer meanwhile, hence read anew.
        let log: *const Option<String> = &*self.log;
        unsafe { (*log).clone() }
    }

    fn set(&self, reference: u32, value: f64) -> Status {
        unsafe { fmi3SetFloat64(self.handle, &reference, 1, &value, 1) }
    }

    fn get(&self, references: &[u32]) -> Vec<f64> {
        let mut values = vec![f64::NAN; references.len()];
        let (count, places) = (references.len(), values.as_mut_ptr());
        self.ok(unsafe { fmi3GetFloat64(self.handle, references.as_ptr(), count, places, count) });
        values
    }

    /// Event, end, early return, time.
    fn step(&self, point: f64, size: f64) -> (Status, [u8; 3], f64) {
        let (mut flags, mut time) = ([7; 3], f64::NAN);
        let [event, terminate, early] = &mut flags;
        let status = unsafe {
            fmi3DoStep(
                self.handle,
                point,
                size,
                1,
                event,
                terminate,
                early,
                &mut time,
            )
        };
        (status, flags, time)
    }
}

impl Drop for Three {
    fn drop(&mut self) {
        unsafe { fmi3FreeInstance(self.handle) }
    }
}

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

type Call = fn(&Three) -> Status;

/// FMI 3.0, section 4.2: columns instantiated, initialization, step mode, terminated.
#[rustfmt::skip]
const TABLE: &[(&str, [bool; 4], Call)] = {
    const Y: bool = true;
    const N: bool = false;
    &[
        ("fmi3SetDebugLogging", [Y, Y, Y, Y], |u| unsafe { fmi3SetDebugLogging(u.handle, 0, 0, ptr::null()) }),
        ("fmi3EnterInitializationMode", [Y, N, N, N], |u| unsafe { fmi3EnterInitializationMode(u.handle, 0, 0.0, 0.0, 0, 0.0) }),
        ("fmi3ExitInitializationMode", [N, Y, N, N], |u| unsafe { fmi3ExitInitializationMode(u.handle) }),
        ("fmi3Terminate", [N, N, Y, N], |u| unsafe { fmi3Terminate(u.handle) }),
        ("fmi3Reset", [Y, Y, Y, Y], |u| unsafe { fmi3Reset(u.handle) }),
        ("fmi3GetFloat64", [N, Y, Y, Y], |u| unsafe { fmi3GetFloat64(u.handle, &DISPLACEMENT, 1, &mut 0.0, 1) }),
        ("fmi3GetFloat32", [N, Y, Y, Y], |u| unsafe { fmi3GetFloat32(u.handle, ptr::null(), 0, ptr::null_mut(), 0) }),
        ("fmi3SetFloat64", [Y, Y, Y, N], |u| u.set(FORCE, 0.0)),
        ("fmi3SetClock", [Y, Y, Y, N], |u| unsafe { fmi3SetClock(u.handle, ptr::null(), 0, ptr::null()) }),
        ("fmi3GetFMUState", [Y, Y, Y, Y], state_round_trip),
        ("fmi3GetDirectionalDerivative", [N, Y, Y, Y], |u| unsafe { fmi3GetDirectionalDerivative(u.handle, &DISPLACEMENT, 1, &FORCE, 1, &1.0, 1, &mut 0.0, 1) }),
        ("fmi3GetAdjointDerivative", [N, Y, Y, Y], |u| unsafe { fmi3GetAdjointDerivative(u.handle, &DISPLACEMENT, 1, &FORCE, 1, &1.0, 1, &mut 0.0, 1) }),
        ("fmi3GetOutputDerivatives", [N, N, Y, Y], |u| unsafe { fmi3GetOutputDerivatives(u.handle, &DISPLACEMENT, 1, &1, &mut 0.0, 1) }),
        ("fmi3DoStep", [N, N, Y, N], step_on),
        ("fmi3EnterEventMode", [N, N, N, N], |u| unsafe { fmi3EnterEventMode(u.handle) }),
        ("fmi3EnterStepMode", [N, N, N, N], |u| unsafe { fmi3EnterStepMode(u.handle) }),
        ("fmi3EnterConfigurationMode", [N, N, N, N], |u| unsafe { fmi3EnterConfigurationMode(u.handle) }),
        ("fmi3EvaluateDiscreteStates", [N, N, N, N], |u| unsafe { fmi3EvaluateDiscreteStates(u.handle) }),
        ("fmi3SetTime", [N, N, N, N], |u| unsafe { fmi3SetTime(u.handle, 0.0) }),
        ("fmi3ActivateModelPartition", [N, N, N, N], |u| unsafe { fmi3ActivateModelPartition(u.handle, 0, 0.0) }),
        ("fmi3GetNumberOfVariableDependencies", [N, N, N, N], |u| unsafe { fmi3GetNumberOfVariableDependencies(u.handle, 1, &mut 0) }),
    ]
};

fn step_on(three: &Three) -> Status {
    let mut time = 0.0;
    // Refused where no step would be allowed either.
    let _ = unsafe { fmi3GetFloat64(three.handle, &TIME_REFERENCE, 1, &mut time, 1) };
    three.step(time, 1e-3).0
}

fn state_round_trip(three: &Three) -> Status {
    let (mut state, mut copy, mut size) = (ptr::null_mut(), ptr::null_mut(), 0);
    let handle = three.handle;
    unsafe {
        let status = fmi3GetFMUState(handle, &mut state);
        three.ok(fmi3SerializedFMUStateSize(handle, state, &mut size));
        let mut bytes = vec![0; size];
        three.ok(fmi3SerializeFMUState(
            handle,
            state,
            bytes.as_mut_ptr(),
            size,
        ));
        three.ok(fmi3DeserializeFMUState(
            handle,
            bytes.as_ptr(),
            size,
            &mut copy,
        ));
        three.ok(fmi3SetFMUState(handle, copy));
        for mut state in [state, copy] {
            three.ok(fmi3FreeFMUState(handle, &mut state));
            assert!(state.is_null());
        }
        status
    }
}

fn after(name: &str, mode: usize) -> usize {
    match name {
        "fmi3EnterInitializationMode" => 1,
        "fmi3ExitInitializationMode" => 2,
        "fmi3Terminate" => 3,
        "fmi3Reset" => 0,
        _ => mode,
    }
}

#[track_caller]
fn obey(three: &Three, mode: usize, (name, allowed, call): &(&str, [bool; 4], Call)) -> usize {
    let status = call(three);
    if allowed[mode] {
        assert_eq!(
            status,
            Status::Ok,
            "{name} in mode {mode}: {:?}",
            three.told()
        );
        return after(name, mode);
    }
    let told = three.error(status);
    assert!(told.starts_with(&format!("{name}: expected ")), "{told}");
    mode
}

#[test]
fn every_pair_of_calls_from_every_mode() {
    let resources = Resources::new(BOLT);
    for mode in 0..4 {
        let three = Three::new(&resources, Drive::Force);
        let way: [&str; 3] = [
            "fmi3EnterInitializationMode",
            "fmi3ExitInitializationMode",
            "fmi3Terminate",
        ];
        for (reached, name) in way[..mode].iter().enumerate() {
            let row = TABLE.iter().find(|row| row.0 == *name).unwrap();
            assert_eq!(obey(&three, reached, row), reached + 1);
        }
        let mut state = ptr::null_mut();
        three.ok(unsafe { fmi3GetFMUState(three.handle, &mut state) });
        for first in TABLE {
            for second in TABLE {
                three.ok(unsafe { fmi3SetFMUState(three.handle, state) });
                let between = obey(&three, mode, first);
                obey(&three, between, second);
            }
        }
        three.ok(unsafe { fmi3FreeFMUState(three.handle, &mut state) });
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
        assert!(told.contains("Float64 variable, came 4711"), "{told}");
        let told = three.error(fmi3SetFloat64(handle, &TIME_REFERENCE, 1, &1.0, 1));
        assert!(told.contains("independent `time`"), "{told}");
        let told = three.error(fmi3GetString(handle, &1, 1, ptr::null_mut(), 1));
        assert!(told.contains("String variable, came 1"), "{told}");
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
