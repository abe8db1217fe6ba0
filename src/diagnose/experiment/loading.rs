//! The records' own loading, thinned to what a look ahead needs.

use crate::diagnose::prepare::Bench;
use crate::identify::Problem;
use crate::record::cycles::cycles;
use crate::record::mains::NOMINAL;

/// Samples over all records that a look ahead marches through.
const BUDGET: usize = 4000;

/// Fewest samples per cycle that thinning leaves.
const PER_CYCLE: usize = 40;

/// Part of the thinned rate by which an alias has to stay away from rest and from half that rate, where one of a sine's
/// two parts vanishes at every sample.
const APART: f64 = 0.05;

/// Counts of samples tried beyond the one asked for.
const TRIED: usize = 4;

/// `every`, or the next larger count of samples `Δt` apart at which a hum of the mains is seen in both its parts, if any
/// is.
fn shows_mains(every: usize, sample: f64) -> usize {
    let seen = |every: &usize| {
        let alias = |f: f64| (f * sample * *every as f64).fract();
        let apart = |f: f64| {
            let twice = 2.0 * alias(f);
            (twice - twice.round()).abs() > 2.0 * APART
        };
        NOMINAL.into_iter().all(apart)
    };
    match every {
        0 | 1 => every,
        _ => (every..every + TRIED).find(seen).unwrap_or(every),
    }
}

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
        let every = shows_mains(every, record.length() / (input.len().max(2) - 1) as f64);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hum_is_not_thinned_away() {
        // At 200 Hz every second sample of 50 Hz is the same but for its sign, and every fourth wholly the same.
        assert_eq!(shows_mains(2, 1.0 / 200.0), 3);
        assert_eq!(shows_mains(4, 1.0 / 200.0), 7);
        assert_eq!(shows_mains(2, 1.0 / 203.0), 3);
        assert_eq!(shows_mains(2, 1.0 / 1000.0), 2);
        // All samples stay as they are, and so do those without a time that means seconds.
        assert_eq!(shows_mains(1, 1.0 / 100.0), 1);
        assert_eq!(shows_mains(3, 1.0), 3);
    }
}
