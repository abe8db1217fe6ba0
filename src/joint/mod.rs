//! The physics of the joint: densities, virgin curve, exact memory, slider network, effects.

pub mod density;
pub mod effect;
pub mod memory;
pub mod parameters;
pub mod simulation;
pub mod virgin;

pub use density::{Density, FourParameter, PowerLaw, PowerLawTable, Sliders, SmallForce};
pub use effect::{Acting, Effect, Place, Response, Situation, SlipLimit, Trajectory};
pub use memory::ExactResponse;
pub use parameters::Parameter;
pub use simulation::{Drive, JointError, Output, Simulation};
pub use virgin::{BehindSpring, VirginCurve};

/// Segalman's augmented joint (Eq. 52): a spring K_1 in series with an Iwan network, and the
/// effects that act on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Density of the network's break-free forces.
    pub density: Density,
    /// K_1 \[N/m\]; infinite where the network carries all the compliance.
    pub series_stiffness: f64,
    /// Effects beyond the baseline, in any order; joint causes only.
    pub effects: Vec<Acting>,
}
