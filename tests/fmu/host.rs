//! An importer in miniature: it calls the exported C functions and collects the log.

use iwan::fmu::*;
use iwan::joint::{Drive, Joint};
use iwan::variables::{Variables, guid};
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::path::PathBuf;
use std::ptr;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Segalman's four parameters behind a finite spring: it slips as a whole at 1000 N.
pub const BOLT: &str = r#"{
  "format": "iwan-joint/1", "version": "0.1.0", "units": "SI",
  "density": {"family": "four_parameter", "slip_force": 1000.0, "stiffness": 1.5e7,
              "exponent": -0.4, "ratio": 0.3},
  "series_stiffness": 4e7,
  "causes": []
}"#;

/// The same with a rate-dependent and a history-dependent cause.
pub const BOLT_WITH_CAUSES: &str = r#"{
  "format": "iwan-joint/1", "version": "0.1.0", "units": "SI",
  "density": {"family": "four_parameter", "slip_force": 1000.0, "stiffness": 1.5e7,
              "exponent": -0.4, "ratio": 0.3},
  "series_stiffness": 4e7,
  "causes": [
    {"name": "pinning", "parameters": {"stiffness": 2e6, "gap_positive": 1e-5,
                                       "gap_negative": 2e-5, "rounding": 0, "stiffness_ratio": 1}},
    {"name": "viscous_damping", "parameters": {"coefficient": 500.0}}
  ]
}"#;

pub const FORCE: u32 = 0;
pub const DISPLACEMENT: u32 = 1;
pub const DISSIPATION: u32 = 2;
pub const DISSIPATION_RATE: u32 = 3;
pub const STORED_ENERGY: u32 = 4;
pub const SERIES_STIFFNESS: u32 = 100;
pub const SLIP_FORCE: u32 = 101;
/// Everything that is answered when driven in force.
pub const ANSWERS: [u32; 6] = [1, 2, 3, 4, 5, 6];

/// An archive's folder `resources` on disk, gone at the end.
pub struct Resources {
    pub folder: PathBuf,
    pub json: &'static str,
}

impl Resources {
    pub fn new(json: &'static str) -> Resources {
        Resources::named(json, "resources")
    }

    pub fn named(json: &'static str, name: &str) -> Resources {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let parent = std::env::temp_dir().join(format!("iwan-fmu-{}-{number}", std::process::id()));
        let folder = parent.join(name);
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("joint.json"), json).unwrap();
        Resources { folder, json }
    }

    pub fn uri(&self) -> String {
        format!("file://{}", self.folder.display())
    }

    pub fn joint(&self) -> Joint {
        iwan::saved::read(self.json, "joint.json").unwrap().joint
    }
}

impl Drop for Resources {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(self.folder.parent().unwrap());
    }
}

/// One message as the host's printf shows it.
#[derive(Debug, Clone, PartialEq)]
pub struct Message {
    pub instance: String,
    pub status: c_int,
    pub category: String,
    /// As it came, to be taken as a format.
    pub format: String,
    /// As printed with no arguments.
    pub text: String,
}

/// Takes messages; `environment` is a [`Log`].
unsafe extern "C" fn logger(
    environment: *mut c_void,
    instance: *const c_char,
    status: c_int,
    category: *const c_char,
    format: *const c_char,
) {
    let read = |text| unsafe { CStr::from_ptr(text) }.to_str().unwrap().to_owned();
    let mut printed = [0 as c_char; 4096];
    unsafe { libc::snprintf(printed.as_mut_ptr(), printed.len(), format) };
    let message = Message {
        instance: read(instance),
        status,
        category: read(category),
        format: read(format),
        text: read(printed.as_ptr()),
    };
    unsafe { &mut *environment.cast::<Log>() }.0.push(message);
}

/// The logger as the variadic function that C has. Rust cannot define one on stable; on the
/// System V and AAPCS64 conventions of Linux fixed arguments travel the same way in both kinds.
pub fn variadic() -> Logger {
    type Fixed =
        unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char);
    unsafe { std::mem::transmute::<Fixed, Logger>(logger) }
}

/// The messages, at a place that stays: the logger writes there.
#[derive(Default)]
struct Log(Vec<Message>);

/// One instance with its log.
pub struct Unit {
    pub handle: Component,
    log: Box<Log>,
}

// Handles may be used from different threads one after another.
unsafe impl Send for Unit {}

/// What is given to fmi2Instantiate; fields may be spoiled one by one.
pub struct Instantiate {
    pub name: Option<CString>,
    pub fmu_type: c_int,
    pub guid: Option<CString>,
    pub location: Option<CString>,
    pub logging_on: bool,
}

impl Instantiate {
    pub fn of(resources: &Resources, drive: Drive) -> Instantiate {
        Instantiate {
            name: Some(c"bolt".to_owned()),
            fmu_type: 1,
            guid: CString::new(guid(resources.json, drive)).ok(),
            location: CString::new(resources.uri()).ok(),
            logging_on: false,
        }
    }

    /// The instance, or the log where it is refused.
    pub fn call(&self) -> Result<Unit, Vec<Message>> {
        let pointer = |text: &Option<CString>| text.as_ref().map_or(ptr::null(), |t| t.as_ptr());
        let mut log = Box::new(Log::default());
        let callbacks = CallbackFunctions {
            logger: Some(variadic()),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            component_environment: ptr::from_mut(&mut *log).cast(),
        };
        let handle = unsafe {
            fmi2Instantiate(
                pointer(&self.name),
                self.fmu_type,
                pointer(&self.guid),
                pointer(&self.location),
                &callbacks,
                FALSE,
                self.logging_on.into(),
            )
        };
        if handle.is_null() {
            Err(log.0)
        } else {
            Ok(Unit { handle, log })
        }
    }
}

impl Unit {
    pub fn instantiated(resources: &Resources, drive: Drive) -> Unit {
        Instantiate::of(resources, drive)
            .call()
            .unwrap_or_else(|log| panic!("{log:?}"))
    }

    pub fn initializing(resources: &Resources, drive: Drive) -> Unit {
        let unit = Unit::instantiated(resources, drive);
        unit.ok(unsafe { fmi2SetupExperiment(unit.handle, FALSE, 0.0, 0.0, FALSE, 0.0) });
        unit.ok(unsafe { fmi2EnterInitializationMode(unit.handle) });
        unit
    }

    pub fn stepping(resources: &Resources, drive: Drive) -> Unit {
        let unit = Unit::initializing(resources, drive);
        unit.ok(unsafe { fmi2ExitInitializationMode(unit.handle) });
        unit
    }

    /// Fails with the log unless the status is OK.
    #[track_caller]
    pub fn ok(&self, status: Status) {
        assert_eq!(status, Status::Ok, "{:?}", self.log());
    }

    /// Fails unless the status is an error, and returns its message.
    #[track_caller]
    pub fn error(&self, status: Status) -> String {
        assert_eq!(status, Status::Error, "{:?}", self.log());
        self.log().last().expect("a refusal is told").text.clone()
    }

    pub fn log(&self) -> &[Message] {
        // Written through the callback's pointer meanwhile, hence read anew.
        let log: *const Log = &*self.log;
        unsafe { (*log).0.as_slice() }
    }

    pub fn set(&self, reference: u32, value: f64) -> Status {
        unsafe { fmi2SetReal(self.handle, &reference, 1, &value) }
    }

    #[track_caller]
    pub fn get(&self, references: &[u32]) -> Vec<f64> {
        let mut values = vec![f64::NAN; references.len()];
        let (count, places) = (references.len(), values.as_mut_ptr());
        self.ok(unsafe { fmi2GetReal(self.handle, references.as_ptr(), count, places) });
        values
    }

    pub fn step(&self, point: f64, size: f64) -> Status {
        unsafe { fmi2DoStep(self.handle, point, size, TRUE) }
    }

    /// Sets the input and steps; answers all outputs and locals.
    #[track_caller]
    pub fn drive(&self, reference: u32, value: f64, point: f64, size: f64) -> Vec<f64> {
        self.ok(self.set(reference, value));
        self.ok(self.step(point, size));
        self.get(&ANSWERS)
    }

    pub fn save(&self) -> FmuState {
        let mut state = ptr::null_mut();
        self.ok(unsafe { fmi2GetFMUstate(self.handle, &mut state) });
        state
    }

    pub fn free_state(&self, mut state: FmuState) {
        self.ok(unsafe { fmi2FreeFMUstate(self.handle, &mut state) });
        assert!(state.is_null());
    }

    pub fn serialize(&self, state: FmuState) -> Vec<u8> {
        let mut size = 0;
        self.ok(unsafe { fmi2SerializedFMUstateSize(self.handle, state, &mut size) });
        let mut bytes = vec![0_u8; size];
        let place = bytes.as_mut_ptr().cast();
        self.ok(unsafe { fmi2SerializeFMUstate(self.handle, state, place, size) });
        bytes
    }

    pub fn deserialize(&self, bytes: &[u8], state: &mut FmuState) -> Status {
        let place = bytes.as_ptr().cast();
        unsafe { fmi2DeSerializeFMUstate(self.handle, place, bytes.len(), state) }
    }
}

impl Drop for Unit {
    fn drop(&mut self) {
        unsafe { fmi2FreeInstance(self.handle) }
    }
}

/// Time derivatives of the input, orders 1 to 3, for the next step.
pub fn derive(unit: &Unit, input: u32, [first, second, third]: [f64; 3]) {
    let (references, orders, values) = ([input; 3], [1, 2, 3], [first, second, third]);
    unit.ok(unsafe {
        let (r, o, v) = (references.as_ptr(), orders.as_ptr(), values.as_ptr());
        fmi2SetRealInputDerivatives(unit.handle, r, 3, o, v)
    });
}

/// Forces \[N\] of a history with nested loops, below full slip, at 1 ms.
pub fn history() -> impl Iterator<Item = (f64, f64)> {
    (0..400).map(|i| {
        let t = f64::from(i) * 1e-3;
        (
            t,
            700.0 * (t / 0.4) * ((40.0 * t).sin() + 0.5 * (290.0 * t).sin()) / 1.5,
        )
    })
}

/// Reference of a parameter by name.
pub fn reference(resources: &Resources, name: &str) -> u32 {
    let variables = Variables::of(&resources.joint(), Drive::Force).unwrap();
    let found = variables.iter().find(|variable| variable.name == name);
    found
        .unwrap_or_else(|| panic!("no variable {name}"))
        .reference
}
