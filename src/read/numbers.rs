//! The rows of numbers, in SI, checked one by one.

use super::error::ReadError;
use super::head::{self, Head};
use super::layout::Column;
use super::number::{self, Fault, Mark};
use super::quantity::Quantity;
use super::source::Source;
use super::spot::Spot;

/// Values in SI, one vector per column of the layout, and the line of the file of each row.
pub struct Numbers {
    columns: Vec<(Quantity, Vec<f64>)>,
    /// Line of each row, from 1.
    pub lines: Vec<usize>,
}

/// Largest number that is taken, SI: no rig has measured it, and the fourth power of it is finite.
const LARGEST: f64 = 1e30;
/// A channel whose numbers are all smaller is refused for the same reason.
const SMALLEST: f64 = 1.0 / LARGEST;

/// The largest number of a column: its size, its row and its text.
#[derive(Clone, Default)]
struct Peak(f64, usize, String);

impl Numbers {
    /// Takes the values of a quantity out.
    pub fn take(&mut self, quantity: Quantity) -> Option<Vec<f64>> {
        let found = self.columns.iter_mut().find(|(of, _)| *of == quantity);
        found.map(|(_, values)| std::mem::take(values))
    }
}

/// Reads every row; says in `notes` what was assumed.
///
/// # Errors
/// [`ReadError::Unreadable`], [`ReadError::Ragged`], [`ReadError::EmptyCell`], [`ReadError::NotANumber`],
/// [`ReadError::NotFinite`], [`ReadError::Beyond`], [`ReadError::Vanishing`], [`ReadError::Negative`],
/// [`ReadError::TimeRunsBack`], [`ReadError::TimeRepeats`], [`ReadError::NoRows`], each at its line.
pub fn read(
    source: &Source,
    head: &Head,
    columns: &[Column],
    notes: &mut Vec<String>,
) -> Result<Numbers, ReadError> {
    let text = &source.text[head.start..];
    let mut lines_seen = source.text[..head.start]
        .bytes()
        .filter(|b| *b == b'\n')
        .count();
    let mut counted_to = 0;
    let mut values: Vec<Vec<f64>> = vec![Vec::new(); columns.len()];
    let mut peaks = vec![Peak::default(); columns.len()];
    let mut lines = Vec::new();
    let mut mark = Mark::Unseen;
    let mut blank_at: Option<usize> = None;
    let mut left_out = Vec::new();
    let mut rows = head::reader(text, head.separator);
    let mut row = csv::StringRecord::new();
    loop {
        let more = rows
            .read_record(&mut row)
            .map_err(|error| ReadError::Unreadable {
                file: source.file.clone(),
                reason: error.to_string(),
            })?;
        if !more {
            break;
        }
        let end = text[..head::end_of(&rows)]
            .trim_end_matches(['\n', '\r'])
            .len();
        if end > counted_to {
            lines_seen += text[counted_to..end]
                .bytes()
                .filter(|byte| *byte == b'\n')
                .count();
            counted_to = end;
        }
        let line = lines_seen + 1;
        if head::is_blank(&row) {
            blank_at = blank_at.or((row.len() > 1).then_some(line));
            continue;
        }
        if row[0].trim_start().starts_with('#') {
            continue;
        }
        let place = Place { source, line };
        if let Some(line) = blank_at {
            let spot = Place { source, line }.spot(&columns[0]);
            return Err(ReadError::EmptyCell { spot });
        }
        place.check_quotes(&row)?;
        place.check_width(&row, head)?;
        let channels = columns.iter().zip(&mut values).zip(&mut peaks);
        for ((column, values), peak) in channels {
            if left_out.contains(&column.index) {
                continue;
            }
            let cell = row.get(column.index).unwrap_or_default();
            let value = place.number(cell, column, &mut mark);
            let value = match value {
                Err(error) if column.quantity.is_spare() => {
                    notes.push(format!("left out: {error}"));
                    left_out.push(column.index);
                    continue;
                }
                value => value?,
            };
            place.check(value, cell, column, values.last().copied())?;
            if value.abs() > peak.0 {
                *peak = Peak(value.abs(), line, number::shown(cell));
            }
            values.push(value);
        }
        lines.push(line);
    }
    if lines.is_empty() {
        return Err(ReadError::NoRows {
            file: source.file.clone(),
            line: head.line,
        });
    }
    let kept = |column: &Column| !left_out.contains(&column.index);
    for (column, Peak(size, line, value)) in columns.iter().zip(peaks) {
        if kept(column) && column.quantity != Quantity::Time && size > 0.0 && size < SMALLEST {
            let spot = Place { source, line }.spot(column);
            return Err(ReadError::Vanishing { spot, value });
        }
    }
    if mark == Mark::Comma {
        notes.push("a comma within a number is read as decimal comma".to_string());
    }
    let columns = columns
        .iter()
        .zip(values)
        .filter(|(column, _)| kept(column))
        .map(|(column, values)| (column.quantity, values))
        .collect();
    Ok(Numbers { columns, lines })
}

/// A line of the file, where a cell can be refused.
struct Place<'a> {
    source: &'a Source,
    line: usize,
}

impl Place<'_> {
    fn spot(&self, column: &Column) -> Spot {
        Spot {
            file: self.source.file.clone(),
            line: self.line,
            column: column.index + 1,
            name: column.name.clone(),
        }
    }

    /// A quote that nothing closes takes the rows below it into its cell.
    fn check_quotes(&self, row: &csv::StringRecord) -> Result<(), ReadError> {
        let torn = row.iter().position(|cell| cell.contains(['\n', '\r']));
        match torn {
            None => Ok(()),
            Some(column) => Err(ReadError::Unreadable {
                file: self.source.file.clone(),
                reason: format!(
                    "up to line {}, column {}: a quote \" opens a cell that goes on over several rows; close the quote, or remove it",
                    self.line,
                    column + 1
                ),
            }),
        }
    }

    /// Further cells are allowed where they are empty: many programs end every row so.
    fn check_width(&self, row: &csv::StringRecord, head: &Head) -> Result<(), ReadError> {
        let further = row.iter().skip(head.width);
        if row.len() >= head.width && further.into_iter().all(|cell| cell.trim().is_empty()) {
            return Ok(());
        }
        Err(ReadError::Ragged {
            file: self.source.file.clone(),
            line: self.line,
            found: row.len(),
            expected: head.width,
            text: head::shown(row, head.separator),
            fault: ragged(row, head),
        })
    }

    fn number(&self, cell: &str, column: &Column, mark: &mut Mark) -> Result<f64, ReadError> {
        let value = || number::shown(cell);
        let written = number::parse(cell, mark).map_err(|fault| match fault {
            Fault::Empty => ReadError::EmptyCell {
                spot: self.spot(column),
            },
            Fault::NotFinite => ReadError::NotFinite {
                spot: self.spot(column),
                value: value(),
            },
            Fault::Text(hint) => ReadError::NotANumber {
                spot: self.spot(column),
                value: value(),
                hint,
            },
        })?;
        let si = column.unit.si(written);
        match si.abs() <= LARGEST {
            true => Ok(si),
            false => Err(ReadError::Beyond {
                spot: self.spot(column),
                value: value(),
            }),
        }
    }

    fn check(
        &self,
        value: f64,
        cell: &str,
        column: &Column,
        last: Option<f64>,
    ) -> Result<(), ReadError> {
        if column.quantity.never_negative() && value < 0.0 {
            return Err(ReadError::Negative {
                spot: self.spot(column),
                value: number::shown(cell),
                quantity: column.quantity,
            });
        }
        match last.filter(|_| column.quantity == Quantity::Time) {
            Some(last) if value < last => Err(ReadError::TimeRunsBack {
                spot: self.spot(column),
                from: number::written(last),
                to: number::written(value),
            }),
            Some(last) if value == last => Err(ReadError::TimeRepeats {
                spot: self.spot(column),
                at: number::written(value),
            }),
            _ => Ok(()),
        }
    }
}

/// The first column that a row lacks or has too many, and what to do about it.
fn ragged(row: &csv::StringRecord, head: &Head) -> String {
    if row.len() < head.width {
        let column = row.len();
        let name = head.names.get(column);
        let name = name.map_or(String::new(), |name| format!(" `{name}`"));
        return format!(
            "column {}{name} is missing: complete the row, or cut the record there",
            column + 1
        );
    }
    let commas = match head.separator {
        b',' => {
            "; numbers with decimal commas need semicolons or tabs between the columns, or quotes"
        }
        _ => "",
    };
    format!(
        "column {} is beyond the header: remove it or give it a name{commas}",
        head.width + 1
    )
}
