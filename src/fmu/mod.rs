//! The C boundary: FMI 2.0 and FMI 3.0 for co-simulation, each complete, from one library; and the
//! only `unsafe` of the project.
//!
//! An exported function takes three to six lines: it names itself, and [`entry`] checks handle and
//! call order against the one table in [`calls`], holds any panic, and logs any refusal. Pointers
//! become slices and texts in [`pointers`]; everything behind is safe Rust on an
//! [`instance::Instance`]. Outputs are written only on success. There are no globals.

mod bundle;
mod c_types;
mod calls;
mod cosimulation;
mod derivatives;
mod entry;
mod instance;
mod lifecycle;
mod location;
mod logger;
mod pointers;
mod refusal;
mod snapshot;
mod states;
mod stepping;
mod three;
mod values;
mod variable_access;

pub use c_types::{
    Boolean3, CallbackFunctions, Component, FALSE, FmuState, LogMessage, Logger, Status,
    StatusKind, TRUE, Type,
};
pub use cosimulation::*;
pub use instance::TURNING_POINTS;
pub use lifecycle::*;
pub use states::{
    fmi2DeSerializeFMUstate, fmi2FreeFMUstate, fmi2GetFMUstate, fmi2SerializeFMUstate,
    fmi2SerializedFMUstateSize, fmi2SetFMUstate,
};
pub use three::*;
pub use variable_access::*;
