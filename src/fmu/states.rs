//! Saved states: fmi2GetFMUstate to fmi2DeSerializeFMUstate.

use super::c_types::{Component, FmuState, Status};
use super::calls::{self, Call};
use super::entry::call;
use super::instance::{Instance, Motion};
use super::pointers::{self, Destination};
use super::refusal::Refusal;
use super::snapshot::{Snapshot, SnapshotError};
use super::stepping::InputDerivatives;
use crate::joint::Simulation;
use libc::{c_char, size_t};

impl Instance {
    /// The complete state.
    fn snapshot(&self) -> Snapshot {
        let motion = &self.motion;
        Snapshot {
            guid: self.guid.clone(),
            mode: self.mode,
            time: motion.time,
            stop: motion.stop,
            input: motion.input,
            derivatives: motion.derivatives.0,
            dissipation_rate: motion.dissipation_rate,
            step: motion.step,
            rates: motion.rates,
            parameters: self.parameters.clone(),
            simulation: motion.simulation.as_ref().map(Simulation::state),
        }
    }

    /// Puts back a state of the same joint, mode included; on a refusal nothing changes.
    fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Refusal> {
        self.check(snapshot)?;
        let simulation = match (&snapshot.simulation, self.motion.simulation.as_mut()) {
            (None, _) => None,
            // With the same parameters it is the same joint: it goes back in its own memory.
            (Some(state), Some(simulation)) if snapshot.parameters == self.parameters => {
                simulation.restore(state)?;
                self.motion.simulation.take()
            }
            (Some(state), _) => {
                let mut simulation = self.virgin(&snapshot.parameters)?;
                simulation.restore(state)?;
                Some(simulation)
            }
        };
        self.parameters.clone_from(&snapshot.parameters);
        self.mode = snapshot.mode;
        self.motion = Motion {
            time: snapshot.time,
            stop: snapshot.stop,
            input: snapshot.input,
            derivatives: InputDerivatives(snapshot.derivatives),
            simulation,
            dissipation_rate: snapshot.dissipation_rate,
            step: snapshot.step,
            rates: snapshot.rates,
        };
        Ok(())
    }

    /// Holds a state against this joint.
    fn check(&self, snapshot: &Snapshot) -> Result<(), SnapshotError> {
        if snapshot.guid != self.guid {
            return Err(SnapshotError::OtherJoint {
                expected: self.guid.clone(),
                came: snapshot.guid.clone(),
            });
        }
        let (expected, came) = (self.parameters.len(), snapshot.parameters.len());
        if expected != came {
            return Err(SnapshotError::Parameters { expected, came });
        }
        Ok(())
    }
}

/// The state behind a handle.
///
/// # Safety
/// `state` is NULL or came from fmi2GetFMUstate or fmi2DeSerializeFMUstate and is not freed yet.
unsafe fn saved<'a>(state: FmuState) -> Result<&'a Snapshot, Refusal> {
    // SAFETY: not NULL, it points to a snapshot that `keep` made, by this function's contract.
    unsafe { state.cast::<Snapshot>().as_ref() }.ok_or(Refusal::NullPointer {
        argument: "FMUstate",
    })
}

/// Puts a state behind a handle: the one that is there already, or a new one where it is NULL.
///
/// # Safety
/// `handle` may be written; what it holds is NULL or a state as for [`saved`].
unsafe fn keep(handle: *mut FmuState, snapshot: Snapshot) {
    // SAFETY: the handle may be read and written, and a state in it is ours, by this function's
    // contract; the box goes to the host, which gives it back to fmi2FreeFMUstate.
    unsafe {
        match (*handle).cast::<Snapshot>().as_mut() {
            Some(place) => *place = snapshot,
            None => *handle = Box::into_raw(Box::new(snapshot)).cast(),
        }
    }
}

/// Saves the complete state, mode included; a handle that holds a state already is used again.
///
/// # Safety
/// `component` and, where not NULL, `*state` came from this library.
pub(super) unsafe fn get(function: Call, component: Component, state: *mut FmuState) -> Status {
    let body = |instance: &mut Instance| {
        // SAFETY: the host gives one place for a handle; `keep` writes it where it is not NULL.
        unsafe {
            Destination::new("FMUstate", state, 1)?;
            keep(state, instance.snapshot());
        }
        Ok(())
    };
    // SAFETY: handle by this function's contract.
    unsafe { call(component, function, body) }
}

/// Continues from a saved state, in its mode.
///
/// # Safety
/// `component` and `state` came from this library.
pub(super) unsafe fn set(function: Call, component: Component, state: FmuState) -> Status {
    // SAFETY: handles by this function's contract.
    unsafe {
        call(component, function, |instance| {
            instance.restore(saved(state)?)
        })
    }
}

/// Frees a saved state and makes its handle NULL; NULL is legal.
///
/// # Safety
/// `component` and, where not NULL, `*state` came from this library.
pub(super) unsafe fn free(function: Call, component: Component, state: *mut FmuState) -> Status {
    let body = |_: &mut Instance| {
        // SAFETY: the host gives NULL or a handle; what it holds was made by `keep` and is freed
        // once, since the handle is NULL afterwards.
        unsafe {
            if let Some(handle) = state.as_mut()
                && !handle.is_null()
            {
                drop(Box::from_raw(handle.cast::<Snapshot>()));
                *handle = std::ptr::null_mut();
            }
        }
        Ok(())
    };
    // SAFETY: handle by this function's contract.
    unsafe { call(component, function, body) }
}

/// Count of bytes of a saved state.
///
/// # Safety
/// Handles of this library, `size` may be written.
pub(super) unsafe fn serialized_size(
    function: Call,
    component: Component,
    state: FmuState,
    size: *mut size_t,
) -> Status {
    // SAFETY: handles and place by this function's contract.
    let body = |_: &mut Instance| unsafe {
        Destination::new("size", size, 1)?.write(&[saved(state)?.length()]);
        Ok(())
    };
    // SAFETY: handle by this function's contract.
    unsafe { call(component, function, body) }
}

/// Writes a saved state as bytes.
///
/// # Safety
/// Handles of this library, `size` bytes at `bytes` may be written.
pub(super) unsafe fn serialize(
    function: Call,
    component: Component,
    state: FmuState,
    (bytes, size): (*mut u8, size_t),
) -> Status {
    // SAFETY: handles and places by this function's contract.
    let body = |_: &mut Instance| unsafe {
        let expected = saved(state)?.length();
        if size < expected {
            return Err(Refusal::Buffer {
                expected,
                came: size,
            });
        }
        Destination::new("serializedState", bytes, size)?.write(&saved(state)?.to_bytes());
        Ok(())
    };
    // SAFETY: handle by this function's contract.
    unsafe { call(component, function, body) }
}

/// Makes a saved state of bytes; a handle that holds a state already is used again.
///
/// # Safety
/// Handles of this library, `size` bytes at `bytes` may be read.
pub(super) unsafe fn deserialize(
    function: Call,
    component: Component,
    (bytes, size): (*const u8, size_t),
    state: *mut FmuState,
) -> Status {
    // SAFETY: handles and bytes by this function's contract.
    let body = |instance: &mut Instance| unsafe {
        Destination::new("FMUstate", state, 1)?;
        let snapshot = Snapshot::from_bytes(pointers::slice("serializedState", bytes, size)?)?;
        instance.check(&snapshot)?;
        keep(state, snapshot);
        Ok(())
    };
    // SAFETY: handle by this function's contract.
    unsafe { call(component, function, body) }
}

/// Saves the complete state, mode included; a handle that holds a state already is used again.
///
/// # Safety
/// As the FMI standard asks: `component` and, where not NULL, `*state` came from this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(component: Component, state: *mut FmuState) -> Status {
    // SAFETY: handles as the standard asks.
    unsafe { get(calls::GET_FMU_STATE, component, state) }
}

/// Continues from a saved state, in its mode.
///
/// # Safety
/// As the FMI standard asks: `component` and `state` came from this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(component: Component, state: FmuState) -> Status {
    // SAFETY: handles as the standard asks.
    unsafe { set(calls::SET_FMU_STATE, component, state) }
}

/// Frees a saved state and makes its handle NULL; NULL is legal.
///
/// # Safety
/// As the FMI standard asks: `component` and, where not NULL, `*state` came from this library.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(component: Component, state: *mut FmuState) -> Status {
    // SAFETY: handles as the standard asks.
    unsafe { free(calls::FREE_FMU_STATE, component, state) }
}

/// Count of bytes that fmi2SerializeFMUstate needs for this state.
///
/// # Safety
/// As the FMI standard asks: handles of this library, `size` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(
    component: Component,
    state: FmuState,
    size: *mut size_t,
) -> Status {
    let function = calls::SERIALIZED_FMU_STATE_SIZE;
    // SAFETY: handles and place as the standard asks.
    unsafe { serialized_size(function, component, state, size) }
}

/// Writes a saved state as bytes that another process, on another machine, can read.
///
/// # Safety
/// As the FMI standard asks: handles of this library, `size` bytes at `bytes` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    component: Component,
    state: FmuState,
    bytes: *mut c_char,
    size: size_t,
) -> Status {
    let place = (bytes.cast(), size);
    // SAFETY: handles and places as the standard asks.
    unsafe { serialize(calls::SERIALIZE_FMU_STATE, component, state, place) }
}

/// Makes a saved state of bytes; a handle that holds a state already is used again.
///
/// # Safety
/// As the FMI standard asks: handles of this library, `size` bytes at `bytes` may be read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    component: Component,
    bytes: *const c_char,
    size: size_t,
    state: *mut FmuState,
) -> Status {
    let place = (bytes.cast(), size);
    // SAFETY: handles and bytes as the standard asks.
    unsafe { deserialize(calls::DESERIALIZE_FMU_STATE, component, place, state) }
}
