//! What a rig with a clock needs: a step allocates nothing and locks nothing.

#[path = "fmu/host.rs"]
#[allow(dead_code)] // the other half of this importer is for tests/fmu_boundary.rs
mod host;

use host::*;
use iwan::fmu::*;
use iwan::joint::Drive;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
    static LIVE: Cell<isize> = const { Cell::new(0) };
}

/// The system's allocator, counting per thread whatever is asked of it.
struct Counting;

fn count(bytes: isize) {
    // A thread that ends has no counter any more, and nothing to count.
    let _ = ALLOCATIONS.try_with(|count| count.set(count.get() + 1));
    let _ = LIVE.try_with(|live| live.set(live.get() + bytes));
}

// SAFETY: every call goes to the system's allocator as it came.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as isize);
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(-(layout.size() as isize));
        unsafe { System.dealloc(pointer, layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(size as isize - layout.size() as isize);
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Calls of the allocator, in either direction, while `body` runs.
fn allocations(body: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.get();
    body();
    ALLOCATIONS.get() - before
}

/// The bolt with these causes, as JSON objects.
fn bolt(causes: &str) -> &'static str {
    let json = BOLT.replace("\"causes\": []", &format!("\"causes\": [{causes}]"));
    Box::leak(json.into_boxed_str())
}

/// Every cause of a joint.
const CAUSES: &str = r#"
    {"name": "clearance", "parameters": {"gap": 2e-6, "seating_force": 20.0}},
    {"name": "creep", "parameters": {"compliance": 1e-9, "time_constant": 0.05,
                                    "faster": 0.5, "slower": 0.5}},
    {"name": "slack_growth", "parameters": {"growth": 1e-9, "threshold": 300.0,
                                            "seating_force": 10.0}},
    {"name": "pinning", "parameters": {"stiffness": 2e6, "gap_positive": 1e-5,
                                       "gap_negative": 2e-5,
                                       "rounding": 0, "stiffness_ratio": 1}},
    {"name": "viscous_damping", "parameters": {"coefficient": 500.0}},
    {"name": "quadratic_damping", "parameters": {"coefficient": 1e3}},
    {"name": "cubic_stiffness", "parameters": {"cubic_compliance": 1e-16}},
    {"name": "joint_opening", "parameters": {"compliance": 2e-10, "opening_force": 50.0,
                                             "rounding": 5.0}},
    {"name": "asymmetric_friction", "parameters": {"asymmetry": 0.05}},
    {"name": "normal_load_variation", "parameters": {"force_sensitivity": 1e-5}},
    {"name": "preload_loss", "parameters": {"loss": 0.05, "energy": 10.0, "tail": 0.3}},
    {"name": "running_in", "parameters": {"deficit": 0.05, "energy": 0.1, "tail": 0.0}},
    {"name": "velocity_weakening", "parameters": {"drop": 0.02, "stribeck_rate": 1e-3,
                                                  "memory": 0.01, "exponent": 0.8}},
    {"name": "static_friction_drop", "parameters": {"excess": 0.05,
                                                    "breakaway_distance": 0.0}},
    {"name": "rate_dependent_friction", "parameters": {"gain": 0.02,
                                                       "reference_rate": 1e-4, "memory": 0.01}}"#;

/// A density that is a table, and one of sliders.
const TABLE: &str = r#"{
  "format": "iwan-joint/1", "version": "0.1.0", "units": "SI",
  "density": {"family": "sliders", "weight": [4e6, 5e6, 3e6], "slip_at": [1e-6, 5e-6, 3e-5],
              "elastic": 1e6},
  "series_stiffness": 4e7, "causes": []
}"#;

const INPUT_SCALE: [(Drive, u32, f64); 2] = [
    (Drive::Force, FORCE, 1.0),
    (Drive::Displacement, DISPLACEMENT, 1e-7),
];

/// One sample of a cycle of all that an importer does between two communication points.
fn cycle(unit: &Unit, input: u32, value: f64, (before, t): (f64, f64)) {
    let references = [FORCE, DISPLACEMENT, 2, 3, 4, 5, 6, SERIES_STIFFNESS];
    let answers = [
        if input == FORCE { DISPLACEMENT } else { FORCE },
        2,
        3,
        4,
        5,
    ];
    let (mut values, mut slopes, mut time) = ([0.0; 8], [0.0; 5], 0.0);
    unsafe {
        let statuses = [
            fmi2SetReal(unit.handle, &input, 1, &value),
            fmi2DoStep(unit.handle, before, t - before, TRUE),
            fmi2GetReal(unit.handle, references.as_ptr(), 8, values.as_mut_ptr()),
            fmi2GetDirectionalDerivative(
                unit.handle,
                answers.as_ptr(),
                5,
                &input,
                1,
                &1.0,
                slopes.as_mut_ptr(),
            ),
            fmi2GetRealOutputDerivatives(
                unit.handle,
                answers.as_ptr(),
                5,
                [1; 5].as_ptr(),
                slopes.as_mut_ptr(),
            ),
            fmi2GetRealStatus(unit.handle, 2, &mut time),
        ];
        assert_eq!(statuses, [Status::Ok; 6]);
    }
}

/// The same with derivatives of the input, so that it turns inside of the step.
fn curved(unit: &Unit, input: u32, value: f64, times: (f64, f64)) {
    let size = times.1 - times.0;
    let orders = [1, 2, 3];
    let values = [
        value / size,
        -6.0 * value / size.powi(2),
        12.0 * value / size.powi(3),
    ];
    let status = unsafe {
        fmi2SetRealInputDerivatives(
            unit.handle,
            [input; 3].as_ptr(),
            3,
            orders.as_ptr(),
            values.as_ptr(),
        )
    };
    assert_eq!(status, Status::Ok);
    cycle(unit, input, value, times);
}

#[test]
fn a_step_allocates_nothing() {
    for json in [
        BOLT,
        TABLE,
        bolt(r#"{"name": "viscous_damping", "parameters": {"coefficient": 500.0}}"#),
        bolt(CAUSES),
    ] {
        let resources = Resources::new(json);
        for (drive, input, scale) in INPUT_SCALE {
            let unit = Unit::stepping(&resources, drive);
            let load: Vec<_> = history().skip(1).collect();
            let counted = allocations(|| {
                let mut before = 0.0;
                for (i, &(t, force)) in load.iter().enumerate() {
                    let value = 0.5 * scale * force;
                    if i.is_multiple_of(3) {
                        curved(&unit, input, value, (before, t));
                    } else {
                        cycle(&unit, input, value, (before, t));
                    }
                    before = t;
                }
            });
            assert_eq!(counted, 0, "{json}, {drive:?}");
        }
    }
}

/// Beyond the turning points that it remembers, and after a way back to a saved state.
#[test]
fn a_full_memory_and_a_restored_one_allocate_nothing() {
    let resources = Resources::new(BOLT);
    for (drive, input, scale) in INPUT_SCALE {
        let unit = Unit::stepping(&resources, drive);
        let swings = 2 * TURNING_POINTS;
        let ring_down = |from: usize, to: usize| {
            for i in from..to {
                let size = 700.0 * (1.0 - i as f64 / swings as f64);
                let value = scale * if i.is_multiple_of(2) { size } else { -size };
                let time = |i: usize| 1e-3 * i as f64;
                cycle(&unit, input, value, (time(i), time(i + 1)));
            }
        };
        assert_eq!(allocations(|| ring_down(0, 100)), 0);
        let state = unit.save();
        assert_eq!(allocations(|| ring_down(100, swings)), 0);
        let back = || unit.ok(unsafe { fmi2SetFMUstate(unit.handle, state) });
        assert_eq!(allocations(back), 0, "the way back to a state");
        assert_eq!(allocations(|| ring_down(100, swings)), 0);
        // In a fresh instance, which had no motion before.
        let fresh = Unit::instantiated(&resources, drive);
        fresh.ok(unsafe { fmi2SetFMUstate(fresh.handle, state) });
        let counted = allocations(|| {
            for i in 100..6000 {
                let size = 700.0 * (1.0 - f64::from(i) / 6000.0);
                let value = scale * if i % 2 == 0 { size } else { -size };
                let time = |i: i32| 1e-3 * f64::from(i);
                cycle(&fresh, input, value, (time(i), time(i + 1)));
            }
        });
        assert_eq!(counted, 0);
        unit.free_state(state);
    }
}

/// Ten thousand instances, one after another, made, moved, saved, refused and freed: not a byte is
/// left of them.
#[test]
fn ten_thousand_instances_leave_nothing_behind() {
    for json in [BOLT, BOLT_WITH_CAUSES] {
        let resources = Resources::new(json);
        let one = || {
            let unit = Unit::stepping(&resources, Drive::Force);
            cycle(&unit, FORCE, 300.0, (0.0, 0.1));
            let state = unit.save();
            unit.error(unit.step(0.1, f64::NAN));
            unit.ok(unsafe { fmi2SetFMUstate(unit.handle, state) });
            unit.free_state(state);
            unit.ok(unsafe { fmi2Reset(unit.handle) });
        };
        nothing_is_left_by_ten_thousand(one);
    }
}

/// The same under the functions of FMI 3.0.
#[test]
fn ten_thousand_instances_of_fmi_3_leave_nothing_behind() {
    use iwan::variables::guid;
    use std::ptr::{null, null_mut};
    for json in [BOLT, BOLT_WITH_CAUSES] {
        let resources = Resources::new(json);
        let token = std::ffi::CString::new(guid(json, Drive::Force)).unwrap();
        let path = std::ffi::CString::new(resources.folder.display().to_string()).unwrap();
        let ok = |status: Status| assert_eq!(status, Status::Ok);
        nothing_is_left_by_ten_thousand(|| unsafe {
            let (token, path, name) = (token.as_ptr(), path.as_ptr(), c"bolt".as_ptr());
            let none = null_mut();
            let unit = fmi3InstantiateCoSimulation(
                name,
                token,
                path,
                0,
                0,
                0,
                0,
                null(),
                0,
                none,
                None,
                null(),
            );
            assert!(!unit.is_null());
            ok(fmi3EnterInitializationMode(unit, 0, 0.0, 0.0, 0, 0.0));
            ok(fmi3ExitInitializationMode(unit));
            let ([mut event, mut end, mut early], mut time, mut state) = ([7; 3], 7.0, null_mut());
            ok(fmi3SetFloat64(unit, &FORCE, 1, &300.0, 1));
            let mut step = |size| {
                fmi3DoStep(
                    unit, 0.0, size, 1, &mut event, &mut end, &mut early, &mut time,
                )
            };
            ok(step(0.1));
            assert_eq!(step(f64::NAN), Status::Error);
            ok(fmi3GetFMUState(unit, &mut state));
            ok(fmi3SetFMUState(unit, state));
            ok(fmi3FreeFMUState(unit, &mut state));
            ok(fmi3Reset(unit));
            fmi3FreeInstance(unit);
        });
    }
}

#[track_caller]
fn nothing_is_left_by_ten_thousand(one: impl Fn()) {
    one();
    let before = LIVE.get();
    for _ in 0..10_000 {
        one();
    }
    assert_eq!(LIVE.get() - before, 0, "bytes are left");
}

/// The counter counts: a saved state is allocated.
#[test]
fn what_allocates_is_seen() {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, Drive::Force);
    assert!(allocations(|| unit.free_state(unit.save())) >= 2);
}

/// Nothing that the shared library is made of names a lock, a channel or a value per thread or
/// process that a step could wait for.
#[test]
fn nothing_in_the_library_locks() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut waiting: Vec<_> = ["joint", "causes", "fmu", "variables"]
        .map(|room| root.join(room))
        .to_vec();
    let mut read = 0;
    while let Some(path) = waiting.pop() {
        if path.is_dir() {
            waiting.extend(
                std::fs::read_dir(path)
                    .unwrap()
                    .map(|entry| entry.unwrap().path()),
            );
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        for word in [
            "Mutex",
            "RwLock",
            "OnceLock",
            "LazyLock",
            "OnceCell",
            "Condvar",
            "Barrier",
            "mpsc",
            "thread_local",
            "Atomic",
            "static mut",
            "println!",
            "sleep",
        ] {
            assert!(!text.contains(word), "{}: {word}", path.display());
        }
        read += 1;
    }
    assert!(read > 60);
}
