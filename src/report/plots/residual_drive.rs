//! The residual over the driving channel: where in the loop the joint is wrong.

use plotters::element::Circle;
use plotters::series::DashedLineSeries;
use plotters::style::{Color, RGBColor};

use super::axis::Axis;
use super::canvas::{FINE, curve, draw as on_canvas, fine, placed};
use super::residual::Channels;
use super::{Figure, decimate, extends, keys, palette};
use crate::diagnose::Findings;
use crate::diagnose::findings::RecordCurves;
use crate::report::ReportError;

/// Dots of one cloud at most: they show the scatter, the means show the shape.
const MOST_DOTS: usize = 450;
/// Bins of the means over the range of the drive.
const BINS: usize = 40;

/// Measured minus predicted over the drive, with means for rising and falling drive; `None` where
/// the record has no curves.
pub(super) fn draw(
    findings: &Findings,
    curves: &RecordCurves,
) -> Result<Option<Figure>, ReportError> {
    let channels = Channels::of(findings, curves);
    let mut clouds = vec![(
        channels.residual(channels.drive, &curves.baseline),
        palette::BASELINE,
    )];
    if extends(findings) {
        let after = channels.residual(channels.drive, &curves.extended);
        clouds.push((after, palette::EXTENDED));
    }
    let all = || clouds.iter().flat_map(|(points, _)| points.iter());
    let (Some(x), Some(y)) = (
        Axis::over(
            channels.drive_name,
            channels.drive_unit,
            all().map(|point| point.0),
            6,
        ),
        Axis::over(
            &format!("residual {}", findings.judged),
            &findings.unit,
            all().map(|point| point.1),
            6,
        ),
    ) else {
        return Ok(None);
    };
    let axes = (&x, &y);
    let svg = on_canvas("residual over the drive", (520, 380), axes, |chart| {
        for (points, colour) in &clouds {
            let dots = decimate::every(points, MOST_DOTS);
            let style = colour.mix(0.3).filled();
            let dots = placed(&dots, axes).map(|place| Circle::new(place, FINE + FINE / 4, style));
            chart.draw_series(dots.collect::<Vec<_>>())?;
        }
        for (points, colour) in &clouds {
            let [rising, falling] = means(points);
            curve(chart, placed(&rising, axes), line(*colour))?;
            let falling: Vec<_> = placed(&falling, axes).collect();
            chart.draw_series(DashedLineSeries::new(
                falling,
                fine(5),
                fine(4),
                line(*colour),
            ))?;
        }
        Ok(())
    })?;
    let mut keys = keys(findings, false);
    keys.push(("rising", format!("{} rising", channels.drive_name)));
    keys.push(("falling", format!("{} falling", channels.drive_name)));
    Ok(Some(Figure {
        title: "Where in the loop".to_owned(),
        caption: format!(
            "Residual over {}: dots are samples, lines their means.",
            channels.drive_name
        ),
        keys,
        svg,
        narrow: None,
        wide: false,
    }))
}

fn line(colour: RGBColor) -> plotters::style::ShapeStyle {
    colour.stroke_width(FINE + FINE / 2)
}

/// Mean residual per bin of the drive, for rising and for falling drive.
fn means(points: &[(f64, f64)]) -> [Vec<(f64, f64)>; 2] {
    let drives = points
        .iter()
        .map(|point| point.0)
        .filter(|drive| drive.is_finite());
    let lower = drives.clone().fold(f64::INFINITY, f64::min);
    let upper = drives.fold(f64::NEG_INFINITY, f64::max);
    let width = (upper - lower) / BINS as f64;
    let mut bins = [[(0.0, 0.0, 0.0); BINS]; 2];
    for pair in points.windows(2) {
        let (drive, error) = pair[1];
        let step = drive - pair[0].0;
        let bin = ((drive - lower) / width).floor();
        if !(error.is_finite() && bin.is_finite() && step.abs() > 0.0) {
            continue;
        }
        let direction = usize::from(step < 0.0);
        let (count, drives, errors) = &mut bins[direction][(bin as usize).min(BINS - 1)];
        *count += 1.0;
        *drives += drive;
        *errors += error;
    }
    bins.map(|bins| {
        let filled = bins.into_iter().filter(|(count, ..)| *count > 0.0);
        filled
            .map(|(count, drives, errors)| (drives / count, errors / count))
            .collect()
    })
}
