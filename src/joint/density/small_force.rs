//! What every power-law joint does while the load is small: two numbers, ϑ and χ.

use crate::joint::elementary::{exp2, power};

/// The small-force laws of a density that begins as `ρ = R φ^χ`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmallForce {
    /// ϑ \[J/N^(χ+3)\].
    pub coefficient: f64,
    /// χ.
    pub exponent: f64,
}

impl SmallForce {
    /// From the density, `ϑ = (4R/k) (k/K_T)^(χ+3) / ((χ+2)(χ+3))` (Eq. 51; where the print and its
    /// text have "ν", read ϑ). `coefficient` is R, `slider_stiffness` k, `stiffness` K_T \[N/m\].
    pub fn of_density(
        coefficient: f64,
        exponent: f64,
        slider_stiffness: f64,
        stiffness: f64,
    ) -> SmallForce {
        let chi = exponent;
        SmallForce {
            coefficient: 4.0 * coefficient / slider_stiffness
                * power(slider_stiffness / stiffness, chi + 3.0)
                / ((chi + 2.0) * (chi + 3.0)),
            exponent,
        }
    }

    /// Loss per cycle at force amplitude F_0 \[N\]: `D = ϑ F_0^(χ+3)` \[J\] (Eq. 47), to leading order
    /// in F_0. The slipping rod of Eq. 8 is the case χ = 0 with `D = (2/3) F_0³ / (EA·2Nν)`: the
    /// square in the print is an error. Two spheres (Eq. 9) are the case χ = 0 as well,
    /// `D = (2−μ) F³ / (18 ν G a P)`, once the print is mended: `c/a = (1 − F_0/νP)^(1/3)` and
    /// `a − c = a F_0 / (3νP)` (Eq. 15, 18: printed is the two-dimensional law) with the pressure
    /// `p_0 (2x/a)^½`, `p_0 = 3P/(2πa²)`, near the edge (Eq. 16, 19).
    pub fn dissipation(&self, force_amplitude: f64) -> f64 {
        self.coefficient * power(force_amplitude, self.exponent + 3.0)
    }

    /// Slip left at zero force after the first loading to F_M \[N\]:
    /// `u_R = ϑ (χ+3)/(4(χ+1)) (1 − 2^−(χ+1)) F_M^(χ+2)` \[m\], to leading order in F_M; for χ = 0
    /// `u_R = (3/8) ϑ F_M²` (Eq. 49 = A7 with its printed coefficient mended).
    pub fn residual_slip(&self, largest_force: f64) -> f64 {
        let chi = self.exponent;
        self.coefficient * (chi + 3.0) / (4.0 * (chi + 1.0))
            * (1.0 - exp2(-(chi + 1.0)))
            * power(largest_force, chi + 2.0)
    }
}
