//! Over velocity: what depends on rate.

use super::Residual;
use super::bin::{Bin, bins};

/// Bins over the velocity \[m/s\] (per sample where the record has no time), by central differences
/// of the displacement over `reach` samples to either side: wide enough that noise does not
/// dominate, short against a cycle.
pub fn over_velocity(residual: &Residual, reach: usize, count: usize) -> Vec<Bin> {
    let time = residual.record.clock();
    let displacement = &residual.record.displacement;
    let reach = reach.max(1);
    let inner = reach..displacement.len().saturating_sub(reach);
    let velocity: Vec<f64> = inner
        .clone()
        .map(|i| {
            (displacement[i + reach] - displacement[i - reach])
                / (time[i + reach] - time[i - reach])
        })
        .collect();
    let values: Vec<f64> = inner.map(|i| residual.values[i]).collect();
    bins(&velocity, &values, count)
}
