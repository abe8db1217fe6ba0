//! Loss and stiffness of every level, measured and predicted.

use super::levels::{Levels, Over};
use super::model::Model;
use crate::diagnose::levels::{Compared, Level};
use crate::record::AmplitudeTable;

/// Every level as all of them together are fitted; a resonance shows its stiffness as its
/// frequency.
pub fn compared(
    levels: &Levels,
    tables: &[AmplitudeTable],
    baseline: &Model,
    extended: &Model,
) -> Vec<Level> {
    let unit = match levels.over {
        Over::Displacement => "m",
        Over::Force => "N",
    };
    let rows = levels.rows.iter().map(|row| {
        let before = baseline.predict(row, levels);
        let after = extended.predict(row, levels);
        let hertz = row.rate.map(|rate| rate / std::f64::consts::TAU);
        let stiffness = row.stiffness.zip(before.stiffness.zip(after.stiffness));
        Level {
            record: tables[row.table].name.clone(),
            amplitude: row.amplitude,
            mean: 0.0,
            unit: unit.to_string(),
            rate: hertz,
            cycles: 1,
            held_out: false,
            energy: Some(plain(row.loss, "J", before.loss, after.loss)),
            stiffness: stiffness.map(|(measured, (before, after))| {
                match hertz.filter(|_| levels.harmonic) {
                    Some(hertz) => {
                        let as_rate = |k: f64| hertz * (k / measured).sqrt();
                        plain(hertz, "Hz", as_rate(before), as_rate(after))
                    }
                    None => plain(measured, "N/m", before, after),
                }
            }),
        }
    });
    rows.collect()
}

fn plain(measured: f64, unit: &str, before: f64, after: f64) -> Compared {
    Compared {
        measured,
        unit: unit.to_string(),
        before: before / measured - 1.0,
        before_interval: None,
        after: after / measured - 1.0,
        after_interval: None,
    }
}
