//! Records searched however they wear the joint: each one that was made new for it, or one joint through all.

use super::growing::{leaves_structure, structure_left};
use super::however_begun::{made_anew, one_leaves, sharply_searched};
use super::investigation::{Investigation, searched};
use super::judged_channel::form;
use super::prepare::{Bench, prepare};
use super::trials::{ALARM, Effort};

use crate::causes::Cause;
use crate::identify::beginning::Beginning;
use crate::identify::{Fit, baseline};
use crate::record::Record;

/// Said where wear of one record is taken to the next.
const WORN_ON: &str = "once more: wear may go on from record to record";

/// Searches for causes in records however they begin, and once more where wear may go on from one to the next.
///
/// What leaves more than `enough` of every row, as a square of the judged channel, is not asked further.
pub(super) fn however_worn(
    records: &[Record],
    (timed, enough): (bool, f64),
    progress: &mut impl FnMut(&str),
) -> Investigation {
    progress("noise and baseline");
    let form = form(records);
    let virgin = prepare(form, records, &vec![Beginning::default(); records.len()]);
    let first = baseline(&virgin.train);
    if let Some(on) = worn_by_one_cause((&virgin, &first), (timed, enough), progress) {
        return on;
    }
    let anew = made_anew(records, (virgin, first), (timed, enough), progress);
    if !anew.may_wear_on() {
        return anew;
    }
    progress(WORN_ON);
    let mut bench = anew.bench.clone();
    bench.wear_on();
    let first = anew.found.baseline.clone();
    let enough = enough.min(anew.enough());
    let on = sharply_searched(bench, first, (timed, enough), progress);
    anew.or_likelier(on)
}

/// What is found in records of virgin joints where wear goes on from one to the next, if one cause that wears leaves
/// noise alone and none does that is asked of joints made anew: several, which may, are less likely.
fn worn_by_one_cause(
    (virgin, first): (&Bench, &Fit),
    (timed, enough): (bool, f64),
    progress: &mut impl FnMut(&str),
) -> Option<Investigation> {
    let train = &virgin.train;
    if train.records.len() < 2 || !virgin.noise_is_repeated() || !leaves_structure(train, first) {
        return None;
    }
    let mut bench = virgin.clone();
    bench.wear_on();
    let usable = |cause: &dyn Cause| timed || !cause.needs_time();
    let wears = |cause: &dyn Cause| usable(cause) && cause.effect().lasting() > 0;
    let noise_alone = first.misfit - structure_left(train, first);
    if !one_leaves((&bench, first), wears, (Effort::Quick, noise_alone)) {
        return None;
    }
    progress(WORN_ON);
    let on = searched(bench, first.clone(), (timed, enough), progress);
    let one =
        on.found.best.effects.len() == 1 && !leaves_structure(&on.bench.train, &on.found.best);
    let near = on.found.best.misfit + ALARM * on.dispersion();
    (one && !one_leaves((virgin, first), usable, (Effort::Full, near))).then_some(on)
}
