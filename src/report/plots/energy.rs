//! Energy lost per cycle, measured and predicted.

use plotters::element::{Circle, Cross, TriangleMarker};
use plotters::style::{Color, RGBColor};

use super::axis::Axis;
use super::canvas::{Chart, FINE, Failure, curve, draw as on_canvas, fine, placed};
use super::{Figure, MOST_POINTS, decimate, extends, keys, marks, palette};
use crate::diagnose::Findings;
use crate::diagnose::findings::RecordCurves;
use crate::report::ReportError;

/// Energy per cycle over the number of the cycle; `None` where no cycle was closed.
pub(super) fn draw(
    findings: &Findings,
    curves: &RecordCurves,
) -> Result<Option<Figure>, ReportError> {
    // An amplitude table has levels and no cycles in time: its loss is drawn over amplitude.
    if curves.time.is_empty() {
        return Ok(None);
    }
    let column = |column: usize| -> Vec<(f64, f64)> {
        let cycles = curves.cycles.iter().enumerate();
        let points: Vec<_> = cycles
            .map(|(index, cycle)| (index as f64 + 1.0, cycle[column]))
            .collect();
        decimate::extremes(&points, MOST_POINTS)
    };
    let (measured, baseline) = (column(1), column(2));
    let extended = if extends(findings) {
        column(3)
    } else {
        Vec::new()
    };
    let all = [&measured, &baseline, &extended];
    let ordinates = all
        .iter()
        .flat_map(|points| points.iter().map(|point| point.1));
    let abscissae = (0..curves.cycles.len()).map(|index| index as f64 + 1.0);
    let x = |ticks| Axis::over("cycle", "1", abscissae.clone(), ticks);
    let y = Axis::from_zero_or_logarithmic("energy per cycle", "J", ordinates, 5);
    let (Some(wide), Some(narrow), Some(y)) = (x(12), x(5), y) else {
        return Ok(None);
    };
    let marked = curves.cycles.len() <= 120;
    let draw = |x: Axis, size: (u32, u32)| {
        let x = x.whole();
        on_canvas("energy per cycle", size, (&x, &y), |chart| {
            let colours = [palette::MEASURED, palette::BASELINE, palette::EXTENDED];
            for (points, colour) in all.into_iter().zip(colours) {
                let points: Vec<_> = placed(points, (&x, &y))
                    .filter(|point| point.1.is_finite())
                    .collect();
                let width = if colour == palette::MEASURED { 3 } else { 1 };
                let style = colour.mix(0.6).stroke_width(width * FINE);
                curve(chart, points.iter().copied(), style)?;
                if marked {
                    mark(chart, &points, colour)?;
                }
            }
            Ok(())
        })
    };
    let svg = draw(wide, (1060, 260))?;
    let narrow = draw(narrow, (520, 300))?;
    let keys = if marked {
        marks(findings, true)
    } else {
        keys(findings, true)
    };
    Ok(Some(Figure {
        title: "Energy per cycle".to_owned(),
        caption: "What the joint dissipates in each closed cycle.".to_owned(),
        keys,
        svg,
        narrow: Some(narrow),
        wide: true,
    }))
}

/// The marks of the legend: rings as measured, triangles and crosses within them.
pub(super) fn mark(
    chart: &mut Chart,
    places: &[(f64, f64)],
    colour: RGBColor,
) -> Result<(), Failure> {
    let places = places.iter().copied();
    match colour {
        palette::MEASURED => {
            let style = colour.stroke_width(2 * FINE);
            chart.draw_series(places.map(|at| Circle::new(at, fine(6), style)))?;
        }
        palette::BASELINE => {
            let style = colour.filled();
            chart.draw_series(places.map(|at| TriangleMarker::new(at, fine(4), style)))?;
        }
        _ => {
            let style = colour.stroke_width(2 * FINE);
            chart.draw_series(places.map(|at| Cross::new(at, fine(3), style)))?;
        }
    }
    Ok(())
}
