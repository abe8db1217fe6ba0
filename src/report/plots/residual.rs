//! Measured minus predicted, in the judged channel, ready to be drawn.

use crate::diagnose::Findings;
use crate::diagnose::findings::RecordCurves;

/// The channels of one record by their part in the diagnosis; SI units.
pub(super) struct Channels<'a> {
    /// Measured values of the judged channel.
    pub(super) judged: &'a [f64],
    /// The channel that drives the joint.
    pub(super) drive: &'a [f64],
    /// Name of the driving channel.
    pub(super) drive_name: &'static str,
    /// Unit of the driving channel.
    pub(super) drive_unit: &'static str,
}

impl<'a> Channels<'a> {
    /// Force-driven records are judged in displacement, displacement-driven ones in force.
    pub(super) fn of(findings: &Findings, curves: &'a RecordCurves) -> Channels<'a> {
        if findings.judged == "force" {
            Channels {
                judged: &curves.force,
                drive: &curves.displacement,
                drive_name: "displacement",
                drive_unit: "m",
            }
        } else {
            Channels {
                judged: &curves.displacement,
                drive: &curves.force,
                drive_name: "force",
                drive_unit: "N",
            }
        }
    }

    /// (abscissa, measured − predicted) per sample.
    pub(super) fn residual(&self, abscissa: &[f64], predicted: &[f64]) -> Vec<(f64, f64)> {
        let errors = self.judged.iter().zip(predicted).map(|(m, p)| m - p);
        abscissa.iter().copied().zip(errors).collect()
    }
}
