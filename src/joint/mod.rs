//! The physics of the joint: densities, virgin curve, exact memory, slider network, effects.

pub mod course;
pub mod density;
pub mod effect;
pub(crate) mod elementary;
pub mod error;
mod extended;
pub mod memory;
pub mod network;
pub mod outlook;
pub mod parameters;
pub mod passed;
pub mod play;
pub mod sensitivity;
pub mod simulation;
pub mod sticking;
mod turnings;
pub mod virgin;

pub use density::{Density, FourParameter, PowerLaw, PowerLawTable, Sliders, SmallForce};
pub use effect::{Acting, Effect, Place, Response, Situation, SlipLimit, Trajectory};
pub use error::JointError;
pub use extended::MOST_TRIALS;
pub use memory::ExactResponse;
pub use network::Network;
pub use parameters::Parameter;
pub use passed::Passed;
pub use play::{PlayNetwork, Plays};
pub use sensitivity::Sensitivity;
pub use simulation::{Drive, Output, Simulation, time_passing};
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

impl Joint {
    /// A joint whose parameters lie in the ranges of their glossaries.
    ///
    /// # Errors
    /// As [`Joint::check`].
    pub fn new(
        density: Density,
        series_stiffness: f64,
        effects: Vec<Acting>,
    ) -> Result<Joint, JointError> {
        let joint = Joint {
            density,
            series_stiffness,
            effects,
        };
        joint.check()?;
        Ok(joint)
    }

    /// Holds K_1 and the effects against their glossaries; a density checks itself when made.
    ///
    /// # Errors
    /// [`JointError::OutOfRange`] names the parameter as `cause.parameter`;
    /// [`JointError::WrongCount`] where an effect has more or fewer values than parameters.
    pub fn check(&self) -> Result<(), JointError> {
        within(
            &SERIES_STIFFNESS,
            SERIES_STIFFNESS.name,
            self.series_stiffness,
        )?;
        within(
            &INITIAL_STIFFNESS,
            INITIAL_STIFFNESS.name,
            self.density.initial_stiffness(),
        )?;
        for acting in &self.effects {
            let name = acting.effect.name();
            let glossary = acting.effect.parameters();
            if glossary.len() != acting.values.len() {
                return Err(JointError::WrongCount {
                    what: format!("parameters of `{name}`"),
                    found: acting.values.len(),
                    expected: glossary.len(),
                });
            }
            for (parameter, value) in glossary.iter().zip(&acting.values) {
                within(parameter, &format!("{name}.{}", parameter.name), *value)?;
            }
        }
        Ok(())
    }

    /// Stiffness of the first motion without effects, `K_1 K_T/(K_1 + K_T)` \[N/m\].
    pub fn initial_stiffness(&self) -> f64 {
        simulation::behind(self.density.initial_stiffness(), self.series_stiffness)
    }

    /// F_S \[N\] of the network without effects (Eq. 33); infinite with an elastic remainder.
    pub fn full_slip_force(&self) -> f64 {
        self.density.full_slip_force()
    }

    /// Answers to a whole record, from the virgin state: `time` \[s\] and `input` \[N or m\] of
    /// equal length give as many outputs.
    ///
    /// # Errors
    /// As [`Simulation::new`]; [`JointError::WrongCount`] for channels of unequal length, and
    /// [`JointError::AtSample`] with time and number of the sample that was refused.
    pub fn simulate(
        &self,
        drive: Drive,
        time: &[f64],
        input: &[f64],
    ) -> Result<Vec<Output>, JointError> {
        if time.len() != input.len() {
            return Err(JointError::WrongCount {
                what: "input".into(),
                found: input.len(),
                expected: time.len(),
            });
        }
        let mut simulation = Simulation::new(self, drive)?;
        let samples = time.iter().zip(input).enumerate();
        samples
            .map(|(sample, (&time, &input))| {
                simulation
                    .step(time, input)
                    .map_err(|reason| JointError::AtSample {
                        time,
                        sample,
                        reason: Box::new(reason),
                    })
            })
            .collect()
    }
}

fn within(parameter: &Parameter, name: &str, value: f64) -> Result<(), JointError> {
    if (parameter.lower..=parameter.upper).contains(&value) {
        return Ok(());
    }
    Err(JointError::OutOfRange {
        name: name.into(),
        value,
        lower: parameter.lower,
        upper: parameter.upper,
    })
}

/// Glossary entry of K_1.
pub const SERIES_STIFFNESS: Parameter = Parameter {
    name: "series_stiffness",
    symbol: "K_1",
    unit: "N/m",
    lower: f64::MIN_POSITIVE,
    upper: f64::INFINITY,
    vanishes_at: Some(f64::INFINITY),
    neutral: None,
    meaning: "Stiffness of the spring in series with the Iwan network; infinite where rigid.",
};

const INITIAL_STIFFNESS: Parameter = Parameter {
    name: "initial stiffness of the density",
    symbol: "K_T",
    unit: "N/m",
    lower: f64::MIN_POSITIVE,
    upper: f64::MAX,
    vanishes_at: None,
    neutral: None,
    meaning: "Stiffness of the network before any slip.",
};
