//! The records' own loading, thinned to what a look ahead needs.

use crate::diagnose::prepare::Bench;
use crate::identify::{Prepared, Problem};
use crate::record::cycles::cycles;

/// Samples over all records that a look ahead marches through.
const BUDGET: usize = 6000;

/// Fewest samples per cycle that thinning leaves.
const PER_CYCLE: usize = 40;

/// Loading of all records with at most about [`BUDGET`] samples, weighed so that slow signatures
/// keep their χ².
///
/// Every `m`-th sample and every turning point stays; noise of correlation `a` then counts as white
/// with variance `σ² (1+a)/((1−a) m)`. What is still too long is cut after a whole cycle, which
/// makes every χ² a lower bound.
pub fn loading(bench: &Bench) -> Problem {
    let total: usize = bench.whole.records.iter().map(|r| r.time.len()).sum();
    if total <= BUDGET {
        return bench.whole.clone();
    }
    let mut problem = bench.whole.clone();
    let share = BUDGET as f64 / total as f64;
    for (k, record) in problem.records.iter_mut().enumerate() {
        let (input, _) = bench.whole.channels(k);
        let found = cycles(input);
        let shortest = found.iter().map(|c| c.len()).min().unwrap_or(input.len());
        let wanted = (1.0 / share).ceil() as usize;
        let every = wanted.min((shortest / PER_CYCLE).max(1)).max(1);
        let mut length = input.len();
        if wanted > every {
            let most = (input.len() as f64 * share * every as f64) as usize;
            let ends = found.iter().map(|c| c.end).filter(|&end| end <= most);
            length = ends.max().unwrap_or(most.max(64).min(input.len()));
        }
        thin(record, input, every, length);
    }
    problem
}

fn thin(record: &mut Prepared, input: &[f64], every: usize, length: usize) {
    let turns = |i: usize| {
        i > 0
            && i + 1 < length
            && (input[i] - input[i - 1]) * (input[i + 1] - input[i]) < 0.0
            && every > 1
    };
    let kept: Vec<(usize, usize)> = (0..length)
        .filter(|&i| i % every == 0 || turns(i) && turning_far(input, i, every))
        .map(|i| (i, every))
        .collect();
    keep(record, &kept);
}

/// Leaves the given samples of a record, each standing for as many: where one stands for more than itself,
/// noise counts as white.
pub(super) fn keep(record: &mut Prepared, kept: &[(usize, usize)]) {
    let indices: Vec<usize> = kept.iter().map(|(i, _)| *i).collect();
    let pick = |channel: &[f64]| indices.iter().map(|&i| channel[i]).collect::<Vec<f64>>();
    record.between.thin(&indices, &record.time);
    let a = record.autoregression;
    record.time = pick(&record.time);
    record.force = pick(&record.force);
    record.displacement = pick(&record.displacement);
    record.steps = std::iter::once(0.0)
        .chain(record.time.windows(2).map(|pair| pair[1] - pair[0]))
        .collect();
    record.weight = pick(&record.weight);
    if kept.iter().any(|(_, every)| *every > 1) {
        // weight = 1/innovation, innovation² = σ² (1 − a²)
        for (weight, (_, every)) in record.weight.iter_mut().zip(kept) {
            *weight *= ((1.0 - a) * (1.0 - a) * *every as f64).sqrt();
        }
        record.autoregression = 0.0;
    }
}

/// True where a sample is the extreme of its neighbourhood and no wiggle of the noise.
fn turning_far(input: &[f64], i: usize, reach: usize) -> bool {
    let (from, to) = (i.saturating_sub(reach), (i + reach).min(input.len() - 1));
    let around = &input[from..=to];
    around.iter().all(|x| *x <= input[i]) || around.iter().all(|x| *x >= input[i])
}
