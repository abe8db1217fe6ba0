//! Steps, derivatives and status.

use super::c_types::{
    Boolean, Component, DO_STEP_STATUS, FALSE, LAST_SUCCESSFUL_TIME, PENDING_STATUS, Status,
    StatusKind, TERMINATED,
};
use super::calls::{self, Call};
use super::entry::call;
use super::instance::Instance;
use super::pointers::{self, Destination};
use super::refusal::Refusal;
use libc::{c_char, c_int, c_uint, size_t};

/// Derivatives of answers with respect to the input, times its differential: the algorithmic
/// tangent of the last step, one-sided along its direction.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, the counted items in each array.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDirectionalDerivative(
    component: Component,
    unknowns: *const c_uint,
    unknown_count: size_t,
    knowns: *const c_uint,
    known_count: size_t,
    known_differentials: *const f64,
    unknown_differentials: *mut f64,
) -> Status {
    // SAFETY: arrays as the standard asks.
    let body = |instance: &mut Instance| unsafe {
        let unknowns = pointers::slice("vUnknown_ref", unknowns, unknown_count)?;
        instance.check_knowns(pointers::slice("vKnown_ref", knowns, known_count)?)?;
        let seeds = pointers::slice("dvKnown", known_differentials, known_count)?;
        Instance::check_seeds("dvKnown", seeds)?;
        let places = Destination::new("dvUnknown", unknown_differentials, unknown_count)?;
        // There is one input: named twice, its differentials add up.
        let seed: f64 = seeds.iter().sum();
        instance.slopes(unknowns, |place, slope| {
            places.write_at(place, slope * seed)
        })
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(component, calls::GET_DIRECTIONAL_DERIVATIVE, body) }
}

/// Takes time derivatives of the input, orders 1 to 3, for the next step.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, `count` items in each array.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetRealInputDerivatives(
    component: Component,
    references: *const c_uint,
    count: size_t,
    orders: *const c_int,
    values: *const f64,
) -> Status {
    // SAFETY: arrays as the standard asks.
    let body = |instance: &mut Instance| unsafe {
        let references = pointers::slice("vr", references, count)?;
        let orders = pointers::slice("order", orders, count)?;
        instance.set_input_derivatives(references, orders, pointers::slice("value", values, count)?)
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(component, calls::SET_REAL_INPUT_DERIVATIVES, body) }
}

/// First time derivatives of answers at the end of the last step.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, `count` items in each array.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealOutputDerivatives(
    component: Component,
    references: *const c_uint,
    count: size_t,
    orders: *const c_int,
    values: *mut f64,
) -> Status {
    // SAFETY: arrays as the standard asks.
    let body = |instance: &mut Instance| unsafe {
        let references = pointers::slice("vr", references, count)?;
        let orders = pointers::slice("order", orders, count)?;
        let places = Destination::new("value", values, count)?;
        instance.output_derivatives(references, orders, |place, rate| {
            places.write_at(place, rate)
        })
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(component, calls::GET_REAL_OUTPUT_DERIVATIVES, body) }
}

/// Moves the joint over one communication step. The input, as set before, is the input at the end
/// of the step, unless derivatives were set.
///
/// # Safety
/// As the FMI standard asks: a handle of this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DoStep(
    component: Component,
    point: f64,
    size: f64,
    _no_set_state_prior: Boolean,
) -> Status {
    // SAFETY: handle as the standard asks.
    unsafe {
        call(component, calls::DO_STEP, |instance| {
            instance.step(point, size)
        })
    }
}

/// Always refused: no step is ever pending.
///
/// # Safety
/// As the FMI standard asks: a handle of this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CancelStep(component: Component) -> Status {
    // SAFETY: handle as the standard asks.
    unsafe { call(component, calls::CANCEL_STEP, |_| Ok(())) }
}

/// Answers one kind of status.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, `place` may be written.
unsafe fn status<T: Copy>(
    component: Component,
    function: Call,
    (kind, answered, expected): (StatusKind, StatusKind, &'static str),
    place: *mut T,
    answer: impl FnOnce(&Instance) -> T,
) -> Status {
    // SAFETY: place as the standard asks.
    let body = |instance: &mut Instance| unsafe {
        let place = Destination::new("value", place, 1)?;
        if kind != answered {
            return Err(Refusal::StatusKind {
                expected,
                came: kind,
            });
        }
        place.write(&[answer(instance)]);
        Ok(())
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(component, function, body) }
}

/// `fmi2DoStepStatus`: steps are done when fmi2DoStep returns.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, `value` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStatus(
    component: Component,
    kind: StatusKind,
    value: *mut Status,
) -> Status {
    let asked = (kind, DO_STEP_STATUS, "0 (fmi2DoStepStatus)");
    // SAFETY: handle and place as the standard asks.
    unsafe { status(component, calls::GET_STATUS, asked, value, |_| Status::Ok) }
}

/// `fmi2LastSuccessfulTime`: end of the last step that was not refused \[s\].
///
/// # Safety
/// As the FMI standard asks: a handle of this library, `value` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealStatus(
    component: Component,
    kind: StatusKind,
    value: *mut f64,
) -> Status {
    let asked = (kind, LAST_SUCCESSFUL_TIME, "2 (fmi2LastSuccessfulTime)");
    // SAFETY: handle and place as the standard asks.
    unsafe {
        status(component, calls::GET_REAL_STATUS, asked, value, |i| {
            i.motion.time
        })
    }
}

/// Always refused: the standard defines no status of type Integer.
///
/// # Safety
/// As the FMI standard asks: a handle of this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetIntegerStatus(
    component: Component,
    kind: StatusKind,
    _value: *mut c_int,
) -> Status {
    let refusal = Refusal::StatusKind {
        expected: "none of type Integer",
        came: kind,
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(component, calls::GET_INTEGER_STATUS, |_| Err(refusal)) }
}

/// `fmi2Terminated`: the joint never ends an experiment by itself.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, `value` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBooleanStatus(
    component: Component,
    kind: StatusKind,
    value: *mut Boolean,
) -> Status {
    let asked = (kind, TERMINATED, "3 (fmi2Terminated)");
    // SAFETY: handle and place as the standard asks.
    unsafe {
        status(component, calls::GET_BOOLEAN_STATUS, asked, value, |_| {
            FALSE
        })
    }
}

/// `fmi2PendingStatus`: an empty text, since nothing is ever pending.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, `value` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStringStatus(
    component: Component,
    kind: StatusKind,
    value: *mut *const c_char,
) -> Status {
    let asked = (kind, PENDING_STATUS, "1 (fmi2PendingStatus)");
    // SAFETY: handle and place as the standard asks.
    unsafe {
        status(component, calls::GET_STRING_STATUS, asked, value, |_| {
            c"".as_ptr()
        })
    }
}
