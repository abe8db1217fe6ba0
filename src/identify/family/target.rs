//! What a fit is judged by: one channel of every record, over the branches of the other.

use super::branches::Branches;
use super::shape::Shape;
use crate::joint::{Drive, VirginCurve};
use crate::record::Record;
use std::borrow::Cow;

/// Samples judged in all: beyond this every second, third … is taken.
const MOST_SAMPLES: usize = 20_000;

/// One record cut into the branches of its driven channel.
#[derive(Debug, Clone, PartialEq)]
struct Part {
    branches: Branches,
    /// Judged channel at the wanted samples.
    measured: Vec<f64>,
}

/// The judged channel of all records.
#[derive(Debug, Clone, PartialEq)]
pub struct Target {
    parts: Vec<Part>,
    drive: Drive,
    /// Whether each record has an offset of its own, which no joint explains.
    free_offset: bool,
    /// rms of the judged channel about its offsets: the unit of the residuals.
    scale: f64,
}

/// The channel that drives; a displacement from where the record begins, for its sensor may have any zero.
pub fn driven(record: &Record, drive: Drive) -> Cow<'_, [f64]> {
    match drive {
        Drive::Force => Cow::Borrowed(&record.force),
        Drive::Displacement => {
            let begins = record.displacement.first().copied().unwrap_or(0.0);
            Cow::Owned(record.displacement.iter().map(|u| u - begins).collect())
        }
    }
}

impl Target {
    /// The records under one drive: displacement judged under force, force under displacement.
    pub fn of_records(records: &[&Record], drive: Drive) -> Target {
        Target::of_some(records, drive, MOST_SAMPLES)
    }

    /// The same, judged at no more than so many samples.
    pub fn of_some(records: &[&Record], drive: Drive, most: usize) -> Target {
        let count: usize = records.iter().map(|r| r.len()).sum();
        let stride = count.div_ceil(most).max(1);
        let driven: Vec<Cow<'_, [f64]>> = records.iter().map(|r| driven(r, drive)).collect();
        let channels = records.iter().zip(&driven).map(|(r, driven)| match drive {
            Drive::Force => (driven.as_ref(), r.displacement.as_slice()),
            Drive::Displacement => (driven.as_ref(), r.force.as_slice()),
        });
        Target::new(channels, drive, true, stride)
    }

    /// A virgin curve given by points, rising from zero.
    pub fn of_curve(displacement: &[f64], force: &[f64], drive: Drive) -> Target {
        let channels = match drive {
            Drive::Force => (force, displacement),
            Drive::Displacement => (displacement, force),
        };
        Target::new([channels].into_iter(), drive, false, 1)
    }

    fn new<'a>(
        channels: impl Iterator<Item = (&'a [f64], &'a [f64])>,
        drive: Drive,
        free_offset: bool,
        stride: usize,
    ) -> Target {
        let parts: Vec<Part> = channels
            .map(|(driven, judged)| {
                let branches = Branches::of(driven, stride);
                let measured = branches.samples().iter().map(|&i| judged[i]).collect();
                Part { branches, measured }
            })
            .collect();
        let mut target = Target {
            parts,
            drive,
            free_offset,
            scale: 1.0,
        };
        let zero: Vec<Vec<f64>> = target
            .parts
            .iter()
            .map(|p| vec![0.0; p.measured.len()])
            .collect();
        let plain = target.against(&zero);
        let square = plain.iter().map(|r| r * r).sum::<f64>() / plain.len().max(1) as f64;
        if square > 0.0 {
            target.scale = square.sqrt();
        }
        target
    }

    /// Which channel drives.
    pub fn drive(&self) -> Drive {
        self.drive
    }

    /// rms of the judged channel: what the residuals are divided by.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Largest argument at which the virgin curve is needed \[N or m\].
    pub fn largest_way(&self) -> f64 {
        self.parts
            .iter()
            .map(|p| p.branches.largest_way())
            .fold(0.0, f64::max)
    }

    /// Response of every record to a curve over the driven channel.
    pub fn respond(&self, curve: &dyn Fn(f64) -> f64) -> Vec<Vec<f64>> {
        self.parts
            .iter()
            .map(|p| p.branches.respond(curve))
            .collect()
    }

    /// Measured less predicted over scale, offsets taken out.
    pub fn against(&self, predicted: &[Vec<f64>]) -> Vec<f64> {
        let mut residual = Vec::new();
        for (part, predicted) in self.parts.iter().zip(predicted) {
            let n = part.measured.len() as f64;
            let difference = part.measured.iter().zip(predicted).map(|(m, p)| m - p);
            let offset = if self.free_offset {
                difference.clone().sum::<f64>() / n
            } else {
                0.0
            };
            residual.extend(difference.map(|d| (d - offset) / self.scale));
        }
        residual
    }

    /// Residuals of a shape; `None` where it cannot carry the load or has no such joint.
    pub fn residuals(&self, shape: &Shape) -> Option<Vec<f64>> {
        let curve = shape.curve().ok()?;
        let response = match self.drive {
            Drive::Force if self.largest_way() >= curve.full_slip_force() => return None,
            Drive::Force => self.respond(&|f| curve.displacement(f)),
            Drive::Displacement => self.respond(&|u| curve.force(u)),
        };
        let residual = self.against(&response);
        residual.iter().all(|r| r.is_finite()).then_some(residual)
    }

    /// Correlation of neighbouring residuals of the same record.
    pub fn autoregression(&self, residual: &[f64]) -> f64 {
        let (mut product, mut square, mut from) = (0.0, 0.0, 0);
        for part in &self.parts {
            let own = &residual[from..from + part.measured.len()];
            product += own.windows(2).map(|w| w[0] * w[1]).sum::<f64>();
            square += own.iter().map(|r| r * r).sum::<f64>();
            from += own.len();
        }
        if square > 0.0 {
            (product / square).clamp(0.0, 0.999)
        } else {
            0.0
        }
    }
}
