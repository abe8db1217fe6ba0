//! From records to a joint: the report's own procedure, the operator dictionary, the parametric
//! families, and the intervals of what they give.

pub mod family;
pub mod interval;
pub mod seed;

pub use family::{Fit, FitError};
pub use interval::Estimated;
pub use seed::{Seed, SeedError};
