//! Glossary: one entry per physical parameter, used by joint.json, the FMU, reports and pages.

/// One physical parameter: its name in words, the symbol of the literature, SI unit and range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// Identifier in words, e.g. `slip_force`.
    pub name: &'static str,
    /// Symbol in the documentation, e.g. `F_S`.
    pub symbol: &'static str,
    /// SI unit as FMI writes it, e.g. `N/m`; `1` where dimensionless.
    pub unit: &'static str,
    /// Smallest admissible value (inclusive).
    pub lower: f64,
    /// Largest admissible value (inclusive).
    pub upper: f64,
    /// Value at which an effect vanishes; `None` for a shape parameter that has no such value
    /// (the effect then vanishes with its other parameters).
    pub vanishes_at: Option<f64>,
    /// Value at which a refinement of the law drops out; a fit leaves it there unless the data ask
    /// for more.
    pub neutral: Option<f64>,
    /// One sentence.
    pub meaning: &'static str,
}
