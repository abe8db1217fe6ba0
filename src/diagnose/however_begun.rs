//! Records searched however they begin: with virgin joints, with a past, or as the record before left the joint.

use super::coarsely::trials;
use super::first_turns::tells_of_first_turns_alone;
use super::growing::{leaves_structure, noise_alone};
use super::investigation::Investigation;
use super::noise_of_all::NoiseOfAll;
use super::prepare::{Bench, prepare};
use super::search::alone;
use super::searched::{SEARCHING, searched};
use super::taught::left_on_own_cells;
use super::trials::{ALARM, Effort, Trial, one_leaves, penalty};

use crate::identify::beginning::{Beginning, at_zero, beginnings};
use crate::identify::{Fit, Form, Problem, baseline};
use crate::record::Record;
use rayon::prelude::*;

/// Said where the records are searched with another beginning.
const ONCE_MORE: &str =
    "once more: a record may begin in the middle of a test, or its zero may be off";

/// What a search begins from: the baseline, and every cause alone beside it where that is known.
type Known = (Fit, Option<Vec<Trial>>);

/// Records of virgin joints before any search.
pub(super) struct Virgin {
    pub(super) bench: Bench,
    pub(super) first: Fit,
    /// Other beginnings that are worth a search, once they were [sought](Virgin::seek_beginnings).
    pub(super) others: Vec<Vec<Beginning>>,
    /// Every cause alone, where that was asked.
    pub(super) alone: Option<Vec<Trial>>,
}

impl Virgin {
    /// Every cause is asked alone where records that start at zero show structure.
    pub(super) fn of(
        (form, records): (Form, &[Record]),
        timed: bool,
        progress: &mut impl FnMut(&str),
    ) -> Virgin {
        progress("noise and baseline");
        let virgin = vec![Beginning::default(); records.len()];
        let bench = prepare(form, records, &virgin);
        let first = baseline(&bench.train);
        let train = &bench.train;
        let mut inputs = (0..records.len()).map(|k| train.channels(k).0);
        let asked =
            inputs.all(at_zero) && bench.noise_is_repeated() && leaves_structure(train, &first);
        let alone = asked.then(|| {
            progress(SEARCHING);
            alone(&bench, timed, &first)
        });
        Virgin {
            bench,
            first,
            others: Vec::new(),
            alone,
        }
    }

    /// Seeks the other beginnings.
    ///
    /// Who starts at zero has a joint without a past as a rule: where one cause leaves noise alone of such records, and
    /// not of their first turns only, nothing is asked of what they went through before.
    pub(super) fn seek_beginnings(&mut self) {
        let doubted = !self.likeliest_alone().is_some_and(|t| self.does_alone(t));
        self.others = beginnings(&self.bench.train, &self.first, doubted);
    }

    /// Of the causes that were asked alone the one that leaves least.
    pub(super) fn likeliest_alone(&self) -> Option<&Trial> {
        let all = self.alone.iter().flatten();
        let own = all.filter(|t| t.plausible);
        own.min_by(|a, b| a.fit.misfit.total_cmp(&b.fit.misfit))
    }

    /// True where a cause leaves noise alone, and does not tell of first turns only.
    fn does_alone(&self, trial: &Trial) -> bool {
        let leaves = trial.fit.misfit;
        let noise = leaves < noise_alone(&self.bench.train, &self.first);
        noise && !tells_of_first_turns_alone(&self.bench, &trial.fit)
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
            let one = sharply_searched(begun, (plain, None), (timed, enough), progress);
            let sought: usize = one.beginnings().map(Beginning::values).sum();
            let beyond = 2.0 * ALARM + penalty(&one.bench.train, sought);
            let near = one.found.best.misfit + beyond * one.dispersion();
            // A single cause that takes the better part may leave as little on cells that suit it.
            let half = 0.5 * (first.misfit + near);
            let asked = (Effort::Full, half);
            let singles = || match &alone {
                Some(known) => known.clone(),
                None => trials(&bench.train, &bench.scale, timed, &first, asked),
            };
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
    let may_lead = all.is_empty()
        && alone
            .as_ref()
            .is_some_and(|alone| !leaves_noise(&bench.train, &first, alone));
    let explained = match may_lead {
        true => explained_by_one((form, records), timed, &mut others),
        false => None,
    };
    let explains = explained.is_some();
    let led = match past_is_rule && !explains {
        true => {
            let begun = prepare(form, records, &others.remove(0));
            let plain = baseline(&begun.train);
            Some((begun, (plain, None)))
        }
        false => explained,
    };
    if let Some((begun, from)) = led {
        let one = sharply_searched(begun, from, (timed, enough), progress);
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
    if !(gone_on || explains) || all[0].may_be_beaten_by(&bench) {
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

/// True where one of these causes alone leaves noise alone.
fn leaves_noise(train: &Problem, plain: &Fit, alone: &[Trial]) -> bool {
    one_leaves(alone, noise_alone(train, plain))
}

/// The records with the first of the `others` beside which one cause alone leaves noise, their baseline and every cause alone:
/// several causes of a virgin joint, which may, are less likely. A past that was sought may do a cause's work, and is not
/// asked.
fn explained_by_one(
    (form, records): (Form, &[Record]),
    timed: bool,
    others: &mut Vec<Vec<Beginning>>,
) -> Option<(Bench, Known)> {
    let told = |(_, other): &(usize, &Vec<Beginning>)| !other.iter().any(Beginning::is_sought);
    let mut tried = others.iter().enumerate().filter(told).map(|(k, other)| {
        let begun = prepare(form, records, other);
        let plain = baseline(&begun.train);
        let known = alone(&begun, timed, &plain);
        let one = begun.noise_is_repeated() && leaves_noise(&begun.train, &plain, &known);
        (k, one.then_some((begun, (plain, Some(known)))))
    });
    let (k, begun) = tried.find(|(_, begun)| begun.is_some())?;
    others.remove(k);
    begun
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
    sharply_searched(bench, (first, None), asked, progress)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;
    use crate::joint::effect::Acting;
    use crate::record::noise::tests::drawn;
    use std::f64::consts::TAU;

    /// A virgin joint in white noise whose limits follow the force, which reads so much at rest.
    fn pressed(zero: f64) -> Record {
        let level = |i: usize| [0.6, 0.8, 1.0, 0.7][i / 400];
        let mut record = Record {
            name: "pressed".to_string(),
            displacement: vec![0.0; 1600],
            force: (0..1600)
                .map(|i| level(i) * (TAU * i as f64 / 80.0).sin())
                .collect(),
            time: Some((0..1600).map(|i| 0.01 * f64::from(i)).collect()),
            ..Record::default()
        };
        let plain = Problem::new(Form::Play, std::slice::from_ref(&record));
        let mut joint = vec![0.02; plain.operators.columns()];
        joint[0] = 1.0;
        let effect = find("normal_load_variation").unwrap().effect();
        let mut values = vec![0.0; effect.parameters().len()];
        values[0] = 0.4;
        let mut noise = drawn(20261130);
        let answer = &plain.predict(&joint, &[Acting { effect, values }])[0].judged;
        record.displacement = answer.iter().map(|u| u + 0.01 * noise()).collect();
        record.force.iter_mut().for_each(|f| *f += zero);
        record
    }

    /// What one cause leaves noise alone of is asked for no loads before it, which would take a search of their own.
    #[test]
    fn records_from_zero_that_one_cause_explains_are_asked_for_no_past() {
        let records = [pressed(0.0)];
        let mut virgin = Virgin::of((Form::Play, &records), true, &mut |_| {});
        let doubted = beginnings(&virgin.bench.train, &virgin.first, true);
        assert!(!doubted.is_empty());
        virgin.seek_beginnings();
        assert_eq!(virgin.others, Vec::<Vec<Beginning>>::new());
        // Where nothing was asked alone, nothing speaks against a past.
        virgin.alone = None;
        virgin.seek_beginnings();
        assert_eq!(virgin.others, doubted);
    }

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
        assert_eq!(known.unwrap()[0].cause.name(), "normal_load_variation");
        assert_eq!(others, [sought(), wrong()]);
        assert!(explained_by_one((Form::Play, &records), true, &mut others).is_none());
        assert_eq!(others, [sought(), wrong()]);
    }
}
