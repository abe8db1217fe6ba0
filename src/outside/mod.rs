//! Laws that are no cause of the catalogue, known so that none of it is blamed for what they do: one file each,
//! one line each in [`OUTSIDE`].

mod heated_friction;
mod remade_joint;
mod settling;
mod warming_gain;

use crate::causes::Scale;
use crate::joint::effect::Effect;

/// A law that a joint or a specimen may follow and the catalogue does not have.
pub trait Outsider: Effect {
    /// True for a cause of this name that it passes for.
    fn passes_for(&self, cause: &str) -> bool;
    /// Where a search starts, as [`crate::causes::Cause::starts`].
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>>;
    /// The values with refinements of the law begun; the same where it has none.
    fn refined(&self, values: &[f64], _scale: &Scale) -> Vec<f64> {
        values.to_vec()
    }
    /// False where the fitted values are those of a cause.
    fn plausible(&self, values: &[f64], scale: &Scale) -> bool;
    /// True where a single cause that explains the records worse is no likelier for being in the catalogue.
    fn stands_for_one(&self) -> bool {
        false
    }
    /// True for a law of joints that are made anew for every test.
    fn is_made_anew(&self) -> bool {
        false
    }
    /// What it may be, as a clause.
    fn words(&self) -> &'static str;
    /// This law as the effect it brings to the simulation.
    fn effect(&self) -> &'static dyn Effect;
    /// True where the law depends on time, so that a record without time cannot show it.
    fn needs_time(&self) -> bool {
        false
    }
}

/// Every such law.
pub static OUTSIDE: &[&dyn Outsider] = &[
    &heated_friction::HeatedFriction,
    &remade_joint::RemadeJoint,
    &settling::Settling,
    &warming_gain::WarmingGain,
];
