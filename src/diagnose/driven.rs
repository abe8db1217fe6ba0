//! Whether the drive turns between its samples, asked again beside the causes that were found.

use super::coarsely::{trials, trials_again};
use super::growing::leaves_structure;
use super::however_worn::however_worn;
use super::investigation::Investigation;
use super::prepare::prepare;
use super::searched::quickly_searched;
use super::trials::{ALARM, Effort, Trial, dispersion};
use super::virgin::Virgin;
use crate::identify::beginning::Beginning;
use crate::identify::operators::Operators;
use crate::identify::{Fit, Form, Problem, as_driven, baseline, refit_below};
use crate::record::Record;

/// Every cause alone beside another drive, and the cells that those are of.
type Known = (Vec<Trial>, Operators);

/// Searches for causes in records however they begin and wear, with the drive as it leaves less between samples.
///
/// Where noise is what a model leaves, another drive is searched in full if a quick search makes it likelier.
pub(super) fn however_driven(
    (form, records): (Form, &[Record]),
    timed: bool,
    progress: &mut impl FnMut(&str),
) -> Investigation {
    let mut driven = as_driven(form, records);
    let mut virgin = Virgin::of((form, &driven), timed, progress);
    let mut otherwise = otherwise_driven(&driven);
    let mut known = None;
    if virgin.suits_another_drive() {
        std::mem::swap(&mut driven, &mut otherwise);
        known = virgin
            .alone
            .take()
            .map(|alone| (alone, virgin.bench.train.operators));
        virgin = Virgin::of((form, &driven), timed, progress);
    }
    let first = however_worn((&driven, virgin), (timed, f64::INFINITY), progress);
    if !first.suits_another_drive((&otherwise, known), timed, progress) {
        return first;
    }
    progress("once more: the drive may do something else between its samples");
    let (asked, virgin) = (
        (timed, first.enough()),
        Virgin::of((form, &otherwise), timed, progress),
    );
    first.or_likelier(however_worn((&otherwise, virgin), asked, progress))
}

/// The records with a drive that does otherwise between its samples.
fn otherwise_driven(records: &[Record]) -> Vec<Record> {
    let other = |record: &Record| Record {
        straight: !record.straight,
        ..record.clone()
    };
    records.iter().map(other).collect()
}

/// The same of what a fit is made to.
fn train_otherwise_driven(train: &Problem) -> Problem {
    let mut other = train.clone();
    for record in &mut other.records {
        record.between.straight = !record.between.straight;
        record.look_between(train.operators.form);
    }
    other
}

/// Misfit below which the same is likelier than a fit.
fn likelier_below(train: &Problem, fit: &Fit) -> f64 {
    fit.misfit - ALARM * dispersion(train, fit)
}

/// True where the causes of a fit leave less than a misfit of another problem.
pub(super) fn leaves_less(other: &Problem, fit: &Fit, misfit: f64) -> bool {
    refit_below(other, fit, fit.effects.clone(), misfit).misfit < misfit
}

impl Virgin {
    /// True where the likeliest cause alone leaves less beside another drive, by as much as makes a model likelier: what
    /// joints without any cause leave had told which drive it is.
    fn suits_another_drive(&self) -> bool {
        self.likeliest_alone().is_some_and(|own| {
            let train = &self.bench.train;
            let bound = likelier_below(train, &own.fit);
            let other = train_otherwise_driven(train);
            leaves_less(&other, &own.fit, bound)
        })
    }
}

impl Investigation {
    /// True where the records may suit better a drive that does otherwise between its samples, beside causes: what joints
    /// without any leave tells little where a cause does much.
    ///
    /// A rarer drive is compared in any case where what it leaves was taken for noise. Every cause alone beside the other
    /// drive may be `known`.
    fn suits_another_drive(
        &self,
        (otherwise, known): (&[Record], Option<Known>),
        timed: bool,
        progress: &mut impl FnMut(&str),
    ) -> bool {
        if self.found.best.effects.is_empty() {
            return false;
        }
        let repeated = self.bench.noise_is_repeated();
        let compared = !repeated && self.is_straight();
        (compared || self.leaves_less_otherwise_driven(timed, known))
            && (repeated || self.quick_search_likes(otherwise, timed, progress))
    }

    fn is_straight(&self) -> bool {
        let mut records = self.bench.train.records.iter();
        records.any(|r| r.between.straight)
    }

    /// True where a quick search, or the causes that were found, make another drive likelier.
    ///
    /// What noise is has to be told anew: another cause may have explained as much beside the wrong drive.
    fn quick_search_likes(
        &self,
        otherwise: &[Record],
        timed: bool,
        progress: &mut impl FnMut(&str),
    ) -> bool {
        let train = &self.bench.train;
        let begin: Vec<Beginning> = self.beginnings().cloned().collect();
        let mut bench = prepare(train.operators.form, otherwise, &begin);
        if train.wears_on {
            bench.wear_on();
        }
        let given = &self.found.best.effects;
        quickly_searched(bench, timed, given, progress).is_likelier_than(self)
    }

    /// True where the causes that were found, or another one alone, leave less beside the other drive.
    ///
    /// Another cause is asked for where the drive is the rarer one, or where what was found leaves structure.
    fn leaves_less_otherwise_driven(&self, timed: bool, known: Option<Known>) -> bool {
        let best = &self.found.best;
        let train = train_otherwise_driven(&self.bench.train);
        let bound = likelier_below(&self.bench.train, best);
        if leaves_less(&train, best, bound) {
            return true;
        }
        if !self.is_straight() && !leaves_structure(&self.bench.train, best) {
            return false;
        }
        let (plain, effort) = (baseline(&train), (Effort::Full, bound));
        let scale = &self.bench.scale;
        let alone = match known {
            Some((known, cells)) => trials_again((&known, &cells), (&train, scale), &plain, effort),
            None => trials(&train, scale, timed, &plain, effort),
        };
        self.one_gains(|own| own.fit.misfit, &alone, bound)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;
    use crate::joint::effect::Acting;
    use crate::record::noise::tests::drawn;
    use std::f64::consts::TAU;

    /// A joint with a spring that hardens in white noise, 17 samples a cycle, that felt no tips between them.
    fn hardened(seed: u64) -> Record {
        let load = |i: usize| (i as f64 / 800.0).min(1.0) * (TAU * i as f64 / 17.3).sin();
        let mut record = Record {
            name: "hardened".to_string(),
            displacement: vec![0.0; 1600],
            force: (0..1600).map(load).collect(),
            time: Some((0..1600).map(|i| 0.01 * f64::from(i)).collect()),
            straight: true,
            ..Record::default()
        };
        let plain = Problem::new(Form::Play, std::slice::from_ref(&record));
        let mut joint = vec![0.02; plain.operators.columns()];
        joint[0] = 1.0;
        let effect = find("cubic_stiffness").unwrap().effect();
        let mut noise = drawn(seed);
        let mut values = vec![0.0; effect.parameters().len()];
        values[0] = 0.3;
        let answer = &plain.predict(&joint, &[Acting { effect, values }])[0].judged;
        record.displacement = answer.iter().map(|u| u + 0.003 * noise()).collect();
        record
    }

    /// What joints without a cause leave of it tells nothing of its drive; beside the spring that is plain.
    #[test]
    fn the_likeliest_cause_alone_tells_what_the_drive_does() {
        let straight = [hardened(20261130)];
        let asked = |records: &[Record]| {
            Virgin::of((Form::Play, records), true, &mut |_| {}).suits_another_drive()
        };
        assert!(!asked(&straight));
        assert!(asked(&otherwise_driven(&straight)));
    }
}
