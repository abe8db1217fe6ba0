//! The evidence of every candidate as bars.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axis::Axis;
use super::canvas::{FINE, fine, ink, on_area};
use super::{Figure, palette};
use crate::diagnose::Findings;
use crate::diagnose::findings::Candidate;
use crate::record::written::number;
use crate::report::ReportError;
use crate::report::wording::in_words;

/// Bars at most; the table beneath has all.
const MOST_BARS: usize = 14;
/// Height of a bar with its gap, and of the axis beneath; shown pixels.
const ROW: u32 = 24;
const FOOT: u32 = 46;
const WIDTH: u32 = 1060;
/// Room for the names at the left and for the numbers at the right; shown pixels.
const NAMES: u32 = 190;
const NUMBERS: u32 = 70;

/// Log evidence of the strongest candidates; `None` where nothing was scored.
pub(super) fn draw(findings: &Findings) -> Result<Option<Figure>, ReportError> {
    let mut ranked: Vec<&Candidate> = findings
        .candidates
        .iter()
        .filter(|candidate| candidate.evidence.is_finite())
        .collect();
    ranked.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    let left_out = ranked.len().saturating_sub(MOST_BARS);
    ranked.truncate(MOST_BARS);
    let values = ranked.iter().map(|candidate| candidate.evidence);
    let Some(axis) = (!ranked.is_empty())
        .then(|| {
            Axis::over(
                "log evidence against the baseline",
                "1",
                values.chain([0.0]),
                8,
            )
        })
        .flatten()
    else {
        return Ok(None);
    };
    let svg = bars(findings, &ranked, &axis)?;
    let rest = if left_out > 0 {
        format!(" {left_out} weaker ones stand in the table.")
    } else {
        String::new()
    };
    Ok(Some(Figure {
        title: "Evidence of the candidates".to_owned(),
        caption: format!(
            "Penalised for parameters and whitened; below zero the baseline is the better account.{rest}"
        ),
        keys: vec![
            ("extended", "named".to_owned()),
            ("ambiguous", "cannot be told from a named one".to_owned()),
            ("measured", "not named".to_owned()),
        ],
        svg,
        wide: true,
    }))
}

fn bars(findings: &Findings, ranked: &[&Candidate], axis: &Axis) -> Result<String, ReportError> {
    let rows = ranked.len() as u32 * ROW;
    on_area("evidence", (WIDTH, rows + FOOT), |area| {
        let span = f64::from(fine(WIDTH - NAMES - NUMBERS));
        let across = |place: f64| {
            let share = (place - axis.lower) / (axis.upper - axis.lower);
            fine(NAMES) as i32 + (share * span).round() as i32
        };
        let bottom = fine(rows) as i32;
        let centred = ink().pos(Pos::new(HPos::Center, VPos::Top));
        let grid = palette::AXIS.mix(0.28).stroke_width(FINE);
        for tick in &axis.ticks {
            let at = across(*tick);
            area.draw(&PathElement::new(vec![(at, 0), (at, bottom)], grid))?;
            let label = axis.label(*tick);
            area.draw(&Text::new(
                label,
                (at, bottom + fine(5) as i32),
                centred.clone(),
            ))?;
        }
        let zero = across(0.0);
        let ground = palette::AXIS.stroke_width(FINE);
        area.draw(&PathElement::new(vec![(zero, 0), (zero, bottom)], ground))?;
        let middle = across(0.5 * (axis.lower + axis.upper));
        let title = (middle, bottom + fine(24) as i32);
        area.draw(&Text::new(axis.title.clone(), title, centred))?;
        for (row, candidate) in ranked.iter().enumerate() {
            let top = fine(row as u32 * ROW) as i32;
            let centre = top + fine(ROW / 2) as i32;
            let end = across(axis.place(candidate.evidence));
            let (from, to) = (zero.min(end), zero.max(end));
            let corners = [
                (from, top + fine(4) as i32),
                (to, top + fine(ROW - 4) as i32),
            ];
            let colour = colour(findings, &candidate.name);
            area.draw(&Rectangle::new(corners, colour.filled()))?;
            let name = ink().pos(Pos::new(HPos::Right, VPos::Center));
            let at = (fine(NAMES - 10) as i32, centre);
            area.draw(&Text::new(in_words(&candidate.name), at, name))?;
            let value = ink().pos(Pos::new(HPos::Left, VPos::Center));
            let at = (to + fine(6) as i32, centre);
            area.draw(&Text::new(number(candidate.evidence, 3), at, value))?;
        }
        Ok(())
    })
}

fn colour(findings: &Findings, name: &str) -> RGBColor {
    let ambiguous = |rival: &String| rival == name;
    if findings.causes.iter().any(|cause| cause.name == name) {
        palette::EXTENDED
    } else if findings
        .causes
        .iter()
        .any(|cause| cause.ambiguous_with.iter().any(ambiguous))
    {
        palette::AMBIGUOUS
    } else {
        palette::MEASURED
    }
}
