//! Records that end with what no sample of the fit has shown: the end is given to the fit, and searched again.

use super::investigation::{Investigation, however_worn, searched};
use super::places::scatter;
use super::prepare::Bench;
use super::tested::each_unseen;
use super::trials::ALARM;
use crate::identify::{Fit, baseline, refit};
use crate::record::Record;

/// Share of the noise's variance, and times what fitted samples leave, that the samples set aside at the end of the
/// records leave beyond noise where something happened that the fit has not seen.
const NEWS: f64 = 0.5;
const TIMES: f64 = 3.0;

/// Share of the misfit beyond noise that causes found with the end may leave: a cause that only mends what is not in the
/// catalogue leaves more.
const LEFT: f64 = 0.25;

/// True where the samples that were set aside at the end of the records show what no fitted sample did: what happened
/// there has not been looked for.
fn ends_with_news(bench: &Bench, fit: &Fit) -> bool {
    let predictions = fit.predict(&bench.train);
    let from = |held: &[bool]| held.iter().rposition(|h| !h).map_or(0, |last| last + 1);
    let ends: Vec<usize> = bench.held.iter().map(|held| from(held)).collect();
    let (mut beyond, mut rows) = (0.0, 0.0);
    each_unseen(bench, |k, i, measured, weight| {
        if i >= ends[k] {
            let (error, variance) = (
                measured - predictions[k].judged[i],
                bench.noise[k].deviation.powi(2),
            );
            beyond += weight * (error.powi(2) - variance);
            rows += weight * variance;
        }
    });
    let fitted = fit.misfit / bench.train.rows().max(1) as f64 - 1.0;
    beyond - scatter(rows) > NEWS.max(TIMES * fitted) * rows
}

/// Searches for causes in records however they begin; once more where they end with what no fitted sample showed.
pub fn investigated(
    records: &[Record],
    timed: bool,
    progress: &mut impl FnMut(&str),
) -> Investigation {
    let first = however_worn(records, timed, progress);
    if !ends_with_news(&first.bench, &first.found.best) {
        return first;
    }
    progress("once more: a record ends with what no sample of the fit has shown");
    let mut bench = first.bench.clone();
    bench.fit_the_end();
    let plain = baseline(&bench.train);
    let again = searched(bench, plain, timed, progress).sharpened();
    // All samples, weighed alike: what happened there is known where little of it is left.
    let beyond = |i: &Investigation| {
        let (whole, best) = (&first.bench.whole, &i.found.best);
        let refitted = refit(whole, best, best.effects.clone());
        refitted.misfit - whole.rows() as f64 + best.effects.len() as f64 * ALARM
    };
    match beyond(&again) < LEFT * beyond(&first) {
        true => again,
        false => first,
    }
}
