//! Hysteresis loops, measured and predicted.

use std::ops::Range;

use plotters::style::{Color, RGBColor};

use super::axis::Axis;
use super::canvas::{FINE, curve, draw as on_canvas, placed};
use super::cycles::{cycles, largest};
use super::residual::Channels;
use super::{Figure, MOST_POINTS, decimate, extends, keys, palette};
use crate::diagnose::Findings;
use crate::diagnose::findings::RecordCurves;
use crate::report::ReportError;

/// With more cycles than this the curves lie too close to be told apart.
const MOST_CYCLES: usize = 3;
/// Cycles that are drawn faintly at most.
const MOST_FAINT: usize = 24;

/// Force over displacement; of many cycles the largest as measured and predicted, and some others
/// as measured; `None` where the record has no curves.
pub(super) fn draw(
    findings: &Findings,
    curves: &RecordCurves,
) -> Result<Option<Figure>, ReportError> {
    let channels = Channels::of(findings, curves);
    let drive = channels.drive;
    let cycles = cycles(drive);
    let largest = largest(drive, &cycles);
    let many = cycles.len() > MOST_CYCLES;
    let shown = if many { largest } else { 0..drive.len() };
    let measured =
        |shown: &Range<usize>, most: usize| path(&curves.displacement, &curves.force, shown, most);
    let predicted = |channel: &[f64]| {
        if findings.judged == "force" {
            path(&curves.displacement, channel, &shown, MOST_POINTS)
        } else {
            path(channel, &curves.force, &shown, MOST_POINTS)
        }
    };
    // Some cycles faintly beneath, the measured loop broad, the predictions thin on it.
    let mut paths = Vec::new();
    if many {
        let faint = palette::MEASURED.mix(0.4).stroke_width(FINE / 2);
        let picked = cycles.iter().step_by(cycles.len().div_ceil(MOST_FAINT));
        paths.extend(picked.map(|cycle| (measured(cycle, MOST_POINTS / MOST_FAINT), faint)));
    }
    let broad = palette::MEASURED.mix(0.75).stroke_width(4 * FINE);
    let thin = |colour: RGBColor| colour.stroke_width(FINE + FINE / 4);
    paths.push((measured(&shown, MOST_POINTS), broad));
    paths.push((predicted(&curves.baseline), thin(palette::BASELINE)));
    if extends(findings) {
        paths.push((predicted(&curves.extended), thin(palette::EXTENDED)));
    }
    let all = || paths.iter().flat_map(|(points, _)| points);
    let (Some(x), Some(y)) = (
        Axis::over("displacement", "m", all().map(|point| point.0), 6),
        Axis::over("force", "N", all().map(|point| point.1), 6),
    ) else {
        return Ok(None);
    };
    let axes = (&x, &y);
    let svg = on_canvas("hysteresis", (520, 380), axes, |chart| {
        for (points, style) in &paths {
            curve(chart, placed(points, axes), *style)?;
        }
        Ok(())
    })?;
    let mut keys = keys(findings, true);
    if many {
        keys.push(("faint", "other cycles".to_owned()));
    }
    Ok(Some(Figure {
        title: "Hysteresis".to_owned(),
        caption: if many {
            format!(
                "The cycle that reaches farthest in {}; others faintly, as measured.",
                channels.drive_name
            )
        } else {
            "Force over displacement; the area is the energy lost.".to_owned()
        },
        keys,
        svg,
        narrow: None,
        wide: false,
    }))
}

fn path(displacement: &[f64], force: &[f64], shown: &Range<usize>, most: usize) -> Vec<(f64, f64)> {
    let points = displacement.iter().copied().zip(force.iter().copied());
    let points: Vec<_> = points.skip(shown.start).take(shown.len()).collect();
    decimate::path(&points, most)
}
