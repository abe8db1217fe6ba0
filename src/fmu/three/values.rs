//! fmi3Get… and fmi3Set… of every type. All variables are of type Float64.

use crate::fmu::c_types::{Boolean3, Component, Status};
use crate::fmu::calls::{self, Call};
use crate::fmu::entry::call;
use crate::fmu::instance::Instance;
use crate::fmu::pointers::{self, Destination};
use crate::fmu::refusal::Refusal;
use libc::{c_char, size_t};

/// Every variable is a scalar: as many values as references.
pub(super) fn scalars(argument: &'static str, expected: usize, came: usize) -> Result<(), Refusal> {
    if expected == came {
        return Ok(());
    }
    Err(Refusal::Count {
        argument,
        expected,
        came,
    })
}

/// Reads Float64 variables; before initialization their start values, of what is calculated zero.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, the counted items in each array.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFloat64(
    instance: Component,
    references: *const u32,
    count: size_t,
    values: *mut f64,
    value_count: size_t,
) -> Status {
    // SAFETY: arrays as the standard asks.
    let body = |instance: &mut Instance| unsafe {
        scalars("nValues", count, value_count)?;
        let places = Destination::new("values", values, count)?;
        let references = pointers::slice("valueReferences", references, count)?;
        instance.reals(references, |place, value| places.write_at(place, value))
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(instance, calls::GET_FLOAT64_3, body) }
}

/// Sets Float64 variables: the input, and parameters before the start.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, the counted items in each array.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFloat64(
    instance: Component,
    references: *const u32,
    count: size_t,
    values: *const f64,
    value_count: size_t,
) -> Status {
    // SAFETY: arrays as the standard asks.
    let body = |instance: &mut Instance| unsafe {
        scalars("nValues", count, value_count)?;
        let references = pointers::slice("valueReferences", references, count)?;
        instance.set_reals(references, pointers::slice("values", values, count)?)
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(instance, calls::SET_FLOAT64_3, body) }
}

/// Refuses every reference: there is no variable of that type.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, `count` references.
unsafe fn none_of(
    expected: &'static str,
    function: Call,
    instance: Component,
    (references, count): (*const u32, size_t),
) -> Status {
    // SAFETY: array as the standard asks.
    let body = |_: &mut Instance| match unsafe {
        pointers::slice("valueReferences", references, count)?
    } {
        [] => Ok(()),
        [came, ..] => Err(Refusal::UnknownReference {
            expected,
            came: *came,
        }),
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(instance, function, body) }
}

/// Writes an exported function for a type that no variable has.
macro_rules! no_variables {
    ($($name:ident($expected:literal, $modes:ident; $($further:ty),*);)*) => {$(
        /// No variable is of this type: any reference is refused.
        ///
        /// # Safety
        /// As the FMI standard asks: a handle of this library, `count` references.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            instance: Component,
            references: *const u32,
            count: size_t,
            $(_: $further),*
        ) -> Status {
            let function = calls::$modes(stringify!($name));
            // SAFETY: handle and array as the standard asks.
            unsafe { none_of($expected, function, instance, (references, count)) }
        }
    )*};
}

no_variables! {
    fmi3GetFloat32("Float32", reading; *mut f32, size_t);
    fmi3GetInt8("Int8", reading; *mut i8, size_t);
    fmi3GetUInt8("UInt8", reading; *mut u8, size_t);
    fmi3GetInt16("Int16", reading; *mut i16, size_t);
    fmi3GetUInt16("UInt16", reading; *mut u16, size_t);
    fmi3GetInt32("Int32", reading; *mut i32, size_t);
    fmi3GetUInt32("UInt32", reading; *mut u32, size_t);
    fmi3GetInt64("Int64", reading; *mut i64, size_t);
    fmi3GetUInt64("UInt64", reading; *mut u64, size_t);
    fmi3GetBoolean("Boolean", reading; *mut Boolean3, size_t);
    fmi3GetString("String", reading; *mut *const c_char, size_t);
    fmi3GetBinary("Binary", reading; *mut size_t, *mut *const u8, size_t);
    fmi3GetClock("Clock", reading; *mut Boolean3);
    fmi3SetFloat32("Float32", setting; *const f32, size_t);
    fmi3SetInt8("Int8", setting; *const i8, size_t);
    fmi3SetUInt8("UInt8", setting; *const u8, size_t);
    fmi3SetInt16("Int16", setting; *const i16, size_t);
    fmi3SetUInt16("UInt16", setting; *const u16, size_t);
    fmi3SetInt32("Int32", setting; *const i32, size_t);
    fmi3SetUInt32("UInt32", setting; *const u32, size_t);
    fmi3SetInt64("Int64", setting; *const i64, size_t);
    fmi3SetUInt64("UInt64", setting; *const u64, size_t);
    fmi3SetBoolean("Boolean", setting; *const Boolean3, size_t);
    fmi3SetString("String", setting; *const *const c_char, size_t);
    fmi3SetBinary("Binary", setting; *const size_t, *const *const u8, size_t);
    fmi3SetClock("Clock", setting; *const Boolean3);
    fmi3GetIntervalDecimal("Clock", timing; *mut f64, *mut libc::c_int);
    fmi3GetIntervalFraction("Clock", timing; *mut u64, *mut u64, *mut libc::c_int);
    fmi3GetShiftDecimal("Clock", timing; *mut f64);
    fmi3GetShiftFraction("Clock", timing; *mut u64, *mut u64);
    fmi3SetIntervalDecimal("Clock", setting; *const f64);
    fmi3SetIntervalFraction("Clock", setting; *const u64, *const u64);
    fmi3SetShiftDecimal("Clock", setting; *const f64);
    fmi3SetShiftFraction("Clock", setting; *const u64, *const u64);
}
