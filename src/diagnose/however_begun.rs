//! Records searched however they begin: with virgin joints, with a past, or as the record before left the joint.

use super::growing::leaves_structure;
use super::investigation::Investigation;
use super::prepare::{Bench, prepare};
use super::rule::Rule;
use super::search::{Begun, alone};
use super::searched::searched;
use super::virgin::{Virgin, leaves_noise};
use crate::identify::beginning::Beginning;
use crate::identify::{Fit, Form, baseline};
use crate::record::Record;

/// Said where the records are searched with another beginning.
const ONCE_MORE: &str =
    "once more: a record may begin in the middle of a test, or its zero may be off";

/// What a search begins from: the baseline, and what is known beside it.
type Known = (Fit, Begun);

/// Searches for causes in records of virgin joints and, where another beginning comes nearer to what a record
/// shows first, in records that begin so; the likelier of both. Every joint was made new for its record.
pub(super) fn made_anew(
    records: &[Record],
    mut virgin: Virgin,
    (timed, enough): (bool, f64),
    progress: &mut impl FnMut(&str),
) -> Investigation {
    let form = virgin.bench.train.operators.form;
    let rule = Rule::of(&virgin.bench.train);
    let mut others = std::mem::take(&mut virgin.others);
    let past_is_rule = others.first().is_some_and(|o| rule.asks_for(o));
    let mut all = Vec::new();
    // A past that alone leaves noise is asked first, although it is against the rule: several causes of a virgin
    // joint, which may, are less likely.
    let led_by_past = !past_is_rule && leaves_structure(&virgin.bench.train, &virgin.first);
    if led_by_past && let Some((begun, from)) = past_alone((form, records), &mut others) {
        progress(ONCE_MORE);
        let one = sharply_searched(begun, from, (timed, enough), progress);
        if one.is_plain() && !virgin.one_cause_does(&one, timed) {
            return one;
        }
        all.push(one);
    }
    let explained = match all.is_empty() && virgin.no_cause_explains() {
        true => explained_by_one((form, records), timed, &mut others),
        false => None,
    };
    let explains = explained.is_some();
    // Where a past is the rule and leaves noise alone, nobody asks what a virgin joint would need.
    let led = match past_is_rule && !explains {
        true => Some(begun_with((form, records), &others.remove(0))),
        false => explained,
    };
    if let Some((begun, from)) = led {
        let one = sharply_searched(begun, from, (timed, enough), progress);
        if one.is_plain() && !one.bench.noise_may_be_structure() {
            return one;
        }
        progress(ONCE_MORE);
        let past = one.other_past();
        let asked = (timed, enough.min(one.enough()));
        all.push(one);
        if let Some(past) = past {
            let (bench, from) = begun_with((form, records), &past);
            all.push(sharply_searched(bench, from, asked, progress));
        }
    }
    let gone_on = all.first().is_some_and(Investigation::goes_on);
    if !(gone_on || explains) || all[0].may_be_beaten_by(&virgin.bench) {
        let asked = (timed, least_enough(&all).min(enough));
        let from = (virgin.first, Begun::knowing(virgin.alone));
        all.push(searched(virgin.bench, from, asked, progress));
    }
    for other in others {
        let bench = prepare(form, records, &other);
        if rule.asks_another(&all[rule.likeliest(&all)], &bench) {
            progress(ONCE_MORE);
            let asked = (timed, least_enough(&all).min(enough));
            let from = (baseline(&bench.train), Begun::default());
            all.push(sharply_searched(bench, from, asked, progress));
        }
    }
    let likeliest = rule.likeliest(&all);
    all.swap_remove(likeliest)
}

/// The records with a beginning, and their baseline.
fn begun_with((form, records): (Form, &[Record]), beginnings: &[Beginning]) -> (Bench, Known) {
    let begun = prepare(form, records, beginnings);
    let plain = baseline(&begun.train);
    (begun, (plain, Begun::default()))
}

/// The records with the first of the `others`, taken from these, where it alone leaves noise.
fn past_alone(
    records: (Form, &[Record]),
    others: &mut Vec<Vec<Beginning>>,
) -> Option<(Bench, Known)> {
    let (begun, (plain, known)) = begun_with(records, others.first()?);
    if !begun.noise_is_repeated() || leaves_structure(&begun.train, &plain) {
        return None;
    }
    others.remove(0);
    Some((begun, (plain, known)))
}

/// The records with the first of the `others` beside which one cause alone leaves noise, their baseline and every cause alone:
/// several causes of a virgin joint, which may, are less likely. A past that was sought may do a cause's work, and is not
/// asked.
fn explained_by_one(
    records: (Form, &[Record]),
    timed: bool,
    others: &mut Vec<Vec<Beginning>>,
) -> Option<(Bench, Known)> {
    let told = |(_, other): &(usize, &Vec<Beginning>)| !other.iter().any(Beginning::is_sought);
    let mut tried = others.iter().enumerate().filter(told).map(|(k, other)| {
        let (begun, (plain, _)) = begun_with(records, other);
        let known = alone(&begun, timed, &plain);
        let one = begun.noise_is_repeated() && leaves_noise(&begun.train, &plain, &known);
        (
            k,
            one.then_some((begun, (plain, Begun::knowing(Some(known))))),
        )
    });
    let (k, begun) = tried.find(|(_, begun)| begun.is_some())?;
    others.remove(k);
    begun
}

/// What is found from a baseline, with the turns before the records as that suits them; once more where it leaves
/// little enough only when they are known better.
pub(super) fn sharply_searched(
    bench: Bench,
    from: Known,
    (timed, enough): (bool, f64),
    progress: &mut impl FnMut(&str),
) -> Investigation {
    let one = searched(bench, from, (timed, enough), progress).sharpened();
    match one.found.unasked && one.left() < enough {
        true => {
            let Investigation { bench, found } = one;
            let asked = (timed, f64::INFINITY);
            searched(bench, (found.baseline, Begun::default()), asked, progress).sharpened()
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::virgin::tests::pressed;

    /// Of several beginnings that one is searched first beside which one cause leaves noise, and none where none does; a past
    /// that was sought is none of them.
    #[test]
    fn the_beginning_that_one_cause_explains_leads() {
        let records = [pressed(0.15)];
        let sought = || {
            vec![Beginning {
                turned: vec![-0.01],
                ..Beginning::at(0.15)
            }]
        };
        let wrong = || vec![Beginning::at(0.3)];
        let mut others = vec![sought(), wrong(), vec![Beginning::at(0.15)]];
        let (bench, (_, known)) =
            explained_by_one((Form::Play, &records), true, &mut others).unwrap();
        assert_eq!(bench.train.records[0].beginning, Beginning::at(0.15));
        assert_eq!(
            known.alone.unwrap()[0].cause.name(),
            "normal_load_variation"
        );
        assert_eq!(others, [sought(), wrong()]);
        assert!(explained_by_one((Form::Play, &records), true, &mut others).is_none());
        assert_eq!(others, [sought(), wrong()]);
    }
}
