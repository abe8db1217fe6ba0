//! The family's own coordinates: what a record sees first comes first.

use crate::joint::{BehindSpring, FourParameter, JointError, SmallForce, VirginCurve};

/// The four-parameter joint behind its spring, in coordinates that a record determines one after
/// the other as its loads rise: K_0 and ϑ, χ, then the share λ of the network in the initial
/// compliance, then the share of the sliders that slip last, which only full slip shows.
///
/// `K_T = K_0/λ`, `K_1 = K_0/(1−λ)`, `R = ϑ (χ+2)(χ+3) K_T^(χ+3)/4` (Eq. 51 with k = 1),
/// `φ_max = [(1−σ) K_T (χ+1)/R]^(1/(χ+1))`, `F_S = K_T φ_max (1 − (1−σ)/(χ+2))`, `β = σ/(1−σ)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// K_0 = K_1 K_T/(K_1+K_T) \[N/m\].
    pub series_stiffness: f64,
    /// ln of ϑ F_r^(χ+3), the small-force loss at the reference force \[J\]; at a force within
    /// the record this varies freely of χ, as ϑ itself does not.
    pub log_loss: f64,
    /// F_r \[N\].
    pub reference_force: f64,
    /// χ.
    pub exponent: f64,
    /// λ = K_0/K_T in (0, 1]; 1 is a network without spring.
    pub network_share: f64,
    /// σ = S/K_T = β/(1+β) in \[0, 1).
    pub last_share: f64,
}

/// Count of [`Shape::numbers`].
pub const NUMBERS: usize = 5;
/// Place of λ among them.
pub const NETWORK_SHARE: usize = 3;
/// Place of σ among them.
pub const LAST_SHARE: usize = 4;

impl Shape {
    /// ln K_0, ln loss, χ, λ, σ.
    pub fn numbers(&self) -> [f64; NUMBERS] {
        [
            self.series_stiffness.ln(),
            self.log_loss,
            self.exponent,
            self.network_share,
            self.last_share,
        ]
    }

    /// The shape with other numbers, at the same reference force.
    pub fn with(&self, numbers: &[f64]) -> Shape {
        Shape {
            series_stiffness: numbers[0].exp(),
            log_loss: numbers[1],
            exponent: numbers[2],
            network_share: numbers[NETWORK_SHARE],
            last_share: numbers[LAST_SHARE],
            ..*self
        }
    }

    /// The shape of a joint.
    pub fn of(network: &FourParameter, spring: f64, reference_force: f64) -> Shape {
        let SmallForce {
            coefficient,
            exponent,
        } = network.small_force();
        let share = 1.0 / (1.0 + network.stiffness / spring);
        Shape {
            series_stiffness: network.stiffness * share,
            log_loss: coefficient.ln() + (exponent + 3.0) * reference_force.ln(),
            reference_force,
            exponent,
            network_share: share,
            last_share: network.ratio / (1.0 + network.ratio),
        }
    }

    /// ln ϑ.
    pub fn log_coefficient(&self) -> f64 {
        self.log_loss - (self.exponent + 3.0) * self.reference_force.ln()
    }

    /// K_T \[N/m\].
    pub fn network_stiffness(&self) -> f64 {
        self.series_stiffness / self.network_share
    }

    /// K_1 \[N/m\]; infinite for λ = 1.
    pub fn spring(&self) -> f64 {
        self.series_stiffness / (1.0 - self.network_share).max(0.0)
    }

    /// β.
    pub fn ratio(&self) -> f64 {
        self.last_share / (1.0 - self.last_share)
    }

    /// R with k = 1.
    pub fn coefficient(&self) -> f64 {
        let chi = self.exponent;
        let log = self.log_coefficient() + (chi + 3.0) * self.network_stiffness().ln();
        log.exp() * (chi + 2.0) * (chi + 3.0) / 4.0
    }

    /// φ_max with k = 1 \[m\].
    pub fn largest_slip(&self) -> f64 {
        let order = self.exponent + 1.0;
        ((1.0 - self.last_share) * self.network_stiffness() * order / self.coefficient())
            .powf(1.0 / order)
    }

    /// F_S \[N\].
    pub fn slip_force(&self) -> f64 {
        let sliding = (1.0 - self.last_share) / (self.exponent + 2.0);
        self.network_stiffness() * self.largest_slip() * (1.0 - sliding)
    }

    /// The network.
    ///
    /// # Errors
    /// [`JointError::OutOfRange`] where a glossary parameter leaves its range.
    pub fn network(&self) -> Result<FourParameter, JointError> {
        FourParameter::new(
            self.slip_force(),
            self.network_stiffness(),
            self.exponent,
            self.ratio(),
        )
    }

    /// The virgin curve of the joint over its total displacement.
    ///
    /// # Errors
    /// As [`Shape::network`].
    pub fn curve(&self) -> Result<BehindSpring<impl VirginCurve>, JointError> {
        Ok(BehindSpring {
            network: crate::joint::Density::FourParameter(self.network()?),
            series_stiffness: self.spring(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_joint_comes_back_from_its_shape() {
        let network = FourParameter::new(1500.0, 2e7, -0.35, 0.8).expect("in range");
        let back = Shape::of(&network, 3e7, 400.0);
        let again = back.network().expect("in range");
        assert!((again.slip_force / 1500.0 - 1.0).abs() < 1e-10);
        assert!((again.ratio / 0.8 - 1.0).abs() < 1e-10);
        assert!((back.spring() / 3e7 - 1.0).abs() < 1e-12);
        assert!((again.largest_slip() / network.largest_slip() - 1.0).abs() < 1e-10);
    }
}
