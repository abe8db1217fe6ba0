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
