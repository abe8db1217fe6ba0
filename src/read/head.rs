//! Where the table starts: separator, header, row of units, first row of numbers.

use super::chosen::{Chosen, Held};
use super::error::ReadError;
use super::options::Options;
use super::quantity::{self, Quantity};
use super::source::Source;
use super::{number, separator, unit};
use csv::StringRecord;

/// The head of a table.
pub struct Head {
    /// Comma, semicolon or tab.
    pub separator: u8,
    /// Header cells; empty where the file has no header.
    pub names: Vec<String>,
    /// Units from a row below the header, one per cell; empty where there is none.
    pub units: Vec<String>,
    /// Line of that row; the header's where there is none.
    pub units_line: usize,
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

/// The two rows above the one looked at: they may be header and row of units.
#[derive(Clone, Default)]
struct Above {
    last: Option<Row>,
    higher: Option<Row>,
}

impl Above {
    fn push(&mut self, row: Row) {
        self.higher = self.last.replace(row);
    }

    /// Header and row of units of a table of that width, as far as they are there. Units with no
    /// row of names above them stay the header: they are all the names there are.
    fn header_and_units(&self, width: usize) -> (Option<&Row>, Option<&Row>) {
        let fits = |row: &&Row| row.cells.len() == width;
        let last = self.last.as_ref().filter(fits);
        let higher = self.higher.as_ref().filter(fits);
        match (higher, last) {
            (Some(header), Some(units)) if is_units(&units.cells) => (Some(header), Some(units)),
            _ => (last, None),
        }
    }
}

const UNITS_BELOW: &str = "units were taken from the row below the header";

/// Finds the head; `needed` says what the table has to hold, for where it does not.
///
/// # Errors
/// [`ReadError::Empty`], [`ReadError::CommentsOnly`], [`ReadError::OneColumn`],
/// [`ReadError::TwoSeparators`], [`ReadError::NoHeader`], [`ReadError::NoRows`], [`ReadError::NoChosenNumbers`].
pub fn find(source: &Source, options: &Options, needed: &'static str) -> Result<Head, ReadError> {
    let text = source.text.as_str();
    let separator = separator::of_table(text);
    let mut rows = reader(text, separator);
    let mut above = Above::default();
    let mut numbers: Option<(Row, Above)> = None; // the first row of numbers, and those above it
    let mut begun: Option<(Row, Above, usize)> = None; // the same, of some of the numbers that are looked for
    let mut chosen = Chosen::of(options);
    let mut skipped = 0;
    while let Some(row) = next(&mut rows, source)? {
        if options.columns.is_empty() {
            let below = next(&mut rows, source)?;
            return declared(source, separator, &row, below.as_ref(), needed);
        }
        match chosen.held_by(&row.cells) {
            Held::None => begun = None,
            held => {
                let first = begun.get_or_insert_with(|| (row.clone(), above.clone(), skipped));
                if held == Held::All {
                    return Ok(behind((text, separator), first));
                }
            }
        }
        skipped += 1;
        if numbers.is_none() && is_numbers(&row.cells) {
            numbers = Some((row.clone(), above.clone()));
        }
        above.push(row);
    }
    if let Some(first) = begun {
        return Ok(behind((text, separator), &first));
    }
    let file = source.file.clone();
    match (numbers, above.last) {
        // The layout says which column is beyond the table.
        (Some((row, above)), _) => Ok(declared_by_options(text, separator, &row, &above)),
        (None, Some(last)) => Err(ReadError::NoChosenNumbers {
            file,
            line: line_at(text, last.end),
            chosen: in_words(options),
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
    if let (true, Some(header)) = (
        first.cells.len() < 2,
        separator::of_header(&first.cells, separator),
    ) && second.is_some_and(|row| row.cells.len() > 1)
    {
        return Err(ReadError::TwoSeparators {
            file,
            line,
            header: separator::sign(header),
            rows: separator::sign(separator),
        });
    }
    if first.cells.len() < 2 {
        return Err(ReadError::OneColumn {
            file,
            line,
            text: shown(&first.cells, separator),
            needed,
        });
    }
    if is_numbers(&first.cells) {
        return declared_in_comment(source, separator, first);
    }
    let second = second.ok_or(ReadError::NoRows { file, line })?;
    let mut head = Head {
        separator,
        names: cells_of(first),
        units: Vec::new(),
        units_line: line,
        line,
        width: first.cells.len(),
        start: first.end,
        notes: Vec::new(),
    };
    if is_units(&second.cells) {
        head.units = cells_of(second);
        head.units_line = line_at(text, second.end);
        head.start = second.end;
        head.notes.push(UNITS_BELOW.to_string());
    }
    Ok(head)
}

/// The head of a file that begins with numbers: its header is a comment above them.
fn declared_in_comment(source: &Source, separator: u8, first: &Row) -> Result<Head, ReadError> {
    let text = source.text.as_str();
    let line = line_at(text, first.end);
    let width = first.cells.len();
    let (header_line, names) =
        commented_header(text, separator, line, width).ok_or_else(|| ReadError::NoHeader {
            file: source.file.clone(),
            line,
            text: shown(&first.cells, separator),
        })?;
    let above = text.split_inclusive('\n').take(line - 1);
    Ok(Head {
        separator,
        names,
        units: Vec::new(),
        units_line: header_line,
        line: header_line,
        width,
        start: above.map(str::len).sum(),
        notes: vec!["the header was found in a comment".to_string()],
    })
}

/// The head of a file that `--columns` describes: the row above the first numbers, if any, is
/// its header, or its row of units where the header stands above that.
fn declared_by_options(text: &str, separator: u8, row: &Row, above: &Above) -> Head {
    let width = row.cells.len();
    let (header, units) = above.header_and_units(width);
    let line = line_at(text, header.unwrap_or(row).end);
    Head {
        separator,
        names: header.map_or(Vec::new(), cells_of),
        units: units.map_or(Vec::new(), cells_of),
        units_line: units.map_or(line, |units| line_at(text, units.end)),
        line,
        width,
        start: above.last.as_ref().map_or(0, |last| last.end),
        notes: units.map_or(Vec::new(), |_| vec![UNITS_BELOW.to_string()]),
    }
}

fn cells_of(row: &Row) -> Vec<String> {
    let cells = row.cells.iter();
    cells.map(|cell| number::bare(cell).to_string()).collect()
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

/// The head of a file whose first row of numbers that is, with so many rows above it.
fn behind((text, separator): (&str, u8), (row, above, skipped): &(Row, Above, usize)) -> Head {
    let mut head = declared_by_options(text, separator, row, above);
    let expected = 1 + usize::from(!head.units.is_empty()); // header, row of units
    if *skipped > expected {
        head.notes.push(format!(
            "{skipped} rows above the numbers are no numbers: skipped"
        ));
    }
    head
}

/// The choices of `--columns` in words.
fn in_words(options: &Options) -> String {
    let entries = options.columns.iter();
    entries
        .map(|(quantity, choice)| format!("{quantity} in column {choice}"))
        .collect::<Vec<_>>()
        .join(", ")
}

/// Many programs write the header as a comment: the last one above the numbers, if it names
/// columns. With its line.
fn commented_header(
    text: &str,
    separator: u8,
    line: usize,
    width: usize,
) -> Option<(usize, Vec<String>)> {
    let (header_line, above) = (1..line)
        .zip(text.lines())
        .filter(|(_, text)| text.starts_with('#'))
        .last()?;
    let above = above.trim_start_matches('#').trim();
    let names: Vec<String> = above
        .split(char::from(separator))
        .map(|cell| number::bare(cell).to_string())
        .collect();
    let is_named = |cell: &String| {
        let (name, unit) = quantity::name_and_unit(cell);
        Quantity::named(name, unit).is_some()
    };
    (names.len() == width && names.iter().any(is_named)).then_some((header_line, names))
}
