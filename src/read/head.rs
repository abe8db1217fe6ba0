//! Where the table starts: separator, header, row of units, first row of numbers.

use super::error::ReadError;
use super::options::{Choice, Options};
use super::quantity::{self, Quantity};
use super::source::Source;
use super::{number, unit};
use csv::StringRecord;

/// The head of a table.
pub struct Head {
    /// Comma, semicolon or tab.
    pub separator: u8,
    /// Header cells; empty where the file has no header.
    pub names: Vec<String>,
    /// Units from a row below the header, one per cell; empty where there is none.
    pub units: Vec<String>,
    /// Line of the header, or of the first row where there is none.
    pub line: usize,
    /// Count of columns.
    pub width: usize,
    /// Byte where the rows of numbers start (comments may stand before the first).
    pub start: usize,
    /// What was assumed on the way.
    pub notes: Vec<String>,
}

/// A reader of the project's tables over `text`.
pub fn reader(text: &str, separator: u8) -> csv::Reader<&[u8]> {
    csv::ReaderBuilder::new()
        .delimiter(separator)
        .comment(Some(b'#'))
        .has_headers(false)
        .flexible(true)
        .from_reader(text.as_bytes())
}

/// The row as it stands in a message: its cells, shortened.
pub fn shown(row: &StringRecord, separator: u8) -> String {
    let text = row
        .iter()
        .collect::<Vec<_>>()
        .join(&char::from(separator).to_string());
    let text = text.replace(['\n', '\r'], "↵"); // within quotes
    if text.chars().count() > 60 {
        text.chars().take(60).chain(['…']).collect()
    } else {
        text
    }
}

/// True where no cell holds anything.
pub fn is_blank(row: &StringRecord) -> bool {
    row.iter().all(|cell| cell.trim().is_empty())
}

/// Line of the last character before byte `end` that ends no line.
pub fn line_at(text: &str, end: usize) -> usize {
    1 + text[..end]
        .trim_end_matches(['\n', '\r'])
        .bytes()
        .filter(|byte| *byte == b'\n')
        .count()
}

#[derive(Clone)]
struct Row {
    cells: StringRecord,
    end: usize,
}

/// Finds the head; `needed` says what the table has to hold, for where it does not.
///
/// # Errors
/// [`ReadError::Empty`], [`ReadError::CommentsOnly`], [`ReadError::OneColumn`],
/// [`ReadError::TwoSeparators`], [`ReadError::NoHeader`], [`ReadError::NoRows`], [`ReadError::NoChosenNumbers`].
pub fn find(source: &Source, options: &Options, needed: &'static str) -> Result<Head, ReadError> {
    let text = source.text.as_str();
    let separator = separator(text);
    let mut rows = reader(text, separator);
    let mut before: Option<Row> = None; // the row before the one looked at
    let mut numbers: Option<(Row, Option<Row>)> = None; // the first row of numbers, and the one before
    let mut skipped = 0;
    while let Some(row) = next(&mut rows, source)? {
        if options.columns.is_empty() {
            let below = next(&mut rows, source)?;
            return declared(source, separator, &row, below.as_ref(), needed);
        }
        if holds_chosen_numbers(&row.cells, options) {
            let mut head = declared_by_options(text, separator, &row, before.as_ref());
            if skipped > 1 {
                head.notes.push(format!(
                    "{skipped} rows above the numbers are no numbers: skipped"
                ));
            }
            return Ok(head);
        }
        skipped += 1;
        let above = before.replace(row.clone());
        if numbers.is_none() && is_numbers(&row.cells) {
            numbers = Some((row, above));
        }
    }
    let file = source.file.clone();
    match (numbers, before) {
        // The layout says which column is beyond the table.
        (Some((row, above)), _) => Ok(declared_by_options(text, separator, &row, above.as_ref())),
        (None, Some(last)) => Err(ReadError::NoChosenNumbers {
            file,
            line: line_at(text, last.end),
            chosen: chosen(options),
        }),
        (None, None) if text.lines().any(|line| line.trim_start().starts_with('#')) => {
            Err(ReadError::CommentsOnly { file })
        }
        (None, None) => Err(ReadError::Empty { file }),
    }
}

/// The head of a file that says itself what it holds.
fn declared(
    source: &Source,
    separator: u8,
    first: &Row,
    second: Option<&Row>,
    needed: &'static str,
) -> Result<Head, ReadError> {
    let text = source.text.as_str();
    let line = line_at(text, first.end);
    let file = source.file.clone();
    let shown = shown(&first.cells, separator);
    let mut notes = Vec::new();
    if let (true, Some(header)) = (
        first.cells.len() < 2,
        header_separator(&first.cells, separator),
    ) && second.is_some_and(|row| row.cells.len() > 1)
    {
        return Err(ReadError::TwoSeparators {
            file,
            line,
            header: sign(header),
            rows: sign(separator),
        });
    }
    if first.cells.len() < 2 {
        return Err(ReadError::OneColumn {
            file,
            line,
            text: shown,
            needed,
        });
    }
    let cells = |row: &StringRecord| row.iter().map(|cell| cell.trim().to_string()).collect();
    let width = first.cells.len();
    if is_numbers(&first.cells) {
        let names = commented_header(text, separator, line, width).ok_or(ReadError::NoHeader {
            file,
            line,
            text: shown,
        })?;
        notes.push("the header was found in a comment".to_string());
        let start = text
            .split_inclusive('\n')
            .take(line - 1)
            .map(str::len)
            .sum();
        return Ok(Head {
            separator,
            names,
            units: Vec::new(),
            line,
            width,
            start,
            notes,
        });
    }
    let second = second.ok_or(ReadError::NoRows { file, line })?;
    let (units, start) = if is_units(&second.cells) {
        notes.push("units were taken from the row below the header".to_string());
        (cells(&second.cells), second.end)
    } else {
        (Vec::new(), first.end)
    };
    Ok(Head {
        separator,
        names: cells(&first.cells),
        units,
        line,
        width,
        start,
        notes,
    })
}

/// The head of a file that `--columns` describes: the row above the first numbers, if any, is
/// its header.
fn declared_by_options(text: &str, separator: u8, row: &Row, before: Option<&Row>) -> Head {
    let width = row.cells.len();
    let header = before.filter(|above| above.cells.len() == width);
    Head {
        separator,
        names: header.map_or(Vec::new(), |above| {
            above
                .cells
                .iter()
                .map(|cell| cell.trim().to_string())
                .collect()
        }),
        units: Vec::new(),
        line: line_at(text, header.unwrap_or(row).end),
        width,
        start: before.map_or(0, |above| above.end),
        notes: Vec::new(),
    }
}

/// The next row that holds anything.
fn next(rows: &mut csv::Reader<&[u8]>, source: &Source) -> Result<Option<Row>, ReadError> {
    let mut cells = StringRecord::new();
    loop {
        let more = rows
            .read_record(&mut cells)
            .map_err(|error| ReadError::Unreadable {
                file: source.file.clone(),
                reason: error.to_string(),
            })?;
        if !more {
            return Ok(None);
        }
        if !is_blank(&cells)
            && !cells
                .get(0)
                .is_some_and(|cell| cell.trim().starts_with('#'))
        {
            return Ok(Some(Row {
                cells,
                end: end_of(rows),
            }));
        }
    }
}

/// Byte where the reader stands.
pub fn end_of(rows: &csv::Reader<&[u8]>) -> usize {
    usize::try_from(rows.position().byte()).unwrap_or(usize::MAX)
}

fn is_numbers(row: &StringRecord) -> bool {
    row.iter()
        .all(|cell| cell.trim().is_empty() || number::is_one(cell))
}

fn is_units(row: &StringRecord) -> bool {
    row.iter().all(|cell| {
        let (name, bracketed) = quantity::name_and_unit(cell);
        name.is_empty() && bracketed.is_none()
            || unit::measures(bracketed.unwrap_or(name)).is_some()
    })
}

fn holds_chosen_numbers(row: &StringRecord, options: &Options) -> bool {
    options.columns.iter().any(|(_, choice)| match choice {
        Choice::Number(number) => row.get(number - 1).is_some_and(number::is_one),
        Choice::Name(_) => row.iter().any(number::is_one),
    })
}

/// The choices of `--columns` in words.
fn chosen(options: &Options) -> String {
    let entries = options.columns.iter();
    entries
        .map(|(quantity, choice)| format!("{quantity} in column {choice}"))
        .collect::<Vec<_>>()
        .join(", ")
}

/// Many programs write the header as a comment: the last one above the numbers, if it names
/// columns.
fn commented_header(text: &str, separator: u8, line: usize, width: usize) -> Option<Vec<String>> {
    let above = text
        .lines()
        .take(line - 1)
        .filter(|line| line.starts_with('#'))
        .last()?;
    let above = above.trim_start_matches('#').trim();
    let names: Vec<String> = above
        .split(char::from(separator))
        .map(|cell| cell.trim().to_string())
        .collect();
    let is_named = |cell: &String| {
        let (name, unit) = quantity::name_and_unit(cell);
        Quantity::named(name, unit).is_some()
    };
    (names.len() == width && names.iter().any(is_named)).then_some(names)
}

const CANDIDATES: [u8; 3] = *b"\t;,";

/// A separator that the header has and the rows do not use.
fn header_separator(header: &StringRecord, of_rows: u8) -> Option<u8> {
    let bytes = header.as_slice().as_bytes();
    CANDIDATES
        .into_iter()
        .find(|candidate| *candidate != of_rows && bytes.contains(candidate))
}

/// A separator as it stands in a message.
fn sign(separator: u8) -> &'static str {
    match separator {
        b'\t' => "a tab",
        b';' => "`;`",
        _ => "`,`",
    }
}

/// The separator that most of the first rows show, tab before semicolon before comma within one
/// row: a comma beside the others is a decimal comma.
fn separator(text: &str) -> u8 {
    let mut votes = [0; 3];
    let rows = text
        .lines()
        .map(str::trim_start)
        .filter(|l| !l.is_empty() && !l.starts_with('#'));
    for row in rows.take(64) {
        if let Some(found) = CANDIDATES
            .iter()
            .position(|sign| row.as_bytes().contains(sign))
        {
            votes[found] += 1;
        }
    }
    let most = (0..3)
        .rev()
        .max_by_key(|candidate| votes[*candidate])
        .unwrap_or(2);
    CANDIDATES[most]
}
