//! From fmi3InstantiateCoSimulation to fmi3FreeInstance.

use crate::fmu::bundle::Bundle;
use crate::fmu::c_types::{Boolean3, Component, LogMessage, Status};
use crate::fmu::calls;
use crate::fmu::entry::{call, stop};
use crate::fmu::instance::Instance;
use crate::fmu::lifecycle::fmi2FreeInstance;
use crate::fmu::logger::{Category, Host, Messenger, Standard};
use crate::fmu::pointers;
use crate::fmu::refusal::Refusal;
use crate::variables::STAMP;
use libc::{c_char, c_void, size_t};

/// `3.0`.
#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetVersion() -> *const c_char {
    c"3.0".as_ptr()
}

/// Switches debug logging, by category where categories are named.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, `count` C strings at `categories`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetDebugLogging(
    instance: Component,
    on: Boolean3,
    count: size_t,
    categories: *const *const c_char,
) -> Status {
    // SAFETY: strings as the standard asks.
    let body = |instance: &mut Instance| unsafe {
        let pointers = pointers::slice("categories", categories, count)?;
        let names: Result<Vec<_>, _> = pointers
            .iter()
            .map(|&name| pointers::text("categories", name))
            .collect();
        instance.set_debug_logging(on != 0, &names?)
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(instance, calls::SET_DEBUG_LOGGING_3, body) }
}

/// Makes an instance of the joint in `resources/joint.json`; NULL where that is refused, with a
/// message to the logger. A step never returns early and never raises an event, whatever is allowed.
///
/// # Safety
/// As the FMI standard asks: C strings, and a logger, NULL or callable until [`fmi3FreeInstance`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateCoSimulation(
    name: *const c_char,
    token: *const c_char,
    resource_path: *const c_char,
    _visible: Boolean3,
    logging_on: Boolean3,
    event_mode_used: Boolean3,
    _early_return_allowed: Boolean3,
    required_intermediate_variables: *const u32,
    required_count: size_t,
    environment: *mut c_void,
    log_message: Option<LogMessage>,
    _intermediate_update: *const c_void,
) -> Component {
    let host = Host::Three(log_message, environment);
    // SAFETY: strings as the standard asks.
    let made = stop(|| unsafe {
        let name = pointers::text("instanceName", name)?;
        let standard = Standard::Three;
        let token = pointers::text(standard.token(), token)?;
        if event_mode_used != 0 {
            return Err(Refusal::NotOffered {
                capability: "hasEventMode",
            });
        }
        let required = "requiredIntermediateVariables";
        pointers::slice(required, required_intermediate_variables, required_count)?;
        let argument = standard.resources();
        if resource_path.is_null() {
            return Err(Refusal::NoLocation { argument });
        }
        let path = pointers::text(argument, resource_path)?;
        let bundle = Bundle::read(standard, path, token)?;
        let instance = Instance::new(bundle, name, host, logging_on != 0)?;
        instance.tell(&format!("instantiated from {STAMP}"));
        Ok(instance)
    });
    made.map_or_else(
        |refusal| refused("fmi3InstantiateCoSimulation", host, &refusal),
        |instance| Box::into_raw(Box::new(instance)).cast(),
    )
}

/// Tells why there is no instance, and answers NULL.
pub(super) fn refused(function: &str, host: Host, refusal: &Refusal) -> Component {
    let text = format!("{function}: {refusal}");
    Messenger::new(host, "IwanJoint", false).tell(Status::Error, Category::Error, &text);
    std::ptr::null_mut()
}

/// Frees an instance; NULL is legal.
///
/// # Safety
/// As the FMI standard asks: NULL or a handle of this library that is not used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeInstance(instance: Component) {
    // SAFETY: the instances of both versions are of one type; handle as the standard asks.
    unsafe { fmi2FreeInstance(instance) }
}

/// Takes start and stop time and begins initialization; a tolerance means nothing to an exact
/// method.
///
/// # Safety
/// As the FMI standard asks: a handle of this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterInitializationMode(
    instance: Component,
    _tolerance_defined: Boolean3,
    _tolerance: f64,
    start: f64,
    stop_defined: Boolean3,
    stop: f64,
) -> Status {
    let stop = (stop_defined != 0).then_some(stop);
    let body = |instance: &mut Instance| {
        instance.setup_experiment(start, stop)?;
        instance.enter_initialization()
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(instance, calls::ENTER_INITIALIZATION_MODE_3, body) }
}

/// Ends initialization: Step Mode follows.
///
/// # Safety
/// As the FMI standard asks: a handle of this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3ExitInitializationMode(instance: Component) -> Status {
    let body = Instance::exit_initialization;
    // SAFETY: handle as the standard asks.
    unsafe { call(instance, calls::EXIT_INITIALIZATION_MODE_3, body) }
}

/// Ends the experiment.
///
/// # Safety
/// As the FMI standard asks: a handle of this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3Terminate(instance: Component) -> Status {
    // SAFETY: handle as the standard asks.
    unsafe { call(instance, calls::TERMINATE_3, Instance::terminate) }
}

/// Back to the state after fmi3InstantiateCoSimulation.
///
/// # Safety
/// As the FMI standard asks: a handle of this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3Reset(instance: Component) -> Status {
    // SAFETY: handle as the standard asks.
    unsafe { call(instance, calls::RESET_3, Instance::reset) }
}
