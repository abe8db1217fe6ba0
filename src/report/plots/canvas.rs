//! The drawing ground: frame, grid, ticks and titles of every plot.

use plotters::chart::ChartContext;
use plotters::coord::Shift;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint};
use plotters::prelude::*;

use super::super::ReportError;
use super::axis::Axis;
use super::palette;

/// Units of the drawing per pixel shown: coordinates are whole numbers, and curves need finer ones.
pub(super) const FINE: u32 = 4;
/// Text height in shown pixels, as plotters counts it (1.24 times the font size).
const TEXT: f64 = 11.5 * 1.24;

pub(super) type Failure = Box<dyn std::error::Error + Send + Sync>;
type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(super) type Plane = Cartesian2d<Axis, Axis>;
pub(super) type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Plane>;

/// An `<svg>` of `width` × `height` shown pixels with two axes, filled by `fill`.
pub(super) fn draw(
    plot: &str,
    (width, height): (u32, u32),
    (x, y): (&Axis, &Axis),
    fill: impl FnOnce(&mut Chart) -> Result<(), Failure>,
) -> Result<String, ReportError> {
    on_area(plot, (width, height), |area| {
        let mut chart = ChartBuilder::on(area)
            .margin(fine(6))
            .margin_right(fine(12))
            // Room for letters half as large again: a narrow page asks for them.
            .x_label_area_size(fine(44))
            .y_label_area_size(fine(68))
            .build_cartesian_2d(x.clone(), y.clone())?;
        let text = ink().pos(plotters::style::text_anchor::Pos::default());
        chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(palette::AXIS.mix(0.28).stroke_width(FINE))
            .axis_style(palette::AXIS.stroke_width(FINE))
            .label_style(text.clone())
            .axis_desc_style(text)
            .x_desc(&x.title)
            .y_desc(&y.title)
            .x_label_formatter(&|tick| x.label(*tick))
            .y_label_formatter(&|tick| y.label(*tick))
            .draw()?;
        fill(&mut chart)
    })
}

/// An `<svg>` of `width` × `height` shown pixels, drawn freely.
fn on_area(
    plot: &str,
    (width, height): (u32, u32),
    fill: impl FnOnce(&Area) -> Result<(), Failure>,
) -> Result<String, ReportError> {
    let mut svg = String::new();
    {
        let size = (width * FINE, height * FINE);
        let area = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        fill(&area)
            .and_then(|()| area.present().map_err(Failure::from))
            .map_err(|error| ReportError::Plot {
                plot: plot.to_owned(),
                reason: error.to_string(),
            })?;
    }
    Ok(svg)
}

/// A curve through points already placed on the axes.
pub(super) fn curve(
    chart: &mut Chart,
    points: impl IntoIterator<Item = (f64, f64)>,
    style: ShapeStyle,
) -> Result<(), Failure> {
    chart.draw_series(LineSeries::new(points, style))?;
    Ok(())
}

/// SI points placed on the axes.
pub(super) fn placed<'a>(
    points: &'a [(f64, f64)],
    (x, y): (&'a Axis, &'a Axis),
) -> impl Iterator<Item = (f64, f64)> + 'a {
    points.iter().map(|(a, b)| (x.place(*a), y.place(*b)))
}

/// Shown pixels as units of the drawing.
pub(super) fn fine(pixels: u32) -> u32 {
    pixels * FINE
}

/// The style of all text.
fn ink() -> TextStyle<'static> {
    ("sans-serif", TEXT * f64::from(FINE))
        .into_font()
        .color(&palette::INK)
}

/// An axis as the drawing library wants it: its own ticks, whatever count is asked for.
impl Ranged for Axis {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, place: &f64, (from, to): (i32, i32)) -> i32 {
        let share = (place - self.lower) / (self.upper - self.lower);
        from + (share * f64::from(to - from)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() {
            Vec::new()
        } else {
            self.ticks.clone()
        }
    }

    fn range(&self) -> std::ops::Range<f64> {
        self.lower..self.upper
    }
}
