//! Energy per cycle, measured and predicted.

use super::{Judged, Residual};
use crate::record::cycles::cycles;

/// Loss of one cycle of the force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnergyRow {
    /// First sample.
    pub start: usize,
    /// One past the last.
    pub end: usize,
    /// Time of its middle \[s\], or sample number.
    pub time: f64,
    /// Force amplitude \[N\].
    pub force_amplitude: f64,
    /// ∮ F dU of the record \[J\].
    pub measured: f64,
    /// The same with the predicted judged channel \[J\].
    pub predicted: f64,
    /// True where the cycle repeats its neighbour.
    pub steady: bool,
}

impl EnergyRow {
    /// (measured − predicted)/measured.
    pub fn relative_error(&self) -> f64 {
        (self.measured - self.predicted) / self.measured
    }
}

/// One row per cycle of the force; every cycle closed by a straight segment.
pub fn energy_per_cycle(residual: &Residual) -> Vec<EnergyRow> {
    let record = residual.record;
    let time = record.clock();
    let (force, displacement) = match residual.judged {
        Judged::Displacement => (record.force.as_slice(), residual.predicted),
        Judged::Force => (residual.predicted, record.displacement.as_slice()),
    };
    cycles(&record.force)
        .iter()
        .map(|cycle| {
            let own = cycle.start..cycle.end;
            EnergyRow {
                start: cycle.start,
                end: cycle.end,
                time: 0.5 * (time[cycle.start] + time[cycle.end - 1]),
                force_amplitude: cycle.amplitude,
                measured: enclosed(
                    &record.force[own.clone()],
                    &record.displacement[own.clone()],
                ),
                predicted: enclosed(&force[own.clone()], &displacement[own]),
                steady: cycle.steady,
            }
        })
        .collect()
}

/// Area of the closed polygon of the samples: ∮ F dU by the trapezoid rule.
fn enclosed(force: &[f64], displacement: &[f64]) -> f64 {
    let count = force.len();
    (0..count)
        .map(|i| {
            let next = (i + 1) % count;
            0.5 * (force[i] + force[next]) * (displacement[next] - displacement[i])
        })
        .sum()
}
