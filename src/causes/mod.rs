//! The catalogue of named causes: one file each, one line each in [`CATALOGUE`].

use crate::joint::effect::Effect;

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

/// A named cause: an effect, the page that explains it, and where a search for it starts.
pub trait Cause: Effect {
    /// The page.
    fn page(&self) -> Page;
    /// This cause as the effect it brings to the simulation.
    fn effect(&self) -> &'static dyn Effect;
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
pub static CATALOGUE: &[&dyn Cause] = &[];

/// The cause of that name.
pub fn find(name: &str) -> Option<&'static dyn Cause> {
    CATALOGUE.iter().copied().find(|cause| cause.name() == name)
}
