//! Types of fmi2TypesPlatform.h and fmi2FunctionTypes.h, and those that FMI 3.0 adds.

use libc::{c_char, c_int, c_void, size_t};

/// `fmi2Component`: handle of an instance.
pub type Component = *mut c_void;
/// `fmi2FMUstate`: handle of a saved state.
pub type FmuState = *mut c_void;
/// `fmi2Boolean`.
pub type Boolean = c_int;
/// `fmi2True`.
pub const TRUE: Boolean = 1;
/// `fmi2False`.
pub const FALSE: Boolean = 0;

/// `fmi2Status`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// All well.
    Ok = 0,
    /// Never returned: six known importers take it for a failure.
    Warning = 1,
    /// Never returned: it makes some importers loop.
    Discard = 2,
    /// Refused; what was before still holds.
    Error = 3,
    /// Never returned: it would forbid freeing the instance.
    Fatal = 4,
    /// Never returned: steps are synchronous.
    Pending = 5,
}

/// `fmi2Type`, as the plain integer that came: a host may pass any.
pub type Type = c_int;
/// `fmi2CoSimulation`.
pub const CO_SIMULATION: Type = 1;

/// `fmi2StatusKind`, as the plain integer that came.
pub type StatusKind = c_int;
/// `fmi2DoStepStatus`.
pub const DO_STEP_STATUS: StatusKind = 0;
/// `fmi2PendingStatus`.
pub const PENDING_STATUS: StatusKind = 1;
/// `fmi2LastSuccessfulTime`.
pub const LAST_SUCCESSFUL_TIME: StatusKind = 2;
/// `fmi2Terminated`.
pub const TERMINATED: StatusKind = 3;

/// `fmi2CallbackLogger`.
pub type Logger = unsafe extern "C" fn(
    environment: *mut c_void,
    instance: *const c_char,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
    ...
);

/// `fmi3LogMessageCallback`.
pub type LogMessage = unsafe extern "C" fn(
    environment: *mut c_void,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
);

/// `fmi3Boolean`: C's `bool`, read as a byte, since a host may send any.
pub type Boolean3 = u8;

/// `fmi2CallbackFunctions`. Every entry may be NULL.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct CallbackFunctions {
    /// Takes messages.
    pub logger: Option<Logger>,
    /// Not used: memory is Rust's own.
    pub allocate_memory: Option<unsafe extern "C" fn(size_t, size_t) -> *mut c_void>,
    /// Not used.
    pub free_memory: Option<unsafe extern "C" fn(*mut c_void)>,
    /// Not used: steps are synchronous.
    pub step_finished: Option<unsafe extern "C" fn(*mut c_void, c_int)>,
    /// Handed back to the logger.
    pub component_environment: *mut c_void,
}
