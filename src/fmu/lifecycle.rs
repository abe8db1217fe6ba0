//! From fmi2Instantiate to fmi2FreeInstance.

use super::bundle::Bundle;
use super::c_types::{Boolean, CO_SIMULATION, CallbackFunctions, Component, FALSE, Status, Type};
use super::calls;
use super::entry::{call, stop};
use super::instance::Instance;
use super::logger::{Category, Host, Messenger, Standard};
use super::pointers;
use super::refusal::Refusal;
use crate::variables::STAMP;
use libc::{c_char, size_t};

/// `default`: the types of fmi2TypesPlatform.h.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

/// `2.0`.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

/// Switches debug logging, by category where categories are named.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, `count` C strings at `categories`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetDebugLogging(
    component: Component,
    on: Boolean,
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
        instance.set_debug_logging(on != FALSE, &names?)
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(component, calls::SET_DEBUG_LOGGING, body) }
}

/// Makes an instance of the joint in `resources/joint.json`; NULL where that is refused, with a
/// message to the logger.
///
/// # Safety
/// As the FMI standard asks: C strings, and callbacks that stay callable until
/// [`fmi2FreeInstance`]; every one of them may be NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    name: *const c_char,
    fmu_type: Type,
    guid: *const c_char,
    resource_location: *const c_char,
    functions: *const CallbackFunctions,
    _visible: Boolean,
    logging_on: Boolean,
) -> Component {
    // SAFETY: callbacks as the standard asks. They are copied, so that a host whose structure moves
    // does no harm.
    let host = Host::Two(unsafe { functions.as_ref().copied() });
    // SAFETY: strings as the standard asks.
    let texts = || unsafe {
        Ok(Texts {
            name: pointers::text("instanceName", name)?,
            guid: pointers::text(Standard::Two.token(), guid)?,
            location: match (resource_location.is_null(), Standard::Two.resources()) {
                (true, argument) => return Err(Refusal::NoLocation { argument }),
                (false, argument) => pointers::text(argument, resource_location)?,
            },
        })
    };
    let made = stop(|| instance(fmu_type, texts()?, host, logging_on != FALSE));
    made.map_or_else(
        |refusal| {
            let text = format!("fmi2Instantiate: {refusal}");
            let messenger = Messenger::new(host, "IwanJoint", false);
            messenger.tell(Status::Error, Category::Error, &text);
            std::ptr::null_mut()
        },
        |instance| Box::into_raw(Box::new(instance)).cast(),
    )
}

/// The texts of fmi2Instantiate.
struct Texts<'a> {
    name: &'a str,
    guid: &'a str,
    location: &'a str,
}

fn instance(fmu_type: Type, texts: Texts, host: Host, debug: bool) -> Result<Instance, Refusal> {
    if fmu_type != CO_SIMULATION {
        return Err(Refusal::NotCoSimulation { came: fmu_type });
    }
    let bundle = Bundle::read(Standard::Two, texts.location, texts.guid)?;
    let instance = Instance::new(bundle, texts.name, host, debug)?;
    instance.tell(&format!("instantiated from {STAMP}"));
    Ok(instance)
}

/// Frees an instance; NULL is legal. Saved states of it stay with the host until it frees them.
///
/// # Safety
/// As the FMI standard asks: NULL or a handle of this library that is not used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(component: Component) {
    // SAFETY: not NULL, it is the box that fmi2Instantiate gave away, given back once.
    let free = || unsafe {
        if !component.is_null() {
            drop(Box::from_raw(component.cast::<Instance>()));
        }
        Ok(())
    };
    // A function without a status has no way to tell of a refusal, and there is none.
    let _ = stop(free);
}

/// Takes start and stop time; a tolerance means nothing to an exact method.
///
/// # Safety
/// As the FMI standard asks: a handle of this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetupExperiment(
    component: Component,
    _tolerance_defined: Boolean,
    _tolerance: f64,
    start: f64,
    stop_defined: Boolean,
    stop: f64,
) -> Status {
    let stop = (stop_defined != FALSE).then_some(stop);
    // SAFETY: handle as the standard asks.
    unsafe {
        call(component, calls::SETUP_EXPERIMENT, |i| {
            i.setup_experiment(start, stop)
        })
    }
}

/// Begins initialization.
///
/// # Safety
/// As the FMI standard asks: a handle of this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterInitializationMode(component: Component) -> Status {
    // SAFETY: handle as the standard asks.
    unsafe {
        call(
            component,
            calls::ENTER_INITIALIZATION_MODE,
            Instance::enter_initialization,
        )
    }
}

/// Ends initialization.
///
/// # Safety
/// As the FMI standard asks: a handle of this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2ExitInitializationMode(component: Component) -> Status {
    // SAFETY: handle as the standard asks.
    unsafe {
        call(
            component,
            calls::EXIT_INITIALIZATION_MODE,
            Instance::exit_initialization,
        )
    }
}

/// Ends the experiment.
///
/// # Safety
/// As the FMI standard asks: a handle of this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Terminate(component: Component) -> Status {
    // SAFETY: handle as the standard asks.
    unsafe { call(component, calls::TERMINATE, Instance::terminate) }
}

/// Back to the state after fmi2Instantiate.
///
/// # Safety
/// As the FMI standard asks: a handle of this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Reset(component: Component) -> Status {
    // SAFETY: handle as the standard asks.
    unsafe { call(component, calls::RESET, Instance::reset) }
}
