//! The map of what this loading takes for what: one row per cause, one column per rival.

use plotters::prelude::*;
use plotters::style::FontTransform;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::canvas::{FINE, Failure, fine, ink, on_area};
use super::{Area, Figure, palette};
use crate::diagnose::Findings;
use crate::diagnose::experiment::Separable;
use crate::diagnose::experiment::separability::TOLD;
use crate::report::ReportError;
use crate::report::wording::in_words;

/// Width of the map, of the names at the left, and heights of the names above and of a row; shown
/// pixels.
const WIDTH: u32 = 1060;
const NAMES: u32 = 190;
const HEAD: u32 = 168;
const ROW: u32 = 23;

/// χ² below which nothing at all tells two causes apart: the margin within which the search counts
/// them as equally good.
const SAME: f64 = 10.0;

/// χ² up to which a pair is told apart by little: four times what is needed.
const LITTLE: f64 = 4.0 * TOLD;

/// The map; `None` where no separability was computed.
pub(super) fn draw(findings: &Findings) -> Result<Option<Figure>, ReportError> {
    let lines = &findings.outlook.separability;
    let mut columns = vec!["none"];
    columns.extend(lines.iter().map(|line| line.name.as_str()));
    if lines.iter().all(|line| line.row.is_empty()) {
        return Ok(None);
    }
    let height = HEAD + ROW * lines.len() as u32 + 6;
    let svg = on_area("map", (WIDTH, height), |area| {
        let map = Map {
            area,
            lines,
            columns: &columns,
        };
        map.heads()?;
        for row in 0..lines.len() {
            map.row(row, findings)?;
        }
        Ok(())
    })?;
    Ok(Some(Figure {
        title: "What is mistaken for what".to_owned(),
        caption: format!(
            "If the cause of a row were at work, the χ² that the rival of a column would leave: below {SAME:.0} they look the same, from {TOLD:.0} on they are told apart. An empty field is above {LITTLE:.0}. Rows are taken at a size that would matter; a named cause (•) and its rivals as fitted."
        ),
        keys: vec![
            ("same", format!("looks the same (below {SAME:.0})")),
            ("doubtful", format!("not told apart (below {TOLD:.0})")),
            (
                "little",
                format!("told apart by little (below {LITTLE:.0})"),
            ),
            ("self", "the cause itself".to_owned()),
        ],
        svg,
        wide: true,
    }))
}

struct Map<'a, 'b> {
    area: &'a Area<'b>,
    lines: &'a [Separable],
    columns: &'a [&'a str],
}

impl Map<'_, '_> {
    /// Left and right edge of a column.
    fn across(&self, column: usize) -> (i32, i32) {
        let span = f64::from(fine(WIDTH - NAMES - 4)) / self.columns.len() as f64;
        let edge = |column: usize| fine(NAMES) as i32 + (column as f64 * span).round() as i32;
        (edge(column), edge(column + 1))
    }

    /// Names of the rivals, read from below.
    fn heads(&self) -> Result<(), Failure> {
        let upright = ink()
            .transform(FontTransform::Rotate270)
            .pos(Pos::new(HPos::Left, VPos::Center));
        for (column, name) in self.columns.iter().enumerate() {
            let (from, to) = self.across(column);
            let at = ((from + to) / 2, fine(HEAD - 8) as i32);
            self.area
                .draw(&Text::new(rival(name), at, upright.clone()))?;
        }
        Ok(())
    }

    fn row(&self, row: usize, findings: &Findings) -> Result<(), Failure> {
        let line = &self.lines[row];
        let top = fine(HEAD + row as u32 * ROW) as i32;
        let bottom = top + fine(ROW) as i32;
        let middle = (top + bottom) / 2;
        let named = findings.causes.iter().any(|cause| cause.name == line.name);
        let label = if named { "• " } else { "" }.to_owned() + &in_words(&line.name);
        let style = ink().pos(Pos::new(HPos::Right, VPos::Center));
        let at = (fine(NAMES - 10) as i32, middle);
        self.area.draw(&Text::new(label, at, style))?;
        let gap = FINE as i32;
        for (column, name) in self.columns.iter().enumerate() {
            let (from, to) = self.across(column);
            let field = [(from + gap, top + gap), (to - gap, bottom - gap)];
            if *name == line.name {
                let own = palette::AXIS.mix(0.45).filled();
                self.area.draw(&Rectangle::new(field, own))?;
                continue;
            }
            let frame = palette::AXIS.mix(0.4).stroke_width(FINE / 2);
            self.area.draw(&Rectangle::new(field, frame))?;
            let left = line.row.iter().find(|(rival, _)| rival == name);
            let Some((_, left)) = left.filter(|(_, left)| *left < LITTLE) else {
                continue;
            };
            let tone = match *left {
                left if left < SAME => palette::BASELINE.mix(0.75).filled(),
                left if left < TOLD => palette::AMBIGUOUS.mix(0.75).filled(),
                _ => palette::HELD_OUT.mix(0.55).filled(),
            };
            self.area.draw(&Rectangle::new(field, tone))?;
            let shown = match *left {
                left if left < 1.0 => "<1".to_owned(),
                left => format!("{left:.0}"),
            };
            let centred = ink().pos(Pos::new(HPos::Center, VPos::Center));
            let at = ((from + to) / 2, middle);
            self.area.draw(&Text::new(shown, at, centred))?;
        }
        Ok(())
    }
}

/// A rival in words.
fn rival(name: &str) -> String {
    match name {
        "none" => "the plain joint".to_owned(),
        name => in_words(name),
    }
}
