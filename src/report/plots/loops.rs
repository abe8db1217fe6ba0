//! Hysteresis loops, measured and predicted.

use std::ops::Range;

use plotters::style::{Color, RGBColor};

use super::axis::Axis;
use super::canvas::{FINE, curve, draw as on_canvas, placed};
use super::residual::Channels;
use super::{Figure, MOST_POINTS, decimate, extends, keys, palette};
use crate::diagnose::Findings;
use crate::diagnose::findings::RecordCurves;
use crate::report::ReportError;

/// With more cycles than this the curves lie too close to be told apart.
const MOST_CYCLES: usize = 3;

/// Force over displacement; of many cycles all as measured, and the largest as predicted; `None`
/// where the record has no curves.
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
    let measured = |shown: &Range<usize>| path(&curves.displacement, &curves.force, shown);
    let everything = 0..curves.force.len();
    let beneath = if many {
        measured(&everything)
    } else {
        Vec::new()
    };
    let predicted = |channel: &[f64]| {
        if findings.judged == "force" {
            path(&curves.displacement, channel, &shown)
        } else {
            path(channel, &curves.force, &shown)
        }
    };
    let mut paths = vec![beneath, measured(&shown), predicted(&curves.baseline)];
    if extends(findings) {
        paths.push(predicted(&curves.extended));
    }
    let all = || paths.iter().flatten();
    let (Some(x), Some(y)) = (
        Axis::over("displacement", "m", all().map(|point| point.0), 6),
        Axis::over("force", "N", all().map(|point| point.1), 6),
    ) else {
        return Ok(None);
    };
    let axes = (&x, &y);
    // All cycles faintly beneath, the measured loop broad, the predictions thin on it.
    let styles: [(RGBColor, f64, u32); 4] = [
        (palette::MEASURED, 0.4, FINE / 2),
        (palette::MEASURED, 0.75, 4 * FINE),
        (palette::BASELINE, 1.0, FINE + FINE / 4),
        (palette::EXTENDED, 1.0, FINE + FINE / 4),
    ];
    let svg = on_canvas("hysteresis", (520, 380), axes, |chart| {
        for (points, (colour, opacity, width)) in paths.iter().zip(styles) {
            let style = colour.mix(opacity).stroke_width(width);
            curve(chart, placed(points, axes), style)?;
        }
        Ok(())
    })?;
    let mut keys = keys(findings, true);
    if many {
        keys.push(("faint", "every cycle".to_owned()));
    }
    Ok(Some(Figure {
        title: "Hysteresis".to_owned(),
        caption: if many {
            format!(
                "The cycle that reaches farthest in {}; every other one faintly.",
                channels.drive_name
            )
        } else {
            "Force over displacement; the area is the energy lost.".to_owned()
        },
        keys,
        svg,
        wide: false,
    }))
}

fn path(displacement: &[f64], force: &[f64], shown: &Range<usize>) -> Vec<(f64, f64)> {
    let points = displacement.iter().copied().zip(force.iter().copied());
    let points: Vec<_> = points.skip(shown.start).take(shown.len()).collect();
    decimate::path(&points, MOST_POINTS)
}

/// Stretches between upward crossings of the middle of the drive's range; a band of a tenth of the
/// range keeps noise from crossing twice.
fn cycles(drive: &[f64]) -> Vec<Range<usize>> {
    let (lower, upper) = range(drive);
    let (middle, band) = (0.5 * (lower + upper), 0.05 * (upper - lower));
    let mut below = false;
    let mut crossings = Vec::new();
    for (sample, value) in drive.iter().enumerate() {
        if *value < middle - band {
            below = true;
        } else if below && *value > middle + band {
            below = false;
            crossings.push(sample);
        }
    }
    // One sample more closes the loop.
    let stretches = crossings.windows(2);
    stretches
        .map(|pair| pair[0]..(pair[1] + 1).min(drive.len()))
        .collect()
}

/// The stretch over which the drive spans most.
fn largest(drive: &[f64], cycles: &[Range<usize>]) -> Range<usize> {
    let span = |cycle: &Range<usize>| {
        let (lower, upper) = range(&drive[cycle.clone()]);
        upper - lower
    };
    let widest = cycles.iter().max_by(|a, b| span(a).total_cmp(&span(b)));
    widest.cloned().unwrap_or(0..drive.len())
}

fn range(values: &[f64]) -> (f64, f64) {
    let values = values.iter().copied();
    let values = values.filter(|value| value.is_finite());
    values.fold(
        (f64::INFINITY, f64::NEG_INFINITY),
        |(lower, upper), value| (value.min(lower), value.max(upper)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_cycle_is_found_in_noise() {
        let drive: Vec<f64> = (0..1000)
            .map(|i| {
                let phase = f64::from(i) / 100.0;
                let growth = if (6.0..7.0).contains(&phase) {
                    2.0
                } else {
                    1.0
                };
                let ripple = 0.02 * f64::from(i % 3);
                growth * (std::f64::consts::TAU * phase).sin() + ripple
            })
            .collect();
        let cycles = cycles(&drive);
        assert_eq!(cycles.len(), 8);
        let widest = largest(&drive, &cycles);
        assert!(widest.contains(&625) && widest.contains(&675) && widest.len() < 110);
        assert_eq!(largest(&[1.0, 2.0], &[]), 0..2);
    }
}
