//! The C boundary of the FMU, called as an importer calls it.

#[path = "fmu/host.rs"]
mod host;

#[path = "fmu/accuracy.rs"]
mod accuracy;
#[path = "fmu/bolts.rs"]
mod bolts;
#[path = "fmu/bounds.rs"]
mod bounds;
#[path = "fmu/call_order.rs"]
mod call_order;
#[path = "fmu/call_table.rs"]
mod call_table;
#[path = "fmu/communication.rs"]
mod communication;
#[path = "fmu/derivatives.rs"]
mod derivatives;
#[path = "fmu/instances.rs"]
mod instances;
#[path = "fmu/messages.rs"]
mod messages;
#[path = "fmu/not_finite.rs"]
mod not_finite;
#[path = "fmu/null_pointers.rs"]
mod null_pointers;
#[path = "fmu/refused_steps.rs"]
mod refused_steps;
#[path = "fmu/reversal.rs"]
mod reversal;
#[path = "fmu/states.rs"]
mod states;
#[path = "fmu/steps.rs"]
mod steps;
#[path = "fmu/three.rs"]
mod three;
#[path = "fmu/three_calls.rs"]
mod three_calls;
#[path = "fmu/three_host.rs"]
mod three_host;
#[path = "fmu/two_calls.rs"]
mod two_calls;
#[path = "fmu/values.rs"]
mod values;
#[path = "fmu/work.rs"]
mod work;
