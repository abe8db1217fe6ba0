//! The virgin curve G, its inverse H, and what follows from them: one trait for every density.

/// Virgin loading curve of an Iwan network, for non-negative arguments.
///
/// `G(u) = Λ_1(ku) + ku [Λ_0(∞) − Λ_0(ku)]` (Eq. 30, 34), concave and increasing, with the moments
/// `Λ_n(θ) = ∫_0^θ ρ φ^n dφ` (Eq. 32);
/// `k² ρ(ku) = −G''(u)` (Eq. 31: the print lacks the minus sign). A slider slides at `|f| = φ`,
/// which is how Eq. 27 is to be read.
pub trait VirginCurve {
    /// `G(u)` \[N\] for slip displacement `u ≥ 0` \[m\].
    fn force(&self, slip: f64) -> f64;
    /// `G'(u)` \[N/m\]; at a corner the value beyond it.
    fn stiffness(&self, slip: f64) -> f64;
    /// `H(F) = G⁻¹(F)` \[m\] for `0 ≤ F < F_S` \[N\]; infinite from full slip on.
    fn displacement(&self, force: f64) -> f64;
    /// `H'(F)` \[m/N\].
    fn compliance(&self, force: f64) -> f64 {
        1.0 / self.stiffness(self.displacement(force))
    }
    /// Energy lost on the virgin leg up to slip `u` \[J\]: what was put in less what is stored,
    ///
    /// `d(u) = ∫_0^u s (u − s) k²ρ(ks) ds = ∫_0^u [G(v) − v G'(v)] dv = 2 ∫_0^u G dv − u G(u)`.
    ///
    /// A slider (w, δ) gives `w δ (u − δ)` once `u > δ`. By Masing's rule a branch of excursion
    /// `|u − u_r|` loses `2 d(|u − u_r|/2)` and a closed loop of amplitude `u` loses `4 d(u)`.
    /// Checked against quadrature for every family in tests/physics.
    fn leg_dissipation(&self, slip: f64) -> f64;
    /// `F_S = Λ_1(∞)` \[N\] (Eq. 33); infinite where an elastic remainder never slips.
    fn full_slip_force(&self) -> f64;
    /// `K_T = k Λ_0(∞)` \[N/m\] (Eq. 38).
    fn initial_stiffness(&self) -> f64;
    /// Stiffness of all that slides at slip `u`, `k Λ_0(ku) = K_T − G'(u)` \[N/m\].
    fn slipped_stiffness(&self, slip: f64) -> f64 {
        self.initial_stiffness() - self.stiffness(slip)
    }
    /// Force of all that slides at slip `u`, `Λ_1(ku) = G(u) − u G'(u)` \[N\].
    fn slipped_force(&self, slip: f64) -> f64 {
        self.force(slip) - slip * self.stiffness(slip)
    }
    /// Slip left at zero force after the first loading to `F_M` \[m\], exact at every force:
    /// `u_R = H(F_M) − 2 H(F_M/2)`; its small-force form is
    /// [`SmallForce::residual_slip`](super::density::SmallForce::residual_slip).
    fn residual_slip(&self, largest_force: f64) -> f64 {
        self.displacement(largest_force) - 2.0 * self.displacement(largest_force / 2.0)
    }
}

/// A borrowed curve is a curve: many responses may share one.
impl<C: VirginCurve + ?Sized> VirginCurve for &C {
    fn force(&self, slip: f64) -> f64 {
        (**self).force(slip)
    }
    fn stiffness(&self, slip: f64) -> f64 {
        (**self).stiffness(slip)
    }
    fn displacement(&self, force: f64) -> f64 {
        (**self).displacement(force)
    }
    fn compliance(&self, force: f64) -> f64 {
        (**self).compliance(force)
    }
    fn leg_dissipation(&self, slip: f64) -> f64 {
        (**self).leg_dissipation(slip)
    }
    fn full_slip_force(&self) -> f64 {
        (**self).full_slip_force()
    }
    fn initial_stiffness(&self) -> f64 {
        (**self).initial_stiffness()
    }
    fn slipped_stiffness(&self, slip: f64) -> f64 {
        (**self).slipped_stiffness(slip)
    }
    fn slipped_force(&self, slip: f64) -> f64 {
        (**self).slipped_force(slip)
    }
}

/// A network behind its spring: the virgin curve of the augmented joint over U, `U = u + F/K_1`
/// (Eq. 52).
///
/// A spring in series keeps Masing's rule, so the exact response under a prescribed U is the one
/// memory on this curve. K_1 loses nothing: `d` is the network's own.
#[derive(Debug, Clone, PartialEq)]
pub struct BehindSpring<C> {
    /// The network's curve over u.
    pub network: C,
    /// K_1 \[N/m\]; may be infinite.
    pub series_stiffness: f64,
}

impl<C: VirginCurve> BehindSpring<C> {
    /// Slip u \[m\] of the network at total displacement `U ≥ 0` \[m\] on the virgin curve:
    /// `u + G(u)/K_1 = U`.
    pub fn slip(&self, displacement: f64) -> f64 {
        // The left side is concave and lies below u (1 + K_T/K_1): Newton's method from there
        // rises to the root without passing it, so the first step that does not rise is the end.
        let flexibility = 1.0 / self.series_stiffness;
        let mut slip = displacement / (1.0 + self.network.initial_stiffness() * flexibility);
        loop {
            let missing = displacement - (slip + self.network.force(slip) * flexibility);
            let slope = 1.0 + self.network.stiffness(slip) * flexibility;
            let next = slip + missing / slope;
            if next <= slip * (1.0 + f64::EPSILON) || !next.is_finite() {
                return slip;
            }
            slip = next;
        }
    }
}

impl<C: VirginCurve> VirginCurve for BehindSpring<C> {
    fn force(&self, displacement: f64) -> f64 {
        self.network.force(self.slip(displacement))
    }
    fn stiffness(&self, displacement: f64) -> f64 {
        let network = self.network.stiffness(self.slip(displacement));
        network / (1.0 + network / self.series_stiffness)
    }
    fn displacement(&self, force: f64) -> f64 {
        self.network.displacement(force) + force / self.series_stiffness
    }
    fn compliance(&self, force: f64) -> f64 {
        self.network.compliance(force) + 1.0 / self.series_stiffness
    }
    fn leg_dissipation(&self, displacement: f64) -> f64 {
        self.network.leg_dissipation(self.slip(displacement))
    }
    fn full_slip_force(&self) -> f64 {
        self.network.full_slip_force()
    }
    fn initial_stiffness(&self) -> f64 {
        let network = self.network.initial_stiffness();
        network / (1.0 + network / self.series_stiffness)
    }
}
