//! fmi2Get… and fmi2Set… of the four types. All variables are of type Real.

use super::c_types::{Boolean, Component, Status};
use super::calls::{self, Call};
use super::entry::call;
use super::instance::Instance;
use super::pointers::{self, Destination};
use super::refusal::Refusal;
use libc::{c_char, c_int, c_uint, size_t};

/// Reads Real variables.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, `count` items in each array.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetReal(
    component: Component,
    references: *const c_uint,
    count: size_t,
    values: *mut f64,
) -> Status {
    // SAFETY: arrays as the standard asks.
    let body = |instance: &mut Instance| unsafe {
        let places = Destination::new("value", values, count)?;
        let references = pointers::slice("vr", references, count)?;
        instance.reals(references, |place, value| places.write_at(place, value))
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(component, calls::GET_REAL, body) }
}

/// Sets Real variables: the input, and parameters before the start.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, `count` items in each array.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetReal(
    component: Component,
    references: *const c_uint,
    count: size_t,
    values: *const f64,
) -> Status {
    // SAFETY: arrays as the standard asks.
    let body = |instance: &mut Instance| unsafe {
        let references = pointers::slice("vr", references, count)?;
        instance.set_reals(references, pointers::slice("value", values, count)?)
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(component, calls::SET_REAL, body) }
}

/// Refuses every reference: there is no variable of that type.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, `count` references.
unsafe fn none_of(
    expected: &'static str,
    function: Call,
    component: Component,
    references: *const c_uint,
    count: size_t,
) -> Status {
    // SAFETY: array as the standard asks.
    let body = |_: &mut Instance| match unsafe { pointers::slice("vr", references, count)? } {
        [] => Ok(()),
        [came, ..] => Err(Refusal::UnknownReference {
            expected,
            came: *came,
        }),
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(component, function, body) }
}

/// Writes an exported function for a type that no variable has.
macro_rules! no_variables {
    ($($name:ident($call:ident, $expected:literal, $values:ty);)*) => {$(
        /// No variable is of this type: any reference is refused.
        ///
        /// # Safety
        /// As the FMI standard asks: a handle of this library, `count` references.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            component: Component,
            references: *const c_uint,
            count: size_t,
            _values: $values,
        ) -> Status {
            // SAFETY: handle and array as the standard asks.
            unsafe { none_of($expected, calls::$call, component, references, count) }
        }
    )*};
}

no_variables! {
    fmi2GetInteger(GET_INTEGER, "Integer", *mut c_int);
    fmi2GetBoolean(GET_BOOLEAN, "Boolean", *mut Boolean);
    fmi2GetString(GET_STRING, "String", *mut *const c_char);
    fmi2SetInteger(SET_INTEGER, "Integer", *const c_int);
    fmi2SetBoolean(SET_BOOLEAN, "Boolean", *const Boolean);
    fmi2SetString(SET_STRING, "String", *const *const c_char);
}
