//! Records searched however they begin: with virgin joints, with a past, or as the record before left the joint.

use super::coarsely::trials;
use super::growing::leaves_structure;
use super::investigation::Investigation;
use super::noise_of_all::NoiseOfAll;
use super::prepare::{Bench, prepare};
use super::searched::searched;
use super::taught::left_on_own_cells;
use super::trials::{ALARM, Effort, Trial, one_leaves, penalty};

use crate::identify::beginning::{Beginning, at_zero, beginnings};
use crate::identify::{Fit, Form, baseline};
use crate::record::Record;
use rayon::prelude::*;

/// Said where the records are searched with another beginning.
const ONCE_MORE: &str =
    "once more: a record may begin in the middle of a test, or its zero may be off";

/// Records of virgin joints before any search.
pub(super) struct Virgin {
    pub(super) bench: Bench,
    pub(super) first: Fit,
    /// Other beginnings that are worth a search.
    pub(super) others: Vec<Vec<Beginning>>,
    /// Every cause alone, where that was asked.
    pub(super) alone: Option<Vec<Trial>>,
}

impl Virgin {
    pub(super) fn of(form: Form, records: &[Record]) -> Virgin {
        let virgin = vec![Beginning::default(); records.len()];
        let bench = prepare(form, records, &virgin);
        let first = baseline(&bench.train);
        Virgin {
            others: beginnings(&bench.train, &first),
            bench,
            first,
            alone: None,
        }
    }
}

/// Searches for causes in records of virgin joints and, where another beginning comes nearer to what a record
/// shows first, in records that begin so; the likelier of both. Every joint was made new for its record.
pub(super) fn made_anew(
    records: &[Record],
    virgin: Virgin,
    (timed, enough): (bool, f64),
    progress: &mut impl FnMut(&str),
) -> Investigation {
    let Virgin {
        bench,
        first,
        mut others,
        alone,
    } = virgin;
    let form = bench.train.operators.form;
    // Who starts a record at zero has a joint without a past as a rule, and who starts elsewhere no virgin one.
    let train = &bench.train;
    let at_zero: Vec<bool> = (0..records.len())
        .map(|k| at_zero(train.channels(k).0))
        .collect();
    let against_rule = |i: &Investigation| {
        let mut both = i.beginnings().zip(&at_zero);
        match i.is_virgin() {
            true => at_zero.contains(&false),
            false if i.goes_on() => false,
            false if i.beginnings().all(|b| b.turned.is_empty()) => false,
            false => both.all(|(b, &at_zero)| b.is_virgin() || at_zero),
        }
    };
    // A joint that is taken for virgin against the rule needs a cause, if only for the first cycle.
    let misled = |i: &Investigation| against_rule(i) && !i.is_plain();
    let leading = |all: &[Investigation]| {
        if all.len() < 2 {
            return 0;
        }
        let common = NoiseOfAll::of(all);
        let unlikely = |i: &Investigation| {
            // Where a past is the rule, a virgin joint and a cause that does its work are two oddities; so is a past
            // where none is the rule, which may do the work of a cause, and a cause that may do the work of a past.
            let plainly_virgin = i.is_virgin() && i.found.best.effects.is_empty();
            let oddities = match (against_rule(i), plainly_virgin) {
                (false, _) if i.is_virgin() && i.tells_of_first_turns_alone() => 2.0,
                (false, _) => 0.0,
                (true, true) => 1.0,
                (true, false) => 2.0,
            };
            i.unlikeliness(common) + oddities * ALARM
        };
        let order = all.iter().map(unlikely).enumerate();
        let least = order.min_by(|(_, a), (_, b)| a.total_cmp(b));
        least.map_or(0, |(i, _)| i)
    };
    // Where a past is the rule and leaves noise alone, nobody asks what a virgin joint would need.
    let past_is_rule = others.first().is_some_and(|o| {
        o.iter().any(|b| b.goes_on) || at_zero.contains(&false) && has_past(o, &at_zero)
    });
    let mut all = Vec::new();
    if !past_is_rule && leaves_structure(&bench.train, &first) && !others.is_empty() {
        // A past that alone leaves noise is asked first, although it is against the rule: several causes of a virgin
        // joint, which may, are less likely.
        let begun = prepare(form, records, &others[0]);
        let plain = baseline(&begun.train);
        if begun.noise_is_repeated() && !leaves_structure(&begun.train, &plain) {
            others.remove(0);
            progress(ONCE_MORE);
            let one = sharply_searched(begun, plain, (timed, enough), progress);
            let sought: usize = one.beginnings().map(Beginning::values).sum();
            let beyond = 2.0 * ALARM + penalty(&one.bench.train, sought);
            let near = one.found.best.misfit + beyond * one.dispersion();
            // A single cause that takes the better part may leave as little on cells that suit it.
            let half = 0.5 * (first.misfit + near);
            let asked = (Effort::Full, half);
            let singles = || trials(&bench.train, &bench.scale, timed, &first, asked);
            let suits = |t: &Trial| {
                t.plausible && t.fit.misfit < half && left_on_own_cells(&bench.train, &t.fit) < near
            };
            let one_does =
                |singles: &[Trial]| one_leaves(singles, near) || singles.par_iter().any(suits);
            if one.is_plain() && !one_does(&singles()) {
                return one;
            }
            all.push(one);
        }
    }
    if past_is_rule {
        let begun = prepare(form, records, &others.remove(0));
        let one = begun_and_searched(begun, (timed, enough), progress);
        if one.is_plain() && !one.bench.noise_may_be_structure() {
            return one;
        }
        progress(ONCE_MORE);
        let other = one.other_past();
        let asked = (timed, enough.min(one.enough()));
        all.push(one);
        if let Some(other) = other {
            let bench = prepare(form, records, &other);
            all.push(begun_and_searched(bench, asked, progress));
        }
    }
    let gone_on = all.first().is_some_and(Investigation::goes_on);
    if !gone_on || all[0].may_be_beaten_by(&bench) {
        let enough = least_enough(&all).min(enough);
        all.push(searched(bench, (first, alone), (timed, enough), progress));
    }
    for other in others {
        let bench = prepare(form, records, &other);
        let so_far = &all[leading(&all)];
        // A past of some records against the rule may do the work of a cause in all of them.
        let by_rule = || bench.train.wears_on && against_rule(so_far);
        if misled(so_far) || by_rule() || so_far.may_be_beaten_by(&bench) {
            progress(ONCE_MORE);
            let enough = least_enough(&all).min(enough);
            all.push(begun_and_searched(bench, (timed, enough), progress));
        }
    }
    let likeliest = leading(&all);
    all.swap_remove(likeliest)
}

/// True where every record whose first reading is not zero has turns before it.
fn has_past(beginnings: &[Beginning], at_zero: &[bool]) -> bool {
    let mut both = beginnings.iter().zip(at_zero);
    both.all(|(begins, at_zero)| *at_zero || !begins.turned.is_empty())
}

/// What is found in records that do not begin with a virgin joint.
fn begun_and_searched(
    bench: Bench,
    asked: (bool, f64),
    progress: &mut impl FnMut(&str),
) -> Investigation {
    let first = baseline(&bench.train);
    sharply_searched(bench, first, asked, progress)
}

/// What is found from a baseline, with the turns before the records as that suits them; once more where it leaves
/// little enough only when they are known better.
pub(super) fn sharply_searched(
    bench: Bench,
    first: Fit,
    (timed, enough): (bool, f64),
    progress: &mut impl FnMut(&str),
) -> Investigation {
    let one = searched(bench, (first, None), (timed, enough), progress).sharpened();
    match one.found.unasked && one.left() < enough {
        true => {
            let Investigation { bench, found } = one;
            let asked = (timed, f64::INFINITY);
            searched(bench, (found.baseline, None), asked, progress).sharpened()
        }
        false => one,
    }
}

/// The least of what is enough for others beside each of these.
fn least_enough(all: &[Investigation]) -> f64 {
    all.iter()
        .map(Investigation::enough)
        .fold(f64::INFINITY, f64::min)
}
