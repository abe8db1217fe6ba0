//! Loss and stiffness over amplitude, measured and predicted.

use plotters::element::{Circle, Cross, TriangleMarker};
use plotters::style::Color;

use super::axis::Axis;
use super::canvas::{FINE, draw as on_canvas, fine};
use super::{Figure, extends, keys, palette};
use crate::diagnose::Findings;
use crate::diagnose::levels::{Compared, Level};
use crate::report::ReportError;

/// Energy per cycle, and stiffness, of every level; none where nothing was measured.
pub(super) fn draw(findings: &Findings) -> Result<Vec<Figure>, ReportError> {
    let energy = |level: &Level| level.energy.clone();
    let stiffness = |level: &Level| level.stiffness.clone();
    let resonance = findings.levels.iter().any(|level| {
        let stiffness = level.stiffness.as_ref();
        stiffness.is_some_and(|stiffness| stiffness.unit == "Hz")
    });
    let (title, name, caption) = match resonance {
        true => (
            "Frequency over amplitude",
            "resonance frequency",
            "Its square is the stiffness over the modal mass.",
        ),
        false => (
            "Stiffness over amplitude",
            "stiffness",
            "Slope of the loop's regression line, or peak over peak.",
        ),
    };
    let drawn = [
        one(
            findings,
            ("Loss over amplitude", "energy per cycle"),
            "What is dissipated at each level of the load.",
            energy,
        )?,
        one(findings, (title, name), caption, stiffness)?,
    ];
    Ok(drawn.into_iter().flatten().collect())
}

/// Amplitude, measured, baseline, extended, and whether it was held out.
type Point = (f64, [f64; 3], bool);

fn one(
    findings: &Findings,
    (title, name): (&str, &str),
    caption: &str,
    of: impl Fn(&Level) -> Option<Compared>,
) -> Result<Option<Figure>, ReportError> {
    let mut unit = String::new();
    let mut points: Vec<Point> = Vec::new();
    for level in &findings.levels {
        let Some(compared) = of(level) else { continue };
        let measured = compared.measured;
        let models = [compared.before, compared.after].map(|error| measured * (1.0 + error));
        let values = [measured, models[0], models[1]];
        if values.iter().chain([&level.amplitude]).all(|v| *v > 0.0) {
            points.push((level.amplitude, values, level.held_out));
        }
        unit = compared.unit;
    }
    if points.len() < 2 {
        return Ok(None);
    }
    let loss = unit == "J";
    let over = findings.levels.first().map_or("N", |level| &level.unit);
    let channel = match over {
        "m" => "displacement amplitude",
        _ => "force amplitude",
    };
    let shown = if extends(findings) { 3 } else { 2 };
    let amplitudes = points.iter().map(|point| point.0);
    let ordinates = points.iter().flat_map(|point| &point.1[..shown]).copied();
    let x = match loss {
        true => Axis::logarithmic(channel, over, amplitudes, 6),
        false => wide(channel, over, amplitudes),
    };
    let y = match loss {
        true => Axis::logarithmic(name, &unit, ordinates, 5),
        false => Axis::over(name, &unit, ordinates, 5),
    };
    let (Some(x), Some(y)) = (x, y) else {
        return Ok(None);
    };
    let svg =
        on_canvas(title, (520, 320), (&x, &y), |chart| {
            let at = |point: &Point, model: usize| (x.place(point.0), y.place(point.1[model]));
            chart.draw_series(points.iter().map(|point| {
                let style = match point.2 {
                    true => palette::MEASURED.stroke_width(2 * FINE),
                    false => palette::MEASURED.filled(),
                };
                Circle::new(at(point, 0), fine(5), style)
            }))?;
            chart.draw_series(points.iter().map(|point| {
                TriangleMarker::new(at(point, 1), fine(4), palette::BASELINE.filled())
            }))?;
            if shown == 3 {
                let style = palette::EXTENDED.stroke_width(2 * FINE);
                chart.draw_series(
                    points
                        .iter()
                        .map(|point| Cross::new(at(point, 2), fine(4), style)),
                )?;
            }
            Ok(())
        })?;
    let unseen = match points.iter().any(|point| point.2) {
        true => " Hollow circles: no fit has seen them.",
        false => "",
    };
    Ok(Some(Figure {
        title: title.to_owned(),
        caption: format!("{caption}{unseen}"),
        keys: keys(findings, true),
        svg,
        wide: false,
    }))
}

/// An amplitude axis: logarithmic where the range is wide, else not from zero.
fn wide(name: &str, unit: &str, values: impl Iterator<Item = f64> + Clone) -> Option<Axis> {
    let largest = values.clone().fold(0.0, f64::max);
    let smallest = values.clone().fold(f64::INFINITY, f64::min);
    match largest > 30.0 * smallest {
        true => Axis::from_zero_or_logarithmic(name, unit, values, 6),
        false => Axis::over(name, unit, values, 6),
    }
}
