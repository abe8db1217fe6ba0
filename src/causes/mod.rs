//! The catalogue of named causes: one file each, one line each in [`CATALOGUE`].

mod ac_coupling;
mod asymmetric_friction;
mod chain;
mod clearance;
mod creep;
mod cubic_stiffness;
pub(crate) mod displacement_drift;
mod fixture_inertia;
mod free_play;
mod joint_opening;
mod mains_hum;
mod normal_load_variation;
mod offset_step;
mod pinning;
mod preload_loss;
mod quadratic_damping;
mod rate_dependent_friction;
mod running_in;
mod sensor_delay;
mod sensor_nonlinearity;
mod sensor_saturation;
mod slack_growth;
mod spring;
mod static_friction_drop;
mod velocity_weakening;
mod viscous_damping;
mod wear;

use crate::joint::effect::{Acting, Effect, Trajectory};

/// Whether a cause belongs to the joint (exported) or to the measuring chain (removed).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Part of the joint and of the exported FMU.
    Joint,
    /// Part of the measuring chain: corrected in the record, never exported.
    Measurement,
}

/// The page of a cause: what an engineer reads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Page {
    /// What happens in the joint or the instrument.
    pub happens: &'static str,
    /// The sign it leaves in the record.
    pub sign: &'static str,
    /// Names of the causes it is mistaken for.
    pub mistaken_for: &'static [&'static str],
    /// What separates it from those.
    pub separated_by: &'static str,
    /// The law, in symbols of its glossary.
    pub formula: &'static str,
    /// Where the law is from.
    pub source: &'static str,
}

/// Sizes of a record that tell where a search starts. SI units.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Scale {
    /// Largest magnitude of the force \[N\].
    pub force: f64,
    /// Largest magnitude of the displacement \[m\].
    pub displacement: f64,
    /// Largest rate of the displacement \[m/s\].
    pub velocity: f64,
    /// Stiffness of the baseline at small amplitude \[N/m\].
    pub stiffness: f64,
    /// Energy the baseline dissipates over the longest record \[J\].
    pub dissipation: f64,
    /// Path of the displacement over the longest record \[m\].
    pub path: f64,
    /// Energy \[J\] and path \[m\] of the same until the load has turned twice, the least of all records that do.
    pub first_turns: (f64, f64),
    /// Lengths of all records in their order \[s\].
    pub lengths: Vec<f64>,
    /// Times at which the displacement may have jumped, counted through the records one after another
    /// \[s\].
    pub jumps: Vec<f64>,
    /// Shortest period of the drive \[s\].
    pub period: f64,
    /// Period of the slowest record, `2π rms(U)/rms(U̇)` of its motion \[s\].
    pub slowest: f64,
    /// Time between samples, of the coarsest record \[s\].
    pub step: f64,
    /// The same of the finest record \[s\].
    pub finest: f64,
    /// True where the displacement drives, so that what a load cell adds shows as it is; where the force drives, a jump
    /// or a hum of its reading looks like one of the displacement's.
    pub judges_force: bool,
    /// Frequencies faster than the load at which what the baseline leaves is loudest \[rad/s\].
    pub ringing: Vec<f64>,
    /// Frequencies near each of those of the mains at which it is loudest \[Hz\].
    pub mains: Vec<f64>,
}

impl Scale {
    /// Length of the longest record \[s\].
    pub fn duration(&self) -> f64 {
        self.lengths.iter().copied().fold(0.0, f64::max)
    }
}

/// A named cause: an effect, the page that explains it, and where a search for it starts.
pub trait Cause: Effect {
    /// The page.
    fn page(&self) -> Page;
    /// This cause as the effect it brings to the simulation.
    fn effect(&self) -> &'static dyn Effect;
    /// Where a search starts: full sets of values with a small amplitude, one for each shape worth
    /// trying; the search scales the amplitude itself.
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>>;
    /// The law with refinements held elsewhere than at what is neutral, and starts beside these values: what a record
    /// that ends early does not tell from it, and that bounds the values.
    fn beside(&self, _values: &[f64]) -> Vec<Acting> {
        Vec::new()
    }
    /// Values from which refinements of the law that are neutral so far are fitted as well; the same
    /// values where there are none, or where a shape has them from its start.
    fn refined(&self, values: &[f64], _scale: &Scale) -> Vec<f64> {
        values.to_vec()
    }
    /// Other values of a refined law to begin from once more, where those fitted are the end of a way.
    fn begun_anew(&self, _values: &[f64], _scale: &Scale) -> Option<Vec<f64>> {
        None
    }
    /// The same size in the other form of a law that has two of its own kind.
    fn otherwise(&self, _values: &[f64]) -> Option<Vec<f64>> {
        None
    }
    /// False where the fitted values are those of another cause: two laws may be the same formula
    /// in different ranges.
    fn plausible(&self, _values: &[f64], _scale: &Scale) -> bool {
        true
    }
    /// Another cause whose law is the same formula with these values, and whose word fits them as well.
    fn also_called(&self, _values: &[f64], _scale: &Scale) -> Option<&'static str> {
        None
    }
    /// What is not in the catalogue and would leave the same trace in a test that went like this; the
    /// cause is named then, and not taken for the whole explanation.
    fn double(&self, _values: &[f64], _truth: &Trajectory) -> Option<&'static str> {
        None
    }
    /// True where the cause depends on time, so that a record without time cannot show it.
    fn needs_time(&self) -> bool {
        false
    }
    /// True where records show it that are `timed`, or are not.
    fn is_told(&self, timed: bool) -> bool {
        timed || !self.needs_time()
    }
    /// True where its law is what happens, as a tone is, so that no other cause mends it.
    fn is_exact(&self) -> bool {
        false
    }
    /// True where it happens once, at a time of its own, so that another test need not have it.
    fn happens_once(&self) -> bool {
        false
    }
    /// Joint or measuring chain, by the place where it acts.
    fn kind(&self) -> Kind {
        if self.place().is_measurement() {
            Kind::Measurement
        } else {
            Kind::Joint
        }
    }
}

/// Every cause known, in the order of the documentation.
pub static CATALOGUE: &[&dyn Cause] = &[
    &viscous_damping::ViscousDamping,
    &quadratic_damping::QuadraticDamping,
    &pinning::Pinning,
    &clearance::Clearance,
    &slack_growth::SlackGrowth,
    &cubic_stiffness::CubicStiffness,
    &joint_opening::JointOpening,
    &asymmetric_friction::AsymmetricFriction,
    &normal_load_variation::NormalLoadVariation,
    &preload_loss::PreloadLoss,
    &running_in::RunningIn,
    &rate_dependent_friction::RateDependentFriction,
    &velocity_weakening::VelocityWeakening,
    &static_friction_drop::StaticFrictionDrop,
    &creep::Creep,
    &fixture_inertia::FixtureInertia,
    &sensor_delay::SensorDelay,
    &displacement_drift::DisplacementDrift,
    &offset_step::OffsetStep,
    &mains_hum::MainsHum,
    &ac_coupling::AcCoupling,
    &sensor_saturation::SensorSaturation,
    &sensor_nonlinearity::SensorNonlinearity,
];

/// The cause of that name.
pub fn find(name: &str) -> Option<&'static dyn Cause> {
    CATALOGUE.iter().copied().find(|cause| cause.name() == name)
}
