//! A joint driven sample by sample, in force or in displacement.

use super::Joint;

/// Which quantity is prescribed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drive {
    /// Force in, displacement out.
    Force,
    /// Displacement in, force out.
    Displacement,
}

/// What the joint answers at one sample. SI units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Output {
    /// Time [s].
    pub time: f64,
    /// Applied force F [N].
    pub force: f64,
    /// Total displacement U [m].
    pub displacement: f64,
    /// Displacement of the Iwan network u [m].
    pub slip_displacement: f64,
    /// Energy dissipated since the start [J], never falling.
    pub dissipation: f64,
    /// Power dissipated over the last step [W].
    pub dissipation_rate: f64,
    /// Energy stored and recoverable [J].
    pub stored_energy: f64,
    /// dF/dU along the direction of the last step [N/m].
    pub tangent_stiffness: f64,
}

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
    /// Time running back.
    #[error("time runs back from {from} s to {to} s")]
    TimeRunsBack {
        /// Last accepted time [s].
        from: f64,
        /// Time asked for [s].
        to: f64,
    },
    /// A saved state that does not belong to this joint.
    #[error("saved state does not fit this joint: {reason}")]
    ForeignState {
        /// What differs.
        reason: String,
    },
}

/// A joint in motion. Owns all its state; starts virgin at zero force and displacement.
#[derive(Debug, Clone)]
pub struct Simulation {
    output: Output,
}

impl Simulation {
    /// A virgin joint, checked against its glossary.
    pub fn new(_joint: &Joint, _drive: Drive) -> Result<Simulation, JointError> {
        todo!()
    }
    /// Takes the input [N or m] at `time` [s]; on an error the state is as before.
    pub fn step(&mut self, _time: f64, _input: f64) -> Result<Output, JointError> {
        todo!()
    }
    /// The last answer.
    pub fn output(&self) -> Output {
        self.output
    }
    /// Complete state as numbers; [`Simulation::restore`] continues identically, to the last bit.
    pub fn state(&self) -> Vec<f64> {
        todo!()
    }
    /// Puts back a saved state of the same joint and drive.
    pub fn restore(&mut self, _state: &[f64]) -> Result<(), JointError> {
        todo!()
    }
}
