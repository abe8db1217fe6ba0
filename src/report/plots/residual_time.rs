//! The residual over time, before and after, against the noise.

use plotters::element::Rectangle;
use plotters::style::Color;

use super::axis::Axis;
use super::canvas::{FINE, curve, draw as on_canvas, placed};
use super::residual::Channels;
use super::{Figure, MOST_NARROW, MOST_POINTS, decimate, extends, keys, palette};
use crate::diagnose::Findings;
use crate::diagnose::findings::RecordCurves;
use crate::record::written::percent;
use crate::report::ReportError;

/// Measured minus predicted over time, with the ± 2 σ band of the noise and held-out data shaded;
/// `None` where the record has no curves.
pub(super) fn draw(
    findings: &Findings,
    curves: &RecordCurves,
) -> Result<Option<Figure>, ReportError> {
    let channels = Channels::of(findings, curves);
    let residual = |predicted: &[f64]| channels.residual(&curves.time, predicted);
    let before = residual(&curves.baseline);
    let after = if extends(findings) {
        residual(&curves.extended)
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
    let x = |ticks| Axis::over(clock, clock_unit, all().map(|point| point.0), ticks);
    let y = Axis::over(
        &format!("residual {}", findings.judged),
        &findings.unit,
        ordinates,
        5,
    );
    let (Some(wide), Some(narrow), Some(y)) = (x(10), x(5), y) else {
        return Ok(None);
    };
    let gap = 1e-3 * (wide.upper - wide.lower);
    let shaded = blocks(&curves.time, &curves.held_out, gap);
    let draw = |x: &Axis, size: (u32, u32), most: usize| {
        on_canvas("residual over time", size, (x, &y), |chart| {
            chart.draw_series(shaded.iter().map(|(from, to)| {
                let corners = [(x.place(*from), y.lower), (x.place(*to), y.upper)];
                Rectangle::new(corners, palette::HELD_OUT.mix(0.22).filled())
            }))?;
            chart.draw_series(band.iter().map(|[lower, upper]| {
                let corners = [(x.lower, y.place(*lower)), (x.upper, y.place(*upper))];
                Rectangle::new(corners, palette::NOISE.mix(0.2).filled())
            }))?;
            for (points, colour) in [(&before, palette::BASELINE), (&after, palette::EXTENDED)] {
                let points = decimate::extremes(points, most);
                let style = colour.mix(0.85).stroke_width(FINE);
                curve(chart, placed(&points, (x, &y)), style)?;
            }
            Ok(())
        })
    };
    let svg = draw(&wide, (1060, 280), MOST_POINTS)?;
    let narrow = draw(&narrow, (520, 300), MOST_NARROW)?;
    let inside = |points: &[(f64, f64)]| within(points, 2.0 * sigma.unwrap_or(0.0));
    let lie = match (inside(&before), inside(&after)) {
        _ if sigma.is_none() => String::new(),
        (Some(before), Some(after)) => format!(
            " In the band lie {} of the samples with the baseline, {} with the extended joint; of noise alone about 95 %.",
            percent(before),
            percent(after)
        ),
        (Some(before), None) => format!(
            " In the band lie {} of the samples; of noise alone about 95 %.",
            percent(before)
        ),
        _ => String::new(),
    };
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
            "Measured minus predicted {}.{lie} Where samples lie too dense to be drawn, the lines show the extremes of each stretch.",
            findings.judged
        ),
        keys,
        svg,
        narrow: Some(narrow),
        wide: true,
    }))
}

/// Share of the points within `bound` of zero; `None` where there is no point.
fn within(points: &[(f64, f64)], bound: f64) -> Option<f64> {
    let errors = points.iter().map(|point| point.1.abs());
    let errors: Vec<f64> = errors.filter(|error| error.is_finite()).collect();
    let inside = errors.iter().filter(|error| **error <= bound).count();
    (!errors.is_empty()).then(|| inside as f64 / errors.len() as f64)
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
