//! What causes of the catalogue do to loss and stiffness per level.

use super::levels::{Level, Levels, Over};
use std::f64::consts::PI;

/// An effect that an amplitude table can show, per unit of its size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shown {
    /// `viscous_damping`: D = π c ω U².
    Viscous,
    /// `quadratic_damping`: D = (8/3) q ω² U³.
    Quadratic,
    /// `cubic_stiffness`: F += κ U³; either sign.
    Cubic,
    /// `pinning`: F += k (U − g)₊ on both sides.
    Pinning {
        /// Gap \[m\].
        gap: f64,
    },
}

/// Gaps of pinning that are tried, over the range of amplitudes.
const GAPS: usize = 9;

impl Shown {
    /// Catalogue name.
    pub fn name(&self) -> &'static str {
        match self {
            Shown::Viscous => "viscous_damping",
            Shown::Quadratic => "quadratic_damping",
            Shown::Cubic => "cubic_stiffness",
            Shown::Pinning { .. } => "pinning",
        }
    }

    /// Whether its size may be negative.
    pub fn is_signed(&self) -> bool {
        matches!(self, Shown::Cubic)
    }

    /// Unknowns that it brings.
    pub fn unknowns(&self) -> f64 {
        match self {
            Shown::Pinning { .. } => 2.0,
            _ => 1.0,
        }
    }

    /// Loss \[J\] per unit of size.
    pub fn loss(&self, row: &Level) -> f64 {
        let rate = row.rate.unwrap_or(0.0);
        match self {
            Shown::Viscous => PI * rate * row.amplitude.powi(2),
            Shown::Quadratic => 8.0 / 3.0 * rate.powi(2) * row.amplitude.powi(3),
            Shown::Cubic | Shown::Pinning { .. } => 0.0,
        }
    }

    /// Secant stiffness per unit of size: peak over peak, or of the first harmonic (the cube's is
    /// `(3/4) X²`, the gap's `1 − (2/π)(asin r + r √(1 − r²))` with `r = g/X`).
    pub fn stiffness(&self, row: &Level, harmonic: bool) -> f64 {
        match self {
            Shown::Viscous | Shown::Quadratic => 0.0,
            Shown::Cubic if harmonic => 0.75 * row.amplitude.powi(2),
            Shown::Cubic => row.amplitude.powi(2),
            Shown::Pinning { gap } => {
                let share = gap / row.amplitude;
                if share >= 1.0 {
                    0.0
                } else if harmonic {
                    1.0 - 2.0 / PI * (share.asin() + share * (1.0 - share * share).sqrt())
                } else {
                    1.0 - share
                }
            }
        }
    }
}

/// Everything that these levels could show: nothing without a stiffness beside the loss, for any
/// loss that grows as a power between one and three is that of some slip.
pub fn shown_by(levels: &Levels) -> Vec<Shown> {
    if levels.over == Over::Force || !levels.has_stiffness() {
        return Vec::new();
    }
    let mut all = vec![Shown::Cubic];
    if levels.has_rate() {
        all.extend([Shown::Viscous, Shown::Quadratic]);
    }
    let (smallest, largest) = levels.range();
    all.extend((0..GAPS).map(|i| {
        let share = (i as f64 + 0.5) / GAPS as f64;
        let (from, to) = ((0.7 * smallest).ln(), (0.97 * largest).ln());
        Shown::Pinning {
            gap: (from + share * (to - from)).exp(),
        }
    }));
    all
}
