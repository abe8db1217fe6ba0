//! Over the load amplitude: what grows with load, and with which power.

use super::Residual;
use super::cycle::over_cycles;

/// Cycles of like force amplitude together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AmplitudeRow {
    /// Mean force amplitude \[N\].
    pub force_amplitude: f64,
    /// Mean residual of the cycles.
    pub mean: f64,
    /// Standard error of that mean from the scatter of the cycles; infinite for one cycle.
    pub standard_error: f64,
    /// rms residual.
    pub rms: f64,
    /// Count of cycles.
    pub count: usize,
}

/// Relative width within which amplitudes count as alike.
const ALIKE: f64 = 0.05;

/// One row per load level, of rising amplitude.
pub fn over_amplitude(residual: &Residual) -> Vec<AmplitudeRow> {
    let mut rows = over_cycles(residual);
    rows.sort_by(|a, b| a.force_amplitude.total_cmp(&b.force_amplitude));
    let mut found = Vec::new();
    let mut from = 0;
    while from < rows.len() {
        let edge = rows[from].force_amplitude * (1.0 + ALIKE);
        let group = &rows[from..];
        let to = group
            .iter()
            .position(|r| r.force_amplitude > edge)
            .unwrap_or(group.len());
        let group = &group[..to];
        let count = group.len() as f64;
        let mean = group.iter().map(|r| r.mean).sum::<f64>() / count;
        let squares: f64 = group.iter().map(|r| (r.mean - mean).powi(2)).sum();
        found.push(AmplitudeRow {
            force_amplitude: group.iter().map(|r| r.force_amplitude).sum::<f64>() / count,
            mean,
            standard_error: if group.len() > 1 {
                (squares / (count - 1.0) / count).sqrt()
            } else {
                f64::INFINITY
            },
            rms: (group.iter().map(|r| r.rms * r.rms).sum::<f64>() / count).sqrt(),
            count: group.len(),
        });
        from += to;
    }
    found
}
