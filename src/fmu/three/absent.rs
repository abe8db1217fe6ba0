//! Functions for what modelDescription.xml does not offer: they must exist, and refuse.

use super::lifecycle::refused;
use crate::fmu::c_types::{Boolean3, Component, LogMessage, Status};
use crate::fmu::calls;
use crate::fmu::entry::call;
use crate::fmu::logger::Host;
use crate::fmu::refusal::Refusal;
use libc::{c_char, c_int, c_void, size_t};

/// Writes an exported function that refuses, naming the capability that is not there.
macro_rules! absent {
    ($($name:ident($($further:ty),*) $capability:literal;)*) => {$(
        /// Refused: modelDescription.xml does not offer it.
        ///
        /// # Safety
        /// As the FMI standard asks: a handle of this library.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(instance: Component, $(_: $further),*) -> Status {
            let refusal = Refusal::NotOffered { capability: $capability };
            // SAFETY: handle as the standard asks.
            unsafe { call(instance, calls::anywhere(stringify!($name)), |_| Err(refusal)) }
        }
    )*};
}

absent! {
    fmi3EnterEventMode() "hasEventMode";
    fmi3EnterStepMode() "hasEventMode";
    fmi3EvaluateDiscreteStates() "hasEventMode";
    fmi3UpdateDiscreteStates(
        *mut Boolean3, *mut Boolean3, *mut Boolean3, *mut Boolean3, *mut Boolean3, *mut f64
    ) "hasEventMode";
    fmi3EnterConfigurationMode() "structural parameters";
    fmi3ExitConfigurationMode() "structural parameters";
    fmi3GetNumberOfVariableDependencies(u32, *mut size_t) "providesPerElementDependencies";
    fmi3GetVariableDependencies(
        u32, *mut size_t, *mut u32, *mut size_t, *mut c_int, size_t
    ) "providesPerElementDependencies";
    fmi3EnterContinuousTimeMode() "model exchange";
    fmi3CompletedIntegratorStep(Boolean3, *mut Boolean3, *mut Boolean3) "model exchange";
    fmi3SetTime(f64) "model exchange";
    fmi3SetContinuousStates(*const f64, size_t) "model exchange";
    fmi3GetContinuousStateDerivatives(*mut f64, size_t) "model exchange";
    fmi3GetEventIndicators(*mut f64, size_t) "model exchange";
    fmi3GetContinuousStates(*mut f64, size_t) "model exchange";
    fmi3GetNominalsOfContinuousStates(*mut f64, size_t) "model exchange";
    fmi3GetNumberOfEventIndicators(*mut size_t) "model exchange";
    fmi3GetNumberOfContinuousStates(*mut size_t) "model exchange";
    fmi3ActivateModelPartition(u32, f64) "scheduled execution";
}

/// NULL, and a message: the archive offers co-simulation only.
///
/// # Safety
/// As the FMI standard asks: the logger is NULL or may be called.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateModelExchange(
    _name: *const c_char,
    _token: *const c_char,
    _resource_path: *const c_char,
    _visible: Boolean3,
    _logging_on: Boolean3,
    environment: *mut c_void,
    log_message: Option<LogMessage>,
) -> Component {
    let host = Host::Three(log_message, environment);
    let capability = "model exchange";
    let refusal = Refusal::NotOffered { capability };
    refused("fmi3InstantiateModelExchange", host, &refusal)
}

/// NULL, and a message: the archive offers co-simulation only.
///
/// # Safety
/// As the FMI standard asks: the logger is NULL or may be called.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateScheduledExecution(
    _name: *const c_char,
    _token: *const c_char,
    _resource_path: *const c_char,
    _visible: Boolean3,
    _logging_on: Boolean3,
    environment: *mut c_void,
    log_message: Option<LogMessage>,
    _clock_update: *const c_void,
    _lock_preemption: *const c_void,
    _unlock_preemption: *const c_void,
) -> Component {
    let host = Host::Three(log_message, environment);
    let capability = "scheduled execution";
    let refusal = Refusal::NotOffered { capability };
    refused("fmi3InstantiateScheduledExecution", host, &refusal)
}
