//! The noise that searches of the same records, each with its own, are compared over.

use super::investigation::Investigation;

/// What the misfits of several searches of the same records are compared over.
#[derive(Debug, Clone, Copy)]
pub(super) struct NoiseOfAll {
    /// The least dispersion of any.
    pub(super) dispersion: f64,
    /// Logarithm of the noise's innovation squared, their mean.
    pub(super) innovation: f64,
}

impl NoiseOfAll {
    /// That of the given searches.
    pub(super) fn of<'a>(all: impl IntoIterator<Item = &'a Investigation>) -> NoiseOfAll {
        let (mut dispersion, mut sum, mut count) = (f64::INFINITY, 0.0, 0.0);
        for one in all {
            dispersion = dispersion.min(one.dispersion());
            sum += one.bench.innovation_square().ln();
            count += 1.0;
        }
        NoiseOfAll {
            dispersion,
            innovation: sum / f64::max(count, 1.0),
        }
    }
}
