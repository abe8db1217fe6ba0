//! The part that the parametric families share: a power-law population up to a limit.

use crate::joint::elementary::power;
use crate::joint::virgin::VirginCurve;

/// Virgin curve of `ρ = R φ^χ` below a limiting slip ū, straight beyond it:
/// `G(u) = K_T u − A u^(χ+2)` with `A = R k^(χ+2) / ((χ+1)(χ+2))`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Seed {
    /// K_T \[N/m\].
    pub stiffness: f64,
    /// A \[N/m^(χ+2)\], not negative.
    pub bend: f64,
    /// χ > −1.
    pub exponent: f64,
    /// ū \[m\]; infinite where nothing ever changes.
    pub limit: f64,
    /// G(ū) \[N\].
    pub force_at_limit: f64,
    /// G' beyond ū \[N/m\].
    pub remaining: f64,
}

/// More steps than the slowest case takes: a double root at a smooth full slip.
const MOST_STEPS: usize = 80;
/// Relative error of the inverse that is left uncorrected.
const LAST_BIT: f64 = 0.25 * f64::EPSILON;

impl Seed {
    /// `k Λ_0(ku)` of the power-law population alone \[N/m\], `0 ≤ u ≤ ū`: `(χ+2) A u^(χ+1)`.
    pub fn population_stiffness(&self, slip: f64) -> f64 {
        (self.exponent + 2.0) * self.bend * power(slip, self.exponent + 1.0)
    }

    /// `Λ_1(ku)` of the power-law population alone \[N\], `0 ≤ u ≤ ū`: `(χ+1) A u^(χ+2)`.
    pub fn population_force(&self, slip: f64) -> f64 {
        (self.exponent + 1.0) * self.bend * power(slip, self.exponent + 2.0)
    }

    /// `d(u) = R k^(χ+2) u^(χ+3) / ((χ+2)(χ+3))` \[J\], `0 ≤ u ≤ ū`.
    fn population_loss(&self, slip: f64) -> f64 {
        let chi = self.exponent;
        (chi + 1.0) / (chi + 3.0) * self.bend * power(slip, chi + 3.0)
    }
}

impl VirginCurve for Seed {
    fn force(&self, slip: f64) -> f64 {
        if slip < self.limit {
            let straightness = self.bend * power(slip, self.exponent + 1.0);
            (slip * (self.stiffness - straightness)).min(self.force_at_limit)
        } else if self.remaining > 0.0 {
            self.force_at_limit + self.remaining * (slip - self.limit)
        } else {
            self.force_at_limit
        }
    }

    fn stiffness(&self, slip: f64) -> f64 {
        if slip < self.limit {
            (self.stiffness - self.population_stiffness(slip)).max(self.remaining)
        } else {
            self.remaining
        }
    }

    /// Halley's method (Newton's, with the curvature that costs nothing here) from `F/K_T`, kept
    /// between that and ū: G is concave and lies below `K_T u`.
    fn displacement(&self, force: f64) -> f64 {
        if force >= self.force_at_limit {
            return if self.remaining > 0.0 {
                self.limit + (force - self.force_at_limit) / self.remaining
            } else {
                f64::INFINITY
            };
        }
        let chi = self.exponent;
        let (mut low, mut high) = (force / self.stiffness, self.limit);
        let mut slip = low;
        for _ in 0..MOST_STEPS {
            let bent = self.bend * power(slip, chi + 1.0);
            let slope = self.stiffness - (chi + 2.0) * bent;
            let missing = force - slip * (self.stiffness - bent);
            if missing > 0.0 {
                low = slip;
            } else if missing < 0.0 {
                high = slip;
            } else {
                return slip;
            }
            // −G''/G' times the Newton step: how far from straight the curve is over the step.
            let newton = missing / slope;
            let turned = (chi + 2.0) * (chi + 1.0) * bent / (slip * slope) * newton;
            let step = newton / (1.0 - 0.5 * turned);
            let mut next = slip + step;
            if !(low <= next && next <= high) {
                next = 0.5 * (low + high);
            } else if (turned * (turned.abs() + step.abs() / slip) * step).abs() < LAST_BIT * slip {
                // What the third-order step leaves is below the last bit.
                return next;
            }
            if next == slip {
                return slip;
            }
            slip = next;
        }
        slip
    }

    fn leg_dissipation(&self, slip: f64) -> f64 {
        if slip < self.limit {
            self.population_loss(slip)
        } else {
            let sliding = self.force_at_limit - self.limit * self.remaining;
            self.population_loss(self.limit) + sliding * (slip - self.limit)
        }
    }

    fn full_slip_force(&self) -> f64 {
        if self.remaining > 0.0 {
            f64::INFINITY
        } else {
            self.force_at_limit
        }
    }

    fn initial_stiffness(&self) -> f64 {
        self.stiffness
    }

    fn slipped_stiffness(&self, slip: f64) -> f64 {
        if slip < self.limit {
            self.population_stiffness(slip)
        } else {
            self.stiffness - self.remaining
        }
    }

    fn slipped_force(&self, slip: f64) -> f64 {
        if slip < self.limit {
            self.population_force(slip)
        } else {
            self.force_at_limit - self.limit * self.remaining
        }
    }
}
