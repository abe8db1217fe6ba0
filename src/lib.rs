//! Segalman's augmented Iwan joint (SAND2001-0811): simulated exactly, identified from measured
//! force and displacement, diagnosed for what the baseline gets wrong, exported as an FMU.
//!
//! SI units inside; every name that could be doubted carries its unit. ARCHITECTURE.md follows a
//! record through the rooms.

pub mod causes;
#[cfg(feature = "tool")]
pub mod cli;
#[cfg(feature = "tool")]
pub mod diagnose;
pub mod fmu;
#[cfg(feature = "tool")]
pub mod identify;
pub mod joint;
#[cfg(feature = "tool")]
pub mod outside;
#[cfg(feature = "tool")]
pub mod pack;
#[cfg(feature = "tool")]
pub mod read;
#[cfg(feature = "tool")]
pub mod record;
#[cfg(feature = "tool")]
pub mod report;
#[cfg(feature = "tool")]
pub mod residual;
pub mod saved;
pub mod variables;
