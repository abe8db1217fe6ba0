//! The family's own coordinates: what a record sees first comes first.

use crate::joint::{BehindSpring, Density, FourParameter, JointError, VirginCurve};

/// What fixes the size of the population.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Size {
    /// ln of ϑ F_r^(χ+3) \[J\], the small-force loss at a reference force F_r \[N\]: at a force within
    /// the record it varies freely of χ, as ϑ itself does not.
    Loss {
        /// ln (ϑ F_r^(χ+3)).
        log: f64,
        /// F_r \[N\].
        reference_force: f64,
    },
    /// ln F_S, where the record slips as a whole.
    SlipForce {
        /// ln F_S.
        log: f64,
    },
}

/// The four-parameter joint behind its spring, in coordinates that a record determines one after
/// the other: K_0, the size of the population (in micro-slip by its loss, in full slip by F_S), χ,
/// the share λ of the network in the initial compliance, and the share σ of the sliders that slip
/// last.
///
/// `K_T = K_0/λ`, `K_1 = K_0/(1−λ)`, `R = ϑ (χ+2)(χ+3) K_T^(χ+3)/4` (Eq. 51 with k = 1),
/// `φ_max = [(1−σ) K_T (χ+1)/R]^(1/(χ+1))`, `F_S = K_T φ_max (1 − (1−σ)/(χ+2))`, `β = σ/(1−σ)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// K_0 = K_1 K_T/(K_1+K_T) \[N/m\].
    pub series_stiffness: f64,
    /// ϑ or F_S.
    pub size: Size,
    /// χ.
    pub exponent: f64,
    /// λ = K_0/K_T in (0, 1]; 1 is a network without spring.
    pub network_share: f64,
    /// σ = S/K_T = β/(1+β) in \[0, 1).
    pub last_share: f64,
}

/// Count of [`Shape::numbers`].
pub const NUMBERS: usize = 5;
/// Place of χ among them.
pub const EXPONENT: usize = 2;
/// Place of λ among them.
pub const NETWORK_SHARE: usize = 3;
/// Place of σ among them.
pub const LAST_SHARE: usize = 4;

impl Shape {
    /// ln K_0, ln loss or ln F_S, χ, λ, σ.
    pub fn numbers(&self) -> [f64; NUMBERS] {
        [
            self.series_stiffness.ln(),
            match self.size {
                Size::Loss { log, .. } | Size::SlipForce { log } => log,
            },
            self.exponent,
            self.network_share,
            self.last_share,
        ]
    }

    /// The shape with other numbers of the same kind.
    pub fn with(&self, numbers: &[f64]) -> Shape {
        Shape {
            series_stiffness: numbers[0].exp(),
            size: match self.size {
                Size::Loss {
                    reference_force, ..
                } => Size::Loss {
                    log: numbers[1],
                    reference_force,
                },
                Size::SlipForce { .. } => Size::SlipForce { log: numbers[1] },
            },
            exponent: numbers[EXPONENT],
            network_share: numbers[NETWORK_SHARE],
            last_share: numbers[LAST_SHARE],
        }
    }

    /// The shape of a joint, sized by its slip force.
    pub fn of(network: &FourParameter, spring: f64) -> Shape {
        let share = 1.0 / (1.0 + network.stiffness / spring);
        Shape {
            series_stiffness: network.stiffness * share,
            size: Size::SlipForce {
                log: network.slip_force.ln(),
            },
            exponent: network.exponent,
            network_share: share,
            last_share: network.ratio / (1.0 + network.ratio),
        }
    }

    /// The same joint, sized by its small-force loss at a reference force.
    pub fn by_loss(&self, reference_force: f64) -> Shape {
        let log = self.log_coefficient() + (self.exponent + 3.0) * reference_force.ln();
        Shape {
            size: Size::Loss {
                log,
                reference_force,
            },
            ..*self
        }
    }

    /// ln ϑ.
    pub fn log_coefficient(&self) -> f64 {
        let chi = self.exponent;
        match self.size {
            Size::Loss {
                log,
                reference_force,
            } => log - (chi + 3.0) * reference_force.ln(),
            Size::SlipForce { .. } => {
                (4.0 * self.coefficient() / ((chi + 2.0) * (chi + 3.0))).ln()
                    - (chi + 3.0) * self.network_stiffness().ln()
            }
        }
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
        match self.size {
            Size::Loss { .. } => {
                let log = self.log_coefficient() + (chi + 3.0) * self.network_stiffness().ln();
                log.exp() * (chi + 2.0) * (chi + 3.0) / 4.0
            }
            Size::SlipForce { .. } => {
                (1.0 - self.last_share) * self.network_stiffness() * (chi + 1.0)
                    / self.largest_slip().powf(chi + 1.0)
            }
        }
    }

    /// φ_max with k = 1 \[m\].
    pub fn largest_slip(&self) -> f64 {
        let order = self.exponent + 1.0;
        match self.size {
            Size::Loss { .. } => ((1.0 - self.last_share) * self.network_stiffness() * order
                / self.coefficient())
            .powf(1.0 / order),
            Size::SlipForce { log } => log.exp() / (self.network_stiffness() * self.force_share()),
        }
    }

    /// F_S \[N\].
    pub fn slip_force(&self) -> f64 {
        match self.size {
            Size::Loss { .. } => {
                self.network_stiffness() * self.largest_slip() * self.force_share()
            }
            Size::SlipForce { log } => log.exp(),
        }
    }

    /// F_S/(K_T φ_max).
    fn force_share(&self) -> f64 {
        1.0 - (1.0 - self.last_share) / (self.exponent + 2.0)
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
            network: Density::FourParameter(self.network()?),
            series_stiffness: self.spring(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_joint_comes_back_from_its_shape_however_sized() {
        let network = FourParameter::new(1500.0, 2e7, -0.35, 0.8).expect("in range");
        let by_force = Shape::of(&network, 3e7);
        for shape in [by_force, by_force.by_loss(400.0)] {
            let again = shape.network().expect("in range");
            assert!((again.slip_force / 1500.0 - 1.0).abs() < 1e-10);
            assert!((again.ratio / 0.8 - 1.0).abs() < 1e-10);
            assert!((shape.spring() / 3e7 - 1.0).abs() < 1e-12);
            assert!((shape.largest_slip() / network.largest_slip() - 1.0).abs() < 1e-10);
            let coefficient = network.small_force().coefficient;
            assert!((shape.log_coefficient() - coefficient.ln()).abs() < 1e-10);
        }
    }
}
