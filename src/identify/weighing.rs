//! Rows whitened and weighed as the noise of their record asks.

use super::prepared::Prepared;
use crate::record::colour::{Colour, White, Whitening};

/// Whitens and weighs rows of one record, sample after sample.
pub struct Weighing<'a> {
    record: &'a Prepared,
    whitening: Whitening,
    before: Vec<f64>,
    new: Vec<f64>,
    white: Vec<f64>,
}

impl<'a> Weighing<'a> {
    /// For rows of `size` numbers.
    pub fn new(record: &'a Prepared, size: usize) -> Self {
        Weighing {
            record,
            whitening: record.colour.whitening(),
            before: vec![0.0; size],
            new: vec![0.0; size],
            white: vec![0.0; size],
        }
    }

    /// The whitened, weighted row of sample `i`; `None` where the sample has no weight. Behind such a
    /// sample whitening begins anew: what was struck out or held out says nothing of its neighbour.
    #[inline]
    pub fn weigh(&mut self, i: usize, row: &[f64]) -> Option<&[f64]> {
        let weight = self.record.weight[i];
        if weight > 0.0 {
            let anew = i == 0 || !self.record.counts(i - 1);
            let step = self.whitening.step(anew);
            let scale = weight * step.scale;
            let rows = row.iter().zip(&self.before);
            // First-order noise keeps nothing of what was new.
            if !self.whitening.keeps() {
                for (z, (x, b)) in self.white.iter_mut().zip(rows) {
                    *z = (x - step.slow * b) * scale;
                }
            } else {
                for ((z, new), (x, b)) in self.white.iter_mut().zip(&mut self.new).zip(rows) {
                    *new = x - step.slow * b + step.kept * *new;
                    *z = *new * scale;
                }
            }
        }
        self.before.copy_from_slice(row);
        (weight > 0.0).then_some(&self.white)
    }
}

/// What is left of samples one after the other, whitened; behind one that does not count noise begins anew.
pub fn whitened(colour: Colour, left: impl Iterator<Item = (f64, bool)>) -> Vec<f64> {
    let (mut whitening, mut white) = (colour.whitening(), White::default());
    let mut anew = true;
    left.map(|(left, counts)| {
        let step = whitening.step(anew);
        anew = !counts;
        white.next(&step, left)
    })
    .collect()
}

/// Standard deviation of the sum of squares of so many weighed rows of noise alone, `√(2 rows)`, in noise variances.
pub fn deviation(rows: f64) -> f64 {
    (2.0 * rows).sqrt()
}
