//! The records' own loading, thinned to what a look ahead needs.

use crate::diagnose::prepare::Bench;
use crate::identify::Problem;
use crate::record::cycles::cycles;

/// Samples over all records that a look ahead marches through.
const BUDGET: usize = 4000;

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
        let wanted = (1.0 / share).ceil() as usize;
        let every = record.every(problem.operators.form, wanted);
        let mut length = input.len();
        if wanted > every {
            let most = (input.len() as f64 * share * every as f64) as usize;
            let ends = found.iter().map(|c| c.end).filter(|&end| end <= most);
            length = ends.max().unwrap_or(most.max(64).min(input.len()));
        }
        record.thin(problem.operators.form, (0, every, length));
    }
    problem
}
