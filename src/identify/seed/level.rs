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

/// Levels of an amplitude table, one per row, sorted by force amplitude.
pub fn table_levels(table: &AmplitudeTable) -> Vec<Level> {
    let at = |column: &Option<Vec<f64>>, i: usize| column.as_ref().map(|c| c[i]);
    let mut found: Vec<Level> = (0..table.force_amplitude.len())
        .map(|i| Level {
            force_amplitude: table.force_amplitude[i],
            displacement_amplitude: at(&table.displacement_amplitude, i),
            dissipation: table.dissipation[i],
            frequency: at(&table.frequency, i),
            count: 1,
            ..Level::default()
        })
        .collect();
    found.sort_by(|a, b| a.force_amplitude.total_cmp(&b.force_amplitude));
    found
}
