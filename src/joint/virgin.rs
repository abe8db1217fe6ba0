//! The virgin curve G, its inverse H, and what follows from them: one trait for every density.

/// Virgin loading curve of an Iwan network, for non-negative arguments.
///
/// `G(u) = Λ_1(ku) + ku [Λ_0(∞) − Λ_0(ku)]` (Eq. 30, 34), concave and increasing;
/// `k² ρ(ku) = −G''(u)` (Eq. 31 with the minus sign that the print lacks).
pub trait VirginCurve {
    /// `G(u)` \[N\] for slip displacement `u ≥ 0` \[m\].
    fn force(&self, slip: f64) -> f64;
    /// `G'(u)` \[N/m\].
    fn stiffness(&self, slip: f64) -> f64;
    /// `H(F) = G⁻¹(F)` \[m\] for `0 ≤ F < F_S` \[N\]; infinite from full slip on.
    fn displacement(&self, force: f64) -> f64;
    /// `H'(F)` \[m/N\].
    fn compliance(&self, force: f64) -> f64 {
        1.0 / self.stiffness(self.displacement(force))
    }
    /// Energy dissipated along the virgin leg up to slip `u`, `d(u) = ∫_0^u G − u G(u)/2 + …`: \[J\].
    fn leg_dissipation(&self, slip: f64) -> f64;
    /// `F_S = Λ_1(∞)` \[N\] (Eq. 33); infinite where an elastic remainder never slips.
    fn full_slip_force(&self) -> f64;
    /// `K_T = k Λ_0(∞)` \[N/m\] (Eq. 38).
    fn initial_stiffness(&self) -> f64;
}
