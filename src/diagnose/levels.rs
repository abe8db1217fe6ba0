//! Loss and stiffness per level of the load, measured and predicted.

use super::bootstrap::interval;
use super::gain::{energy, slope};
use super::prepare::Bench;
use crate::identify::Prediction;
use crate::record::cycles::{Cycle, alike, cycles};

/// One quantity of a level.
#[derive(Debug, Clone, PartialEq)]
pub struct Compared {
    /// Mean of the cycles as measured.
    pub measured: f64,
    /// Its unit.
    pub unit: String,
    /// Mean relative error of the baseline.
    pub before: f64,
    /// Its 95 % interval, by a bootstrap over the level's cycles; `None` with fewer than three.
    pub before_interval: Option<(f64, f64)>,
    /// Mean relative error of the extended joint.
    pub after: f64,
    /// Its interval.
    pub after_interval: Option<(f64, f64)>,
}

/// Cycles of one record that follow each other with the same amplitude, mean and rate.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// Name of the record.
    pub record: String,
    /// Amplitude of the prescribed channel, in its unit.
    pub amplitude: f64,
    /// Mean of the prescribed channel.
    pub mean: f64,
    /// Unit of both, `N` or `m`.
    pub unit: String,
    /// Cycles per second; `None` where the record has no time.
    pub rate: Option<f64>,
    /// Count of cycles.
    pub cycles: usize,
    /// True where no fit has seen them.
    pub held_out: bool,
    /// Energy per cycle \[J\]; `None` where the loop has no area beyond rounding.
    pub energy: Option<Compared>,
    /// Slope of the loop's regression line, force over displacement \[N/m\].
    pub stiffness: Option<Compared>,
}

/// Levels of all records, in order.
pub fn levels(
    bench: &Bench,
    before: &[Prediction],
    after: &[Prediction],
    timed: bool,
) -> Vec<Level> {
    let mut all = Vec::new();
    for (k, held) in bench.held.iter().enumerate() {
        let (input, _) = bench.whole.channels(k);
        let unseen = |c: &Cycle| held[c.start..c.end].iter().all(|held| *held);
        let found = cycles(input);
        let joins =
            |a: &Cycle, b: &Cycle| a.end == b.start && alike(a, b) && unseen(a) == unseen(b);
        for group in found.chunk_by(joins) {
            let channels = [
                bench.whole.channels(k).1,
                before[k].judged.as_slice(),
                after[k].judged.as_slice(),
            ];
            let form = bench.whole.operators.form;
            let record = &bench.whole.records[k];
            let count = group.len() as f64;
            let mean = |of: &dyn Fn(&Cycle) -> f64| group.iter().map(of).sum::<f64>() / count;
            let seconds = mean(&|c| {
                let last = (c.end).min(record.time.len() - 1);
                record.time[last] - record.time[c.start]
            });
            let compare = |unit: &str, of: &dyn Fn(&Cycle, &[f64]) -> Option<f64>| {
                let each = group.iter().map(|cycle| {
                    let [measured, before, after] = channels.map(|channel| of(cycle, channel));
                    Some([measured?, before?, after?])
                });
                compared(unit, &each.collect::<Option<Vec<_>>>()?)
            };
            all.push(Level {
                record: record.name.clone(),
                amplitude: mean(&|c| c.amplitude),
                mean: mean(&|c| c.mean),
                unit: form.input().1.to_string(),
                rate: (timed && seconds > 0.0).then(|| seconds.recip()),
                cycles: group.len(),
                held_out: unseen(&group[0]),
                energy: compare("J", &|c, y| Some(energy(form, input, y, c.start, c.end))),
                stiffness: compare("N/m", &|c, y| slope(form, input, y, c.start, c.end)),
            });
        }
    }
    all
}

/// Mean and mean relative errors of values \[measured, before, after\] of each cycle.
fn compared(unit: &str, cycles: &[[f64; 3]]) -> Option<Compared> {
    if cycles.iter().any(|[measured, ..]| *measured <= 0.0) {
        return None;
    }
    let error = |model: usize| {
        let each: Vec<f64> = cycles.iter().map(|c| c[model] / c[0] - 1.0).collect();
        let mean = |errors: &[f64]| errors.iter().sum::<f64>() / errors.len().max(1) as f64;
        (mean(&each), interval(&each, mean))
    };
    let ((before, before_interval), (after, after_interval)) = (error(1), error(2));
    Some(Compared {
        measured: cycles.iter().map(|c| c[0]).sum::<f64>() / cycles.len().max(1) as f64,
        unit: unit.to_string(),
        before,
        before_interval,
        after,
        after_interval,
    })
}
