//! Over cycles and over the phase within a cycle: wear, running-in, and where in the loop.

use super::bin::{Bin, bins};
use super::{Residual, rms};
use crate::record::cycles::cycles;

/// One cycle of the force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CycleRow {
    /// First sample.
    pub start: usize,
    /// One past the last.
    pub end: usize,
    /// Time of its middle \[s\], or sample number.
    pub time: f64,
    /// Force amplitude \[N\].
    pub force_amplitude: f64,
    /// Mean residual.
    pub mean: f64,
    /// Standard error of the mean, samples taken as independent.
    pub standard_error: f64,
    /// rms residual.
    pub rms: f64,
}

/// One row per cycle of the force.
pub fn over_cycles(residual: &Residual) -> Vec<CycleRow> {
    let time = residual.record.clock();
    cycles(&residual.record.force)
        .iter()
        .map(|cycle| {
            let own = &residual.values[cycle.start..cycle.end];
            let count = own.len() as f64;
            let mean = own.iter().sum::<f64>() / count;
            let squares: f64 = own.iter().map(|v| (v - mean).powi(2)).sum();
            CycleRow {
                start: cycle.start,
                end: cycle.end,
                time: 0.5 * (time[cycle.start] + time[cycle.end - 1]),
                force_amplitude: cycle.amplitude,
                mean,
                standard_error: (squares / (count - 1.0).max(1.0) / count).sqrt(),
                rms: rms(own),
            }
        })
        .collect()
}

/// Bins over the phase of the cycle, 0 … 1 from the force's rising mid value, all cycles together.
pub fn over_phase(residual: &Residual, count: usize) -> Vec<Bin> {
    let mut phase = Vec::new();
    let mut values = Vec::new();
    for cycle in cycles(&residual.record.force) {
        for i in cycle.start..cycle.end {
            phase.push((i - cycle.start) as f64 / cycle.len() as f64);
            values.push(residual.values[i]);
        }
    }
    bins(&phase, &values, count)
}
