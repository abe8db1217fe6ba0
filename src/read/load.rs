//! The load of a simulation: time and what is prescribed.

use super::error::ReadError;
use super::options::Options;
use super::quantity::Quantity;
use super::spot::Spot;
use super::{Opened, numbers};
use std::path::{Path, PathBuf};

/// A load for a simulation.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadTable {
    /// Time \[s\], strictly increasing; row numbers where the file has none.
    pub time: Vec<f64>,
    /// Force \[N\], where the file has it.
    pub force: Option<Vec<f64>>,
    /// Displacement \[m\], where the file has it; one of both is there.
    pub displacement: Option<Vec<f64>>,
    /// What was assumed, converted or left out, in sentences.
    pub notes: Vec<String>,
    file: PathBuf,
    header_line: usize,
    columns: Vec<(Quantity, usize, String)>,
    lines: Vec<usize>,
}

impl LoadTable {
    /// Where the value of a row, from 0, stands in the file: to say where a simulation stopped.
    /// `None` for a quantity or row that the load does not have.
    pub fn spot(&self, quantity: Quantity, row: usize) -> Option<Spot> {
        let (_, index, name) = self.columns.iter().find(|(of, ..)| *of == quantity)?;
        let line = *self.lines.get(row)?;
        Some(Spot {
            file: self.file.clone(),
            line,
            column: index + 1,
            name: name.clone(),
        })
    }

    /// The error for a quantity that the load does not have.
    pub fn missing(&self, wanted: Quantity) -> ReadError {
        let found = self
            .columns
            .iter()
            .map(|(_, at, name)| format!("{} `{name}`", at + 1));
        ReadError::MissingColumn {
            file: self.file.clone(),
            line: self.header_line,
            wanted: wanted.name().to_string(),
            found: found.collect::<Vec<_>>().join(", "),
        }
    }
}

/// Whichever of the two is chosen by `--columns` alone is what drives.
const ONE_DRIVE: [(Quantity, Quantity); 2] = [
    (Quantity::Force, Quantity::Displacement),
    (Quantity::Displacement, Quantity::Force),
];

/// Reads a load: time, and force or displacement or both. Without time the rows are taken one
/// second apart, and the notes say so.
///
/// # Errors
/// As [`super::file`].
pub fn load_table(path: &Path, options: &Options) -> Result<LoadTable, ReadError> {
    let Opened {
        source,
        head,
        mut notes,
    } = Opened::new(
        path,
        options,
        "a load needs time, and force or displacement",
    )?;
    let layout = super::Layout::new(&source, &head, options, &ONE_DRIVE)?;
    let prescribed = [Quantity::Force, Quantity::Displacement];
    let required: Vec<Quantity> = prescribed.into_iter().filter(|q| layout.has(*q)).collect();
    if required.is_empty() {
        return Err(layout.missing("force or displacement"));
    }
    let columns = layout.columns(&required, &[], &mut notes)?;
    let mut numbers = numbers::read(&source, &head, &columns, &mut notes)?;
    let time = numbers.take(Quantity::Time).unwrap_or_else(|| {
        notes.push("no time column: the rows are taken one second apart".to_string());
        (0..numbers.lines.len()).map(|row| row as f64).collect()
    });
    Ok(LoadTable {
        time,
        force: numbers.take(Quantity::Force),
        displacement: numbers.take(Quantity::Displacement),
        notes,
        file: source.file,
        header_line: head.line,
        columns: columns
            .into_iter()
            .map(|c| (c.quantity, c.index, c.name))
            .collect(),
        lines: numbers.lines,
    })
}
