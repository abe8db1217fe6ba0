//! FMI 3.0 for co-simulation: the same instances under the functions of the third version.
//!
//! Every function of fmi3FunctionTypes.h is there. What co-simulation of a joint has no use for
//! (events, clocks, intermediate update, configuration mode, model exchange, scheduled execution,
//! other types than Float64) is declared as absent in modelDescription.xml and refused when called.

mod absent;
mod cosimulation;
mod lifecycle;
mod states;
mod values;

pub use absent::*;
pub use cosimulation::*;
pub use lifecycle::*;
pub use states::*;
pub use values::*;
