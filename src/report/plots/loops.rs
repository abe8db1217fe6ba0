//! Hysteresis loops, measured and predicted.

use plotters::style::Color;

use super::axis::Axis;
use super::canvas::{FINE, curve, draw as on_canvas, placed};
use super::{Figure, MOST_POINTS, decimate, extends, keys, palette};
use crate::diagnose::Findings;
use crate::diagnose::findings::RecordCurves;
use crate::report::ReportError;

/// Force over displacement; `None` where the record has no curves.
pub(super) fn draw(
    findings: &Findings,
    curves: &RecordCurves,
) -> Result<Option<Figure>, ReportError> {
    let pair = |displacement: &[f64], force: &[f64]| -> Vec<(f64, f64)> {
        displacement
            .iter()
            .copied()
            .zip(force.iter().copied())
            .collect()
    };
    let predicted = |channel: &[f64]| {
        if findings.judged == "force" {
            pair(&curves.displacement, channel)
        } else {
            pair(channel, &curves.force)
        }
    };
    let mut paths = vec![
        (
            pair(&curves.displacement, &curves.force),
            palette::MEASURED,
            2 * FINE + FINE / 2,
        ),
        (predicted(&curves.baseline), palette::BASELINE, FINE),
    ];
    if extends(findings) {
        paths.push((predicted(&curves.extended), palette::EXTENDED, FINE));
    }
    for (points, ..) in &mut paths {
        *points = decimate::path(points, MOST_POINTS);
    }
    let all = || paths.iter().flat_map(|(points, ..)| points.iter());
    let (Some(x), Some(y)) = (
        Axis::over("displacement", "m", all().map(|point| point.0), 6),
        Axis::over("force", "N", all().map(|point| point.1), 6),
    ) else {
        return Ok(None);
    };
    let axes = (&x, &y);
    let svg = on_canvas("hysteresis", (520, 380), axes, |chart| {
        for (points, colour, width) in &paths {
            curve(chart, placed(points, axes), colour.stroke_width(*width))?;
        }
        Ok(())
    })?;
    Ok(Some(Figure {
        title: "Hysteresis".to_owned(),
        caption: "Force over displacement; the enclosed area is the energy lost per cycle."
            .to_owned(),
        keys: keys(findings, true),
        svg,
        wide: false,
    }))
}
