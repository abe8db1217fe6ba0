//! Whether the drive turns between its samples, asked again beside the causes that were found.

use super::investigation::{Investigation, however_worn};
use super::prepare::form;
use super::trials::ALARM;
use crate::identify::{as_driven, refit_below};
use crate::record::Record;

/// Searches for causes in records however they begin and wear, with the drive as it leaves less between samples.
pub(super) fn however_driven(
    records: &[Record],
    timed: bool,
    progress: &mut impl FnMut(&str),
) -> Investigation {
    let driven = as_driven(form(records), records);
    let first = however_worn(&driven, timed, progress);
    if !first.suits_another_drive() {
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
    first.or_likelier(however_worn(&otherwise, timed, progress))
}

impl Investigation {
    /// True where the causes that were found leave less beside a drive that does otherwise between its samples: what
    /// joints without any cause leave tells little where a cause does much.
    fn suits_another_drive(&self) -> bool {
        let best = &self.found.best;
        if best.effects.is_empty() {
            return false;
        }
        let mut train = self.bench.train.clone();
        let form = train.operators.form;
        for record in &mut train.records {
            record.between.straight = !record.between.straight;
            record.look_between(form);
        }
        let bound = best.misfit - ALARM * self.dispersion();
        refit_below(&train, best, best.effects.clone(), bound).misfit < bound
    }
}
