//! Records searched however they wear the joint: each one that was made new for it, or one joint through all.

use super::coarsely::{trials_again, trials_of};
use super::driven::leaves_less;
use super::growing::{FURTHER_SHARE, leaves_structure, noise_alone};
use super::however_begun::{made_anew, sharply_searched};
use super::investigation::Investigation;
use super::prepare::Bench;
use super::search::{Begun, Found, alone};
use super::searched::{SEARCHING, searched};
use super::trials::{ALARM, Effort, Trial, dispersion, one_leaves, trial_of};
use super::virgin::Virgin;
use crate::causes::Cause;
use crate::identify::{Problem, suited};
use crate::record::Record;

/// Said where wear of one record is taken to the next.
const WORN_ON: &str = "once more: wear may go on from record to record";

/// Share of what one cause takes away that leaves noise alone from which another that wears on may be its rival: a search
/// from there may find the rest.
const RIVAL: f64 = 0.8;

/// Searches for causes in records however they begin, and once more where wear may go on from one to the next.
///
/// What leaves more than `enough` of every row, as a square of the judged channel, is not asked further.
pub(super) fn however_worn(
    (records, mut virgin): (&[Record], Virgin),
    (timed, enough): (bool, f64),
    progress: &mut impl FnMut(&str),
) -> Investigation {
    virgin.seek_beginnings();
    if let Some(on) = worn_by_one_cause(&mut virgin, (timed, enough), progress) {
        return on;
    }
    let anew = made_anew(records, virgin, (timed, enough), progress);
    if !anew.may_wear_on(timed) {
        return anew;
    }
    progress(WORN_ON);
    let mut bench = anew.bench.clone();
    bench.wear_on();
    // Where nothing else tells the noise any set may.
    bench.wearing_sets = bench.noise_is_repeated();
    let known = bench
        .wearing_sets
        .then(|| anew.alone_worn_on(&bench, timed));
    let first = (anew.found.baseline.clone(), Begun::knowing(known));
    let enough = enough.min(anew.enough());
    let mut on = sharply_searched(bench, first, (timed, enough), progress);
    on.bench.wearing_sets = false;
    anew.or_likelier(on)
}

/// True of a cause that wears the joint, and of records it can be told by.
fn wears(cause: &dyn Cause, timed: bool) -> bool {
    cause.effect().wears() && cause.is_told(timed)
}

/// What is found in records of virgin joints where wear goes on from one to the next, if one cause that wears leaves
/// noise alone and none does that is asked of joints made anew: several, which may, are less likely.
fn worn_by_one_cause(
    virgin: &mut Virgin,
    (timed, enough): (bool, f64),
    progress: &mut impl FnMut(&str),
) -> Option<Investigation> {
    let Virgin {
        bench,
        first,
        others,
        alone: known,
    } = virgin;
    let asked = bench.train.records.len() > 1
        && others.is_empty()
        && bench.noise_is_repeated()
        && leaves_structure(&bench.train, first);
    if !asked {
        return None;
    }
    let anew = known.get_or_insert_with(|| {
        progress(SEARCHING);
        alone(bench, timed, first)
    });
    let noise_alone = noise_alone(&bench.train, first);
    let mut on = bench.clone();
    on.wear_on();
    let quick = (Effort::Quick, noise_alone);
    let wears = |cause: &dyn Cause| wears(cause, timed);
    let worn = || trials_of(wears, &on.train, &on.scale, first, quick);
    if one_leaves(anew, noise_alone) || !one_leaves(&worn(), noise_alone) {
        return None;
    }
    progress(WORN_ON);
    let on = searched(
        on,
        (first.clone(), Begun::default()),
        (timed, enough),
        progress,
    );
    let best = &on.found.best;
    let one = best.effects.len() == 1 && !leaves_structure(&on.bench.train, best);
    let near = best.misfit + ALARM * on.dispersion();
    (one && !one_leaves(anew, near)).then_some(on)
}

impl Investigation {
    /// True where wear that goes on from record to record explains what wear of joints made new between them does not, alone
    /// or by the causes that were found; where those leave structure, beside them or in the place of one.
    ///
    /// Beside one cause that leaves noise it has to do a good part of what that does: any cause may do somewhat more of it
    /// where it goes on.
    fn may_wear_on(&self, timed: bool) -> bool {
        let train = &self.bench.train;
        let best = &self.found.best;
        if train.records.len() < 2 || train.wears_on {
            return false;
        }
        let worn = best.effects.iter().any(|a| a.effect.wears());
        let mut on = train.clone();
        on.wears_on = true;
        let margin = ALARM * dispersion(train, best);
        let wanted = best.misfit - margin;
        if worn && leaves_less(&on, best, wanted) {
            return true;
        }
        let Found { baseline, .. } = &self.found;
        let beyond = baseline.misfit - train.rows() as f64;
        let least = margin.max(FURTHER_SHARE * beyond);
        let structure = leaves_structure(train, best);
        let nearly = match best.effects.len() == 1 && !structure {
            true => baseline.misfit - RIVAL * (baseline.misfit - best.misfit),
            false => f64::INFINITY,
        };
        let done_by_wear = worn && !structure;
        let enough = if done_by_wear {
            nearly.max(wanted)
        } else {
            wanted
        };
        let tried = (Effort::Full, enough);
        let wearing = |cause: &dyn Cause| wears(cause, timed);
        let trials = trials_of(wearing, &on, &self.bench.scale, baseline, tried);
        let does_more_than_anew = |on: &Trial| {
            let anew = trial_of(&self.found.trials, on.cause.name());
            let more = anew.map_or(baseline.misfit, |t| t.fit.misfit) - least;
            on.fit.misfit < more.min(nearly)
        };
        let does_more =
            |on: &Trial| on.fit.misfit < wanted || done_by_wear && does_more_than_anew(on);
        trials.iter().any(does_more) || structure && self.is_mended_by(wearing, &on)
    }

    /// True where one of the causes beside the set, or in the place of one of several, takes a share of what it leaves.
    fn is_mended_by(&self, causes: impl Fn(&dyn Cause) -> bool, on: &Problem) -> bool {
        let best = &self.found.best;
        let beyond = best.misfit - on.rows() as f64;
        let enough = best.misfit - FURTHER_SHARE * beyond;
        let fewer = (0..best.effects.len()).map(|place| best.others(place));
        let several = best.effects.len() > 1;
        let mut sets = fewer.filter(|_| several).chain([best.effects.clone()]);
        sets.any(|set| {
            let begun = suited(on, best, set);
            let tried = (Effort::Full, enough);
            one_leaves(
                &trials_of(&causes, on, &self.bench.scale, &begun, tried),
                enough,
            )
        })
    }

    /// Every cause alone where wear goes on: those that do not wear the joint as they were found of joints made anew.
    fn alone_worn_on(&self, on: &Bench, timed: bool) -> Vec<Trial> {
        let Found {
            baseline, trials, ..
        } = &self.found;
        let wearing = |cause: &dyn Cause| wears(cause, timed);
        let others = trials.iter().filter(|t| !wearing(t.cause));
        let others: Vec<Trial> = others.cloned().collect();
        let cells = (others.as_slice(), &self.bench.train.operators);
        let (problem, asked) = ((&on.train, &on.scale), (Effort::Full, f64::INFINITY));
        let (mut all, worn) = rayon::join(
            || trials_again(cells, problem, baseline, asked),
            || trials_of(wearing, &on.train, &on.scale, baseline, asked),
        );
        all.extend(worn);
        all.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;
    use crate::diagnose::prepare::prepare;
    use crate::identify::beginning::Beginning;
    use crate::identify::refit;
    use crate::identify::{Fit, Form, baseline};
    use crate::joint::effect::Acting;
    use crate::record::noise::tests::drawn;
    use std::f64::consts::TAU;

    /// A reading that comes late by so much \[s\].
    fn delay(late: f64) -> Acting {
        Acting {
            effect: find("sensor_delay").unwrap().effect(),
            values: vec![late, 0.0, 0.0],
        }
    }

    /// Two tests of joints whose friction settles with the energy they dissipate, made new between them or going on, in
    /// noise of the displacement, whose reading comes late by so much \[s\] and has a seventh of the load's cycle in it, of
    /// this size.
    fn settling(goes_on: bool, (late, seventh): (f64, f64)) -> (Bench, Vec<Acting>) {
        let test = |levels: [f64; 4]| {
            let load = |i: usize| levels[i / 400] * (TAU * i as f64 / 80.0).sin();
            Record {
                name: format!("to {}", levels[3]),
                displacement: vec![0.0; 1600],
                force: (0..1600).map(load).collect(),
                time: Some((0..1600).map(|i| 0.01 * f64::from(i)).collect()),
                ..Record::default()
            }
        };
        let mut records = [test([0.5, 0.7, 0.9, 1.0]), test([1.0, 0.6, 0.8, 0.9])];
        let mut plain = Problem::new(Form::Play, &records);
        plain.wears_on = goes_on;
        let mut joint = vec![0.02; plain.operators.columns()];
        joint[0] = 1.0;
        let acting = vec![Acting {
            effect: find("running_in").unwrap().effect(),
            values: vec![0.2, 2.0, 0.0, 0.0, 0.0],
        }];
        let mut noise = drawn(20261128);
        let both = [acting.clone(), vec![delay(late)]].concat();
        let answers = plain.predict(&joint, &both);
        for (record, answer) in records.iter_mut().zip(answers) {
            let read = |(i, u): (usize, &f64)| {
                u + seventh * (7.0 * TAU * i as f64 / 80.0).sin() + 0.01 * noise()
            };
            record.displacement = answer.judged.iter().enumerate().map(read).collect();
        }
        let virgin = [Beginning::default(), Beginning::default()];
        (prepare(Form::Play, &records, &virgin), acting)
    }

    /// Where one cause leaves noise, others that do somewhat more of its work where wear goes on are not searched for.
    #[test]
    fn wear_that_goes_on_has_to_rival_one_cause_that_leaves_noise() {
        let (bench, acting) = settling(false, (0.0, 0.0));
        let first = baseline(&bench.train);
        let best = refit(&bench.train, &first, acting);
        assert!(!leaves_structure(&bench.train, &best));
        let beyond = first.misfit - best.misfit;
        let mut on = bench.train.clone();
        on.wears_on = true;
        let wearing = |cause: &dyn Cause| cause.effect().wears();
        let asked = (Effort::Full, f64::INFINITY);
        let others = trials_of(wearing, &on, &bench.scale, &first, asked);
        let taken = others
            .iter()
            .map(|t| (first.misfit - t.fit.misfit) / beyond);
        let most = taken.fold(0.0, f64::max);
        assert!(most > 2.0 * FURTHER_SHARE && most < 0.8 * RIVAL, "{most}");
        let found = |best: Fit| Investigation {
            bench: bench.clone(),
            found: Found::unasked(first.clone(), best, Vec::new()),
        };
        assert!(!found(best).may_wear_on(true));
        // Beside nothing that explains the records they are.
        assert!(found(first.clone()).may_wear_on(true));
    }

    /// What a load's seventh leaves no wear takes, whether it goes on or not; friction that settles through both tests does,
    /// beside a reading that comes late.
    #[test]
    fn of_what_is_left_wear_that_goes_on_has_to_take_a_share() {
        let investigation = |(bench, effects): (Bench, Vec<Acting>)| {
            let first = baseline(&bench.train);
            let best = refit(&bench.train, &first, effects);
            assert!(leaves_structure(&bench.train, &best));
            Investigation {
                found: Found::unasked(first, best, Vec::new()),
                bench,
            }
        };
        let anew = settling(false, (0.0, 0.05));
        assert!(!investigation(anew).may_wear_on(true));
        let (bench, _) = settling(true, (0.03, 0.0));
        assert!(investigation((bench, vec![delay(0.02)])).may_wear_on(true));
    }
}
