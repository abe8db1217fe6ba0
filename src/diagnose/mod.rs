//! Evidence, joint refits and the held-out verdict: what is wrong, why, and what it gains.

pub mod findings;
pub mod prepare;
pub mod search;

pub use findings::Findings;
