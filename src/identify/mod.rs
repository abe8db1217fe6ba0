//! From a record to a joint: operator dictionary, non-negative least squares, joint refits.

pub mod fit;
pub mod march;
pub mod nonnegative;
pub mod operators;
pub mod problem;
pub mod score;

pub use fit::{Fit, baseline, refit};
pub use operators::{Form, Operators};
pub use problem::{Prediction, Prepared, Problem};
pub use score::{Score, scores};
