//! Why a file was refused: where it stands, what stands there, and the way out.

use super::quantity::Quantity;
use super::spot::Spot;
use std::path::{Path, PathBuf};

/// Why a file, or an option that describes one, was refused. Checked by `tests/reading.rs`.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ReadError {
    /// No such file.
    #[error("{}: there is no such file; check the name and the folder", .file.display())]
    Missing {
        /// The file.
        file: PathBuf,
    },
    /// A folder where a file is wanted.
    #[error("{}: this is a folder; name the files in it", .file.display())]
    Directory {
        /// The folder.
        file: PathBuf,
    },
    /// The system refused to read.
    #[error("{}: cannot be read: {reason}", .file.display())]
    Unreadable {
        /// The file.
        file: PathBuf,
        /// The system's words.
        reason: String,
    },
    /// Not text.
    #[error(
        "{}: this is a binary file, not a table of text; export it as CSV with a header such as `time [s], force [N], displacement [m]`",
        .file.display()
    )]
    Binary {
        /// The file.
        file: PathBuf,
    },
    /// Nothing in it but blank lines and comments.
    #[error(
        "{}: the file is empty; it needs a header such as `time [s], force [N], displacement [m]` and rows of numbers",
        .file.display()
    )]
    Empty {
        /// The file.
        file: PathBuf,
    },
    /// Comments and blank lines alone.
    #[error(
        "{}: there is nothing but comments (#) in this file; it needs a header such as `time [s], force [N], displacement [m]` and rows of numbers",
        .file.display()
    )]
    CommentsOnly {
        /// The file.
        file: PathBuf,
    },
    /// A header without rows.
    #[error("{}, line {line}: a header and no row of numbers below it: add the rows, or name the file that holds them", .file.display())]
    NoRows {
        /// The file.
        file: PathBuf,
        /// Line of the header.
        line: usize,
    },
    /// No number where `--columns` looks for one.
    #[error(
        "{}: up to its last line, {line}, no row has a number where --columns looks for one ({chosen}); columns are counted from 1",
        .file.display()
    )]
    NoChosenNumbers {
        /// The file.
        file: PathBuf,
        /// Its last line that holds anything.
        line: usize,
        /// What was looked for, and where.
        chosen: String,
    },
    /// A header that is separated otherwise than the rows below it.
    #[error(
        "{}, line {line}: the header has {header} and the rows have {rows} between the columns; use one of them in both",
        .file.display()
    )]
    TwoSeparators {
        /// The file.
        file: PathBuf,
        /// Line of the header.
        line: usize,
        /// Separator of the header.
        header: &'static str,
        /// Separator of the rows.
        rows: &'static str,
    },
    /// A single column.
    #[error(
        "{}, line {line}: one column only, `{text}`; columns are separated by comma, semicolon or tab, and {needed}",
        .file.display()
    )]
    OneColumn {
        /// The file.
        file: PathBuf,
        /// Line where the table starts.
        line: usize,
        /// That line.
        text: String,
        /// What the table has to hold.
        needed: &'static str,
    },
    /// Numbers where the header should stand.
    #[error(
        "{}, line {line}: `{text}` are numbers where the header should stand; add one such as `time [s], force [N], displacement [m]`, or say what the columns hold with --columns force=2,displacement=1 --units force=N,displacement=mm",
        .file.display()
    )]
    NoHeader {
        /// The file.
        file: PathBuf,
        /// Line where the table starts.
        line: usize,
        /// That line.
        text: String,
    },
    /// Columns that must be there are not.
    #[error(
        "{}, line {line}: no column {wanted} among {found}; rename it in the header or point to it with --columns, counted from 1",
        .file.display()
    )]
    MissingColumn {
        /// The file.
        file: PathBuf,
        /// Line of the header.
        line: usize,
        /// Names wanted.
        wanted: String,
        /// Names there are.
        found: String,
    },
    /// Two columns for one quantity.
    #[error(
        "{second}: column {first} `{first_name}` holds {quantity} too; name the one to use with --columns, such as {}={first}", .quantity.option()
    )]
    Twice {
        /// The later column.
        second: Spot,
        /// The earlier one, from 1.
        first: usize,
        /// Its header.
        first_name: String,
        /// What both hold.
        quantity: Quantity,
    },
    /// `--columns` points beyond the table.
    #[error(
        "{}, line {line}: --columns asks for {quantity} in column {choice}, and there are {found}",
        .file.display()
    )]
    NoSuchColumn {
        /// The file.
        file: PathBuf,
        /// Line of the header.
        line: usize,
        /// What it should hold.
        quantity: Quantity,
        /// The column asked for.
        choice: String,
        /// Columns there are.
        found: String,
    },
    /// One column chosen for two quantities.
    #[error(
        "{spot}: --columns takes it for {first} and for {second}; give each a column of its own"
    )]
    SameColumn {
        /// The column.
        spot: Spot,
        /// The quantity that stands first in `--columns`.
        first: Quantity,
        /// The later one.
        second: Quantity,
    },
    /// A quantity without unit.
    #[error(
        "{spot}: no unit; write it in the header as `{quantity} [{example}]` or give --units {}={example}", .quantity.option()
    )]
    MissingUnit {
        /// The header cell.
        spot: Spot,
        /// What it holds.
        quantity: Quantity,
        /// A unit that would do.
        example: &'static str,
    },
    /// A unit that is not known, or one of another dimension.
    #[error("{spot}: {}; known for {quantity}: {}", unit_fault(.unit, .measures), super::unit::known(*.quantity))]
    UnknownUnit {
        /// The column, at the line where the unit stands.
        spot: Spot,
        /// The unit as written.
        unit: String,
        /// What it would measure; `None` where it is not known at all.
        measures: Option<&'static str>,
        /// What the column holds.
        quantity: Quantity,
    },
    /// A row longer or shorter than the header.
    #[error(
        "{}, line {line}: {} where the table has {expected}: `{text}`; {fault}",
        .file.display(),
        columns(*.found)
    )]
    Ragged {
        /// The file.
        file: PathBuf,
        /// Line of the row.
        line: usize,
        /// Columns of this row.
        found: usize,
        /// Columns of the table.
        expected: usize,
        /// The row, shortened.
        text: String,
        /// The first column that is missing or in excess, and the way out.
        fault: String,
    },
    /// Nothing where a number should stand.
    #[error("{spot}: empty cell; a gap cannot be simulated: cut the record there or fill it in")]
    EmptyCell {
        /// The cell.
        spot: Spot,
    },
    /// Text where a number should stand.
    #[error("{spot}: `{value}` is not a number{hint}")]
    NotANumber {
        /// The cell.
        spot: Spot,
        /// The text.
        value: String,
        /// What may have happened, and the way out: `; …`.
        hint: &'static str,
    },
    /// NaN, infinity, or beyond what a double holds.
    #[error("{spot}: `{value}` is not a finite number; remove the sample or cut the record there")]
    NotFinite {
        /// The cell.
        spot: Spot,
        /// The text.
        value: String,
    },
    /// A number so large that what is made of it is none.
    #[error(
        "{spot}: `{value}` is beyond all that can be computed with (1e30 in SI units); remove the sample, or check the unit"
    )]
    Beyond {
        /// The cell.
        spot: Spot,
        /// The text.
        value: String,
    },
    /// A column whose largest number is so small that its powers vanish.
    #[error(
        "{spot}: `{value}` is the largest of its column, and too small to be computed with (1e-30 in SI units); check the unit"
    )]
    Vanishing {
        /// The cell of the largest number.
        spot: Spot,
        /// The text.
        value: String,
    },
    /// Time falls.
    #[error(
        "{spot}: time runs back from {from} s to {to} s; sort the rows, or give each test its own file"
    )]
    TimeRunsBack {
        /// The cell.
        spot: Spot,
        /// Time of the row before \[s\].
        from: String,
        /// Time of this row \[s\].
        to: String,
    },
    /// Time stands still.
    #[error(
        "{spot}: time {at} s stands twice; write time with more digits or remove the repeated row"
    )]
    TimeRepeats {
        /// The cell.
        spot: Spot,
        /// That time \[s\].
        at: String,
    },
    /// A negative number where none can be.
    #[error("{spot}: {value} is negative, and {quantity} cannot be; check the sign and the column")]
    Negative {
        /// The cell.
        spot: Spot,
        /// The text.
        value: String,
        /// What it should be.
        quantity: Quantity,
    },
    /// A loss that no loop within the amplitudes of its row can have.
    #[error(
        "{spot}: {value} J a cycle is more than {bound} J, four times force amplitude times displacement amplitude of its row, which a loop that fills the whole rectangle loses; check the unit of dissipation and of displacement amplitude"
    )]
    BeyondRectangle {
        /// The cell of the loss.
        spot: Spot,
        /// The loss \[J\].
        value: String,
        /// Area of the rectangle \[J\].
        bound: String,
    },
    /// `--columns` or `--units` cannot be understood.
    #[error("{option} `{text}`: {reason}")]
    Option {
        /// Which option.
        option: &'static str,
        /// The entry as written.
        text: String,
        /// What is wrong and what is right.
        reason: String,
    },
}

impl ReadError {
    /// The refusal of the system to open or read `file`.
    pub(super) fn from_system(file: &Path, error: &std::io::Error) -> ReadError {
        let file = file.to_path_buf();
        match error.kind() {
            std::io::ErrorKind::NotFound => ReadError::Missing { file },
            std::io::ErrorKind::IsADirectory => ReadError::Directory { file },
            _ => ReadError::Unreadable {
                file,
                reason: error.to_string(),
            },
        }
    }
}

fn columns(count: usize) -> String {
    match count {
        1 => "1 column".to_string(),
        count => format!("{count} columns"),
    }
}

fn unit_fault(unit: &str, measures: &Option<&'static str>) -> String {
    match measures {
        Some(other) => format!("unit `{unit}` measures {other}"),
        None => format!("unknown unit `{unit}`"),
    }
}
