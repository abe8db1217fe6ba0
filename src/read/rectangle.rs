//! A loss per cycle that no loop within its amplitudes can have: told by line, before any fit.

use super::error::ReadError;
use super::layout::Column;
use super::number::written;
use super::quantity::Quantity;
use super::source::Source;
use super::spot::Spot;
use crate::record::AmplitudeTable;

/// A loop lies within force and displacement amplitude and encloses no more than their rectangle, 4 F X;
/// beyond this many times that it is no error of measurement.
const TOLERATED: f64 = 1.1;

/// Refuses a table with such a loss, where it keeps the displacement amplitude.
///
/// # Errors
/// [`ReadError::BeyondRectangle`] at the first row; `lines` are those of the rows.
pub fn admit(
    table: &AmplitudeTable,
    source: &Source,
    columns: &[Column],
    lines: &[usize],
) -> Result<(), ReadError> {
    let column = columns.iter().find(|c| c.quantity == Quantity::Dissipation);
    let (Some(displacement), Some(column)) = (&table.displacement_amplitude, column) else {
        return Ok(());
    };
    let amplitudes = table.force_amplitude.iter().zip(displacement);
    let rows = amplitudes.zip(&table.dissipation).zip(lines);
    for (((force, displacement), &loss), &line) in rows {
        let bound = 4.0 * force * displacement;
        // A level of no amplitude is no level: others leave it out.
        if bound > 0.0 && loss > TOLERATED * bound {
            return Err(ReadError::BeyondRectangle {
                spot: Spot {
                    file: source.file.clone(),
                    line,
                    column: column.index + 1,
                    name: column.name.clone(),
                },
                value: written(loss),
                bound: format!("{bound:.3e}"),
            });
        }
    }
    Ok(())
}
