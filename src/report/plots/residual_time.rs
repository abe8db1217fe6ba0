//! The residual over time, before and after, against the noise.

use plotters::element::Rectangle;
use plotters::style::Color;

use super::axis::Axis;
use super::canvas::{FINE, curve, draw as on_canvas, placed};
use super::residual::Channels;
use super::{Figure, MOST_POINTS, decimate, extends, keys, palette};
use crate::diagnose::Findings;
use crate::diagnose::findings::RecordCurves;
use crate::report::ReportError;

/// Measured minus predicted over time, with the ± 2 σ band of the noise and held-out data shaded;
/// `None` where the record has no curves.
pub(super) fn draw(
    findings: &Findings,
    curves: &RecordCurves,
) -> Result<Option<Figure>, ReportError> {
    let channels = Channels::of(findings, curves);
    let over_time = |predicted: &[f64]| {
        decimate::extremes(&channels.residual(&curves.time, predicted), MOST_POINTS)
    };
    let before = over_time(&curves.baseline);
    let after = if extends(findings) {
        over_time(&curves.extended)
    } else {
        Vec::new()
    };
    let sigma = Some(findings.noise.rms).filter(|rms| rms.is_finite() && *rms > 0.0);
    let band = sigma.map(|sigma| [-2.0 * sigma, 2.0 * sigma]);
    let all = || before.iter().chain(&after);
    let ordinates = all().map(|point| point.1).chain(band.into_iter().flatten());
    // A record without time is clocked by its sample numbers.
    let counted = curves
        .time
        .iter()
        .enumerate()
        .all(|(index, time)| *time == index as f64);
    let (clock, clock_unit) = if counted {
        ("sample", "1")
    } else {
        ("time", "s")
    };
    let (Some(x), Some(y)) = (
        Axis::over(clock, clock_unit, all().map(|point| point.0), 10),
        Axis::over(
            &format!("residual {}", findings.judged),
            &findings.unit,
            ordinates,
            5,
        ),
    ) else {
        return Ok(None);
    };
    let shaded = blocks(&curves.time, &curves.held_out, 1e-3 * (x.upper - x.lower));
    let axes = (&x, &y);
    let svg = on_canvas("residual over time", (1060, 280), axes, |chart| {
        chart.draw_series(shaded.iter().map(|(from, to)| {
            let corners = [(x.place(*from), y.lower), (x.place(*to), y.upper)];
            Rectangle::new(corners, palette::HELD_OUT.mix(0.22).filled())
        }))?;
        chart.draw_series(band.iter().map(|[lower, upper]| {
            let corners = [(x.lower, y.place(*lower)), (x.upper, y.place(*upper))];
            Rectangle::new(corners, palette::NOISE.mix(0.2).filled())
        }))?;
        for (points, colour) in [(&before, palette::BASELINE), (&after, palette::EXTENDED)] {
            curve(
                chart,
                placed(points, axes),
                colour.mix(0.85).stroke_width(FINE),
            )?;
        }
        Ok(())
    })?;
    let mut keys = keys(findings, false);
    if band.is_some() {
        keys.push(("noise", "± 2 σ of the noise".to_owned()));
    }
    if !shaded.is_empty() {
        keys.push(("held-out", "held out of every fit".to_owned()));
    }
    Ok(Some(Figure {
        title: "Residual over time".to_owned(),
        caption: format!(
            "Measured minus predicted {}. A joint that explains the record stays in the noise band.",
            findings.judged
        ),
        keys,
        svg,
        wide: true,
    }))
}

/// Stretches of time that were held out, joined over gaps of less than `gap`.
fn blocks(time: &[f64], held_out: &[bool], gap: f64) -> Vec<(f64, f64)> {
    let mut blocks: Vec<(f64, f64)> = Vec::new();
    for (time, _) in time
        .iter()
        .zip(held_out)
        .filter(|(time, held)| **held && time.is_finite())
    {
        match blocks.last_mut() {
            Some((_, to)) if *time - *to <= gap => *to = *time,
            _ => blocks.push((*time, *time)),
        }
    }
    blocks
}
