//! Records held out whole, in turn: both models refitted to the others.

use rayon::prelude::*;

use super::bootstrap::interval;
use super::gain::{edges, of_squares};
use super::prepare::Bench;
use crate::identify::{Fit, Prediction, Problem, baseline, refit};

/// One record as the others predict it.
#[derive(Debug, Clone, PartialEq)]
pub struct LeftOut {
    /// Name of the record.
    pub record: String,
    /// rms of the judged channel as the baseline, fitted to the other records, misses it.
    pub before: f64,
    /// The same of the extended joint.
    pub after: f64,
    /// `after` over `before`.
    pub ratio: f64,
    /// Its 95 % interval, by a bootstrap over whole cycles; `None` with fewer than three.
    pub interval: Option<(f64, f64)>,
}

/// Records that are held out at most; of more, as many spread evenly over them.
const MOST: usize = 4;

/// Holds out every record in turn. The causes are those named on cycles of all records; their values
/// and the joint are of the others alone. Empty for a single record.
pub fn left_out(bench: &Bench, whole: &Fit) -> Vec<LeftOut> {
    let count = bench.whole.records.len();
    if count < 2 {
        return Vec::new();
    }
    let most = count.min(MOST);
    let picked: Vec<usize> = (0..most)
        .map(|i| i * (count - 1) / (most - 1).max(1))
        .collect();
    picked
        .par_iter()
        .map(|&k| one(&bench.whole, whole, k))
        .collect()
}

fn one(problem: &Problem, whole: &Fit, k: usize) -> LeftOut {
    let mut others = problem.clone();
    others.records[k].weight.iter_mut().for_each(|w| *w = 0.0);
    let plain = baseline(&others);
    let before = squares(problem, &plain, k);
    let after = match whole.effects.is_empty() {
        true => before.clone(),
        false => {
            let extended = refit(&others, whole, whole.effects.clone());
            squares(problem, &extended, k)
        }
    };
    let blocks: Vec<(f64, f64)> = before.iter().copied().zip(after.iter().copied()).collect();
    let samples = problem.records[k].time.len().max(1) as f64;
    let rms = |squares: &[f64]| (squares.iter().sum::<f64>() / samples).sqrt();
    LeftOut {
        record: problem.records[k].name.clone(),
        before: rms(&before),
        after: rms(&after),
        ratio: of_squares(&blocks),
        interval: match whole.effects.is_empty() {
            true => None,
            false => interval(&blocks, of_squares),
        },
    }
}

/// Squared errors of the record's cycles. The zero of its sensor is no property of the joint: the
/// mean error is taken off.
fn squares(problem: &Problem, fit: &Fit, k: usize) -> Vec<f64> {
    let Prediction { judged, .. } = problem.pass(k, &fit.coefficients, &fit.acting(), |_, _, _| {});
    let (input, measured) = problem.channels(k);
    let errors: Vec<f64> = measured.iter().zip(&judged).map(|(y, p)| y - p).collect();
    let mean = errors.iter().sum::<f64>() / errors.len().max(1) as f64;
    let edges = edges(input);
    edges
        .windows(2)
        .map(|pair| {
            let cycle = &errors[pair[0]..pair[1]];
            cycle.iter().map(|e| (e - mean).powi(2)).sum()
        })
        .collect()
}
