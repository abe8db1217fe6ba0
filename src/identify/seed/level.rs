//! Load levels: settled cycles of like amplitude, averaged.

use super::cycle_point::CyclePoint;
use crate::record::AmplitudeTable;

/// One load level: means over its cycles, with the standard error of the energy.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Level {
    /// F_0 \[N\].
    pub force_amplitude: f64,
    /// U_0 \[m\], where measured.
    pub displacement_amplitude: Option<f64>,
    /// D \[J\] per cycle.
    pub dissipation: f64,
    /// Relative standard error of D; `None` for a single cycle.
    pub relative_error: Option<f64>,
    /// u_R \[m\] and its standard error, from loops.
    pub residual_slip: Option<(f64, f64)>,
    /// Frequency \[Hz\], where measured.
    pub frequency: Option<f64>,
    /// Count of cycles.
    pub count: usize,
}

/// Relative width of a level: cycles within it are taken together.
const SAME_LEVEL: f64 = 0.05;

/// Levels of rising force amplitude.
pub fn levels(points: &[CyclePoint]) -> Vec<Level> {
    let mut sorted: Vec<&CyclePoint> = points.iter().collect();
    sorted.sort_by(|a, b| a.force_amplitude.total_cmp(&b.force_amplitude));
    let mut groups: Vec<Vec<&CyclePoint>> = Vec::new();
    for point in sorted {
        match groups.last_mut() {
            Some(group)
                if point.force_amplitude <= group[0].force_amplitude * (1.0 + SAME_LEVEL) =>
            {
                group.push(point);
            }
            _ => groups.push(vec![point]),
        }
    }
    groups.iter().map(|group| average(group)).collect()
}

fn average(group: &[&CyclePoint]) -> Level {
    let count = group.len();
    let mean = |f: &dyn Fn(&CyclePoint) -> f64| {
        let values: Vec<f64> = group.iter().map(|p| f(p)).collect();
        let mean = values.iter().sum::<f64>() / count as f64;
        let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
        let error = (squares / (count.max(2) - 1) as f64 / count as f64).sqrt();
        (mean, error)
    };
    let (dissipation, error) = mean(&|p| p.dissipation);
    let frequency = group
        .iter()
        .map(|p| p.frequency)
        .sum::<Option<f64>>()
        .map(|sum| sum / count as f64);
    Level {
        force_amplitude: mean(&|p| p.force_amplitude).0,
        displacement_amplitude: Some(mean(&|p| p.displacement_amplitude).0),
        dissipation,
        relative_error: (count > 1).then(|| error / dissipation.abs()),
        residual_slip: Some(mean(&|p| p.residual_slip)),
        frequency,
        count,
    }
}

/// Levels closer than this, in the logarithm of the amplitude, are repeats of one.
pub const APART: f64 = 0.02;

/// Levels of an amplitude table by rising force amplitude: the mean of the rows that repeat one in force and,
/// where measured, in displacement; of two or three readings the scatter stays unknown.
///
/// Between repeats the slope of the loss would be that of their noise alone, and none at all between equal loads.
/// Checked by `repeated_rows_are_one_level`.
pub fn table_levels(table: &AmplitudeTable) -> Vec<Level> {
    let mut rows: Vec<usize> = (0..table.force_amplitude.len()).collect();
    rows.sort_by(|&a, &b| table.force_amplitude[a].total_cmp(&table.force_amplitude[b]));
    let alike = |column: &[f64], a: usize, b: usize| {
        column[a] == column[b] || (column[a] / column[b]).ln().abs() <= APART
    };
    let repeats = |a: usize, b: usize| {
        let displacement = table.displacement_amplitude.as_ref();
        alike(&table.force_amplitude, a, b) && displacement.is_none_or(|u| alike(u, a, b))
    };
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for row in rows {
        match groups.iter_mut().find(|group| repeats(group[0], row)) {
            Some(group) => group.push(row),
            None => groups.push(vec![row]),
        }
    }
    groups.iter().map(|group| mean_row(table, group)).collect()
}

fn mean_row(table: &AmplitudeTable, group: &[usize]) -> Level {
    let count = group.len();
    let mean = |column: &[f64]| group.iter().map(|&i| column[i]).sum::<f64>() / count as f64;
    Level {
        force_amplitude: mean(&table.force_amplitude),
        displacement_amplitude: table.displacement_amplitude.as_deref().map(mean),
        dissipation: mean(&table.dissipation),
        frequency: table.frequency.as_deref().map(mean),
        count,
        ..Level::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeated_rows_are_one_level() {
        let table = AmplitudeTable {
            force_amplitude: vec![200.0, 100.0, 201.0, 100.0, 100.0],
            displacement_amplitude: Some(vec![2.0, 1.0, 2.0, 1.0, 1.3]),
            dissipation: vec![9.0, 1.0, 11.0, 3.0, 4.0],
            ..AmplitudeTable::default()
        };
        let found: Vec<(f64, f64, usize)> = table_levels(&table)
            .iter()
            .map(|l| (l.force_amplitude, l.dissipation, l.count))
            .collect();
        // The row of another displacement is another joint's or another frequency's.
        assert_eq!(found, [(100.0, 2.0, 2), (100.0, 4.0, 1), (200.5, 10.0, 2)]);
    }
}
