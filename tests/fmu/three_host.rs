//! An importer of FMI 3.0 in miniature.

use super::host::Resources;
use iwan::fmu::*;
use iwan::joint::Drive;
use iwan::variables::guid;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr;

/// One FMI 3.0 instance with the last message of its log.
pub struct Three {
    pub handle: Component,
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
    pub fn try_new(
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

    pub fn new(resources: &Resources, drive: Drive) -> Three {
        let path = resources.folder.display().to_string();
        Three::try_new(resources, &guid(resources.json, drive), Some(&path), false).unwrap()
    }

    pub fn stepping(resources: &Resources, drive: Drive) -> Three {
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
    pub fn ok(&self, status: Status) {
        assert_eq!(status, Status::Ok, "{:?}", self.last_message());
    }

    #[track_caller]
    pub fn error(&self, status: Status) -> String {
        assert_eq!(status, Status::Error);
        self.last_message().expect("a refusal is told")
    }

    pub fn last_message(&self) -> Option<String> {
        // Written through the callback's pointer meanwhile, hence read anew.
        let log: *const Option<String> = &*self.log;
        unsafe { (*log).clone() }
    }

    pub fn set(&self, reference: u32, value: f64) -> Status {
        unsafe { fmi3SetFloat64(self.handle, &reference, 1, &value, 1) }
    }

    pub fn get(&self, references: &[u32]) -> Vec<f64> {
        let mut values = vec![f64::NAN; references.len()];
        let (count, places) = (references.len(), values.as_mut_ptr());
        self.ok(unsafe { fmi3GetFloat64(self.handle, references.as_ptr(), count, places, count) });
        values
    }

    /// Event, end, early return, time.
    pub fn step(&self, point: f64, size: f64) -> (Status, [u8; 3], f64) {
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
