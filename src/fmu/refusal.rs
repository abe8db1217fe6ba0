//! Why a call was refused: what was expected and what came.

use super::calls::Mode;
use super::location::LocationError;
use super::snapshot::SnapshotError;
use crate::joint::JointError;
use crate::joint::error::{admitted, shown};
use crate::saved::SavedError;
use crate::variables::VariableError;
use std::path::PathBuf;

/// Why a call was refused. The message that reaches the host is `function: refusal`.
#[derive(Debug, thiserror::Error)]
pub enum Refusal {
    /// Called out of order.
    #[error("expected mode {expected}, came in mode {}", came.name())]
    WrongMode { expected: String, came: Mode },
    /// NULL where something must be.
    #[error("{argument}: expected a pointer, came NULL")]
    NullPointer { argument: &'static str },
    /// A pointer that cannot point to its type.
    #[error("{argument}: expected an aligned pointer, came a misaligned one")]
    Misaligned { argument: &'static str },
    /// A count beyond the address space.
    #[error("{argument}: expected at most {largest} items, came {count}")]
    TooMany {
        argument: &'static str,
        count: usize,
        largest: usize,
    },
    /// A text in another encoding.
    #[error("{argument}: expected UTF-8, came other bytes")]
    NotUtf8 { argument: &'static str },
    /// Model exchange, or a number that is no type.
    #[error("fmuType: expected 1 (co-simulation), came {came}")]
    NotCoSimulation { came: i32 },
    /// XML and joint from different exports.
    #[error(
        "{argument}: expected {force_driven} or {displacement_driven}, as resources/joint.json says, \
         came {came}: the archive's parts belong to different exports"
    )]
    WrongGuid {
        argument: &'static str,
        force_driven: String,
        displacement_driven: String,
        came: String,
    },
    /// No location.
    #[error(
        "{argument}: expected where the folder `resources` is, came NULL: the joint is in \
         resources/joint.json"
    )]
    NoLocation { argument: &'static str },
    /// A location that is not understood.
    #[error("{argument}: {error}")]
    Location {
        argument: &'static str,
        error: LocationError,
    },
    /// joint.json is not there or not readable.
    #[error("expected the joint in {path}, came: {error}")]
    Unreadable {
        path: PathBuf,
        error: std::io::Error,
    },
    /// joint.json is no joint.
    #[error(transparent)]
    Saved(#[from] SavedError),
    /// The joint cannot be shown.
    #[error(transparent)]
    Variables(#[from] VariableError),
    /// The physics refuses.
    #[error(transparent)]
    Joint(#[from] JointError),
    /// A saved state that does not fit.
    #[error(transparent)]
    Snapshot(#[from] SnapshotError),
    /// A reference that no variable has.
    #[error("expected the reference of a variable of type {expected}, came {came}")]
    UnknownReference { expected: &'static str, came: u32 },
    /// A variable that is not for setting.
    #[error("expected an input or, before the first step, a parameter; came {causality} `{name}`")]
    NotSettable {
        name: String,
        causality: &'static str,
    },
    /// A parameter after the start.
    #[error(
        "expected parameter `{name}` before the end of Initialization Mode: it is fixed afterwards"
    )]
    Fixed { name: String },
    /// A value outside its bounds, or no number.
    #[error(
        "`{name}`: expected a value that is {}, came {}",
        admitted(*.lower, *.upper),
        shown(*.came)
    )]
    OutOfRange {
        name: String,
        lower: f64,
        upper: f64,
        came: f64,
    },
    /// A derivative of something else than the input.
    #[error("expected the reference of the input, came {came}")]
    NotInput { came: u32 },
    /// A seed that is no number.
    #[error("{argument}[{place}]: expected a finite number, came {came}")]
    Seed {
        argument: &'static str,
        place: usize,
        came: f64,
    },
    /// A derivative that is not used.
    #[error("expected an order from 1 to {largest}, came {came}")]
    Order { largest: usize, came: i32 },
    /// A derivative of the input or of a parameter.
    #[error("expected the reference of an output, came {came}")]
    NotAnswer { came: u32 },
    /// A variable that is itself a slope, or a slope without a finite value.
    #[error("`{name}` has no derivative here")]
    NoDerivative { name: String },
    /// Counts that do not fit together.
    #[error("{argument}: expected {expected} items, came {came}")]
    Count {
        argument: &'static str,
        expected: usize,
        came: usize,
    },
    /// A service that modelDescription.xml does not offer.
    #[error("expected no call: modelDescription.xml does not offer {capability}")]
    NotOffered { capability: &'static str },
    /// A step that cannot be.
    #[error("communicationStepSize: expected a finite number from 0 on, came {}", shown(*.came))]
    StepSize { came: f64 },
    /// A step from elsewhere.
    #[error(
        "currentCommunicationPoint: expected {} s (to {tolerance:e} s), came {} s",
        shown(*.expected),
        shown(*.came)
    )]
    CommunicationPoint {
        expected: f64,
        tolerance: f64,
        came: f64,
    },
    /// A step past the end.
    #[error("expected a step that ends by the stop time {} s, came one to {} s", shown(*.stop), shown(*.came))]
    PastStop { stop: f64, came: f64 },
    /// Times of an experiment that cannot be.
    #[error("expected finite times with stop after start, came start {} s, {}", shown(*.start), stopping(*stop))]
    Times { start: f64, stop: Option<f64> },
    /// A status that is not asked like this.
    #[error("expected status kind {expected}, came {came}")]
    StatusKind { expected: &'static str, came: i32 },
    /// A category that the XML does not list.
    #[error("expected category logStatusError or logEvents, came `{came}`")]
    Category { came: String },
    /// A buffer too small for a state.
    #[error("size: expected at least {expected} bytes, came {came}")]
    Buffer { expected: usize, came: usize },
    /// A panic that was held: a defect of this library.
    #[error("a defect in the joint's library was held: {message}; the instance needs a reset")]
    Defect { message: String },
}

fn stopping(stop: Option<f64>) -> String {
    stop.map_or("no stop".to_owned(), |stop| {
        format!("stop {} s", shown(stop))
    })
}
