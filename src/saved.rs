//! joint.json ⇄ joint.
//!
//! ```json
//! {
//!   "format": "iwan-joint/1", "version": "0.1.0", "units": "SI",
//!   "density": {"family": "four_parameter", "slip_force": 1000.0, "…": 0.0},
//!   "series_stiffness": null,
//!   "causes": [{"name": "pinning", "parameters": {"…": 0.0}}],
//!   "provenance": {
//!     "records": [{"name": "bolt-1", "samples": 4000, "sha256": "…",
//!                  "duration": 8.0, "sample_interval": 0.002, "largest_force": 4300.0}],
//!     "date": "2024-05-01T12:00:00Z",
//!     "verdict": {"word": "explained", "held_out_rms_ratio": 0.2, "interval": [0.18, 0.23]}
//!   },
//!   "intervals": {"slip_force": [990.0, 1010.0]}
//! }
//! ```
//! Parameters stand under their glossary names. `null` is infinity: a rigid series spring, or a
//! bound that the data do not set. Every finite number survives a round trip to the last bit.

mod entry;
mod origin;
mod reading;
mod repeated;
mod writing;

use std::collections::BTreeMap;

use crate::joint::{Joint, JointError};

pub use reading::read;
pub use writing::write;

/// What the `format` entry must say.
pub const FORMAT: &str = "iwan-joint/1";

/// A joint with where it comes from and how well it is known.
#[derive(Debug, Clone, PartialEq)]
pub struct SavedJoint {
    /// The joint.
    pub joint: Joint,
    /// What it was identified from.
    pub provenance: Provenance,
    /// 95 % intervals by parameter name, SI units; infinite where the data set no bound.
    pub intervals: BTreeMap<String, (f64, f64)>,
}

/// What a joint was identified from.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Provenance {
    /// The records.
    pub records: Vec<RecordUsed>,
    /// When, as ISO 8601 in UTC.
    pub date: Option<String>,
    /// What wrote the file, with its version.
    pub tool: Option<String>,
    /// In words, for joints that no record stands behind.
    pub remark: Option<String>,
    /// What the diagnosis found, where there was one.
    pub verdict: Option<Judgement>,
}

/// One record that a joint was identified from.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RecordUsed {
    /// File stem.
    pub name: String,
    /// Count of samples.
    pub samples: usize,
    /// Hash of the file's content, hexadecimal.
    pub sha256: String,
    /// Times from the first to the last sample, where the record has times.
    pub span: Option<Span>,
    /// Largest magnitude of its force \[N\], where the file says it.
    pub largest_force: Option<f64>,
}

impl Provenance {
    /// Largest magnitude of the force in any record \[N\]: beyond it nothing was measured of the joint. `None` where a
    /// record does not say it, or there is none.
    pub fn largest_force(&self) -> Option<f64> {
        let all: Option<Vec<f64>> = self.records.iter().map(|r| r.largest_force).collect();
        all?.into_iter().reduce(f64::max)
    }
}

/// How long a record is, and how closely sampled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Last time minus first \[s\].
    pub duration: f64,
    /// Mean distance of the samples \[s\].
    pub sample_interval: f64,
}

impl Span {
    /// Of sample times \[s\]; `None` for fewer than two, or where time does not run forward.
    pub fn of(time: &[f64]) -> Option<Span> {
        let (first, last) = (time.first()?, time.last()?);
        let duration = last - first;
        let steps = time.len() - 1;
        (duration.is_finite() && duration > 0.0).then(|| Span {
            duration,
            sample_interval: duration / steps as f64,
        })
    }
}

/// What a diagnosis found.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// `clean`, `explained`, `partly_explained` or `unexplained`.
    pub word: String,
    /// Held-out rms error after the causes over before; `None` where nothing was held out.
    pub held_out_rms_ratio: Option<f64>,
    /// Its 95 % interval.
    pub interval: Option<(f64, f64)>,
}

/// Why a joint.json was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SavedError {
    /// No JSON, or cut short.
    #[error(
        "{file}:{line}:{column}: {reason}; the file is damaged or cut short: write it again with `iwan identify` or `iwan diagnose`"
    )]
    Syntax {
        /// File as named by the caller.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What the JSON parser found.
        reason: String,
    },
    /// A name that stands twice in one object: which of the two counts nobody can know.
    #[error("{file}:{line}:{column}: {place} is there twice: keep one")]
    Repeated {
        /// File as named by the caller.
        file: String,
        /// JSON path, e.g. `$.series_stiffness`.
        place: String,
        /// Line of the second, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
    },
    /// An entry that must be there.
    #[error("{file}: {place} is missing: {needed}")]
    Missing {
        /// File as named by the caller.
        file: String,
        /// JSON path, e.g. `$.density.family`.
        place: String,
        /// What to put there.
        needed: String,
    },
    /// An entry that cannot be used.
    #[error("{file}: {place} is {value}: {needed}")]
    Unusable {
        /// File as named by the caller.
        file: String,
        /// JSON path.
        place: String,
        /// The value found, shortened.
        value: String,
        /// What to put there.
        needed: String,
    },
    /// Well-formed values that make no joint.
    #[error("{file}: {place}: {reason}")]
    NoJoint {
        /// File as named by the caller.
        file: String,
        /// JSON path.
        place: String,
        /// What the joint says.
        reason: JointError,
    },
}
