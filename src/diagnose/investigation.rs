//! Records of one beginning with what was found in them, and how likely that is beside other beginnings.

use super::coarsely::trials_of;
use super::growing::{FURTHER_SHARE, leaves_structure};
use super::noise_of_all::NoiseOfAll;
use super::prepare::Bench;
use super::search::Found;
use super::trials::{ALARM, Effort, Trial, dispersion, implausible, penalty, trial_of};
use crate::causes::Cause;
use crate::identify::beginning::Beginning;
use crate::identify::past::{past, sharpened};
use crate::identify::{Fit, Problem, baseline, refit, without};
use crate::joint::effect::Acting;

/// Share of what a cause brought that other turns before the records may leave.
const HALF: f64 = 0.5;

/// Times that turns and joint are fitted to each other in turn.
const ROUNDS: usize = 3;

/// Multiple of what a search leaves beyond noise that the same records may leave when they begin otherwise, before
/// they are given up. Judged: exchanging causes, which comes later, takes a part of that.
const FAR: f64 = 4.0;

/// Part of the noise's variance that counts as left at least.
const SLIGHT: f64 = 0.1;

/// Records, and what was found in them.
pub struct Investigation {
    /// The records, with how each of them begins.
    pub bench: Bench,
    /// What the search found.
    pub found: Found,
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

impl Investigation {
    pub(super) fn beginnings(&self) -> impl Iterator<Item = &Beginning> {
        self.bench.train.records.iter().map(|r| &r.beginning)
    }

    /// True where the baseline leaves noise alone.
    pub(super) fn is_plain(&self) -> bool {
        self.found.names_none() && !leaves_structure(&self.bench.train, &self.found.best)
    }

    /// χ² per degree of freedom of what was found, at least one.
    pub(super) fn dispersion(&self) -> f64 {
        dispersion(&self.bench.train, &self.found.best)
    }

    /// What is left of every row, as a square of the judged channel.
    pub(super) fn left(&self) -> f64 {
        self.dispersion() * self.bench.innovation_square()
    }

    /// What other beginnings, drives or wear may leave of every row, as such a square, and still be asked further beside
    /// what was found here: [`FAR`] times as much beyond noise, or of all where noise is what the model leaves.
    pub(super) fn enough(&self) -> f64 {
        let rows = self.bench.train.rows().max(1) as f64;
        let beyond = (self.dispersion() - 1.0).max(SLIGHT + ALARM / rows);
        match (self.found.unasked, self.bench.noise_is_repeated()) {
            (true, _) => f64::INFINITY,
            (false, true) => self.bench.innovation_square() * (1.0 + FAR * beyond),
            (false, false) => FAR * self.left(),
        }
    }

    /// True where the joint goes on from record to record.
    pub(super) fn goes_on(&self) -> bool {
        self.beginnings().any(|b| b.goes_on)
    }

    pub(super) fn is_virgin(&self) -> bool {
        self.beginnings().all(Beginning::is_virgin)
    }

    /// True where other beginnings leave less beside the causes that were found, or no more beside fewer, until
    /// the first turns are known better on samples that do not hang on them.
    pub(super) fn may_be_beaten_by(&self, other: &Bench) -> bool {
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
        let fewer = |drop: usize| beside(best.others(drop)) < reached + margin;
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
            let asked = |cause: &dyn Cause| trial_of(&self.found.trials, cause.name()).is_some();
            let scale = &self.bench.scale;
            let tried = trials_of(asked, &other, scale, &plain, (Effort::Full, wanted));
            let left_here = |own: &Trial| train.misfit(&own.fit.predict(&train)).0;
            self.one_gains(left_here, &tried, wanted)
        };
        plain.misfit < reached + margin
            || beside(best.effects.clone()) < reached - taken
            || best.effects.len() > 1 && (0..best.effects.len()).any(fewer)
            || (several || structure) && one_alone()
    }

    /// True where a cause alone leaves less than a misfit beside other beginnings or another drive, and less than it
    /// leaves here: what was not taken here for another reason would not be there either.
    pub(super) fn one_gains(
        &self,
        left_here: impl Fn(&Trial) -> f64,
        there: &[Trial],
        wanted: f64,
    ) -> bool {
        let margin = ALARM * self.dispersion();
        let gains = |there: &Trial| {
            let own = trial_of(&self.found.trials, there.cause.name());
            own.is_none_or(|own| there.fit.misfit < left_here(own) - margin)
        };
        let mut less = there.iter().filter(|t| t.fit.misfit < wanted);
        less.any(gains)
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
    pub(super) fn other_past(&self) -> Option<Vec<Beginning>> {
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
                    let samples = input.len() as f64;
                    let beside = |begins: &Beginning| left(&train, &fit, (k, begins));
                    let (_, found) = past((input, samples), beside)?;
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
        match other.is_likelier_than(&self) {
            true => other,
            false => self,
        }
    }

    /// True where this is likelier than another.
    pub(super) fn is_likelier_than(&self, other: &Investigation) -> bool {
        let common = NoiseOfAll::of([self, other]);
        self.unlikeliness(common) < other.unlikeliness(common)
    }

    /// Twice the negative logarithm of the likelihood over that of noise of a common variance, whose misfit counts over a
    /// common dispersion, and `ln n` for every value that the model chose: those of its causes, of beginnings that are
    /// not a virgin joint's, and whether wear goes on; every cause is as unlikely as what is against the rule.
    ///
    /// A sample that one of two weighs and the other does not, held out or struck or behind a turn that nothing tells of,
    /// speaks for neither as far as it is noise.
    pub(super) fn unlikeliness(&self, common: NoiseOfAll) -> f64 {
        let train = &self.bench.train;
        let rows = train.rows() as f64;
        let (misfit, _) = train.misfit(&self.found.best.predict(train));
        let causes = &self.found.best.effects;
        let of_beginnings: usize = self.beginnings().map(Beginning::values).sum();
        let chosen = penalty(
            train,
            self.found.best.free() + of_beginnings + usize::from(train.wears_on),
        );
        self.bench.innovations() - rows * common.innovation + misfit / common.dispersion - rows
            + chosen
            + causes.len() as f64 * ALARM
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::prepare::prepare;
    use crate::diagnose::search::Begun;
    use crate::diagnose::search::tests::dashpot;
    use crate::diagnose::searched::searched;
    use crate::identify::Form;
    use crate::record::Record;
    use crate::record::noise::tests::drawn;

    /// A dashpot in white noise: what single causes leave here is no reason to search elsewhere if they leave as much
    /// there, be it less than is wanted.
    #[test]
    fn what_a_cause_leaves_here_as_well_is_no_gain_elsewhere() {
        let bench = dashpot(20261128);
        let plain = baseline(&bench.train);
        let asked = (true, f64::INFINITY);
        let here = searched(bench, (plain, Begun::default()), asked, &mut |_| ());
        let gains = |there: &[Trial], wanted: f64| here.one_gains(|t| t.fit.misfit, there, wanted);
        let mut there = here.found.trials.clone();
        assert!(there.len() > 10 && !gains(&there, f64::INFINITY));
        // The dashpot's rival, and by more than one model is likelier than another.
        there[1].fit.misfit -= 1.1 * ALARM * here.dispersion();
        assert!(gains(&there, f64::INFINITY));
        assert!(!gains(&there, there[1].fit.misfit));
    }

    /// Four times what is left beyond noise, of a model that leaves much as of one that leaves little.
    #[test]
    fn others_may_leave_more_before_their_causes_are_exchanged() {
        let bench = dashpot(20261130);
        let plain = baseline(&bench.train);
        let rows = bench.train.rows() as f64;
        let enough = |left: f64| {
            let misfit = left * rows;
            let best = Fit {
                misfit,
                ..plain.clone()
            };
            let mut found = Found::unasked(plain.clone(), best, Vec::new());
            found.unasked = false;
            let bench = bench.clone();
            let innovation = bench.innovation_square();
            Investigation { bench, found }.enough() / innovation
        };
        assert!((1.4..1.5).contains(&enough(1.0)), "{}", enough(1.0));
        assert!((enough(5.0) - 17.0).abs() < 1e-9);
    }

    /// Where the noise is what is left, every fit is judged by the weights that the last one gave.
    #[test]
    fn what_fits_leave_is_weighed_as_the_records_are() {
        let mut noise = drawn(20261128);
        let time: Vec<f64> = (0..1200).map(|i| 0.01 * f64::from(i)).collect();
        let force = |t: f64| 50.0 * (5.0 * t).sin() + 30.0 * (3.31 * t * (1.0 + 0.05 * t)).sin();
        let late = |t: &f64| 1e-8 * force(*t - 0.04) + 1e-8 * noise();
        let record = Record {
            name: "dashpot".to_string(),
            displacement: time.iter().map(late).collect(),
            force: time.iter().map(|t| force(*t)).collect(),
            time: Some(time),
            ..Record::default()
        };
        let bench = prepare(Form::Play, &[record], &[Beginning::default()]);
        assert!(!bench.noise_is_repeated());
        let plain = baseline(&bench.train);
        let asked = (true, f64::INFINITY);
        let Investigation { bench, found } =
            searched(bench, (plain, Begun::default()), asked, &mut |_| ());
        assert!(!found.best.effects.is_empty());
        let trials = found.trials.iter().map(|t| &t.fit);
        for fit in trials.chain([&found.best, &found.baseline]) {
            let (left, _) = bench.train.misfit(&fit.predict(&bench.train));
            assert!(
                (fit.misfit - left).abs() < 1e-6 * left,
                "{} {left}",
                fit.misfit
            );
        }
    }
}
