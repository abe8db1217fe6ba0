//! File → values: CSV with units in its header, in any order, checked cell by cell.
//!
//! ```text
//! bytes ─ source ─ text ─ head ─ header, separator ─ layout ─ columns, units ─ numbers ─ SI values
//! ```

mod error;
mod head;
mod layout;
mod number;
mod numbers;
mod options;
mod quantity;
mod source;
mod unit;

pub use error::{ReadError, Spot};
pub use options::{Choice, Options};
pub use quantity::Quantity;
pub use unit::{Dimension, Unit};

use crate::record::{AmplitudeTable, Measurement, Record};
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

/// A load for a simulation: time and what is prescribed.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadTable {
    /// Time \[s\], strictly increasing; `None` where the file has none.
    pub time: Option<Vec<f64>>,
    /// Force \[N\], where the file has it.
    pub force: Option<Vec<f64>>,
    /// Displacement \[m\], where the file has it; one of both is there.
    pub displacement: Option<Vec<f64>>,
    /// Line of the file of each row, to say where a simulation stopped.
    pub lines: Vec<usize>,
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

/// Reads a time history or an amplitude table, whichever the header (or `--columns`) declares.
///
/// # Errors
/// [`ReadError`], naming file, line, column, value and the way out. Checked by
/// `tests/reading.rs`.
pub fn file(path: &Path, options: &Options) -> Result<Loaded, ReadError> {
    let mut source = Source::open(path)?;
    let mut notes = std::mem::take(&mut source.notes);
    let head = head::find(&source, options)?;
    notes.extend(head.notes.iter().cloned());
    let layout = Layout::new(&source, &head, options)?;
    let is_history = layout.has(Quantity::Force) && layout.has(Quantity::Displacement);
    let is_table = layout.has(Quantity::ForceAmplitude) && layout.has(Quantity::Dissipation);
    let measurement = if is_history {
        let required = [Quantity::Force, Quantity::Displacement];
        let columns = layout.columns(&required, &WITH_HISTORY, &mut notes)?;
        let mut numbers = numbers::read(&source, &head, &columns)?;
        Measurement::History(Record {
            name: source.name(),
            time: numbers.take(Quantity::Time),
            force: numbers.take(Quantity::Force).unwrap_or_default(),
            displacement: numbers.take(Quantity::Displacement).unwrap_or_default(),
            preload: numbers.take(Quantity::Preload),
            temperature: numbers.take(Quantity::Temperature),
            acceleration: numbers.take(Quantity::Acceleration),
        })
    } else if is_table {
        let required = [Quantity::ForceAmplitude, Quantity::Dissipation];
        let columns = layout.columns(&required, &WITH_AMPLITUDES, &mut notes)?;
        let mut numbers = numbers::read(&source, &head, &columns)?;
        Measurement::Amplitudes(AmplitudeTable {
            name: source.name(),
            force_amplitude: numbers.take(Quantity::ForceAmplitude).unwrap_or_default(),
            dissipation: numbers.take(Quantity::Dissipation).unwrap_or_default(),
            displacement_amplitude: numbers.take(Quantity::DisplacementAmplitude),
            frequency: numbers.take(Quantity::Frequency),
        })
    } else {
        return Err(
            layout.missing(match (&layout, layout.has(Quantity::Force)) {
                (layout, _) if layout.has(Quantity::ForceAmplitude) => "dissipation",
                (layout, _) if layout.has(Quantity::Dissipation) => "force amplitude",
                (_, true) => "displacement",
                (layout, false) if layout.has(Quantity::Displacement) => "force",
                _ => "force and displacement",
            }),
        );
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

/// Reads the load of a simulation: time, and force or displacement or both.
///
/// # Errors
/// As [`file`].
pub fn load_table(path: &Path, options: &Options) -> Result<LoadTable, ReadError> {
    let mut source = Source::open(path)?;
    let mut notes = std::mem::take(&mut source.notes);
    let head = head::find(&source, options)?;
    notes.extend(head.notes.iter().cloned());
    let layout = Layout::new(&source, &head, options)?;
    let prescribed = [Quantity::Force, Quantity::Displacement];
    let required: Vec<Quantity> = prescribed.into_iter().filter(|q| layout.has(*q)).collect();
    if required.is_empty() {
        return Err(layout.missing("force or displacement"));
    }
    let columns = layout.columns(&required, &[Quantity::Time], &mut notes)?;
    let mut numbers = numbers::read(&source, &head, &columns)?;
    Ok(LoadTable {
        time: numbers.take(Quantity::Time),
        force: numbers.take(Quantity::Force),
        displacement: numbers.take(Quantity::Displacement),
        lines: numbers.lines,
        notes,
    })
}
