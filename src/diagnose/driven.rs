//! Whether the drive turns between its samples, asked again beside the causes that were found.

use super::coarsely::trials;
use super::growing::leaves_structure;
use super::however_worn::however_worn;
use super::investigation::Investigation;
use super::prepare::prepare;
use super::searched::quickly_searched;
use super::trials::{ALARM, Effort};
use crate::identify::beginning::Beginning;
use crate::identify::{Form, as_driven, baseline, refit_below};
use crate::record::Record;

/// Searches for causes in records however they begin and wear, with the drive as it leaves less between samples.
///
/// Where noise is what a model leaves, another drive is searched in full if a quick search makes it likelier.
pub(super) fn however_driven(
    (form, records): (Form, &[Record]),
    timed: bool,
    progress: &mut impl FnMut(&str),
) -> Investigation {
    let driven = as_driven(form, records);
    let first = however_worn((form, &driven), (timed, f64::INFINITY), progress);
    let otherwise: Vec<Record> = driven
        .into_iter()
        .map(|record| Record {
            straight: !record.straight,
            ..record
        })
        .collect();
    if !first.suits_another_drive(&otherwise, timed, progress) {
        return first;
    }
    progress("once more: the drive may do something else between its samples");
    let asked = (timed, first.enough());
    first.or_likelier(however_worn((form, &otherwise), asked, progress))
}

impl Investigation {
    /// True where the records may suit better a drive that does otherwise between its samples, beside causes: what joints
    /// without any leave tells little where a cause does much.
    ///
    /// A rarer drive is compared in any case where what it leaves was taken for noise.
    fn suits_another_drive(
        &self,
        otherwise: &[Record],
        timed: bool,
        progress: &mut impl FnMut(&str),
    ) -> bool {
        if self.found.best.effects.is_empty() {
            return false;
        }
        let repeated = self.bench.noise_is_repeated();
        let compared = !repeated && self.is_straight();
        (compared || self.leaves_less_otherwise_driven(timed))
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
    fn leaves_less_otherwise_driven(&self, timed: bool) -> bool {
        let best = &self.found.best;
        let mut train = self.bench.train.clone();
        let form = train.operators.form;
        for record in &mut train.records {
            record.between.straight = !record.between.straight;
            record.look_between(form);
        }
        let bound = best.misfit - ALARM * self.dispersion();
        if refit_below(&train, best, best.effects.clone(), bound).misfit < bound {
            return true;
        }
        if !self.is_straight() && !leaves_structure(&self.bench.train, best) {
            return false;
        }
        let (plain, effort) = (baseline(&train), (Effort::Full, bound));
        let alone = trials(&train, &self.bench.scale, timed, &plain, effort);
        self.one_gains(|own| own.fit.misfit, &alone, bound)
    }
}
