//! Evidence, joint refits and the held-out verdict: what is wrong, why, and what it gains.

pub mod findings;

pub use findings::Findings;
