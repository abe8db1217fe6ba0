//! Rows whitened and weighed as the noise of their record asks.

use super::prepared::Prepared;

/// Whitens and weighs rows of one record, sample after sample.
pub struct Weighing<'a> {
    record: &'a Prepared,
    before: Vec<f64>,
    white: Vec<f64>,
}

impl<'a> Weighing<'a> {
    /// For rows of `size` numbers.
    pub fn new(record: &'a Prepared, size: usize) -> Self {
        Weighing {
            record,
            before: vec![0.0; size],
            white: vec![0.0; size],
        }
    }

    /// The whitened, weighted row of sample `i`; `None` where the sample has no weight. Behind such a
    /// sample whitening begins anew: what was struck out or held out says nothing of its neighbour.
    #[inline]
    pub fn weigh(&mut self, i: usize, row: &[f64]) -> Option<&[f64]> {
        let weight = self.record.weight[i];
        let a = self.record.autoregression;
        if weight > 0.0 {
            let (factor, scale) = if i > 0 && self.record.counts(i - 1) {
                (a, weight)
            } else {
                (0.0, weight * (1.0 - a * a).max(0.0).sqrt())
            };
            for ((z, x), b) in self.white.iter_mut().zip(row).zip(&self.before) {
                *z = (x - factor * b) * scale;
            }
        }
        self.before.copy_from_slice(row);
        (weight > 0.0).then_some(&self.white)
    }
}

/// Removes first-order autoregression: the whitened value, and what a constant 1 becomes.
#[inline]
pub fn whiten(autoregression: f64, value: f64, before: Option<f64>) -> (f64, f64) {
    match before {
        Some(before) => (value - autoregression * before, 1.0 - autoregression),
        None => {
            let start = (1.0 - autoregression * autoregression).max(0.0).sqrt();
            (start * value, start)
        }
    }
}

/// What is left of samples one after the other, whitened; behind one that does not count noise begins anew.
pub fn whitened(autoregression: f64, left: impl Iterator<Item = (f64, bool)>) -> Vec<f64> {
    let mut before = None;
    left.map(|(left, counts)| {
        let (white, _) = whiten(autoregression, left, before);
        before = counts.then_some(left);
        white
    })
    .collect()
}

/// Standard deviation of the sum of squares of so many weighed rows of noise alone, `√(2 rows)`, in noise variances.
pub fn deviation(rows: f64) -> f64 {
    (2.0 * rows).sqrt()
}
