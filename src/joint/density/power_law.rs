//! The report's density: a power law below a limit, the remainder elastic.

use super::cells::graded;
use super::seed::Seed;
use super::small_force::SmallForce;
use super::{Sliders, checked};
use crate::joint::elementary::power;
use crate::joint::parameters::Parameter;
use crate::joint::simulation::JointError;
use crate::joint::virgin::VirginCurve;

/// `ρ(φ) = R φ^χ` for `φ < φ̄` (Eq. 45), the remainder of K_T elastic (Eq. 53):
///
/// `G(u) = K_T u − R (ku)^(χ+2) / ((χ+1)(χ+2))` for `ku < φ̄`, straight beyond.
///
/// An infinite φ̄ is cut where the population has used up all of K_T,
/// `φ̄ = [(χ+1) K_T/(kR)]^(1/(χ+1))`; there the network slips as a whole, and so does one whose
/// finite φ̄ lies beyond. Made by [`PowerLaw::new`]; the fields are for reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PowerLaw {
    /// R, in N^−(1+χ) with k in N/m.
    pub coefficient: f64,
    /// χ.
    pub exponent: f64,
    /// k \[N/m\].
    pub slider_stiffness: f64,
    /// φ̄ \[N\]; may be infinite.
    pub break_free_limit: f64,
    /// K_T \[N/m\].
    pub stiffness: f64,
    curve: Seed,
}

impl PowerLaw {
    /// Glossary, in the order of [`PowerLaw::new`].
    pub const PARAMETERS: &'static [Parameter] = &[
        COEFFICIENT,
        EXPONENT,
        SLIDER_STIFFNESS,
        Parameter {
            name: "break_free_limit",
            symbol: "phi_bar",
            unit: "N",
            lower: 1e-300,
            upper: f64::INFINITY,
            vanishes_at: None,
            neutral: None,
            meaning: "Largest break-free force of the power-law population; stronger sliders never slip.",
        },
        STIFFNESS,
    ];

    /// Checks R, χ, k \[N/m\], φ̄ \[N\] and K_T \[N/m\] against the glossary.
    ///
    /// # Errors
    /// [`JointError::OutOfRange`] names the parameter.
    pub fn new(
        coefficient: f64,
        exponent: f64,
        slider_stiffness: f64,
        break_free_limit: f64,
        stiffness: f64,
    ) -> Result<PowerLaw, JointError> {
        let values = [
            coefficient,
            exponent,
            slider_stiffness,
            break_free_limit,
            stiffness,
        ];
        for (parameter, value) in Self::PARAMETERS.iter().zip(values) {
            checked(parameter, value)?;
        }
        Ok(PowerLaw {
            coefficient,
            exponent,
            slider_stiffness,
            break_free_limit,
            stiffness,
            curve: cut_seed(
                coefficient,
                exponent,
                slider_stiffness,
                break_free_limit,
                stiffness,
            ),
        })
    }

    /// ϑ and χ of the small-force laws (Eq. 51).
    pub fn small_force(&self) -> SmallForce {
        SmallForce::of_density(
            self.coefficient,
            self.exponent,
            self.slider_stiffness,
            self.stiffness,
        )
    }

    /// `count` cells for what slips by `largest_slip` \[m\]; the rest elastic.
    pub fn cells(&self, count: usize, largest_slip: f64) -> Sliders {
        seed_cells(&self.curve, count, largest_slip)
    }

    pub(super) fn curve(&self) -> &Seed {
        &self.curve
    }
}

/// The seed curve of a power-law population, cut where it has used up the stiffness.
pub(super) fn cut_seed(
    coefficient: f64,
    exponent: f64,
    slider_stiffness: f64,
    break_free_limit: f64,
    stiffness: f64,
) -> Seed {
    let chi = exponent;
    let used_up = power(
        (chi + 1.0) * stiffness / (slider_stiffness * coefficient),
        1.0 / (chi + 1.0),
    ) / slider_stiffness;
    let wanted = break_free_limit / slider_stiffness;
    let mut seed = Seed {
        stiffness,
        bend: coefficient * power(slider_stiffness, chi + 2.0) / ((chi + 1.0) * (chi + 2.0)),
        exponent,
        limit: f64::INFINITY,
        force_at_limit: f64::INFINITY,
        remaining: stiffness,
    };
    if wanted < used_up {
        let remaining = stiffness - seed.population_stiffness(wanted);
        seed.force_at_limit = seed.force(wanted);
        seed.limit = wanted;
        seed.remaining = remaining.max(0.0);
    } else if used_up.is_finite() {
        seed.limit = used_up;
        seed.force_at_limit = stiffness * used_up * (chi + 1.0) / (chi + 2.0);
        seed.remaining = 0.0;
    }
    seed
}

/// Cells of a seed curve without a jump at its limit.
pub(super) fn seed_cells(seed: &Seed, count: usize, largest_slip: f64) -> Sliders {
    let end = seed.limit.min(largest_slip.max(0.0));
    if !end.is_finite() {
        return Sliders::sorted(Vec::new(), Vec::new(), seed.stiffness);
    }
    let moments = |slip| (seed.population_stiffness(slip), seed.population_force(slip));
    let cells = graded(moments, count.max(1), end);
    Sliders::sorted(cells.weight, cells.slip_at, seed.stiffness(end))
}

pub(super) const COEFFICIENT: Parameter = Parameter {
    name: "coefficient",
    symbol: "R",
    unit: "1",
    lower: 0.0,
    upper: 1e300,
    vanishes_at: None,
    neutral: None,
    meaning: "Coefficient of the power law of break-free forces, in N^-(1+chi): its unit follows the exponent.",
};
pub(super) const EXPONENT: Parameter = Parameter {
    name: "exponent",
    symbol: "chi",
    unit: "1",
    lower: -0.999,
    upper: 4.0,
    vanishes_at: None,
    neutral: None,
    meaning: "Exponent of the power law of break-free forces; loss per cycle grows with force to the power chi + 3.",
};
pub(super) const SLIDER_STIFFNESS: Parameter = Parameter {
    name: "slider_stiffness",
    symbol: "k",
    unit: "N/m",
    lower: 1e-12,
    upper: 1e18,
    vanishes_at: None,
    neutral: None,
    meaning: "Stiffness common to all sliders, by which break-free forces and slip displacements convert.",
};
pub(super) const STIFFNESS: Parameter = Parameter {
    name: "stiffness",
    symbol: "K_T",
    unit: "N/m",
    lower: 1e-12,
    upper: 1e18,
    vanishes_at: None,
    neutral: None,
    meaning: "Stiffness of the network before anything slips.",
};
