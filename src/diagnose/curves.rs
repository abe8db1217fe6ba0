//! Curves of every record for plots.

use super::findings::RecordCurves;
use super::gain::energy;
use super::prepare::Bench;
use crate::identify::Prediction;
use crate::record::cycles::cycles;

/// Measured, baseline and extended, sample by sample and cycle by cycle.
pub fn curves(bench: &Bench, before: &[Prediction], after: &[Prediction]) -> Vec<RecordCurves> {
    bench
        .whole
        .records
        .iter()
        .enumerate()
        .map(|(k, record)| {
            let (input, judged) = bench.whole.channels(k);
            let form = bench.whole.operators.form;
            let cycles = cycles(input)
                .iter()
                .map(|c| {
                    [
                        record.time[c.start],
                        energy(form, input, judged, c.start, c.end),
                        energy(form, input, &before[k].judged, c.start, c.end),
                        energy(form, input, &after[k].judged, c.start, c.end),
                    ]
                })
                .collect();
            RecordCurves {
                name: record.name.clone(),
                time: record.time.clone(),
                force: record.force.clone(),
                displacement: record.displacement.clone(),
                baseline: before[k].judged.clone(),
                extended: after[k].judged.clone(),
                held_out: bench.held[k].clone(),
                cycles,
            }
        })
        .collect()
}
