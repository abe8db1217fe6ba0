//! The way in: every exported function passes here, where handle and call order are checked, a
//! panic is stopped before it reaches C, and a refusal is told to the host.

use super::c_types::{Component, Status};
use super::calls::Call;
use super::instance::Instance;
use super::logger::Category;
use super::refusal::Refusal;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs one call on the instance behind a handle. A NULL handle is an error without a message: it
/// knows no logger.
///
/// # Safety
/// `component` is NULL or came from fmi2Instantiate, is not freed yet, and no other call on it
/// runs at the same time.
pub unsafe fn call(
    component: Component,
    call: Call,
    body: impl FnOnce(&mut Instance) -> Result<(), Refusal>,
) -> Status {
    // SAFETY: not NULL, it points to the instance that fmi2Instantiate made, for this call alone,
    // by this function's contract.
    match unsafe { component.cast::<Instance>().as_mut() } {
        Some(instance) => on_instance(instance, &call, body),
        None => Status::Error,
    }
}

fn on_instance(
    instance: &mut Instance,
    call: &Call,
    body: impl FnOnce(&mut Instance) -> Result<(), Refusal>,
) -> Status {
    let outcome = stop(|| {
        let came = instance.mode();
        if !call.allowed_in(came) {
            return Err(Refusal::WrongMode {
                expected: call.expected(),
                came,
            });
        }
        body(instance)
    });
    let Err(refusal) = outcome else {
        return Status::Ok;
    };
    if matches!(refusal, Refusal::Defect { .. }) {
        instance.break_down();
    }
    let text = format!("{}: {refusal}", call.name);
    instance
        .messenger()
        .tell(Status::Error, Category::Error, &text);
    Status::Error
}

/// The one stop: a panic becomes [`Refusal::Defect`]. Unwinding into C would end the host.
pub fn stop<T>(body: impl FnOnce() -> Result<T, Refusal>) -> Result<T, Refusal> {
    // What the body leaves half done is never used again: the instance is marked broken.
    catch_unwind(AssertUnwindSafe(body)).unwrap_or_else(|payload| {
        let message = payload
            .downcast_ref::<&str>()
            .map(|text| (*text).to_owned())
            .or_else(|| payload.downcast_ref::<String>().cloned())
            .unwrap_or_else(|| "panic without a text".to_owned());
        Err(Refusal::Defect { message })
    })
}

#[cfg(test)]
mod tests {
    use super::super::bundle::Bundle;
    use super::super::calls;
    use super::super::calls::Mode;
    use super::super::logger::Host;
    use super::*;
    use crate::joint::{Density, Drive, Joint};

    fn instance() -> Instance {
        let density = Density::from_values("four_parameter", &[1000.0, 1e7, -0.3, 0.2]).unwrap();
        let joint = Joint::new(density, f64::INFINITY, Vec::new()).unwrap();
        let bundle = Bundle {
            joint,
            drive: Drive::Force,
            guid: String::new(),
        };
        Instance::new(bundle, "tested", Host::Two(None), false).unwrap()
    }

    fn message<T>(outcome: Result<T, Refusal>) -> String {
        match outcome {
            Err(Refusal::Defect { message }) => message,
            _ => "not stopped".to_owned(),
        }
    }

    #[test]
    fn a_panic_becomes_a_refusal_with_its_text() {
        assert_eq!(message(stop::<()>(|| panic!("plain"))), "plain");
        let value = 7;
        assert_eq!(
            message(stop::<()>(|| panic!("formatted {value}"))),
            "formatted 7"
        );
        let other = stop::<()>(|| std::panic::panic_any(7));
        assert_eq!(message(other), "panic without a text");
        assert_eq!(stop(|| Ok(7)).unwrap(), 7);
    }

    #[test]
    fn after_a_panic_only_reset_a_saved_state_or_freeing_help() {
        let mut instance = instance();
        let status = on_instance(&mut instance, &calls::RESET, |_| panic!("held"));
        assert_eq!((status, instance.mode()), (Status::Error, Mode::Broken));
        let help = [
            "SetDebugLogging",
            "Reset",
            "SetFMUstate",
            "FreeFMUstate",
            "SerializedFMUstateSize",
            "SerializeFMUstate",
            "DeSerializeFMUstate",
        ];
        let mut helped = 0;
        for call in calls::ALL_OF_FMI_2.iter().chain(calls::ALL_OF_FMI_3) {
            let helps = |help: &&str| call.name[4..].eq_ignore_ascii_case(help);
            let expected = if help.iter().any(helps) {
                helped += 1;
                Status::Ok
            } else {
                Status::Error
            };
            let status = on_instance(&mut instance, call, |_| Ok(()));
            assert_eq!(
                (status, instance.mode()),
                (expected, Mode::Broken),
                "{call:?}"
            );
        }
        assert_eq!(helped, 2 * help.len());
        let status = on_instance(&mut instance, &calls::RESET, Instance::reset);
        assert_eq!((status, instance.mode()), (Status::Ok, Mode::Instantiated));
    }
}
