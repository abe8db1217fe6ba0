//! Noise, baseline and the search for causes; once more where records may not begin with a virgin joint, or with a
//! worn one.

use super::growing::{FURTHER_SHARE, leaves_structure};
use super::prepare::{Bench, form, prepare};
use super::search::{Found, quick, search};
use super::trials::{ALARM, Effort, dispersion, implausible, trials_of};
use crate::causes::Cause;
use crate::identify::beginning::{Beginning, at_zero, beginnings, past, sharpened};
use crate::identify::{Fit, Problem, baseline, refit, without};
use crate::joint::effect::Acting;
use crate::record::Record;

/// Share of what a cause brought that other turns before the records may leave.
const HALF: f64 = 0.5;

/// Times that turns and joint are fitted to each other in turn.
const ROUNDS: usize = 3;

/// Records, and what was found in them.
pub struct Investigation {
    /// The records, with how each of them begins.
    pub bench: Bench,
    /// What the search found.
    pub found: Found,
}

/// Said where the records are searched with another beginning.
const ONCE_MORE: &str =
    "once more: a record may begin in the middle of a test, or its zero may be off";

/// Searches for causes in records however they begin, and once more where wear may go on from one to the next.
pub(super) fn however_worn(
    records: &[Record],
    timed: bool,
    progress: &mut impl FnMut(&str),
) -> Investigation {
    let anew = made_anew(records, timed, progress);
    if !anew.may_wear_on() {
        return anew;
    }
    progress("once more: wear may go on from record to record");
    let mut bench = anew.bench.clone();
    bench.wear_on();
    let on = searched(bench, anew.found.baseline.clone(), timed, progress).sharpened();
    anew.or_likelier(on)
}

/// Searches for causes in records of virgin joints and, where another beginning comes nearer to what a record
/// shows first, in records that begin so; the likelier of both. Every joint was made new for its record.
fn made_anew(records: &[Record], timed: bool, progress: &mut impl FnMut(&str)) -> Investigation {
    progress("noise and baseline");
    let virgin = vec![Beginning::default(); records.len()];
    let form = form(records);
    let bench = prepare(form, records, &virgin);
    let first = baseline(&bench.train);
    let mut others = beginnings(&bench.train, &first);
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
        let scale = all
            .iter()
            .map(Investigation::dispersion)
            .fold(f64::INFINITY, f64::min);
        let unlikely = |i: &Investigation| {
            // Where a past is the rule, a virgin joint and a cause that does its work are two oddities; so is a past
            // where none is the rule, which may do the work of a cause.
            let plainly_virgin = i.is_virgin() && i.found.best.effects.is_empty();
            let oddities = match (against_rule(i), plainly_virgin) {
                (false, _) => 0.0,
                (true, true) => 1.0,
                (true, false) => 2.0,
            };
            i.unlikeliness(scale) + oddities * ALARM
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
    if past_is_rule {
        let begun = prepare(form, records, &others.remove(0));
        let one = begun_and_searched(begun, timed, progress);
        if one.is_plain() && !one.bench.noise_may_be_structure() {
            return one;
        }
        progress(ONCE_MORE);
        let other = one.other_past();
        all.push(one);
        if let Some(other) = other {
            let bench = prepare(form, records, &other);
            all.push(begun_and_searched(bench, timed, progress));
        }
    }
    let gone_on = all.first().is_some_and(Investigation::goes_on);
    if !gone_on || all[0].may_be_beaten_by(&bench) {
        all.push(searched(bench, first, timed, progress));
    }
    for other in others {
        let bench = prepare(form, records, &other);
        let so_far = &all[leading(&all)];
        // A past of some records against the rule may do the work of a cause in all of them.
        let by_rule = || bench.train.wears_on && against_rule(so_far);
        if misled(so_far) || by_rule() || so_far.may_be_beaten_by(&bench) {
            progress(ONCE_MORE);
            all.push(begun_and_searched(bench, timed, progress));
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
fn begun_and_searched(bench: Bench, timed: bool, progress: &mut impl FnMut(&str)) -> Investigation {
    let first = baseline(&bench.train);
    searched(bench, first, timed, progress).sharpened()
}

/// What a model leaves of record `k` with a beginning.
fn left(train: &Problem, fit: &Fit, (k, beginning): (usize, &Beginning)) -> f64 {
    // A worn joint is worn by what came before.
    let before = if train.wears_on { 0 } else { k };
    let mut one = Problem {
        operators: train.operators.clone(),
        records: train.records[before..=k].to_vec(),
        ..*train
    };
    one.records[k - before].beginning.clone_from(beginning);
    one.misfit(&one.predict(&fit.coefficients, &fit.acting())).0
}

/// What is found from the baseline of the records as they are weighed.
pub(super) fn searched(
    mut bench: Bench,
    mut first: Fit,
    timed: bool,
    progress: &mut impl FnMut(&str),
) -> Investigation {
    if !bench.noise_is_repeated() {
        progress("what is noise: a quick search, because too few cycles repeat");
        for _ in 0..2 {
            bench.weigh_what_is_left(&quick(&bench, timed, &first));
            first = baseline(&bench.train);
        }
    }
    progress("searching the catalogue for causes");
    let found = search(&mut bench, timed, first);
    bench.weigh_what_is_left(&found.best);
    Investigation { bench, found }
}

impl Investigation {
    fn beginnings(&self) -> impl Iterator<Item = &Beginning> {
        self.bench.train.records.iter().map(|r| &r.beginning)
    }

    /// True where the baseline leaves noise alone.
    fn is_plain(&self) -> bool {
        let Found { best, .. } = &self.found;
        best.effects.is_empty() && !leaves_structure(&self.bench.train, best)
    }

    /// χ² per degree of freedom of what was found, at least one.
    pub(super) fn dispersion(&self) -> f64 {
        dispersion(&self.bench.train, &self.found.best)
    }

    /// True where the joint goes on from record to record.
    fn goes_on(&self) -> bool {
        self.beginnings().any(|b| b.goes_on)
    }

    fn is_virgin(&self) -> bool {
        self.beginnings().all(Beginning::is_virgin)
    }

    /// True where other beginnings leave less beside the causes that were found, or no more beside fewer, until
    /// the first turns are known better on samples that do not hang on them.
    fn may_be_beaten_by(&self, other: &Bench) -> bool {
        let sought = |train: &Problem| -> usize {
            let records = train.records.iter();
            records.map(|r| r.beginning.values()).sum()
        };
        let weighed = |bench: &Bench| {
            let mut bench = bench.clone();
            bench.unsure.clone_from(&other.unsure);
            bench.weigh(self.bench.noise.clone());
            bench.train
        };
        let (train, other) = (weighed(&self.bench), weighed(other));
        let best = &self.found.best;
        let (reached, _) = train.misfit(&best.predict(&train));
        let rows = train.rows().max(1) as f64;
        let margin = ALARM * (reached / rows).max(1.0);
        // What the right beginning explains leaves little; any freedom takes a little of what no cause explains.
        let taken = margin.max(FURTHER_SHARE * (reached - rows));
        let plain = baseline(&other);
        let beside = |effects: Vec<Acting>| refit(&other, &plain, effects).misfit;
        let fewer = |drop: usize| {
            let mut effects = best.effects.clone();
            effects.remove(drop);
            beside(effects) < reached + margin
        };
        // One of several causes may do what the beginning is wrong by, or one cause another's work; so may turns that
        // were sought, beside one cause with more values than the right one has, or in the place of a second.
        let sought = !best.effects.is_empty() && sought(&train) > sought(&other);
        let structure = leaves_structure(&train, best);
        if sought && structure {
            return true;
        }
        let several = best.effects.len() > 1 || sought;
        let wanted = if several {
            reached + margin
        } else {
            reached - taken
        };
        let one_alone = || {
            let asked = |cause: &dyn Cause| {
                let mut names = self.found.trials.iter().map(|t| t.cause.name());
                names.any(|name| name == cause.name())
            };
            let scale = &self.bench.scale;
            let tried = trials_of(asked, &other, scale, &plain, (Effort::Full, wanted));
            tried.iter().any(|t| t.fit.misfit < wanted)
        };
        plain.misfit < reached + margin
            || beside(best.effects.clone()) < reached - taken
            || best.effects.len() > 1 && (0..best.effects.len()).any(fewer)
            || (several || structure) && one_alone()
    }

    /// True where wear that goes on from record to record explains what wear of joints made new between them does
    /// not, beside the causes that were found or alone.
    fn may_wear_on(&self) -> bool {
        let train = &self.bench.train;
        let best = &self.found.best;
        let lasts = |a: &Acting| a.effect.lasting() > 0;
        let wears = best.effects.iter().any(lasts);
        let asked = train.records.len() > 1 && !train.wears_on;
        if !asked || !(wears || leaves_structure(train, best)) {
            return false;
        }
        let mut on = train.clone();
        on.wears_on = true;
        let margin = ALARM * dispersion(train, best);
        if wears && refit(&on, best, best.effects.clone()).misfit < best.misfit - margin {
            return true;
        }
        let wearing = |cause: &dyn Cause| cause.effect().lasting() > 0;
        let baseline = &self.found.baseline;
        let scale = &self.bench.scale;
        let tried = (Effort::Full, f64::INFINITY);
        let trials = trials_of(wearing, &on, scale, baseline, tried);
        trials.iter().any(|on| {
            let mut anew = self.found.trials.iter();
            let anew = anew.find(|t| t.cause.name() == on.cause.name());
            let anew = anew.map_or(baseline.misfit, |t| t.fit.misfit);
            let beyond = baseline.misfit - train.rows() as f64;
            on.fit.misfit < anew - margin.max(FURTHER_SHARE * beyond)
        })
    }

    /// The same with first samples as witnesses again, the turns before them where they ask for those beside what
    /// was found, and everything refitted to both.
    pub(super) fn sharpened(mut self) -> Investigation {
        if self.is_virgin() {
            return self;
        }
        self.bench.unsure.fill(0);
        self.bench.weigh(self.bench.noise.clone());
        self.settle();
        // Turns that were sought with fewer samples may have left a cause only what they were wrong by.
        while let Some(place) = implausible(&self.bench.scale, &self.found.best) {
            self.found.best = without(&self.bench.train, &self.found.best, place);
            self.settle();
        }
        self.found.baseline = baseline(&self.bench.train);
        if self.found.best.effects.is_empty() {
            self.found.best = self.found.baseline.clone();
        }
        self.bench.weigh_what_is_left(&self.found.best);
        self
    }

    /// Turns and joint fitted to each other.
    fn settle(&mut self) {
        for _ in 0..ROUNDS {
            for k in 0..self.bench.train.records.len() {
                self.sharpen(k);
            }
            let best = &self.found.best;
            self.found.best = refit(&self.bench.train, best, best.effects.clone());
        }
    }

    fn sharpen(&mut self, k: usize) {
        let (train, fit) = (&self.bench.train, &self.found.best);
        let begun = train.records[k].beginning.clone();
        if !begun.is_sought() {
            return;
        }
        let (_, sharp) = sharpened(begun, |beginning| left(train, fit, (k, beginning)));
        for problem in [&mut self.bench.train, &mut self.bench.whole] {
            problem.records[k].beginning.clone_from(&sharp);
        }
    }

    /// Beginnings that suit a set with one cause less, where they do most of what it brought: turns before the
    /// records were found before any cause was, and one cause of several may do what they are wrong by.
    fn other_past(&self) -> Option<Vec<Beginning>> {
        let best = &self.found.best;
        if best.effects.len() < 2 || !self.beginnings().any(Beginning::is_sought) {
            return None;
        }
        let fewer = (0..best.effects.len()).filter_map(|drop| {
            let less = without(&self.bench.train, best, drop);
            let mut train = self.bench.train.clone();
            let mut fit = refit(&train, &less, less.effects.clone());
            let brought = fit.misfit - best.misfit;
            for _ in 0..ROUNDS {
                for k in 0..train.records.len() {
                    if !train.records[k].beginning.is_sought() {
                        continue;
                    }
                    let (input, _) = train.channels(k);
                    let (_, found) = past(input, |begins| left(&train, &fit, (k, begins)))?;
                    train.records[k].beginning = found;
                }
                fit = refit(&train, &fit, fit.effects.clone());
            }
            (fit.misfit - best.misfit < HALF * brought).then_some((fit.misfit, train))
        });
        let (_, train) = fewer.min_by(|(a, _), (b, _)| a.total_cmp(b))?;
        Some(train.records.into_iter().map(|r| r.beginning).collect())
    }

    /// This, or another where that is likelier.
    pub(super) fn or_likelier(self, other: Investigation) -> Investigation {
        let scale = self.dispersion().min(other.dispersion());
        match other.unlikeliness(scale) < self.unlikeliness(scale) {
            true => other,
            false => self,
        }
    }

    /// Twice the negative logarithm of the likelihood, whose misfit counts over a common dispersion, and `ln n` for
    /// every value that the model chose: those of its causes, of beginnings that are not a virgin joint's, and
    /// whether wear goes on; every cause is as unlikely as what is against the rule.
    fn unlikeliness(&self, dispersion: f64) -> f64 {
        let train = &self.bench.train;
        let (misfit, _) = train.misfit(&self.found.best.predict(train));
        let weights = train.records.iter().flat_map(|r| &r.weight);
        let innovations: f64 = weights.filter(|w| **w > 0.0).map(|w| -2.0 * w.ln()).sum();
        let causes = &self.found.best.effects;
        let of_causes: usize = causes.iter().map(Acting::free).sum();
        let of_beginnings: usize = self.beginnings().map(Beginning::values).sum();
        let values = (of_causes + of_beginnings + usize::from(train.wears_on)) as f64;
        let chosen = values * (train.rows().max(3) as f64).ln();
        innovations + misfit / dispersion + chosen + causes.len() as f64 * ALARM
    }
}
