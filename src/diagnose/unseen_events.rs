//! Records in which something happens within the samples set aside: those are given to the fit, others set aside, and
//! the records searched again.

use super::driven::however_driven;
use super::investigation::Investigation;
use super::places::scatter;
use super::prepare::Bench;
use super::search::Begun;
use super::searched::searched;
use super::tested::each_unseen;
use super::trials::ALARM;
use crate::identify::{Fit, Form, baseline, refit};
use crate::record::Record;
use crate::record::split::Fitted;

/// Share of the noise's variance, and times what fitted samples leave, that samples set aside leave beyond noise where
/// something happened that the fit has not seen.
const NEWS: f64 = 0.5;
const TIMES: f64 = 3.0;

/// Share of the misfit beyond noise that causes found with the end may leave: a cause that only mends what is not in the
/// catalogue leaves more.
const LEFT: f64 = 0.25;

/// Times as much that a set which has grown may leave, before its causes are exchanged for better ones, and still be
/// asked further. Judged.
const EXCHANGED: f64 = 2.0;

/// Where samples that were set aside show what no fitted sample did, at the end of the records and before it: what
/// happened there has not been looked for, or not been placed.
fn news(bench: &Bench, fit: &Fit) -> Fitted {
    let predictions = fit.predict(&bench.train);
    let from = |held: &[bool]| held.iter().rposition(|h| !h).map_or(0, |last| last + 1);
    let ends: Vec<usize> = bench.held.iter().map(|held| from(held)).collect();
    // Beyond noise, and rows: before the end and at it.
    let mut sums = [(0.0, 0.0); 2];
    each_unseen(bench, |k, i, measured, weight| {
        let (error, variance) = (
            measured - predictions[k].judged[i],
            bench.noise[k].deviation.powi(2),
        );
        let sum = &mut sums[usize::from(i >= ends[k])];
        sum.0 += weight * (error.powi(2) - variance);
        sum.1 += weight * variance;
    });
    let fitted = fit.misfit / bench.train.rows().max(1) as f64 - 1.0;
    let [middle, end] =
        sums.map(|(beyond, rows)| beyond - scatter(rows) > NEWS.max(TIMES * fitted) * rows);
    Fitted { end, middle }
}

/// Searches for causes in records however they begin; once more where they end with what no fitted sample showed, or
/// where something that all samples together tell happened within those set aside.
pub fn investigated(
    records: (Form, &[Record]),
    timed: bool,
    progress: &mut impl FnMut(&str),
) -> Investigation {
    let first = however_driven(records, timed, progress);
    let first = first.behind_unknown_pasts(timed, progress);
    let news = news(&first.bench, &first.found.best);
    if !news.end && !news.middle {
        return first;
    }
    let before = first.left_of_all(&first.bench);
    // The noise's own variance is known to its scatter, too.
    let rows = first.bench.whole.rows() as f64;
    let noise = (first.bench.most_left()).map_or(0.0, |most| (most - 1.0) * rows);
    let told_by_all = !first.found.best.effects.is_empty() && before < scatter(rows).max(noise);
    if !news.end && !told_by_all {
        return first;
    }
    progress("once more: samples that were set aside show what no sample of the fit has shown");
    let mut bench = first.bench.clone();
    bench.fit_also(news);
    let plain = baseline(&bench.train);
    // Every cause counts for what one must bring.
    let counted = |i: &Investigation, left: f64| left + i.found.best.effects.len() as f64 * ALARM;
    let wanted = LEFT * counted(&first, before);
    // Refitted to all samples a set leaves no less of those it was fitted to.
    let beyond = EXCHANGED * wanted / bench.train.rows().max(1) as f64;
    let enough = match told_by_all {
        true => f64::INFINITY,
        false => bench.innovation_square() * (1.0 + beyond),
    };
    // What was tried before had not seen what happened.
    let begun = Begun::from_several(&first.found.best.effects);
    let again = searched(bench, (plain, begun), (timed, enough), progress);
    if again.found.unasked {
        return first;
    }
    let again = again.sharpened();
    let after = again.left_of_all(&first.bench);
    let explains = counted(&again, after) < wanted;
    // The same causes with what happened in sight: their gain is measured where nothing does.
    let places = told_by_all && again.names() == first.names();
    match explains || places {
        true => again,
        false => first,
    }
}

impl Investigation {
    /// What the causes leave of all samples beyond noise, refitted to them, weighed alike: what happened in a few cycles is
    /// known where little of it is left.
    fn left_of_all(&self, weighed: &Bench) -> f64 {
        let (whole, best) = (&weighed.whole, &self.found.best);
        refit(whole, best, best.effects.clone()).misfit - whole.rows() as f64
    }

    /// Names of its causes, in an order of their own.
    fn names(&self) -> Vec<&'static str> {
        let effects = self.found.best.effects.iter();
        let mut names: Vec<&str> = effects.map(|a| a.effect.name()).collect();
        names.sort_unstable();
        names
    }
}
