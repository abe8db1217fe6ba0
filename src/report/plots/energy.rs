//! Energy lost per cycle, measured and predicted.

use plotters::element::{Circle, Cross, TriangleMarker};
use plotters::style::Color;

use super::axis::Axis;
use super::canvas::{FINE, curve, draw as on_canvas, fine, placed};
use super::{Figure, MOST_POINTS, decimate, extends, keys, palette};
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
    let (Some(x), Some(y)) = (
        Axis::over("cycle", "1", abscissae, 12),
        Axis::from_zero_or_logarithmic("energy per cycle", "J", ordinates, 5),
    ) else {
        return Ok(None);
    };
    let x = x.whole();
    let axes = (&x, &y);
    let marked = curves.cycles.len() <= 120;
    let svg = on_canvas("energy per cycle", (1060, 260), axes, |chart| {
        let colours = [palette::MEASURED, palette::BASELINE, palette::EXTENDED];
        for (points, colour) in all.into_iter().zip(colours) {
            let points: Vec<_> = placed(points, axes)
                .filter(|point| point.1.is_finite())
                .collect();
            curve(
                chart,
                points.iter().copied(),
                colour
                    .mix(0.6)
                    .stroke_width(if colour == palette::MEASURED {
                        3 * FINE
                    } else {
                        FINE
                    }),
            )?;
            if !marked {
                continue;
            }
            let places = points.into_iter();
            if colour == palette::MEASURED {
                chart.draw_series(places.map(|at| Circle::new(at, fine(4), colour.filled())))?;
            } else if colour == palette::BASELINE {
                chart.draw_series(
                    places.map(|at| TriangleMarker::new(at, fine(4), colour.filled())),
                )?;
            } else {
                let style = colour.stroke_width(2 * FINE);
                chart.draw_series(places.map(|at| Cross::new(at, fine(3), style)))?;
            }
        }
        Ok(())
    })?;
    Ok(Some(Figure {
        title: "Energy per cycle".to_owned(),
        caption: "What the joint dissipates in each closed cycle.".to_owned(),
        keys: keys(findings, true),
        svg,
        wide: true,
    }))
}
