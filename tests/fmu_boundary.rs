//! The C boundary of the FMU, called as an importer calls it.

#[path = "fmu/host.rs"]
mod host;

#[path = "fmu/call_order.rs"]
mod call_order;
#[path = "fmu/communication.rs"]
mod communication;
#[path = "fmu/derivatives.rs"]
mod derivatives;
#[path = "fmu/instances.rs"]
mod instances;
#[path = "fmu/messages.rs"]
mod messages;
#[path = "fmu/states.rs"]
mod states;
#[path = "fmu/steps.rs"]
mod steps;
#[path = "fmu/three.rs"]
mod three;
#[path = "fmu/values.rs"]
mod values;
