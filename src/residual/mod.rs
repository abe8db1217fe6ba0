//! Measured less simulated, one view per file: where and how a simulation is wrong.
//!
//! Every view is a pure function of a [`Residual`] and returns small structs: bins with mean,
//! standard error and count, or one row per cycle.

mod amplitude;
mod bin;
mod cycle;
mod displacement;
mod energy;
mod harmonics;
mod time;
mod velocity;

pub use amplitude::{AmplitudeRow, over_amplitude};
pub use bin::{Bin, bins};
pub use cycle::{CycleRow, over_cycles, over_phase};
pub use displacement::{Sides, over_displacement};
pub use energy::{EnergyRow, energy_per_cycle};
pub use harmonics::{Harmonic, even_share, harmonics};
pub use time::{Trend, over_time, trend};
pub use velocity::over_velocity;

use crate::record::Record;

/// The channel in which errors are judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Judged {
    /// Displacement under the measured force \[m\].
    Displacement,
    /// Force under the measured displacement \[N\].
    Force,
}

impl Judged {
    /// SI unit.
    pub fn unit(self) -> &'static str {
        match self {
            Judged::Displacement => "m",
            Judged::Force => "N",
        }
    }
}

/// A prediction that does not belong to the record.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("record `{name}` has {samples} samples, its prediction {predicted}")]
pub struct LengthDiffers {
    /// The record.
    pub name: String,
    /// Its samples.
    pub samples: usize,
    /// Samples of the prediction.
    pub predicted: usize,
}

/// A record beside the prediction of its judged channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Residual<'a> {
    /// The record.
    pub record: &'a Record,
    /// Which channel is judged.
    pub judged: Judged,
    /// Predicted judged channel \[m or N\], offset of the record included.
    pub predicted: &'a [f64],
    /// Measured less predicted \[m or N\].
    pub values: Vec<f64>,
}

impl<'a> Residual<'a> {
    /// Measured less predicted.
    ///
    /// # Errors
    /// [`LengthDiffers`].
    pub fn new(
        record: &'a Record,
        judged: Judged,
        predicted: &'a [f64],
    ) -> Result<Residual<'a>, LengthDiffers> {
        let measured = match judged {
            Judged::Displacement => &record.displacement,
            Judged::Force => &record.force,
        };
        if measured.len() != predicted.len() {
            return Err(LengthDiffers {
                name: record.name.clone(),
                samples: measured.len(),
                predicted: predicted.len(),
            });
        }
        let values = measured.iter().zip(predicted).map(|(m, p)| m - p).collect();
        Ok(Residual {
            record,
            judged,
            predicted,
            values,
        })
    }

    /// Root mean square \[m or N\].
    pub fn rms(&self) -> f64 {
        rms(&self.values)
    }
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|v| v * v).sum::<f64>() / values.len().max(1) as f64).sqrt()
}
