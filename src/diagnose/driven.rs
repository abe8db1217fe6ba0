//! Whether the drive turns between its samples, asked again beside the causes that were found.

use super::growing::leaves_structure;
use super::however_worn::however_worn;
use super::investigation::{Investigation, quickly_searched};
use super::judged_channel::form;
use super::prepare::prepare;
use super::trials::{ALARM, Effort, one_leaves, trials};
use crate::identify::beginning::Beginning;
use crate::identify::{as_driven, baseline, refit_below};
use crate::record::Record;

/// Searches for causes in records however they begin and wear, with the drive as it leaves less between samples.
///
/// Where noise is what a model leaves, another drive is searched in full if a quick search makes it likelier.
pub(super) fn however_driven(
    records: &[Record],
    timed: bool,
    progress: &mut impl FnMut(&str),
) -> Investigation {
    let driven = as_driven(form(records), records);
    let first = however_worn(&driven, (timed, f64::INFINITY), progress);
    if !first.suits_another_drive(timed) {
        return first;
    }
    progress("once more: the drive may do something else between its samples");
    let otherwise: Vec<Record> = driven
        .into_iter()
        .map(|record| Record {
            straight: !record.straight,
            ..record
        })
        .collect();
    if !first.bench.noise_is_repeated() {
        // What noise is has to be told anew: another cause may have explained as much beside the wrong drive.
        let begin: Vec<Beginning> = first.beginnings().cloned().collect();
        let mut bench = prepare(form(records), &otherwise, &begin);
        if first.bench.train.wears_on {
            bench.wear_on();
        }
        let given = &first.found.best.effects;
        if !quickly_searched(bench, timed, given, progress).is_likelier_than(&first) {
            return first;
        }
    }
    let asked = (timed, first.enough());
    first.or_likelier(however_worn(&otherwise, asked, progress))
}

impl Investigation {
    /// True where the causes that were found, or another one alone, leave less beside a drive that does otherwise
    /// between its samples: what joints without any cause leave tells little where a cause does much.
    ///
    /// Another cause is asked for where the drive is the rarer one, or where what was found leaves structure; without
    /// asking, a rarer drive is compared where what it leaves was taken for noise.
    fn suits_another_drive(&self, timed: bool) -> bool {
        let best = &self.found.best;
        if best.effects.is_empty() {
            return false;
        }
        let mut train = self.bench.train.clone();
        let straight = train.records.iter().any(|r| r.between.straight);
        if straight && !self.bench.noise_is_repeated() {
            return true;
        }
        let form = train.operators.form;
        for record in &mut train.records {
            record.between.straight = !record.between.straight;
            record.look_between(form);
        }
        let bound = best.misfit - ALARM * self.dispersion();
        if refit_below(&train, best, best.effects.clone(), bound).misfit < bound {
            return true;
        }
        if !straight && !leaves_structure(&self.bench.train, best) {
            return false;
        }
        let (plain, effort) = (baseline(&train), (Effort::Full, bound));
        let alone = trials(&train, &self.bench.scale, timed, &plain, effort);
        one_leaves(&alone, bound)
    }
}
