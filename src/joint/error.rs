//! Why a joint, a step or a saved state is refused.

/// Why a step or a joint was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum JointError {
    /// A force at or beyond full slip: no displacement answers it.
    #[error(
        "force {force} N reaches full slip at {full_slip} N: no displacement answers it; drive the joint in displacement or lower the load"
    )]
    BeyondFullSlip {
        /// The force asked for [N].
        force: f64,
        /// F_S [N].
        full_slip: f64,
    },
    /// A parameter outside its glossary's range.
    #[error("parameter `{name}` is {value}: it must lie in [{lower}, {upper}]")]
    OutOfRange {
        /// Glossary name.
        name: String,
        /// The value refused.
        value: f64,
        /// Smallest admissible.
        lower: f64,
        /// Largest admissible.
        upper: f64,
    },
    /// An input that is no number.
    #[error("input {value} at t = {time} s is not a finite number")]
    NotFinite {
        /// Time [s].
        time: f64,
        /// The value refused.
        value: f64,
    },
    /// An input so large that the equation of the joint has no finite root.
    #[error("input {value} at t = {time} s is beyond all that this joint can answer in numbers")]
    OutOfReach {
        /// Time [s].
        time: f64,
        /// The value refused.
        value: f64,
    },
    /// Time running back.
    #[error("time runs back from {from} s to {to} s")]
    TimeRunsBack {
        /// Last accepted time [s].
        from: f64,
        /// Time asked for [s].
        to: f64,
    },
    /// Vectors or counts that do not fit together.
    #[error("{what}: {found} values where {expected} are needed")]
    WrongCount {
        /// What was counted.
        what: String,
        /// Count found.
        found: usize,
        /// Count needed.
        expected: usize,
    },
    /// An error at one sample of a record.
    #[error("at t = {time} s (sample {sample}): {reason}")]
    AtSample {
        /// Time [s].
        time: f64,
        /// Number of the sample, from 0.
        sample: usize,
        /// What was refused.
        reason: Box<JointError>,
    },
    /// A saved state that does not belong to this joint.
    #[error("saved state does not fit this joint: {reason}")]
    ForeignState {
        /// What differs.
        reason: String,
    },
}
