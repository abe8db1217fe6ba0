//! From records to a joint: the report's own procedure, the operator dictionary with its
//! non-negative least squares and joint refits, the parametric families, and the intervals of what
//! they give.

mod before_all;
pub mod beginning;
mod bonds;
mod bracket;
mod driven;
pub mod exported;
pub mod family;
pub mod fewer;
pub mod finer;
pub mod fit;
mod flanks;
mod gone_on;
mod inertia;
pub mod initial;
pub mod interval;
pub mod lanes;
mod late;
pub mod linearised;
pub mod march;
pub mod nonnegative;
pub mod operators;
mod passes;
pub mod past;
pub mod prepared;
pub mod problem;
mod reached;
mod remembered;
pub mod rows;
pub mod scatter;
pub mod score;
pub mod seed;
pub mod series;
mod slopes;
pub mod smoothing;
mod strides;
pub mod summed;
pub mod table;
mod tips;
mod turns;
mod undone;
mod walk;
pub mod weighing;

pub use driven::as_driven;
pub use family::{FamilyError, FamilyFit};
pub use fit::{Fit, PROSPECT, baseline, glanced, refit, refit_below, suited, without};
pub use interval::Estimated;
pub use operators::{Form, Operators};
pub use prepared::Prepared;
pub use problem::{HAULING, Prediction, Problem, TURNS};
pub use scatter::scatter;
pub use score::{Score, scores};
pub use seed::{Seed, SeedError};
pub use slopes::size_of;
pub use smoothing::smoothed;
