//! Messages to the host: the variadic logger callback of FMI 2.0, and that of FMI 3.0.

use super::c_types::{CallbackFunctions, LogMessage, Status};
use libc::c_void;
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

/// Version of the standard that the host speaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standard {
    /// FMI 2.0.
    Two,
    /// FMI 3.0.
    Three,
}

impl Standard {
    /// Name of the type of our variables.
    pub fn real(self) -> &'static str {
        match self {
            Standard::Two => "Real",
            Standard::Three => "Float64",
        }
    }

    /// Name of the argument that binds XML and joint.
    pub fn token(self) -> &'static str {
        match self {
            Standard::Two => "fmuGUID",
            Standard::Three => "instantiationToken",
        }
    }

    /// Name of the argument that tells where the folder `resources` is.
    pub fn resources(self) -> &'static str {
        match self {
            Standard::Two => "fmuResourceLocation",
            Standard::Three => "resourcePath",
        }
    }

    /// A text as the argument `message` of the logger. In either version `#` begins the reference
    /// of a variable, so every `#` is doubled; in FMI 2.0 the message is moreover the *format* of a
    /// printf, so every `%` is doubled and no argument follows.
    fn message(self, text: &str) -> String {
        let text = text.replace('#', "##");
        match self {
            Standard::Two => text.replace('%', "%%"),
            Standard::Three => text,
        }
    }
}

/// Where messages go: one logger per version of the standard, each of which may be NULL.
#[derive(Debug, Clone, Copy)]
pub enum Host {
    /// Callbacks of FMI 2.0; `None` where the host gave NULL.
    Two(Option<CallbackFunctions>),
    /// Callback of FMI 3.0 with its environment.
    Three(Option<LogMessage>, *mut c_void),
}

/// The host's logger with the name under which the instance speaks.
#[derive(Debug)]
pub struct Messenger {
    host: Host,
    instance: CString,
    /// True while events are told.
    pub debug: bool,
}

impl Messenger {
    /// Takes a copy of the callbacks.
    pub fn new(host: Host, instance: &str, debug: bool) -> Messenger {
        Messenger {
            host,
            instance: c_text(instance),
            debug,
        }
    }

    /// What the host speaks.
    pub fn standard(&self) -> Standard {
        match self.host {
            Host::Two(_) => Standard::Two,
            Host::Three(..) => Standard::Three,
        }
    }

    /// Hands a text to the host, escaped as its version asks; no logger, no message.
    pub fn tell(&self, status: Status, category: Category, text: &str) {
        if category == Category::Event && !self.debug {
            return;
        }
        let name = c_text(category.name());
        let message = c_text(&self.standard().message(text));
        match self.host {
            Host::Two(Some(CallbackFunctions {
                logger: Some(logger),
                component_environment,
                ..
            })) => {
                // SAFETY: the host promises that the logger of fmi2Instantiate stays callable until
                // fmi2FreeInstance; the texts live to the end of this block and the format consumes
                // no arguments.
                unsafe {
                    logger(
                        component_environment,
                        self.instance.as_ptr(),
                        status as libc::c_int,
                        name.as_ptr(),
                        message.as_ptr(),
                    );
                }
            }
            Host::Three(Some(logger), environment) => {
                // SAFETY: the host promises that the logger stays callable until fmi3FreeInstance;
                // the texts live to the end of this block.
                unsafe {
                    logger(
                        environment,
                        status as libc::c_int,
                        name.as_ptr(),
                        message.as_ptr(),
                    );
                }
            }
            Host::Two(_) | Host::Three(None, _) => (),
        }
    }
}

/// A C string; NUL characters inside would end it early and become `?`.
fn c_text(text: &str) -> CString {
    CString::new(text.replace('\0', "?")).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_version_reads_as_more_than_text_is_doubled() {
        let text = "/data/#1#/50 %/joint.json";
        let two = Standard::Two.message(text);
        assert_eq!(two, "/data/##1##/50 %%/joint.json");
        let three = Standard::Three.message(text);
        assert_eq!(three, "/data/##1##/50 %/joint.json");
        for standard in [Standard::Two, Standard::Three] {
            assert_eq!(standard.message("came 4711"), "came 4711");
        }
    }
}
