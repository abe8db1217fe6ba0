//! Densities of break-free forces that the product supports, one file per family.

mod cells;
mod four_parameter;
mod power_law;
mod power_law_table;
mod seed;
mod sliders;
mod small_force;

pub use four_parameter::FourParameter;
pub use power_law::PowerLaw;
pub use power_law_table::PowerLawTable;
pub use sliders::Sliders;
pub use small_force::SmallForce;

use super::parameters::Parameter;
use super::simulation::JointError;
use super::virgin::VirginCurve;

/// A density ρ(φ) of break-free forces.
#[derive(Debug, Clone, PartialEq)]
pub enum Density {
    /// The report's power law below a limit, the remainder elastic.
    PowerLaw(PowerLaw),
    /// A power law joined to a table above it.
    PowerLawTable(PowerLawTable),
    /// Segalman's of 2005, with full slip.
    FourParameter(FourParameter),
    /// A finite set of sliders.
    Sliders(Sliders),
}

impl Density {
    /// Name of the family in joint.json.
    pub fn family(&self) -> &'static str {
        match self {
            Density::PowerLaw(_) => "power_law",
            Density::PowerLawTable(_) => "power_law_table",
            Density::FourParameter(_) => "four_parameter",
            Density::Sliders(_) => "sliders",
        }
    }

    /// Glossary of the family's scalar parameters.
    pub fn parameters(&self) -> &'static [Parameter] {
        match self {
            Density::PowerLaw(_) => PowerLaw::PARAMETERS,
            Density::PowerLawTable(_) => PowerLawTable::PARAMETERS,
            Density::FourParameter(_) => FourParameter::PARAMETERS,
            Density::Sliders(_) => Sliders::PARAMETERS,
        }
    }

    /// Scalar parameters in the order of [`Density::parameters`], SI units; tables and sliders
    /// have their vectors beside these.
    pub fn values(&self) -> Vec<f64> {
        match self {
            Density::PowerLaw(p) => vec![
                p.coefficient,
                p.exponent,
                p.slider_stiffness,
                p.break_free_limit,
                p.stiffness,
            ],
            Density::PowerLawTable(p) => {
                vec![p.coefficient, p.exponent, p.slider_stiffness, p.stiffness]
            }
            Density::FourParameter(p) => vec![p.slip_force, p.stiffness, p.exponent, p.ratio],
            Density::Sliders(p) => vec![p.elastic],
        }
    }

    /// A density of a family that has scalar parameters alone, from its [`Density::values`].
    ///
    /// # Errors
    /// [`JointError::OutOfRange`] for a value outside the glossary, [`JointError::ForeignState`] for
    /// another family or count of values.
    pub fn from_values(family: &str, values: &[f64]) -> Result<Density, JointError> {
        match (family, values) {
            ("power_law", &[coefficient, exponent, slider_stiffness, limit, stiffness]) => {
                PowerLaw::new(coefficient, exponent, slider_stiffness, limit, stiffness)
                    .map(Density::PowerLaw)
            }
            ("four_parameter", &[slip_force, stiffness, exponent, ratio]) => {
                FourParameter::new(slip_force, stiffness, exponent, ratio)
                    .map(Density::FourParameter)
            }
            _ => Err(JointError::ForeignState {
                reason: format!(
                    "no density `{family}` is given by {} numbers (power_law: 5, four_parameter: 4)",
                    values.len()
                ),
            }),
        }
    }

    /// At most `count` sliders with the exact mass of their cell at its centroid, edges graded as
    /// `(i/count)³`, for what slips by `largest_slip` \[m\]; what slips later is elastic. The
    /// sliders that a [`FourParameter`] density has at φ_max are one cell more.
    ///
    /// Error of a steady cycle's loss O(count⁻²) for every χ; checked in tests/physics.
    pub fn cells(&self, count: usize, largest_slip: f64) -> Sliders {
        match self {
            Density::PowerLaw(p) => p.cells(count, largest_slip),
            Density::PowerLawTable(p) => p.cells(count, largest_slip),
            Density::FourParameter(p) => p.cells(count, largest_slip),
            Density::Sliders(p) => p.cells(count, largest_slip),
        }
    }

    fn curve(&self) -> &dyn VirginCurve {
        match self {
            Density::PowerLaw(p) => p.curve(),
            Density::PowerLawTable(p) => p,
            Density::FourParameter(p) => p.curve(),
            Density::Sliders(p) => p,
        }
    }
}

impl VirginCurve for Density {
    fn force(&self, slip: f64) -> f64 {
        self.curve().force(slip)
    }
    fn stiffness(&self, slip: f64) -> f64 {
        self.curve().stiffness(slip)
    }
    fn displacement(&self, force: f64) -> f64 {
        self.curve().displacement(force)
    }
    fn compliance(&self, force: f64) -> f64 {
        self.curve().compliance(force)
    }
    fn leg_dissipation(&self, slip: f64) -> f64 {
        self.curve().leg_dissipation(slip)
    }
    fn full_slip_force(&self) -> f64 {
        self.curve().full_slip_force()
    }
    fn initial_stiffness(&self) -> f64 {
        self.curve().initial_stiffness()
    }
    fn slipped_stiffness(&self, slip: f64) -> f64 {
        self.curve().slipped_stiffness(slip)
    }
    fn slipped_force(&self, slip: f64) -> f64 {
        self.curve().slipped_force(slip)
    }
}

/// Refuses a value outside its glossary's range, or no number at all.
fn checked(parameter: &Parameter, value: f64) -> Result<(), JointError> {
    named(parameter, value, || parameter.name.into())
}

/// [`checked`] for a value of a list; the refusal names its place in it, from 0.
fn checked_at(parameter: &Parameter, place: usize, value: f64) -> Result<(), JointError> {
    named(parameter, value, || format!("{}[{place}]", parameter.name))
}

fn named(
    parameter: &Parameter,
    value: f64,
    name: impl FnOnce() -> String,
) -> Result<(), JointError> {
    if (parameter.lower..=parameter.upper).contains(&value) {
        Ok(())
    } else {
        Err(JointError::OutOfRange {
            name: name(),
            value,
            lower: parameter.lower,
            upper: parameter.upper,
        })
    }
}
