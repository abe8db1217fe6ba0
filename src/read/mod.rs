//! File → values: CSV with units in its header, in any order, checked cell by cell.
//!
//! ```text
//! bytes ─ source ─ text ─ head ─ header, separator ─ layout ─ columns, units ─ numbers ─ SI values
//! ```

mod chosen;
mod error;
mod head;
mod layout;
mod load;
mod number;
mod numbers;
mod options;
mod quantity;
mod rectangle;
mod separator;
mod source;
mod spot;
mod unit;

pub use error::ReadError;
pub use load::{LoadTable, load_table};
pub use options::{Choice, Options};
pub use quantity::Quantity;
pub use spot::Spot;
pub use unit::{Dimension, Unit};

use crate::record::{AmplitudeTable, Measurement, Record};
use head::Head;
use layout::Layout;
use source::Source;
use std::path::Path;

/// A measurement as it was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Loaded {
    /// The values, SI.
    pub measurement: Measurement,
    /// SHA-256 of the file's bytes, hexadecimal.
    pub sha256: String,
    /// What was assumed, converted or left out, in sentences.
    pub notes: Vec<String>,
}

const WITH_HISTORY: [Quantity; 4] = [
    Quantity::Time,
    Quantity::Preload,
    Quantity::Temperature,
    Quantity::Acceleration,
];
const WITH_AMPLITUDES: [Quantity; 2] = [Quantity::DisplacementAmplitude, Quantity::Frequency];
/// Where `--columns` names one of a table, the file is no history.
const A_TABLE: [(Quantity, Quantity); 2] = [
    (Quantity::ForceAmplitude, Quantity::Force),
    (Quantity::Dissipation, Quantity::Force),
];

/// Reads a time history or an amplitude table, whichever the header (or `--columns`) declares.
///
/// # Errors
/// [`ReadError`], naming file, line, column, value and the way out. Checked by
/// `tests/reading.rs`.
pub fn file(path: &Path, options: &Options) -> Result<Loaded, ReadError> {
    let Opened {
        source,
        head,
        mut notes,
    } = Opened::new(path, options, "a measurement needs force and displacement")?;
    let layout = Layout::new(&source, &head, options, &A_TABLE)?;
    let is_history = layout.has(Quantity::Force) && layout.has(Quantity::Displacement);
    let is_table = layout.has(Quantity::ForceAmplitude) && layout.has(Quantity::Dissipation);
    let measurement = if is_history {
        let required = [Quantity::Force, Quantity::Displacement];
        let columns = layout.columns(&required, &WITH_HISTORY, &mut notes)?;
        let mut numbers = numbers::read(&source, &head, &columns, &mut notes)?;
        Measurement::History(Record {
            name: source.name(),
            time: numbers.take(Quantity::Time),
            force: numbers.take(Quantity::Force).unwrap_or_default(),
            displacement: numbers.take(Quantity::Displacement).unwrap_or_default(),
            preload: numbers.take(Quantity::Preload),
            temperature: numbers.take(Quantity::Temperature),
            acceleration: numbers.take(Quantity::Acceleration),
            straight: false,
            drawn: false,
            noisy_drive: false,
            calmed: false,
            alone: Vec::new(),
        })
    } else if is_table {
        let required = [Quantity::ForceAmplitude, Quantity::Dissipation];
        let columns = layout.columns(&required, &WITH_AMPLITUDES, &mut notes)?;
        let mut numbers = numbers::read(&source, &head, &columns, &mut notes)?;
        let table = AmplitudeTable {
            name: source.name(),
            force_amplitude: numbers.take(Quantity::ForceAmplitude).unwrap_or_default(),
            dissipation: numbers.take(Quantity::Dissipation).unwrap_or_default(),
            displacement_amplitude: numbers.take(Quantity::DisplacementAmplitude),
            frequency: numbers.take(Quantity::Frequency),
        };
        rectangle::admit(&table, &source, &columns, &numbers.lines)?;
        Measurement::Amplitudes(table)
    } else {
        return Err(layout.missing(wanted(&layout)));
    };
    if let Measurement::History(Record { time: None, .. }) = &measurement {
        notes.push(
            "no time column: only causes that depend on the order of the samples, not on time, \
             can be told"
                .to_string(),
        );
    }
    Ok(Loaded {
        measurement,
        sha256: source.sha256,
        notes,
    })
}

/// What a table lacks that is neither a history nor an amplitude table.
fn wanted(layout: &Layout) -> &'static str {
    let has = |quantity| layout.has(quantity);
    match () {
        () if has(Quantity::Force) => "displacement",
        () if has(Quantity::Displacement) => "force",
        () if has(Quantity::ForceAmplitude) => "dissipation",
        () if has(Quantity::Dissipation) => "force amplitude",
        () => "force and displacement",
    }
}

/// A file whose text and head are known.
struct Opened {
    source: Source,
    head: Head,
    notes: Vec<String>,
}

impl Opened {
    /// `needed` says what the table has to hold, for where it does not.
    fn new(path: &Path, options: &Options, needed: &'static str) -> Result<Opened, ReadError> {
        let mut source = Source::open(path)?;
        let mut head = head::find(&source, options, needed)?;
        let mut notes = std::mem::take(&mut source.notes);
        notes.append(&mut head.notes);
        Ok(Opened {
            source,
            head,
            notes,
        })
    }
}
