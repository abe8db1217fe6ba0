//! What the comparison asks of an importer, whatever the version of the archive.

use std::fmt::Display;

/// A call that an archive refused, and how.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{call}: {answer}")]
pub struct Refused {
    /// The function, with what it was asked.
    pub call: String,
    /// Status or message of the importer.
    pub answer: String,
}

impl Refused {
    /// Of a call and what the importer says of it.
    pub fn new(call: impl Into<String>, answer: impl Display) -> Refused {
        let call = call.into();
        let answer = answer.to_string();
        Refused { call, answer }
    }
}

/// One instance of an archive inside an independent importer. Times in seconds; values in the
/// variables' SI units.
pub trait Unit {
    /// Begins Initialization Mode, with this start time.
    ///
    /// # Errors
    /// [`Refused`], as everywhere below.
    fn enter_initialization(&mut self, time: f64) -> Result<(), Refused>;
    /// Ends Initialization Mode.
    fn exit_initialization(&mut self) -> Result<(), Refused>;
    /// Sets the input.
    fn set(&mut self, input: u32, value: f64) -> Result<(), Refused>;
    /// One communication step.
    fn step(&mut self, from: f64, size: f64) -> Result<(), Refused>;
    /// Values of variables.
    fn read(&mut self, references: &[u32]) -> Result<Vec<f64>, Refused>;
    /// Back to before [`Unit::enter_initialization`].
    fn reset(&mut self) -> Result<(), Refused>;
    /// The state as bytes.
    fn save(&mut self) -> Result<Vec<u8>, Refused>;
    /// Continues from such bytes.
    fn restore(&mut self, bytes: &[u8]) -> Result<(), Refused>;
}
