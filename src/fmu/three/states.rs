//! Saved states: fmi3GetFMUState to fmi3DeserializeFMUState.

use crate::fmu::c_types::{Component, FmuState, Status};
use crate::fmu::calls;
use crate::fmu::states::{deserialize, free, get, serialize, serialized_size, set};
use libc::size_t;

/// Saves the complete state, mode included; a handle that holds a state already is used again.
///
/// # Safety
/// As the FMI standard asks: `instance` and, where not NULL, `*state` came from this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFMUState(instance: Component, state: *mut FmuState) -> Status {
    // SAFETY: handles as the standard asks.
    unsafe { get(calls::GET_FMU_STATE_3, instance, state) }
}

/// Continues from a saved state, in its mode.
///
/// # Safety
/// As the FMI standard asks: `instance` and `state` came from this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFMUState(instance: Component, state: FmuState) -> Status {
    // SAFETY: handles as the standard asks.
    unsafe { set(calls::SET_FMU_STATE_3, instance, state) }
}

/// Frees a saved state and makes its handle NULL; NULL is legal.
///
/// # Safety
/// As the FMI standard asks: `instance` and, where not NULL, `*state` came from this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeFMUState(instance: Component, state: *mut FmuState) -> Status {
    // SAFETY: handles as the standard asks.
    unsafe { free(calls::FREE_FMU_STATE_3, instance, state) }
}

/// Count of bytes that fmi3SerializeFMUState needs for this state.
///
/// # Safety
/// As the FMI standard asks: handles of this library, `size` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializedFMUStateSize(
    instance: Component,
    state: FmuState,
    size: *mut size_t,
) -> Status {
    let function = calls::SERIALIZED_FMU_STATE_SIZE_3;
    // SAFETY: handles and place as the standard asks.
    unsafe { serialized_size(function, instance, state, size) }
}

/// Writes a saved state as bytes that another process, on another machine, can read; instances of
/// both versions of the standard read it.
///
/// # Safety
/// As the FMI standard asks: handles of this library, `size` bytes at `bytes` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializeFMUState(
    instance: Component,
    state: FmuState,
    bytes: *mut u8,
    size: size_t,
) -> Status {
    // SAFETY: handles and places as the standard asks.
    unsafe { serialize(calls::SERIALIZE_FMU_STATE_3, instance, state, (bytes, size)) }
}

/// Makes a saved state of bytes; a handle that holds a state already is used again.
///
/// # Safety
/// As the FMI standard asks: handles of this library, `size` bytes at `bytes` may be read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DeserializeFMUState(
    instance: Component,
    bytes: *const u8,
    size: size_t,
    state: *mut FmuState,
) -> Status {
    let function = calls::DESERIALIZE_FMU_STATE_3;
    // SAFETY: handles and bytes as the standard asks.
    unsafe { deserialize(function, instance, (bytes, size), state) }
}
