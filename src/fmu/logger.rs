//! Messages to the host: the variadic logger callback.

use super::c_types::{CallbackFunctions, Status};
use std::ffi::CString;

/// Categories of messages, as modelDescription.xml lists them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Category {
    /// Why a call was refused; always told.
    Error,
    /// What happened; told while debug logging is on.
    Event,
}

impl Category {
    /// Name in the XML.
    pub fn name(self) -> &'static str {
        match self {
            Category::Error => "logStatusError",
            Category::Event => "logEvents",
        }
    }

    /// The category of that name.
    pub fn find(name: &str) -> Option<Category> {
        [Category::Error, Category::Event]
            .into_iter()
            .find(|category| category.name() == name)
    }
}

/// The host's logger with the name under which the instance speaks.
#[derive(Debug)]
pub struct Messenger {
    callbacks: Option<CallbackFunctions>,
    instance: CString,
    /// True while events are told.
    pub debug: bool,
}

impl Messenger {
    /// Takes a copy of the callbacks; `None` where the host gave NULL.
    pub fn new(callbacks: Option<CallbackFunctions>, instance: &str, debug: bool) -> Messenger {
        Messenger {
            callbacks,
            instance: c_text(instance),
            debug,
        }
    }

    /// Hands a text to the host; no logger, no message. The text travels as the *format* of a
    /// printf, so every `%` in it is doubled and no argument follows.
    pub fn tell(&self, status: Status, category: Category, text: &str) {
        if category == Category::Event && !self.debug {
            return;
        }
        let Some(CallbackFunctions {
            logger: Some(logger),
            component_environment,
            ..
        }) = self.callbacks
        else {
            return;
        };
        let format = c_text(&text.replace('%', "%%"));
        let category = c_text(category.name());
        // SAFETY: the host promises that the logger of fmi2Instantiate stays callable until
        // fmi2FreeInstance; the texts live to the end of this block and the format consumes no
        // arguments.
        unsafe {
            logger(
                component_environment,
                self.instance.as_ptr(),
                status as libc::c_int,
                category.as_ptr(),
                format.as_ptr(),
            );
        }
    }
}

/// A C string; NUL characters inside would end it early and become `?`.
fn c_text(text: &str) -> CString {
    CString::new(text.replace('\0', "?")).unwrap_or_default()
}
