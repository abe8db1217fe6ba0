//! Plots of the findings as inline SVG, drawn large and scaled down by their view box.

mod axis;
mod canvas;
mod cycles;
mod decimate;
mod energy;
mod levels;
mod loops;
mod palette;
mod residual;
mod residual_drive;
mod residual_time;

use super::ReportError;
use crate::diagnose::Findings;
use crate::diagnose::findings::RecordCurves;

/// Points of one curve at most; extremes are kept.
const MOST_POINTS: usize = 1500;

/// The same in a drawing for a narrow page.
const MOST_NARROW: usize = 500;

/// A plot with what is said beneath it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Figure {
    /// What it shows, in words.
    pub(super) title: String,
    /// How to read it.
    pub(super) caption: String,
    /// Keys of the legend: (style class, label).
    pub(super) keys: Vec<(&'static str, String)>,
    /// The drawing: one `<svg>` element.
    pub(super) svg: String,
    /// The same for a narrow page, where the drawing is a wide one.
    pub(super) narrow: Option<String>,
    /// Whether it takes the full width of the page.
    pub(super) wide: bool,
}

/// Every plot of one record that has data, in reading order.
///
/// # Errors
/// [`ReportError::Plot`] where the drawing library fails.
pub(super) fn of_record(
    findings: &Findings,
    curves: &RecordCurves,
) -> Result<Vec<Figure>, ReportError> {
    let drawn = [
        loops::draw(findings, curves)?,
        residual_drive::draw(findings, curves)?,
        residual_time::draw(findings, curves)?,
        energy::draw(findings, curves)?,
    ];
    Ok(drawn.into_iter().flatten().collect())
}

/// Loss and stiffness over amplitude; none where no level was measured.
///
/// # Errors
/// [`ReportError::Plot`] where the drawing library fails.
pub(super) fn levels(findings: &Findings) -> Result<Vec<Figure>, ReportError> {
    levels::draw(findings)
}

/// Whether the extended joint differs from the baseline, so that it is worth a curve.
fn extends(findings: &Findings) -> bool {
    !findings.causes.is_empty()
}

/// The legend of a plot of points: every model has a mark of its own.
fn marks(findings: &Findings, measured: bool) -> Vec<(&'static str, String)> {
    let each = keys(findings, measured).into_iter();
    each.map(|(class, label)| match class {
        "measured" => ("mark ring", label),
        "baseline" => ("mark triangle", label),
        _ => ("mark cross", label),
    })
    .collect()
}

/// The legend of the curves of a plot.
fn keys(findings: &Findings, measured: bool) -> Vec<(&'static str, String)> {
    let mut keys = vec![("baseline", "baseline joint".to_owned())];
    if measured {
        keys.insert(0, ("measured", "measured".to_owned()));
    }
    if extends(findings) {
        keys.push(("extended", "extended joint".to_owned()));
    }
    keys
}
