//! Loss and stiffness over amplitude: measured and predicted, and how far off the predictions are.

use plotters::element::{Circle, PathElement};
use plotters::style::{Color, RGBColor};

use super::axis::Axis;
use super::canvas::{Chart, FINE, Failure, draw as on_canvas, fine};
use super::energy::mark;
use super::{Figure, extends, marks, palette};
use crate::diagnose::Findings;
use crate::diagnose::levels::{Compared, Level};
use crate::report::ReportError;
use crate::report::compared::dwelt_on;

/// Size of each drawing, shown pixels.
const SIZE: (u32, u32) = (520, 300);

/// Energy per cycle and stiffness of every level, then the relative errors of both; none where nothing
/// was measured.
pub(super) fn draw(findings: &Findings) -> Result<Vec<Figure>, ReportError> {
    let resonance = findings.levels.iter().any(|level| {
        let stiffness = level.stiffness.as_ref();
        stiffness.is_some_and(|stiffness| stiffness.unit == "Hz")
    });
    let loss = Quantity {
        title: "Loss",
        name: "energy per cycle",
        caption: "What is dissipated at each level of the load.",
        points: points(findings, |level| level.energy.as_ref()),
    };
    let stiffness = Quantity {
        title: if resonance { "Frequency" } else { "Stiffness" },
        name: if resonance {
            "resonance frequency"
        } else {
            "stiffness"
        },
        caption: match resonance {
            true => "Its square is the stiffness over the modal mass.",
            false => "Slope of the loop's regression line, or peak over peak.",
        },
        points: points(findings, |level| level.stiffness.as_ref()),
    };
    let drawn = [
        values(findings, &loss)?,
        values(findings, &stiffness)?,
        errors(findings, &loss)?,
        errors(findings, &stiffness)?,
    ];
    Ok(drawn.into_iter().flatten().collect())
}

/// What is compared level by level.
struct Quantity {
    title: &'static str,
    name: &'static str,
    caption: &'static str,
    points: Vec<Point>,
}

/// One level.
struct Point {
    amplitude: f64,
    unit: String,
    measured: f64,
    /// Relative errors of baseline and extended joint, with their intervals.
    errors: [(f64, Option<(f64, f64)>); 2],
    held_out: bool,
}

fn points<'a>(
    findings: &'a Findings,
    of: impl Fn(&'a Level) -> Option<&'a Compared>,
) -> Vec<Point> {
    let levels = dwelt_on(findings).into_iter();
    let points = levels.filter_map(|level| {
        let compared = of(level)?;
        Some(Point {
            amplitude: level.amplitude,
            unit: compared.unit.clone(),
            measured: compared.measured,
            errors: [
                (compared.before, compared.before_interval),
                (compared.after, compared.after_interval),
            ],
            held_out: level.held_out,
        })
    });
    let positive = |p: &Point| {
        let values = [p.amplitude, p.measured, p.predicted(0), p.predicted(1)];
        values.iter().all(|value| *value > 0.0)
    };
    points.filter(positive).collect()
}

impl Point {
    fn predicted(&self, model: usize) -> f64 {
        self.measured * (1.0 + self.errors[model].0)
    }
}

const COLOURS: [RGBColor; 2] = [palette::BASELINE, palette::EXTENDED];

/// Measured and predicted values.
fn values(findings: &Findings, quantity: &Quantity) -> Result<Option<Figure>, ReportError> {
    let points = &quantity.points;
    if points.len() < 2 {
        return Ok(None);
    }
    let models = models(findings);
    let unit = &points[0].unit;
    let predicted = |p: &Point| (0..models).map(|m| p.predicted(m)).collect::<Vec<_>>();
    let ordinates = points
        .iter()
        .flat_map(|p| predicted(p).into_iter().chain([p.measured]));
    let y = match unit == "J" {
        true => Axis::logarithmic(quantity.name, unit, ordinates, 5),
        false => Axis::over(quantity.name, unit, ordinates, 5),
    };
    let (Some(x), Some(y)) = (amplitudes(findings, quantity), y) else {
        return Ok(None);
    };
    let svg = on_canvas(quantity.title, SIZE, (&x, &y), |chart| {
        let at = |p: &Point, value: f64| (x.place(p.amplitude), y.place(value));
        shade(
            chart,
            points
                .iter()
                .filter(|p| p.held_out)
                .map(|p| at(p, p.measured)),
        )?;
        for (model, colour) in COLOURS.iter().enumerate().take(models) {
            let places: Vec<_> = points.iter().map(|p| at(p, p.predicted(model))).collect();
            mark(chart, &places, *colour)?;
        }
        let places: Vec<_> = points.iter().map(|p| at(p, p.measured)).collect();
        mark(chart, &places, palette::MEASURED)
    })?;
    Ok(Some(Figure {
        title: format!("{} over amplitude", quantity.title),
        caption: quantity.caption.to_owned(),
        keys: legend(findings, quantity, true),
        svg,
        narrow: None,
        wide: false,
    }))
}

/// Relative errors of the predictions, with their intervals, about a line at zero.
fn errors(findings: &Findings, quantity: &Quantity) -> Result<Option<Figure>, ReportError> {
    let points = &quantity.points;
    if points.len() < 2 {
        return Ok(None);
    }
    let models = models(findings);
    let ordinates = points.iter().flat_map(|p| {
        let shown = p.errors[..models].iter();
        shown.flat_map(|(error, interval)| {
            let (lower, upper) = interval.unwrap_or((*error, *error));
            [100.0 * error, 100.0 * lower, 100.0 * upper]
        })
    });
    let y = Axis::over("off by", "%", ordinates.chain([0.0]), 5);
    let (Some(x), Some(y)) = (amplitudes(findings, quantity), y) else {
        return Ok(None);
    };
    let svg = on_canvas(quantity.title, SIZE, (&x, &y), |chart| {
        let at = |p: &Point, error: f64| (x.place(p.amplitude), y.place(100.0 * error));
        let zero = vec![(x.lower, y.place(0.0)), (x.upper, y.place(0.0))];
        let ground = palette::AXIS.stroke_width(FINE + FINE / 2);
        chart.draw_series([PathElement::new(zero, ground)])?;
        let unseen = points.iter().filter(|p| p.held_out);
        let unseen = unseen.flat_map(|p| p.errors[..models].iter().map(|e| at(p, e.0)));
        shade(chart, unseen.collect::<Vec<_>>())?;
        for (model, colour) in COLOURS.iter().enumerate().take(models) {
            let bars = points.iter().filter_map(|p| {
                let (lower, upper) = p.errors[model].1?;
                Some(PathElement::new(
                    vec![at(p, lower), at(p, upper)],
                    colour.stroke_width(FINE),
                ))
            });
            chart.draw_series(bars)?;
            let places: Vec<_> = points.iter().map(|p| at(p, p.errors[model].0)).collect();
            mark(chart, &places, *colour)?;
        }
        Ok(())
    })?;
    let bars = match points
        .iter()
        .any(|p| p.errors[..models].iter().any(|e| e.1.is_some()))
    {
        true => " Bars: 95 % intervals, where three cycles or more repeat.",
        false => "",
    };
    Ok(Some(Figure {
        title: format!("{}: how far off", quantity.title),
        caption: format!("Predicted over measured, less one: zero is as measured.{bars}"),
        keys: legend(findings, quantity, false),
        svg,
        narrow: None,
        wide: false,
    }))
}

/// Baseline alone, or with the extended joint.
fn models(findings: &Findings) -> usize {
    if extends(findings) { 2 } else { 1 }
}

/// Ground beneath the marks of what no fit has seen.
fn shade(chart: &mut Chart, places: impl IntoIterator<Item = (f64, f64)>) -> Result<(), Failure> {
    let style = palette::HELD_OUT.mix(0.8).filled();
    chart.draw_series(places.into_iter().map(|at| Circle::new(at, fine(7), style)))?;
    Ok(())
}

fn legend(findings: &Findings, quantity: &Quantity, measured: bool) -> Vec<(&'static str, String)> {
    let mut keys = marks(findings, measured);
    if quantity.points.iter().any(|p| p.held_out) {
        keys.push(("mark disc", "no fit has seen it".to_owned()));
    }
    keys
}

/// The axis of amplitudes: logarithmic for the loss and where the range is wide, else not from zero.
fn amplitudes(findings: &Findings, quantity: &Quantity) -> Option<Axis> {
    let unit = findings.levels.first().map_or("N", |level| &level.unit);
    let name = match unit {
        "m" => "displacement amplitude",
        _ => "force amplitude",
    };
    let values = quantity.points.iter().map(|p| p.amplitude);
    let largest = values.clone().fold(0.0, f64::max);
    let smallest = values.clone().fold(f64::INFINITY, f64::min);
    if quantity.points.first().is_some_and(|p| p.unit == "J") {
        Axis::logarithmic(name, unit, values, 6)
    } else if largest > 30.0 * smallest {
        Axis::from_zero_or_logarithmic(name, unit, values, 6)
    } else {
        Axis::over(name, unit, values, 6)
    }
}
