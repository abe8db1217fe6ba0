//! Segalman's four-parameter density of 2005.

use super::cells::graded;
use super::power_law::{EXPONENT, STIFFNESS};
use super::seed::Seed;
use super::small_force::SmallForce;
use super::{Sliders, checked};
use crate::joint::elementary::power;
use crate::joint::parameters::Parameter;
use crate::joint::simulation::JointError;
use crate::joint::virgin::VirginCurve;

/// `ρ(φ) = R φ^χ` on `(0, φ_max)` and `S δ(φ − φ_max)` with k = 1 (Segalman 2005, J. Appl. Mech. 72),
/// in terms of slip force F_S, stiffness K_T, exponent χ and ratio β:
///
/// `G(u) = K_T [u − φ_max (u/φ_max)^(χ+2) / ((1+β)(χ+2))]` for `u < φ_max`, F_S beyond, with
/// `φ_max = F_S (1+β) / (K_T [β + (χ+1)/(χ+2)])`, `S = K_T β/(1+β)`,
/// `β = S (χ+1) / (R φ_max^(χ+1))`. Made by [`FourParameter::new`]; the fields are for reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FourParameter {
    /// F_S \[N\].
    pub slip_force: f64,
    /// K_T \[N/m\].
    pub stiffness: f64,
    /// χ.
    pub exponent: f64,
    /// β.
    pub ratio: f64,
    curve: Seed,
}

impl FourParameter {
    /// Glossary, in the order of [`FourParameter::new`].
    pub const PARAMETERS: &'static [Parameter] = &[
        Parameter {
            name: "slip_force",
            symbol: "F_S",
            unit: "N",
            lower: 1e-12,
            upper: 1e18,
            vanishes_at: None,
            neutral: None,
            meaning: "Force at which the whole joint slips.",
        },
        STIFFNESS,
        EXPONENT,
        Parameter {
            name: "ratio",
            symbol: "beta",
            unit: "1",
            lower: 0.0,
            upper: 1e9,
            vanishes_at: None,
            neutral: None,
            meaning: "Stiffness of the sliders that slip last over that of the power-law population; 0 is a smooth transition to full slip.",
        },
    ];

    /// Checks F_S \[N\], K_T \[N/m\], χ and β against the glossary.
    ///
    /// # Errors
    /// [`JointError::OutOfRange`] names the parameter.
    pub fn new(
        slip_force: f64,
        stiffness: f64,
        exponent: f64,
        ratio: f64,
    ) -> Result<FourParameter, JointError> {
        let values = [slip_force, stiffness, exponent, ratio];
        for (parameter, value) in Self::PARAMETERS.iter().zip(values) {
            checked(parameter, value)?;
        }
        let mean_place = (exponent + 1.0) / (exponent + 2.0);
        let limit = slip_force * (1.0 + ratio) / (stiffness * (ratio + mean_place));
        let curve = Seed {
            stiffness,
            bend: stiffness / ((1.0 + ratio) * (exponent + 2.0) * power(limit, exponent + 1.0)),
            exponent,
            limit,
            force_at_limit: slip_force,
            remaining: 0.0,
        };
        Ok(FourParameter {
            slip_force,
            stiffness,
            exponent,
            ratio,
            curve,
        })
    }

    /// φ_max over the slider stiffness \[m\]: slip displacement at which the whole joint slips.
    pub fn largest_slip(&self) -> f64 {
        self.curve.limit
    }

    /// `R = K_T (χ+1) / ((1+β) φ_max^(χ+1))`, with k = 1: in N/m^(2+χ).
    pub fn coefficient(&self) -> f64 {
        (self.exponent + 1.0) * (self.exponent + 2.0) * self.curve.bend
    }

    /// ϑ and χ of the small-force laws (Eq. 51).
    pub fn small_force(&self) -> SmallForce {
        SmallForce::of_density(self.coefficient(), self.exponent, 1.0, self.stiffness)
    }

    /// `count` cells of the population for what slips by `largest_slip` \[m\], and one more for the
    /// sliders at φ_max where that is within; the rest elastic.
    pub fn cells(&self, count: usize, largest_slip: f64) -> Sliders {
        let seed = &self.curve;
        let end = seed.limit.min(largest_slip.max(0.0));
        let moments = |slip| (seed.population_stiffness(slip), seed.population_force(slip));
        let mut cells = graded(moments, count.max(1), end);
        let last = self.stiffness * self.ratio / (1.0 + self.ratio);
        if end < seed.limit {
            return Sliders::sorted(cells.weight, cells.slip_at, seed.stiffness(end));
        }
        if last > 0.0 {
            cells.weight.push(last);
            cells.slip_at.push(seed.limit);
        }
        Sliders::sorted(cells.weight, cells.slip_at, 0.0)
    }

    pub(super) fn curve(&self) -> &Seed {
        &self.curve
    }
}
