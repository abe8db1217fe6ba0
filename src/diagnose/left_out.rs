//! Records held out whole, in turn: both models refitted to the others.

use rayon::prelude::*;

use super::bootstrap::interval;
use super::gain::{edges, of_squares};
use super::prepare::Bench;
use super::trials::{ALARM, dispersion};
use crate::identify::{Fit, Prediction, Problem, baseline, refit, refit_below, smoothed};

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

/// True where the records tell of the causes without one of them, or there is only one: else nothing but what differs
/// between them does, and a joint is not the same in every test.
pub fn bears_out(all: &[LeftOut]) -> bool {
    all.is_empty() || all.iter().any(|one| one.after != one.before)
}

fn one(problem: &Problem, whole: &Fit, k: usize) -> LeftOut {
    let mut others = problem.clone();
    others.records[k].weight.iter_mut().for_each(|w| *w = 0.0);
    // Loads beyond those of the others meet cells that no sample tells: smoothed, a density goes on into them.
    let plain = smoothed(&others, &baseline(&others));
    let before = squares(problem, &plain, k);
    let extended = || told(&others, refit(&others, whole, whole.effects.clone()));
    let named = (!whole.effects.is_empty()).then(extended);
    let after = match named.filter(|fit| !fit.effects.is_empty()) {
        None => before.clone(),
        Some(fit) => squares(problem, &smoothed(&others, &fit), k),
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

/// The fit without the causes that these records tell nothing of: whoever had them alone would have named none, and
/// values that nothing tells predict anything.
fn told(others: &Problem, mut fit: Fit) -> Fit {
    while !fit.effects.is_empty() {
        let told = fit.misfit + ALARM * dispersion(others, &fit);
        let places = 0..fit.effects.len();
        let without = places.map(|place| refit_below(others, &fit, fit.others(place), told));
        match without.min_by(|a, b| a.misfit.total_cmp(&b.misfit)) {
            Some(less) if less.misfit < told => fit = less,
            _ => break,
        }
    }
    fit
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;
    use crate::identify::Form;
    use crate::joint::effect::Acting;
    use crate::record::Record;
    use crate::record::noise::tests::drawn;

    /// A joint with hum of so much in each of two records, and the fit of both.
    fn hummed(loud: [f64; 2]) -> (Problem, Fit) {
        let mut noise = drawn(20261126);
        let mut record = |loud: f64| {
            let time: Vec<f64> = (0..1000).map(|i| 1e-3 * f64::from(i)).collect();
            let force: Vec<f64> = time.iter().map(|t| 100.0 * (30.0 * t).sin()).collect();
            let hum = |t: &f64| loud * (std::f64::consts::TAU * 50.0 * t).sin();
            let both = force.iter().zip(&time);
            Record {
                name: format!("hum of {loud}"),
                displacement: both
                    .map(|(force, t)| 1e-8 * force + hum(t) + 1e-9 * noise())
                    .collect(),
                force,
                time: Some(time),
                ..Record::default()
            }
        };
        let records = loud.map(&mut record);
        let mut problem = Problem::new(Form::Play, &records);
        for record in &mut problem.records {
            record.weight.fill(1e9);
        }
        let effects = vec![Acting {
            effect: find("mains_hum").unwrap().effect(),
            values: vec![1e-8, 0.0, 50.0, 0.0, 0.0, 0.0, 0.0],
        }];
        let whole = refit(&problem, &baseline(&problem), effects);
        (problem, whole)
    }

    #[test]
    fn what_the_others_tell_nothing_of_they_do_not_predict() {
        let (problem, whole) = hummed([2e-7, 2e-7]);
        let told_by_both = one(&problem, &whole, 1);
        assert!(told_by_both.ratio < 0.1, "{told_by_both:?}");
        let (problem, whole) = hummed([0.0, 2e-7]);
        let told_by_itself = one(&problem, &whole, 1);
        assert_eq!(told_by_itself.before, told_by_itself.after);
        assert!(!bears_out(std::slice::from_ref(&told_by_itself)));
        assert!(bears_out(&[told_by_itself, told_by_both]) && bears_out(&[]));
    }
}
