//! The experiment that an importer offers by default: the joint's own measurement.

use crate::saved::Provenance;

/// Start, end and communication step \[s\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Experiment {
    /// End; the start is zero.
    pub stop_time: f64,
    /// Communication step.
    pub step_size: f64,
}

impl Experiment {
    /// The longest record's duration and the finest record's distance of samples, no longer than
    /// that; one second in milliseconds where no record has times.
    pub fn of(provenance: &Provenance) -> Experiment {
        let spans = || provenance.records.iter().filter_map(|record| record.span);
        let longest = spans().map(|span| span.duration).reduce(f64::max);
        let finest = spans().map(|span| span.sample_interval).reduce(f64::min);
        let stop_time = longest.unwrap_or(1.0);
        Experiment {
            stop_time,
            step_size: finest.unwrap_or(1e-3).min(stop_time),
        }
    }
}
