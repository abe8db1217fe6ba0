//! Densities of break-free forces that the product supports.

mod sliders;

pub use sliders::Sliders;

/// A density ρ(φ) of break-free forces.
#[derive(Debug, Clone, PartialEq)]
pub enum Density {
    /// A finite set of sliders.
    Sliders(Sliders),
}
